"""The conformance kit, over everything registered."""

import inspect
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from format_files import sample
from sklearn.exceptions import NotFittedError

from mocapbench.baselines import (
    FAM,
    GPLVM,
    HGP,
    LDS,
    MOHGP,
    Calibrated,
    ChannelKriging,
    FrameImputer,
    LinearImputer,
    LowRank,
    Synthesiser,
)
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.benchmark.registry import FORMATS, METRICS, MODELS, TASKS
from mocapbench.benchmark.testing import check_format, check_metric, check_task, model_checks
from mocapbench.benchmark.testing.subject import COMPLETE, GAP, TIMES, Subject, problem


def is_documented(parameter, value):
    """Return whether the annotation of a parameter has values like this one."""
    kinds = parameter.annotation.split(" | ")
    return (
        (value is None and "None" in kinds)
        or (value == 1.5 and "float" in kinds)
        or (value == -1 and parameter.name == "n_jobs")
    )


CHECKS = [
    pytest.param(name, check, id=f"{name}-{check.__name__}")
    for name in MODELS.names()
    for check in model_checks(MODELS.get(name))
]


@pytest.mark.parametrize(("name", "check"), CHECKS)
def test_a_model_conforms(name, check):
    check(MODELS.get(name))


def calibrated(inner):
    """Return a class of models that wraps one with these parameters."""

    class Wrapped(Calibrated):
        """A model and its calibration."""

        def __init__(self, model=inner):
            super().__init__(model)

    return Wrapped


WRAPPED = {
    "mohgp": MOHGP(max_iter=5, n_restarts=1, random_state=0),
    "hgp": HGP(max_iter=5, random_state=0),
    "lds": LDS(n_states=3),
    "fam": FAM(n_restarts=1, random_state=0),
    "low-rank": LowRank(),
    "gplvm": GPLVM(n_latent=1, max_iter=2, fill_iter=5),
    "channel-kriging": ChannelKriging(),
    "linear": LinearImputer(),
}
CALIBRATED = [
    pytest.param(name, check, id=f"{name}-{check.__name__}")
    for name, model in WRAPPED.items()
    for check in model_checks(calibrated(model))
]


@pytest.mark.parametrize(("name", "check"), CALIBRATED)
def test_a_calibrated_model_conforms_as_the_model_in_it(name, check):
    check(calibrated(WRAPPED[name]))


@pytest.mark.parametrize("name", WRAPPED)
def test_a_calibrated_model_is_checked_as_the_model_in_it(name):
    own, wrapped = (model_checks(kind) for kind in (type(WRAPPED[name]), calibrated(WRAPPED[name])))
    assert [check.__name__ for check in wrapped] == [check.__name__ for check in own]


PARAMETERS = [
    pytest.param(name, parameter, wrong, id=f"{name}-{parameter.name}-{wrong!r}")
    for name in MODELS.names()
    for parameter in inspect.signature(MODELS.get(name)).parameters.values()
    for wrong in ("x", None, -1, 1.5, float("nan"))
    if not is_documented(parameter, wrong)
]


@pytest.mark.parametrize(("name", "parameter", "wrong"), PARAMETERS)
def test_a_model_refuses_a_wrong_parameter_by_its_name(name, parameter, wrong):
    model = Subject(MODELS.get(name)).build(**{parameter.name: wrong})
    with pytest.raises(ValueError, match=rf"expected {parameter.name}\b.*, got ") as raised:
        model.fit(problem(GAP))
    assert repr(wrong) in str(raised.value)


@pytest.fixture(scope="module")
def fitted():
    """Return a registered model fitted to recordings one of which has a gap, by its name."""
    return cache(lambda name: Subject(MODELS.get(name)).fit_model(problem(GAP)))


FILLERS = [name for name in MODELS.names() if issubclass(MODELS.get(name), FrameImputer)]


ANSWERS = [
    (name, answer)
    for name in FILLERS
    for answer in ("impute", "impute_uncalibrated", "impute_held_out", "leave_one_out")
    if hasattr(MODELS.get(name), answer)
]
OTHERS = {
    "expected channels": COMPLETE[-1].select(COMPLETE[-1].channels[::-1]).hide(GAP),
    "in unit": replace(COMPLETE[-1], units=("deg",) * 2).hide(GAP),
}


@pytest.mark.parametrize(("name", "answer"), ANSWERS)
@pytest.mark.parametrize(("expected", "other"), OTHERS.items(), ids=OTHERS)
def test_a_model_refuses_channels_and_units_other_than_those_of_fit(
    fitted, name, answer, expected, other
):
    with pytest.raises(ValueError, match=f"{expected} .*, got"):
        getattr(fitted(name), answer)([other])


@pytest.mark.parametrize(("name", "answer"), ANSWERS)
def test_a_model_answers_nothing_before_it_is_fitted(name, answer):
    with pytest.raises(NotFittedError):
        getattr(MODELS.get(name)(), answer)(problem(GAP))


UNUSABLE = {
    "no frames": (lambda recording: recording.frames([]), "one frame and one channel, got (0, 2)"),
    "no channels": (lambda recording: recording.select([]), "one channel, got (20, 0)"),
    "overflow": (
        lambda recording: recording.with_values(1e76 * np.sign(recording.values)),
        "values of at most 1e+75 in size, got 1e+76; use another unit",
    ),
}


