"""What it costs each model to fill gaps: `benchmark/filling/costs.csv`.

Every able model fills made recordings of joints and of markers, with and without calibration,
and its processor time is measured, that of processes which it starts included; other work on the
machine hardly changes it. A power law of the sizes of the problem is fitted to the logarithms::

    export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
    python docs/evidence/fill_costs.py measure MEASURED.csv [MODEL ...]
    python docs/evidence/fill_costs.py fit MEASURED.csv  # writes rows of the table, prints how good

Measurements are added to those that a file has. A fill is stopped after a minute; problems that
are larger in every size are then left out, and what they cost is extrapolated. All take some hours.
"""

from __future__ import annotations

import itertools
import resource
import sys
from collections.abc import Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from mocapbench.basics.child import ProcessDiedError, call_in_child
from mocapbench.benchmark.filling.candidates import find_candidates
from mocapbench.benchmark.filling.costs import (
    START,
    TABLE,
    Sizes,
    count_seconds,
    measure_sizes,
)
from mocapbench.benchmark.filling.fill_attempt import attempt_fill
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.registry import MODELS, build_unfitted, find_calibration
from mocapbench.datasets import Recording

Array = NDArray[np.float64]

METHODS = ("impute_uncalibrated", "impute")
LONGEST = 60
"""Seconds of processor time after which a fill is stopped."""
MEMORY = 8 * 2**30
"""Bytes of address space."""
RATE = 100.0
"""Frames per second."""


class Grid(NamedTuple):
    """A made problem: its kind, sizes, what each gap hides, and the number of training files."""

    kind: str
    frames: int
    channels: int
    gaps: int
    length: int
    extent: str
    train: int = 0


GRID = (
    Grid("joints", 150, 9, 1, 5, "limb"),
    Grid("joints", 150, 9, 3, 20, "frames"),
    Grid("markers", 150, 30, 2, 20, "limb"),
    Grid("joints", 300, 62, 4, 20, "frames"),
    Grid("markers", 150, 120, 4, 10, "frames"),
    Grid("joints", 600, 30, 10, 5, "limb"),
    Grid("markers", 600, 60, 4, 60, "one"),
    Grid("joints", 300, 30, 4, 20, "frames", 3),
    Grid("markers", 600, 120, 10, 20, "limb"),
    Grid("joints", 1000, 62, 1, 100, "frames"),
    Grid("markers", 300, 240, 4, 20, "limb"),
    Grid("joints", 2000, 9, 40, 5, "limb"),
    Grid("markers", 1000, 60, 10, 20, "limb", 3),
    Grid("joints", 2000, 30, 10, 60, "frames"),
    Grid("markers", 2000, 120, 10, 300, "one"),
    Grid("joints", 4000, 62, 120, 5, "frames"),
    Grid("markers", 3000, 120, 24, 40, "one"),
    Grid("markers", 4000, 120, 40, 20, "limb"),
    Grid("joints", 8000, 62, 10, 300, "frames"),
    Grid("markers", 8000, 30, 120, 20, "one"),
    Grid("markers", 12000, 120, 10, 60, "frames"),
    Grid("joints", 36000, 9, 40, 60, "frames"),
    Grid("joints", 36000, 62, 120, 20, "limb"),
    Grid("markers", 36000, 120, 120, 20, "limb"),
    Grid("markers", 12000, 240, 40, 100, "one"),
)


