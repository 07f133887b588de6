"""How often `mocapbench fill` says "more than chance" of equal models: `equal_models.py [PAGE]`.

A simulated file is a random walk in three channels with a little noise. One model fills a gap by a
line with a bow above it, and another with the same bow below it, so that neither is better. With a
lead, the first one's bow is half as high.

Prints the table, and writes it into the page if one is given.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from mocapbench.benchmark.filling.choosing.hold_outs import HoldOut, make_hold_outs
from mocapbench.benchmark.filling.choosing.ranking import Ranking, number_positions, rank
from mocapbench.benchmark.filling.choosing.scores import list_gaps, score_gaps, weigh_gaps
from mocapbench.benchmark.filling.gap_problem import GapProblem, PredictedEntries
from mocapbench.benchmark.filling.gaps import find_gaps
from mocapbench.datasets import Mask, Recording

sys.path.insert(0, str(Path(__file__).parents[1] / "speed"))
from page import place, table

__all__ = ["files", "rankings", "report", "told_apart"]

SEED = 20_240_603
N_FILES = 1000
HEIGHT, LEAD = 0.5, 0.25
ALL = (0, 1, 2)
SHORT = tuple((400 + 100 * n, 405 + 100 * n, (0,)) for n in range(8))
FILES = {
    "1500 frames, a gap of 15": (1500, ((700, 715, ALL),)),
    "120 frames, a gap of 40": (120, ((40, 80, ALL),)),
    "200 frames, a gap of 60": (200, ((70, 130, ALL),)),
    "300 frames, a gap of 60": (300, ((120, 180, ALL),)),
    "600 frames, a gap of 90": (600, ((200, 290, ALL),)),
    "600 frames, three gaps of 30": (
        600,
        ((100, 130, ALL), (250, 280, ALL), (400, 430, ALL)),
    ),
    "1500 frames, a gap of 90, eight of 5 in one channel": (1500, ((200, 290, ALL), *SHORT)),
}


def files(name: str, n_files: int) -> Iterator[GapProblem]:
    """Yield files of one kind, with their gaps."""
    n_frames, gaps = FILES[name]
    target = np.zeros((n_frames, len(ALL)), dtype=bool)
    for start, stop, channels in gaps:
        target[start:stop, channels] = True
    times = np.arange(n_frames) / 30
    rng = np.random.default_rng([SEED, n_frames, len(gaps)])
    for _ in range(n_files):
        walk = np.cumsum(rng.normal(size=n_frames))[:, None]
        values = walk + rng.normal(0.0, 0.05, target.shape)
        yield GapProblem(
            Recording("r", times, values, ("a", "b", "c"), ("mm",) * 3).hide(target), target
        )


def rankings(problem: GapProblem, lead: float = 0.0) -> tuple[Ranking, Ranking]:
    """Return the ranking of both models, with each held-out gap as a unit, then each position."""
    hold_outs = make_hold_outs(problem, np.random.default_rng(0))
    gaps, heights = list_gaps(hold_outs), {"above": HEIGHT - lead, "below": -HEIGHT}
    errors = {
        model: score_gaps(hold_outs, [_fill(hold_out, height) for hold_out in hold_outs])
        for model, height in heights.items()
    }
    weights, positions = weigh_gaps(gaps), number_positions(gaps)
    return rank(errors, weights, np.arange(len(positions))), rank(errors, weights, positions)


def _fill(hold_out: HoldOut, height: float) -> PredictedEntries:
    values = hold_out.problem.given.values
    filled = np.column_stack([_line(column) for column in values.T])
    filled += height * _bows(~np.isfinite(values))
    return PredictedEntries(filled[hold_out.problem.target], None)


def _line(column: np.ndarray) -> np.ndarray:
    frames, seen = np.arange(len(column)), np.isfinite(column)
    return np.interp(frames, frames[seen], column[seen])


def _bows(hidden: Mask) -> np.ndarray:
    """Return a bow over each gap, which is as high as a random walk strays from the line."""
    bows = np.zeros(hidden.shape)
    for gap in find_gaps(hidden):
        along = np.arange(1, len(gap) + 1) / (len(gap) + 1)
        bow = np.sqrt(len(gap)) * 4.0 * along * (1.0 - along)
        bows[gap.start : gap.stop, list(gap.channels)] = bow[:, None]
    return bows


def told_apart(found: Sequence[Ranking]) -> float:
    """Return the share of rankings of which a page says "more than chance"."""
    return float(np.mean([ranking.tested and len(ranking.sharing) == 1 for ranking in found]))


def _rows() -> Iterator[list[str]]:
    for name in FILES:
        asked = list(files(name, N_FILES))
        alone, placed = zip(*(rankings(problem) for problem in asked), strict=True)
        _, better = zip(*(rankings(problem, LEAD) for problem in asked), strict=True)
        sizes = (placed[0].n_gaps, placed[0].n_positions)
        shares = (f"{100.0 * told_apart(found):.1f} %" for found in (alone, placed, better))
        yield [name, *map(str, sizes), *shares]


def report() -> str:
    """Return the table."""
    head = [
        "file",
        "held-out gaps",
        "independent positions",
        "each gap a unit",
        "each position a unit",
        "and a lead",
    ]
    return table(head, _rows())


if __name__ == "__main__":
    text = report()
    print(text)
    for page in sys.argv[1:]:
        place(Path(page), "equal-models", text)
