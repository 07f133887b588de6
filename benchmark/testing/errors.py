"""The error of a failed check, and how checks raise it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import ArrayLike

from mocapbench.benchmark.messages import reason

__all__ = [
    "ConformanceError",
    "global_randomness_untouched",
    "raised_by",
    "require",
    "require_equal",
]


class ConformanceError(Exception):
    """Something does not keep what its protocol promises; the message says what to do."""


def require(condition: object, expected: str, got: object, advice: str) -> None:
    """Raise a `ConformanceError` unless ``condition`` holds."""
    if not condition:
        raise ConformanceError(f"expected {expected}, got {got}: {advice}")


def require_equal(one: ArrayLike, two: ArrayLike, expected: str, advice: str) -> None:
    """Raise a `ConformanceError` unless two arrays are the same, NaN where the other is NaN."""
    a, b = np.asarray(one, dtype=np.float64), np.asarray(two, dtype=np.float64)
    require(a.shape == b.shape, expected, f"shapes {a.shape} and {b.shape}", advice)
    same = np.array_equal(a, b, equal_nan=True)
    require(same, expected, f"differences in {int((a != b).sum())} of {a.size} values", advice)


@contextmanager
def raised_by(name: str, promise: str) -> Iterator[None]:
    """Turn whatever is raised inside into a `ConformanceError` of ``name``."""
    try:
        yield
    except ConformanceError as error:
        raise ConformanceError(f"{name}: {error}") from error
    except (Exception, SystemExit) as error:  # else the tests would end, with exit code 0
        raise ConformanceError(f"{name}: expected that {promise}, got {reason(error)}") from error


@contextmanager
def global_randomness_untouched() -> Iterator[None]:
    """Raise a `ConformanceError` if NumPy's global random state was used or seeded inside."""
    before = np.random.get_state()[1].copy()  # type: ignore[index]  # noqa: NPY002
    yield
    after = np.random.get_state()[1]  # type: ignore[index]  # noqa: NPY002
    advice = "draw from numpy.random.default_rng(self.random_state)"
    require_equal(before, after, "NumPy's global random state untouched", advice)