def make_problem(grid: Grid) -> GapProblem:
    """Return a made recording with gaps, and training recordings half as long."""
    rng = np.random.default_rng(0)
    make = {"joints": _make_joints, "markers": _make_markers}[grid.kind]
    whole, *train = (
        make(rng, f"made-{number}", n_frames, grid.channels)
        for number, n_frames in enumerate((grid.frames, *[grid.frames // 2] * grid.train))
    )
    target = np.zeros(whole.values.shape, dtype=bool)
    starts = np.linspace(0, grid.frames, grid.gaps + 2)[1:-1] - grid.length / 2
    for number, start in enumerate(starts.astype(int)):
        target[start : start + grid.length, _choose_channels(grid, number)] = True
    return GapProblem(whole.hide(target), target, tuple(train))


def _choose_channels(grid: Grid, number: int) -> NDArray[np.intp]:
    """Return what a gap hides: all, twelve channels of a limb, or a joint or marker."""
    width = {"frames": grid.channels, "limb": min(12, grid.channels // 3), "one": 3}[grid.extent]
    return (np.arange(width) + 3 * number * (width // 3)) % grid.channels


def _make_courses(rng: np.random.Generator, n_frames: int, count: int) -> Array:
    """Return smooth courses of about unit variance: a gait's harmonics, and slow drift (N, K)."""
    phase = 2 * np.pi * np.cumsum(1 + 0.1 * _make_drift(rng, n_frames, 1), axis=0) / RATE
    harmonics = np.hstack([np.sin(phase * k + rng.uniform(0, 6)) / k for k in (1, 1, 2, 2, 3)])
    latent = np.hstack([harmonics, _make_drift(rng, n_frames, 5)])
    return latent @ rng.normal(size=(latent.shape[1], count)) / 2


def _make_drift(rng: np.random.Generator, n_frames: int, count: int) -> Array:
    drift: Array = gaussian_filter1d(rng.normal(size=(n_frames, count)), 30, axis=0)
    return 10 * drift


def _make_joints(rng: np.random.Generator, name: str, n_frames: int, count: int) -> Recording:
    """Return angles in degrees, and the place of the root."""
    values = 20 * _make_courses(rng, n_frames, count)
    names = ["root.tx", "root.ty", "root.tz", *(f"joint{k}.rx" for k in range(count - 3))]
    units = ["mm"] * 3 + ["deg"] * (count - 3)
    values += rng.normal(scale=0.05, size=values.shape)
    return Recording(name, np.arange(n_frames) / RATE, values, tuple(names), tuple(units))


def _make_markers(rng: np.random.Generator, name: str, n_frames: int, count: int) -> Recording:
    """Return coordinates in mm of markers, up to four on each of some rigid segments."""
    n_markers = count // 3
    segments = np.arange(n_markers) // 4
    shape = n_frames, segments[-1] + 1, 3
    places, angles = (_make_courses(rng, n_frames, shape[1] * 3).reshape(shape) for _ in range(2))
    offsets = rng.uniform(-80, 80, (n_markers, 3))
    turned = [
        Rotation.from_euler("xyz", 0.4 * angles[:, segment]).apply(offset)
        for segment, offset in zip(segments, offsets, strict=True)
    ]
    values = np.hstack([300 * places[:, s] + t for s, t in zip(segments, turned, strict=True)])
    values += rng.normal(scale=0.3, size=values.shape)
    names = [f"M{k}.{axis}" for k in range(n_markers) for axis in "xyz"]
    return Recording(name, np.arange(n_frames) / RATE, values, tuple(names), ("mm",) * count)


def measure(path: Path, models: Sequence[str]) -> None:
    """Add to a file what some models take, or all, of what it does not have."""
    rows = _read_rows(path)
    for method, grid in itertools.product(METHODS, GRID):
        problem = make_problem(grid)
        for name in _find_models(problem, method):
            key = {"model": name, "method": method, **grid._asdict()}
            known = any(key.items() <= row.items() for row in rows)
            if not known and name in (models or [name]) and not _is_too_large(key, rows):
                rows.append({**key, "seconds": _time_fill(name, method, problem)})
                pd.DataFrame(rows).to_csv(path, index=False, float_format="%.4g")


def _find_models(problem: GapProblem, method: str) -> list[str]:
    """Return the models to measure; those that nothing calibrates do the same by both methods."""
    models = find_candidates(problem)
    return [name for name in models if method != "impute" or find_calibration(name)]


def _read_rows(path: Path) -> list[dict[str, Any]]:
    table = pd.read_csv(path) if path.exists() else pd.DataFrame()
    return [{str(name): value for name, value in row.items()} for row in table.to_dict("records")]


def _is_too_large(key: dict[str, Any], rows: Sequence[dict[str, Any]]) -> bool:
    """Return whether the model was stopped in a problem that is smaller in every size."""
    numbers = [name for name in Grid._fields if Grid.__annotations__[name] == "int"]
    return any(
        row["seconds"] >= LONGEST
        and all(row[name] == key[name] for name in ("model", "method", "extent"))
        and all(row[name] <= key[name] for name in numbers)
        for row in rows
    )


def _time_fill(name: str, method: str, problem: GapProblem) -> float:
    """Return the processor time of a fill: `LONGEST` if it was stopped, NaN if it failed."""
    calibration = find_calibration(name)
    attempt = partial(attempt_fill, seconds=LONGEST, method=method, calibration=calibration)
    before = _count_processor_time()
    try:
        made = call_in_child(attempt, MODELS.get(name), problem, MEMORY, timeout=20 * LONGEST)
    except (ProcessDiedError, TimeoutError):
        return LONGEST
    if made.failure:
        print(f"{name}: {made.failure}", flush=True)
        return np.nan
    return _count_processor_time() - before


def _count_processor_time() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


PRIOR = {"frames": 1.0, "channels": 1.0, "gaps": 0.3, "longest": 0.0, "groups": 0.0, "parts": 0.0}
"""The exponents that a model has where measurements say nothing, before calibration."""
MOST = {"frames": 3.5, "channels": 3.5, "gaps": 1.0, "longest": 3.5, "groups": 1.0, "parts": 1.0}
"""The largest exponents; that of gaps in a window is at most 1, or more windows would cost less."""
DOUBT = 1.0
"""How far exponents may be from those, in the unit of the logarithms of seconds."""


def fit_cost(
    sizes: pd.DataFrame, seconds: Array, expected: Mapping[str, float]
) -> dict[str, float]:
    """Return the coefficient of a model and method, and the exponents, near those expected."""
    logs = np.log(sizes[[*PRIOR]].to_numpy(float))
    windows = np.log(sizes["windows"].to_numpy(float))
    prior = np.array([expected[name] for name in PRIOR])
    most = np.array([*MOST.values()])

    def find_residuals(law: Array) -> Array:
        predicted = START + np.exp(law[0] + windows + logs @ law[1:])
        errors = np.log(predicted / seconds)
        errors = np.where(seconds < LONGEST, errors, np.minimum(errors, 0.0))
        return np.concatenate([errors, (law[1:] - prior) / DOUBT])

    bounds = np.r_[-50.0, 0 * most], np.r_[50.0, most]
    start = np.r_[-12.0, np.clip(prior, 1e-3, most - 1e-3)]
    law = least_squares(find_residuals, start, bounds=bounds, loss="soft_l1").x
    return dict(zip(["seconds", *PRIOR], [float(np.exp(law[0])), *law[1:]], strict=True))


def fit(path: Path) -> None:
    """Write the rows of measured models, and print how predictions compare with measurements."""
    measured = pd.read_csv(path).dropna()
    measured[[*Sizes._fields]] = _measure_all_sizes(measured)
    table, quality = [], []
    for model, of_model in measured.groupby("model"):
        expected = PRIOR
        for method in METHODS:  # calibrated fills grow with sizes about as others do
            rows = of_model[of_model["method"] == method]
            if len(rows):
                cost = fit_cost(rows[[*Sizes._fields]], rows["seconds"].to_numpy(), expected)
                table.append({"model": model, "method": method, **_round(cost)})
                quality.append({"model": model, "method": method, **_compare(rows, cost)})
                expected = cost
    others = pd.read_csv(TABLE)
    others = others[~others["model"].isin(measured["model"])]
    rows = pd.concat([others, pd.DataFrame(table)]).sort_values("model", kind="stable")
    text = rows.to_csv(index=False, lineterminator="\n")
    TABLE.write_text(text, encoding="utf-8")
    print(pd.DataFrame(quality).to_string(index=False, float_format="%.2f"))


def _round(cost: dict[str, float]) -> dict[str, float]:
    exponents = {name: round(cost[name], 2) + 0.0 for name in PRIOR}
    return {"seconds": float(f"{cost['seconds']:.3g}"), **exponents}


def _measure_all_sizes(measured: pd.DataFrame) -> Array:
    """Return the sizes of each measured problem for its model."""
    make, models = cache(make_problem), {name: build_unfitted(name) for name in MODELS.names()}
    limits = {name: getattr(model, "max_frames", None) for name, model in models.items()}
    return np.array(
        [
            measure_sizes(make(Grid(*(row[field] for field in Grid._fields))), limits[row["model"]])
            for _, row in measured.iterrows()
        ]
    )


def _compare(rows: pd.DataFrame, cost: dict[str, float]) -> dict[str, float]:
    """Return quantiles of predicted by measured seconds, of fills that were not stopped."""
    whole = rows[rows["seconds"] < LONGEST]
    sizes = itertools.starmap(Sizes, whole[[*Sizes._fields]].to_numpy())
    predicted = np.array([count_seconds(cost, each) for each in sizes])
    ratios = predicted / whole["seconds"].to_numpy()
    low, median, high = np.quantile(ratios, [0.05, 0.5, 0.95]) if len(ratios) else [np.nan] * 3
    within = np.mean((ratios > 1 / 3) & (ratios < 3))
    counts = {"problems": len(whole), "stopped": len(rows) - len(whole)}
    return {**counts, "within 3": float(within), "5 %": low, "median": median, "95 %": high}


if __name__ == "__main__":
    command, file, *names = sys.argv[1:]
    if command == "measure":
        measure(Path(file), names)
    else:
        fit(Path(file))
