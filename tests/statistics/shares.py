"""How often equal means are told apart where units weigh unequally: `python shares.py [PAGE]`.

Simulated are people of whom there are unequally many recordings. The differences of two entrants
have the mean 0: a part is shared by all recordings of a person, and every recording adds its own.
The intraclass correlation (ICC) is the share of the variance that is of people. Each recording
weighs the same in the mean. In a second table are strongly skewed differences of equal units.

Prints the tables, and writes them into the page if one is given.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.statistics import ALPHA, UnitMeans, too_few, unit_means

sys.path.insert(0, str(Path(__file__).parents[1] / "speed"))
from page import place, table

__all__ = ["by_number", "differences", "heavy", "normal", "rate", "report", "skewed"]

SEED = 20_240_602
N_RUNS = 20_000
RECORDINGS = (
    (1, 1, 1, 1, 1),
    (1, 2, 1, 2, 2),
    (4, 1, 1, 1, 1),
    (10, 1, 1, 1, 1),
    (31, 2, 2, 2, 2),
    (4, 4, 1, 1, 1, 1),
    (6, 4, 1, 1, 1, 1, 1, 1),
    (10, *[1] * 11),
    (10, 10, 10, *[1] * 9),
    (20, 20, 20, *[1] * 18),
)
CORRELATIONS = (0.3, 1.0)
SIGMA = 1.5
SAMPLES = (5, 12, 50)

Array = NDArray[np.float64]
Noise = Callable[[np.random.Generator, tuple[int, ...]], Array]


def normal(rng: np.random.Generator, shape: tuple[int, ...]) -> Array:
    """Return standard normal values."""
    return rng.standard_normal(shape)


def heavy(rng: np.random.Generator, shape: tuple[int, ...]) -> Array:
    """Return values with heavy tails: Student's t with 3 degrees of freedom, of variance 1."""
    return rng.standard_t(3, shape) / np.sqrt(3.0)


def skewed(rng: np.random.Generator, shape: tuple[int, ...]) -> Array:
    """Return log-normal values less their mean."""
    return rng.lognormal(0.0, SIGMA, shape) - np.exp(SIGMA**2 / 2.0)


def differences(recordings: Sequence[int], correlation: float, noise: Noise = normal) -> Array:
    """Return the mean differences of people whose true mean is 0, of shape (N_RUNS, people)."""
    rng = np.random.default_rng([SEED, *recordings, int(100 * correlation)])
    shared = noise(rng, (N_RUNS, len(recordings)))
    own = [noise(rng, (N_RUNS, count)).mean(axis=1) for count in recordings]
    return np.sqrt(correlation) * shared + np.sqrt(1.0 - correlation) * np.stack(own, axis=1)


def by_number(values: Array, shares: Array) -> UnitMeans:
    """Return means with n − 1 degrees of freedom, as if the n units had equal shares."""
    n, mean = len(shares), values @ shares
    squares = (shares * (values - mean[:, None])) ** 2
    error = np.sqrt(n / (n - 1) * squares.sum(axis=1))
    return UnitMeans(mean, error, np.full(len(mean), n - 1.0))


NOISES = (normal, heavy)
RULES = (by_number, unit_means)


def rate(means: UnitMeans) -> float:
    """Return in which share of runs the mean is called other than 0."""
    return float(np.mean(means.p <= ALPHA))


def _rows() -> Iterator[list[str]]:
    for recordings in RECORDINGS:
        shares = np.array(recordings) / sum(recordings)
        worth = float(unit_means(np.zeros(len(shares)), shares).freedom) + 1.0
        tested = "no" if too_few(worth - 1.0) else "yes"
        samples = (
            differences(recordings, each, noise) for noise in NOISES for each in CORRELATIONS
        )
        rates = ([100.0 * rate(rule(s, shares)) for rule in RULES] for s in samples)
        written = [f"{plain:.1f}, {general:.1f} %" for plain, general in rates]
        yield [_listed(recordings), f"{worth:.2f}", tested, *written]


def _listed(recordings: Sequence[int]) -> str:
    counts = {count: recordings.count(count) for count in recordings}
    if len(recordings) <= 6:
        return ", ".join(map(str, recordings))
    return ", ".join(f"{times} × {count}" for count, times in counts.items())


def _skewed_rows() -> Iterator[list[str]]:
    for n in SAMPLES:
        found = unit_means(differences([1] * n, 1.0, skewed), np.full(n, 1.0 / n))
        yield [str(n), f"{100.0 * rate(found):.0f} %"]


def report() -> tuple[str, str]:
    """Return the tables of unequal shares and of skewed differences."""
    head = ["recordings", "worth", "tested"]
    head += [f"{noise.__name__}, ICC {each:g}" for noise in NOISES for each in CORRELATIONS]
    return table(head, _rows()), table(["units", "false alarms"], _skewed_rows())


if __name__ == "__main__":
    texts = dict(zip(("shares", "skewed"), report(), strict=True))
    print("\n\n".join(texts.values()))
    for page in sys.argv[1:]:
        for name, text in texts.items():
            place(Path(page), name, text)
