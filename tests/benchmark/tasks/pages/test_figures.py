"""Every figure that a page declares has something to show, and can be drawn."""

import joblib
import pytest

from mocapbench.benchmark import (
    MODELS,
    TASKS,
    Request,
    Solved,
    archive_at,
    plan,
)
from mocapbench.benchmark.registry import find_calibration
from mocapbench.benchmark.runs.fitting.solve import solve, train
from mocapbench.reports import Motions
from mocapbench.reports.figures.pictures.draw import draw
from mocapbench.reports.motions.player import player

BUDGET = {"max_iter": 1, "n_restarts": 1, "fill_iter": 1, "refine_iter": 1}
ENTRANTS = {
    "toy-interpolation-1": ("mohgp-3", "trivial"),
    "toy-interpolation-2": ("mohgp-1", "trivial"),
    "toy-interpolation-3": ("mohgp-1", "trivial"),
    "toy-synthesis": ("mohgp-3", "replay"),
    "covariance-recovery": ("mohgp-3-starts-10", "moa-3"),
    "walking-interpolation": ("mohgp-3", "cubic-spline"),
    "walking-synthesis": ("mohgp-3", "replay"),
    "exaggerated-synthesis": ("hgp", "replay"),
    "soccer-synthesis": ("hgp", "replay"),
    "lafan1": ("linear", "trivial"),
    "marker-gaps": ("linear", "trivial"),
    "marker-masks": ("linear", "trivial"),
    **dict.fromkeys(
        (
            *("lost-limb", "lost-markers", "in-betweening"),
            *("lost-limb-angles", "lost-markers-angles", "in-betweening-angles"),
        ),
        ("linear", "trivial"),
    ),
    **dict.fromkeys(
        ("motion-prediction", "motion-prediction-8-windows", "motion-prediction-corrected"),
        ("ridge-forecast", "zero-velocity"),
    ),
    "missing-frames": ("gplvm-window", "gpdm-map-viterbi", "cubic-spline"),
    "golf-swings": ("gplvm-window", "gpdm-map-viterbi", "cubic-spline"),
    "unseen-walkers": ("lds", "replay"),
    "upper-body-missing": ("nn", "trivial"),
    "subject-35-missing": ("nn-scaled", "trivial"),
    "style-clustering": ("cyclic-alignment", "k-means"),
}
"""What has something to show in every figure, and something that has little to show."""


SLOW = {"golf-swings", "style-clustering", "walking-interpolation"}
NAMES = [pytest.param(name, marks=[pytest.mark.slow] if name in SLOW else []) for name in ENTRANTS]


def _fit(job, problem):
    budget = {name: value for name, value in BUDGET.items() if name in job.parameters}
    parameters = {**job.parameters, **budget}
    random_state = job.training_seeds.random_state("init")
    model, calibration = MODELS.get(job.model), find_calibration(job.model)
    fitted = train(problem, model, parameters, random_state, calibration)
    return solve(problem, fitted, job.seeds.random_state("sample"))


@pytest.fixture(scope="module", params=NAMES)
def stored(request, posed):
    """Return a task, the problem of its smoke profile, and the arrays of each entrant's fit."""
    task = TASKS.get(request.param)
    jobs = plan(Request("smoke", (task.name,), ENTRANTS[task.name], folds=1), archive_at())
    (case,) = {job.address.case for job in jobs}
    assert case in task.page.illustrated
    problem = posed(task.name, case)
    arrays = {job.address.label: _fit(job, problem).arrays for job in jobs}
    assert set(arrays) == set(ENTRANTS[task.name])
    return task, problem, arrays


def test_every_task_with_figures_is_tried():
    assert set(ENTRANTS) == {name for name in TASKS.names() if TASKS.get(name).page.figures}


def test_a_solution_comes_back_whole_from_among_what_a_fit_stores(stored):
    _, problem, fits = stored
    for label, arrays in fits.items():
        again = problem.to_arrays(problem.from_arrays(arrays))
        assert again, label
        assert joblib.hash(again) == joblib.hash({name: arrays[name] for name in again}), label


def test_every_figure_of_a_page_draws(stored):
    task, problem, fits = stored
    solutions = {label: problem.from_arrays(a) for label, a in fits.items()}
    published = task.page.published_models
    solved = Solved(task.name, problem, solutions, fits, published, archive=archive_at())
    pictures = [list(figure(solved)) for figure in task.page.figures]
    assert all(pictures)
    shown = [picture for of_figure in pictures for picture in of_figure]
    assert {picture.task for picture in shown} == {task.name}
    assert len({picture.title for picture in shown}) == len(shown)
    for picture in shown:
        if isinstance(picture, Motions):
            assert player(picture)["labels"] == tuple(solutions)
        else:
            assert "<svg" in draw(picture, {}).svg
