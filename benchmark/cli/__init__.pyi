from .failures import explain

__all__ = ["explain"]
