"""Checks of recordings before anything is filled: gaps, spikes, swaps and segments' lengths.

`check_file` reads a file and finds what a careful technician would look for, and `describe_check`
says it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
