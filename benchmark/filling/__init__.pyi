from .able import require_able
from .filler import BEST, Filled, fill
from .page import page_of
from .requests.request import NamedEntries
from .sources import Source, read_sources
from .trials.choice import require_room
from .wording import headline, remarks, verdict
from .workers import Workers
from .writing import Outputs, outputs_of, write

__all__ = [
    "BEST",
    "Filled",
    "NamedEntries",
    "Outputs",
    "Source",
    "Workers",
    "fill",
    "headline",
    "outputs_of",
    "page_of",
    "read_sources",
    "remarks",
    "require_able",
    "require_room",
    "verdict",
    "write",
]
