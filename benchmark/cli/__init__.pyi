from .failures import exit_code, explain, show_warning

__all__ = ["exit_code", "explain", "show_warning"]