@pytest.mark.parametrize("name", MODELS.names())
@pytest.mark.parametrize(("changed", "expected"), UNUSABLE.values(), ids=UNUSABLE)
def test_a_model_says_what_recordings_it_cannot_learn_from(name, changed, expected):
    with pytest.raises(ValueError, match=f"'child-1': expected .*{re.escape(expected)}"):
        Subject(MODELS.get(name)).fit_model([changed(recording) for recording in problem(GAP)])


@pytest.mark.parametrize(("name", "answer"), ANSWERS)
@pytest.mark.parametrize("unusable", ["no frames", "overflow"])
def test_a_model_says_what_recordings_it_cannot_fill(fitted, name, answer, unusable):
    changed, expected = UNUSABLE[unusable]
    with pytest.raises(ValueError, match=f"'child-4': expected .*{re.escape(expected)}"):
        getattr(fitted(name), answer)([changed(problem(GAP)[-1])])


LEARNT = [name for name in MODELS.names() if issubclass(MODELS.get(name), GaussianProcess)]


@pytest.mark.parametrize("name", LEARNT)
@pytest.mark.parametrize("learnt", ["layers", "coregionalisation_", "noise_"])
def test_a_model_has_learnt_nothing_before_it_is_fitted(name, learnt):
    with pytest.raises(NotFittedError):
        getattr(MODELS.get(name)(), learnt)


@pytest.mark.parametrize("name", sorted({*FILLERS} - {"oracle", "trivial"}))
def test_a_model_claims_nothing_of_channels_that_are_seen_once(name):
    """Unless it is a reference, which knows the process, or has the moments of what is visible."""
    (recording,) = COMPLETE[:1]
    once = recording.hide(np.arange(len(recording.times))[:, None] != 10)
    try:
        (prediction,) = Subject(MODELS.get(name)).fit_model([once]).impute([once])
    except ValueError as error:
        assert "expected" in str(error)
    else:
        assert prediction.variance is None


NO_RECORDINGS = {
    "None": None,
    "a string": "ab",
    "an array": COMPLETE[0].values,
    "one recording": COMPLETE[0],
    "arrays": [COMPLETE[0].values],
    "an iterator": iter(COMPLETE),
}


@pytest.mark.parametrize("name", FILLERS)
@pytest.mark.parametrize("wrong", NO_RECORDINGS.values(), ids=NO_RECORDINGS)
def test_an_imputer_wants_a_list_of_recordings(fitted, name, wrong):
    with pytest.raises(ValueError, match="expected a sequence of Recordings, got"):
        fitted(name).impute(wrong)


@pytest.mark.parametrize("name", FILLERS)
def test_an_imputer_fills_no_recordings(fitted, name):
    assert fitted(name).impute([]) == []


SYNTHESISERS = [name for name in MODELS.names() if issubclass(MODELS.get(name), Synthesiser)]
DRAWS = [
    ({"times": None}, "times"),
    ({"times": "ab"}, "times to be real numbers"),
    ({"times": [0.0, 1j]}, "times to be real numbers"),
    ({"times": [0.0, np.nan]}, "finite times"),
    ({"times": np.zeros((3, 1))}, "times of shape"),
    ({"times": []}, "times of shape"),
    *(({"n_samples": wrong}, "n_samples") for wrong in ("x", None, -1, 0, 1.5, np.nan)),
    *(({"random_state": wrong}, "random_state") for wrong in ("x", -1, 1.5, np.nan)),
]


@pytest.mark.parametrize("name", SYNTHESISERS)
@pytest.mark.parametrize(("wrong", "named"), DRAWS, ids=str)
def test_a_synthesiser_says_what_is_wrong_with_a_draw(fitted, name, wrong, named):
    right = {"times": TIMES, "n_samples": 2, "random_state": 0}
    with pytest.raises(ValueError, match=rf"expected .*{named}.*, got "):
        fitted(name).sample(**{**right, **wrong})


@pytest.mark.parametrize("name", SYNTHESISERS)
def test_a_synthesiser_wants_increasing_times_unless_it_takes_any_order(fitted, name):
    if "in any order" in " ".join(MODELS.get(name).sample.__doc__.split()):
        assert fitted(name).sample([1.0, 0.0, 1.0], 2, 0).shape == (2, 3, 2)
    else:
        with pytest.raises(ValueError, match=r"expected increasing times, got 0\.0 after 1\.0"):
            fitted(name).sample([1.0, 0.0, 1.0], 2, 0)


@pytest.mark.parametrize("name", TASKS.names())
def test_a_task_conforms(name):
    task = TASKS.get(name)
    assert task.name == name
    check_task(task)


@pytest.mark.parametrize("name", METRICS.names())
def test_a_metric_conforms(name):
    metric = METRICS.get(name)
    assert metric.name == name
    check_metric(metric)


@pytest.mark.parametrize("name", FORMATS.names())
def test_a_format_conforms(name, tmp_path):
    check_format(FORMATS.get(name), sample(name, tmp_path))
