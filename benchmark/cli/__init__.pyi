from .commands import COMMANDS, app
from .ending.failures import exit_code, explain, show_warning

__all__ = ["COMMANDS", "app", "exit_code", "explain", "show_warning"]
