from .cells import find_cell
from .made import EntrantMotion, entrant_motion
from .writing import require_new, write

__all__ = ["EntrantMotion", "entrant_motion", "find_cell", "require_new", "write"]
