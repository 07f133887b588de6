"""Names of array types; those of more than one axis are stated where they are used."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Index", "Mask"]

Array = NDArray[np.float64]
"""Real numbers."""
Index = NDArray[np.intp]
"""Positions in another array."""
Mask = NDArray[np.bool_]
"""True or False for each entry of another array."""
