"""The numbers of a C3D file, which are those of Intel, DEC or MIPS computers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["PROCESSORS", "Processor"]

_FRACTION_BITS = 24  # of a DEC F_float, of which the first is always 1 and is not stored
_EXPONENT_OF_ONE = 128


@dataclass(frozen=True)
class Processor:
    """How a computer stores numbers.

    Parameters
    ----------
    order : str
        Of the bytes of a 16-bit word: ``"<"`` or ``">"``.
    stored : dtype
        Of a floating-point number in the file.
    largest : float
        That can be stored.
    decode : callable
        Returns the floating-point numbers that are stored, NaN where there is no valid one.
    encode : callable
        Returns what is to be stored for finite numbers up to the largest.
    """

    order: str
    stored: np.dtype[Any]
    largest: float
    decode: Callable[[NDArray[Any]], NDArray[np.float64]]
    encode: Callable[[NDArray[np.float64]], NDArray[Any]]


def _decode_ieee(stored: NDArray[Any]) -> NDArray[np.float64]:
    with np.errstate(invalid="ignore"):  # signalling NaN
        return stored.astype(np.float64)


def _encode_ieee(values: NDArray[np.float64]) -> NDArray[Any]:
    return values.astype(np.float32)


def _decode_dec(stored: NDArray[Any]) -> NDArray[np.float64]:
    """Return the values of DEC F_floats.

    The word with sign, exponent e and the high bits of the fraction comes first. The value is
    0.1f × 2^(e − 128) in binary, or 0 if e = 0 (VAX Architecture Reference Manual, Leonard 1987).
    DEC computers have no NaN: programs for other computers that write one, or infinity, into such a
    file leave the largest exponent, 1e38 and more, which is no measurement.
    """
    bits = (stored >> 16) | (stored << 16)
    exponent = ((bits >> 23) & 0xFF).astype(np.int32)
    fraction = ((bits & 0x7FFFFF) | 0x800000).astype(np.float64)
    sizes = np.ldexp(fraction, exponent - _EXPONENT_OF_ONE - _FRACTION_BITS)
    sizes = np.where(exponent == 0, 0.0, np.where(exponent == 0xFF, np.nan, sizes))
    return np.where(bits >> 31, -sizes, sizes)


def _encode_dec(values: NDArray[np.float64]) -> NDArray[Any]:
    # Rounded to 24 bits first, as that may carry into the exponent; frexp gives 0.1f, as DEC has.
    fraction, exponent = np.frexp(values.astype(np.float32).astype(np.float64))
    whole = np.ldexp(np.abs(fraction), _FRACTION_BITS).astype(np.uint32) & 0x7FFFFF
    high = (exponent + _EXPONENT_OF_ONE).clip(0, 0xFF).astype(np.uint32) << 23
    bits = high | whole | (np.signbit(values).astype(np.uint32) << 31)
    bits = np.where((fraction == 0) | (high == 0), np.uint32(0), bits)
    return (bits >> 16) | (bits << 16)


_LARGEST_IEEE = float(np.finfo(np.float32).max)
_LARGEST_DEC = _LARGEST_IEEE / 4  # below the exponent that stands for no number

PROCESSORS: Mapping[int, Processor] = {
    84: Processor("<", np.dtype("<f4"), _LARGEST_IEEE, _decode_ieee, _encode_ieee),  # Intel
    85: Processor("<", np.dtype("<u4"), _LARGEST_DEC, _decode_dec, _encode_dec),  # DEC
    86: Processor(">", np.dtype(">f4"), _LARGEST_IEEE, _decode_ieee, _encode_ieee),  # SGI, MIPS
}
"""By the number that the file's parameters begin with."""
