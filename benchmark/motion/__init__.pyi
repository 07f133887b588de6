from .cells import find_cell
from .made import MadeMotion, entrant_motion
from .writing import require_new, write

__all__ = ["MadeMotion", "entrant_motion", "find_cell", "require_new", "write"]
