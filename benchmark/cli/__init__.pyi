from .failures import explain, show_warning

__all__ = ["explain", "show_warning"]
