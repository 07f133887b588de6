"""How much wider a scale inferred from few values makes predictions."""

from __future__ import annotations

__all__ = ["student_variance"]


def student_variance(n_values: int) -> float:
    """Return the variance of Student's t, with as many degrees of freedom, of unit scale.

    It is n / (n − 2), which is infinite for n = 2 and has no meaning below. With one or two values
    it is that of three: no more values ever make it larger.

    Examples
    --------
    >>> [student_variance(n) for n in (1, 2, 3, 4, 6)]
    [3.0, 3.0, 3.0, 2.0, 1.5]
    """
    n_counted = max(n_values, 3)
    return n_counted / (n_counted - 2)
