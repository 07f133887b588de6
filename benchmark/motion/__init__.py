"""The motion of one entrant, as a file: GIF, AMC, BVH or CSV."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
