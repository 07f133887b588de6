"""A bundle shaped like a real one: three tasks, some failures, some data missing."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields

import numpy as np
import pandas as pd
import pytest

from mocapbench.datasets import GaitLibrary, joint_positions
from mocapbench.metrics.base import Direction
from mocapbench.reports import render
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import CaseLayout, TaskLayout
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.bundle.pictures import Axes, Curve, Illustration, Motions
from mocapbench.reports.bundle.task_page import TaskPage

METRICS = {
    info.name: info
    for info in (
        MetricInfo("mse", "MSE", Direction.LOWER),
        MetricInfo("smse_pooled", "SMSE (pooled)", Direction.LOWER),
        MetricInfo("msll", "MSLL", Direction.LOWER),
        MetricInfo("rms_per_frame", "RMS per frame", Direction.LOWER),
        MetricInfo("mpjpe", "MPJPE, cm", Direction.LOWER),
        MetricInfo("mcc", "MCC", Direction.HIGHER),
        MetricInfo("mlc", "MLC", Direction.HIGHER),
        MetricInfo("variance_ratio", "Variance ratio", Direction.TARGET, 1.0),
        *(
            MetricInfo(
                f"coverage_{p}",
                f"Coverage at {p} %",
                Direction.TARGET,
                p / 100,
                of_distribution=True,
            )
            for p in (50, 80, 90, 95)
        ),
    )
}
COVERAGES = tuple(name for name in METRICS if name.startswith("coverage"))
WITHOUT_VARIANCE = ("cubic-spline", "knn", "nn", "aligned-window")
HOSTILE = "<script>alert('x')</script>"

TOY = TaskLayout(
    name="toy-interpolation-1",
    page=TaskPage(
        title="Toy interpolation, one incomplete child",
        reference="thesis §5.1.1, Tables 1–3, Figure 17",
        description=(
            "Children of one parent are drawn from a two-layer Gaussian process. All are complete "
            "but the last, of which 5 of 50 points per output are visible."
        ),
        metrics=("mse", "smse_pooled", "msll"),
        published_rows={f"test {number}": f"test {number}" for number in range(1, 10)},
        published_models={"mohgp-3": "MOHGP", "moa-3": "MOA"},
        published_metrics={"mse": "MSE", "smse_pooled": "SMSE", "msll": "MSLL"},
        remarks=("Tests 4 and 7 of the thesis carry identical MOHGP values.",),
    ),
    cases=tuple(
        CaseLayout(
            f"test {number}",
            {"noise": noise, "outputs": outputs, "children": children},
        )
        for number, (noise, (outputs, children)) in enumerate(
            ((noise, size) for noise in (0.001, 0.01, 0.1) for size in ((3, 5), (6, 6), (3, 10))), 1
        )
    ),
    labels=(
        *("mohgp-3", "moa-3", "lmc-independent", "gp-independent"),
        *("cubic-spline", "knn", "nn", "trivial", "oracle"),
    ),
)
WALKING = TaskLayout(
    name="walking-interpolation",
    page=TaskPage(
        title="Walking interpolation",
        reference="thesis §5.1.2, Tables 10–11, Figure 20",
        description="Three walks; the first has 40, 30, 20 or 10 of its 90 frames visible.",
        metrics=("smse_pooled", "mse", "msll"),
        published_rows={f"observed {n}": f"observed {n}" for n in (40, 30, 20, 10)},
        published_models={
            **{"mohgp-1": "MOHGP", "mohgp-3": "MOHGP"},
            **{"moa-1": "MOA", "moa-3": "MOA"},
        },
        published_metrics={"mse": "MSE", "smse_pooled": "SMSE", "msll": "MSLL"},
        remarks=("The thesis does not print its 39 channels.",),
    ),
    cases=(
        *(CaseLayout(f"observed {n}", {"observed": n}) for n in (40, 30, 20, 10)),
        CaseLayout(
            "generated 20",
            {"observed": 20},
            synthetic=True,
        ),
    ),
    labels=("mohgp-1", "mohgp-3", "moa-1", "moa-3", "gp-independent", "cubic-spline"),
)
GROUPS = ("four-walkers", "three-walkers")
RECORDINGS = ("35-03", "12-02", "16-21", "12-03", "07-01", "07-02", "08-01", "08-02")
FRAMES = TaskLayout(
    name="missing-frames",
    page=TaskPage(
        title="Missing frames",
        reference="GPDM §5.3, Table 2",
        description=("31 whole frames of a walk are hidden; training walks are of other subjects."),
        metrics=("rms_per_frame",),
        published_rows={f"{name} {group}": name for group in GROUPS for name in RECORDINGS},
        published_models={"cubic-spline": "cubic-spline", "knn": "KNN-15"},
        published_metrics={"rms_per_frame": "RMS per frame"},
        not_comparable={("knn", "*"): "the paper does not print its KNN objective"},
    ),
    cases=tuple(
        CaseLayout(
            f"{name} {group}",
            {"test": name, "training": group},
        )
        for group in GROUPS
        for name in RECORDINGS
    ),
    labels=("cubic-spline", "knn", "aligned-window", "gp-independent"),
    independent_folds=False,
)
FOLDS = {"toy-interpolation-1": 5, "walking-interpolation": 5, "missing-frames": 12}
LEVELS: Mapping[str, float] = {
    **{"oracle": 0.06, "mohgp-3": 0.08, "mohgp-1": 0.085, "lmc-independent": 0.12},
    **{"gp-independent": 0.07, "moa-1": 0.8, "moa-3": 0.75, "cubic-spline": 0.5, "knn": 0.6},
    **{"nn": 0.9, "trivial": 1.05, "aligned-window": 0.3},
}
NO_DATA = ("12-02", "12-03")
FRAME_TIMES = np.arange(50) / 30
FILLED = Illustration(
    task=FRAMES.name,
    title="Filled channels",
    caption="the truth, and what two models put in its place.",
    axes=tuple(
        Axes(
            channel,
            "time, s",
            "deg",
            tuple(
                Curve(FRAME_TIMES, size * np.sin(6.0 * FRAME_TIMES), group)
                for group, size in (("truth", 1.0), ("knn", 0.9), ("cubic-spline", 0.2))
            ),
        )
        for channel in ("rhumerus.rx", "thorax.ry")
    ),
)


def _status(task: TaskLayout, case: str, label: str, fold: int) -> str:
    if case.startswith(NO_DATA):
        return "data-missing"
    if (task.name, label, case) == ("toy-interpolation-1", "lmc-independent", "test 5"):
        return "timeout"
    if (task.name, label, case, fold) == ("walking-interpolation", "mohgp-3", "observed 10", 2):
        return "failed"
    if (task.name, label, case) == ("toy-interpolation-1", "nn", "test 8"):
        return "failed"
    return "ok"


MESSAGES = {
    "ok": "",
    "timeout": "stopped after 600 s",
    "failed": f"LinAlgError: the covariance is not positive definite {HOSTILE}",
    "data-missing": "subjects/12/12_02.amc is not at hand; run: mocapbench data fetch cmu:12_02",
}
TRACEBACK = (
    "Traceback (most recent call last):\n"
    '  File "baselines/gp/core.py", line 61, in factorise\n'
    "    chol = linalg.cholesky(covariance, lower=True)\n"
    f"LinAlgError: 17-th leading minor is not positive definite {HOSTILE}\n"
)


def _record(
    rng: np.random.Generator, task: TaskLayout, case: str, label: str, fold: int
) -> dict[str, object]:
    status = _status(task, case, label, fold)
    done = status == "ok"
    gaussian = done and label not in WITHOUT_VARIANCE
    return {
        "task": task.name,
        "case": case,
        "fold": fold,
        "label": label,
        "model": label.rstrip("-13"),
        "parameters": "{}",
        "status": status,
        "message": MESSAGES[status],
        "traceback": TRACEBACK if status == "failed" else "",
        "fit_seconds": rng.gamma(4.0, 2.0 if gaussian else 0.01) if done else np.nan,
        "predict_seconds": rng.gamma(4.0, 0.02) if done else np.nan,
        "peak_memory_mb": rng.uniform(120, 400) if done else np.nan,
        "iterations": float(rng.integers(20, 400)) if gaussian else np.nan,
        "converged": bool(rng.uniform() < 0.9) if gaussian else None,
        "engine": "latent-split: 0.7 billion operations" if gaussian else "",
    }


def _values(rng: np.random.Generator, task: TaskLayout, case: int, label: str) -> dict[str, float]:
    smse = LEVELS[label] * (1 + 0.15 * case) * rng.lognormal(0.0, 0.15)
    if task is FRAMES:
        return {"rms_per_frame": 30.0 + 60.0 * smse}
    values = {"mse": 1.3 * smse, "smse_pooled": smse}
    if label in WITHOUT_VARIANCE:
        return values
    coverage = {name: rng.normal(METRICS[name].target, 0.03) for name in COVERAGES}
    return {**values, "msll": 0.5 * np.log(smse), **coverage}


def played() -> Motions:
    """Return a walk whose middle third two models fill, one of them 10 cm too high."""
    motion = GaitLibrary().motion("01_01")
    truth = joint_positions(motion.skeleton, motion.recording("walk").frames(range(0, 240, 4)))
    hidden = (np.arange(60) >= 20) & (np.arange(60) < 40)
    above, noisy = truth.copy(), truth.copy()
    above[hidden] += [0.0, 10.0, 0.0]
    noisy[hidden] += np.random.default_rng(3).normal(size=noisy[hidden].shape)
    return Motions(
        task=FRAMES.name,
        title="Motion",
        caption="A generated walk.",
        interval=1 / 30,
        joints=tuple(segment.name for segment in motion.skeleton.segments),
        parents=motion.skeleton.parents,
        hidden=hidden,
        truths={"truth": truth},
        motions={"noisy": noisy, "above": above},
        beside="above",
    )


@pytest.fixture(scope="session")
def bundle() -> Bundle:
    rng = np.random.default_rng(7)
    records, scores = [], []
    for task in (TOY, WALKING, FRAMES):
        for position, case in enumerate(task.cases):
            for fold in range(FOLDS[task.name]):
                for label in task.labels:
                    record = _record(rng, task, case.name, label, fold)
                    records.append(record)
                    address = {k: record[k] for k in ("task", "case", "fold", "label", "model")}
                    scores += [
                        {**address, "metric": metric, "value": value}
                        | {"sample_two_sd": np.nan, "left_out": 0}
                        for metric, value in _values(rng, task, position, label).items()
                        if record["status"] == "ok" and metric in METRICS
                    ]
    return Bundle(
        scores=pd.DataFrame(scores),
        records=pd.DataFrame(records),
        layouts=(TOY, WALKING, FRAMES),
        metrics=METRICS,
        provenance={
            "profile": "paper",
            "mocapbench version": "0.1.0",
            "numpy version": "2.4.6",
            "commit": "0f3c1a9e7b6d4c52810c6f0a9b1e2d3c4b5a6978",
            "CPU": "AMD EPYC 7B13",
            "threads": "1 per job",
            "seed": "0",
            "started": "2025-03-01 10:00 UTC",
            "wall time": "2 h 14 min",
            "command line": "mocapbench run --profile paper --seed 0",
            "acknowledgement": (
                "The data used in this project was obtained from mocap.cs.cmu.edu. "
                "The database was created with funding from NSF EIA-0196217."
            ),
        },
        illustrations=(FILLED, played()),
    )


@pytest.fixture(scope="session")
def page(bundle: Bundle) -> str:
    return render(bundle)


Values = Mapping[str, Mapping[str, list[float]]]


@pytest.fixture
def small() -> Callable[..., Bundle]:
    """Return a maker of bundles of one task from {case: {label: [a value per fold]}}.

    A NaN stands for a job that failed; further arguments are fields of the layout or of its page.
    """

    def make(values: Values, metric: str = "mse", task: str = "small", **options: object) -> Bundle:
        rows = [
            {"task": task, "case": case, "fold": fold, "label": label, "model": label}
            | {"value": value}
            for case, labels in values.items()
            for label, folds in labels.items()
            for fold, value in enumerate(folds)
        ]
        frame = pd.DataFrame(rows).assign(metric=metric, sample_two_sd=np.nan, left_out=0)
        records = frame.drop(columns=["metric", "value", "sample_two_sd", "left_out"]).assign(
            parameters="{}",
            status=["ok" if np.isfinite(row["value"]) else "failed" for row in rows],
            **dict.fromkeys(("message", "traceback", "engine"), ""),
            **dict.fromkeys(("fit_seconds", "predict_seconds", "peak_memory_mb"), 1.0),
            **dict.fromkeys(("iterations", "converged"), None),
        )
        return Bundle(
            frame.dropna(subset="value"),
            records,
            (_layout(task, metric, rows, options),),
            METRICS,
            {},
        )

    return make


PAGE_FIELDS = {field.name for field in fields(TaskPage)}


def _layout(
    task: str, metric: str, rows: list[dict[str, object]], options: Mapping[str, object]
) -> TaskLayout:
    """Return a layout whose page has those of the ``options`` that are fields of a page."""
    page = {name: value for name, value in options.items() if name in PAGE_FIELDS}
    layout = {name: value for name, value in options.items() if name not in PAGE_FIELDS}
    texts = dict.fromkeys(("title", "reference", "description"), "Small")
    return TaskLayout(
        **{
            "name": task,
            "page": TaskPage(**{**texts, "metrics": (metric,), **page}),
            "cases": tuple(CaseLayout(case, {}) for case in dict.fromkeys(r["case"] for r in rows)),
            "labels": tuple(dict.fromkeys(row["label"] for row in rows)),
            **layout,
        }
    )
