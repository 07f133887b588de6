"""What models need and provide is data, which all that choose models read alike."""

from dataclasses import replace
from types import SimpleNamespace
from typing import ClassVar

import numpy as np
import pytest
from sklearn.base import clone

from mocapbench.baselines import (
    ABILITIES,
    IMPLIED,
    NEEDS,
    Imputer,
    Model,
    Need,
    Prediction,
    protocols,
)
from mocapbench.baselines.declarations.abilities import DEPENDENCES
from mocapbench.baselines.declarations.needs import find_met_needs
from mocapbench.benchmark.catalogue.entries import model_entry
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.candidates import find_candidates, require_candidate
from mocapbench.benchmark.filling.gap_problem import GapProblem, pose_imputing
from mocapbench.benchmark.problems.internals import internals_of
from mocapbench.benchmark.registry import MODELS, TASKS, build_unfitted
from mocapbench.benchmark.results.interpolations import interpolates
from mocapbench.benchmark.results.model_infos import model_infos
from mocapbench.benchmark.runs.request import entrants
from mocapbench.benchmark.tasks.base import Entrant
from mocapbench.benchmark.testing import ConformanceError, check_model, check_task, model_checks
from mocapbench.benchmark.testing.subject import GAP, Subject, problem
from mocapbench.datasets import Recording

NEEDY = [(name, need) for name in MODELS.names() for need in sorted(build_unfitted(name).needs)]
ANGLES = ("hip", "knee")
MARKERS = ("LKNE.x", "LKNE.y", "LKNE.z")


def ask(channels):
    """Return the problem of filling a gap in all channels."""
    hidden = np.zeros((9, len(channels)), dtype=bool)
    hidden[3:5] = True
    values = np.arange(9.0)[:, None] * np.ones(len(channels))
    recording = Recording("r", np.arange(9.0), values, channels, ("cm",) * len(channels))
    return GapProblem(recording.hide(hidden), hidden)


class Wrapped(Model):
    """Does all that another model does."""

    def __init__(self, estimator=None):
        self.estimator = estimator

    @property
    def provides(self):
        return self.estimator.provides

    @property
    def needs(self):
        return self.estimator.needs

    @property
    def family(self):
        return self.estimator.family

    @property
    def max_frames(self):
        return self.estimator.max_frames

    def fit(self, recordings, **given):
        self.estimator_ = clone(self.estimator).fit(recordings, **given)
        return self

    def __getattr__(self, name):
        if name.startswith("_") or "estimator_" not in vars(self):
            raise AttributeError(name)
        return getattr(self.estimator_, name)


def wrap(name):
    """Return a class that wraps the model called ``name``, and is built without arguments."""

    default = build_unfitted(name)

    class Wrapper(Wrapped):
        """Does all that another model does."""

        def __init__(self, estimator=default):
            self.estimator = estimator

    return Wrapper


@pytest.fixture
def registered(monkeypatch):
    """Return a function that registers a model for the time of a test."""
    return lambda name, model: monkeypatch.setitem(MODELS._added, name, model)


@pytest.mark.parametrize("name", MODELS.names())
def test_what_a_registered_model_provides_and_needs_is_known(name):
    model = build_unfitted(name)
    assert model.provides
    assert model.provides <= {*ABILITIES}
    assert model.needs <= {*NEEDS}
    assert (MODELS.get(name).provides, MODELS.get(name).needs) == (model.provides, model.needs)


PROTOCOLS = [getattr(protocols, name) for name in protocols.__all__]
PROTOCOLS = [kind for kind in PROTOCOLS if isinstance(kind, type) and issubclass(kind, Model)]


def test_an_ability_is_provided_with_those_that_it_implies():
    for kind in (*PROTOCOLS, *map(MODELS.get, MODELS.names())):
        implied = {IMPLIED[ability] for ability in kind.provides & IMPLIED.keys()}
        assert implied <= kind.provides


@pytest.mark.parametrize("name", MODELS.names())
def test_a_model_provides_what_the_classes_promise_that_it_inherits(name):
    kind = MODELS.get(name)
    promised = set().union(*(each.provides for each in PROTOCOLS if issubclass(kind, each)))
    assert promised <= kind.provides
    assert kind.provides - promised <= {"replays", *DEPENDENCES}


def test_a_model_of_two_bases_has_what_each_provides_and_needs():
    class One(Imputer):
        needs = frozenset({"coordinates"})

    class Both(One, protocols.Synthesiser):
        pass

    class Own(One, protocols.Synthesiser):
        provides = frozenset({"clusters"})

    assert Both.provides == Imputer.provides | {"draws samples"}
    assert Both.needs == {"coordinates"}
    assert Own.provides == {"clusters"}


@pytest.mark.parametrize(("name", "need"), NEEDY)
def test_a_task_refuses_a_model_by_the_sentence_of_a_need_that_it_does_not_meet(name, need):
    model = build_unfitted(name)
    task = replace(TASKS.get("marker-gaps"), requires=model.provides, meets={*NEEDS})
    assert task.accepts(model)
    assert task.list_unmet(model) == []
    unmet = replace(task, meets={*NEEDS} - {need})
    assert not unmet.accepts(model)
    assert unmet.list_unmet(model) == [NEEDS[need].sentence]


@pytest.mark.parametrize(("name", "need"), NEEDY)
def test_a_run_of_a_model_alone_says_what_it_needs(cli, name, need):
    assert cli("run", "--models", name, "--tasks", "missing-frames", "--dry-run") == 2
    words = " ".join(cli.printed.split())
    assert f"({name} needs {NEEDS[need].sentence}); `mocapbench list models`" in words


@pytest.mark.parametrize(("name", "need"), NEEDY)
def test_filling_and_the_catalogue_have_the_sentence_too(name, need):
    gap_problem = ask(ANGLES)
    assert need not in find_met_needs(pose_imputing(gap_problem))
    assert name not in find_candidates(gap_problem)
    with pytest.raises(UsageError, match=rf"{name}', which needs {NEEDS[need].sentence}; choose"):
        require_candidate(name, gap_problem)
    assert NEEDS[need].sentence in model_entry(name)["needs"]


def test_a_need_that_a_file_meets_bars_no_model():
    assert find_met_needs(pose_imputing(ask(MARKERS))) == {"coordinates"}
    require_candidate("rigid-body", ask(MARKERS))


@pytest.mark.parametrize("name", TASKS.names())
def test_a_task_meets_needs_that_are_known(name):
    assert {*TASKS.get(name).meets} <= {*NEEDS}


@pytest.mark.parametrize(
    ("field", "value", "complaint"),
    [
        ("requires", {"fill frames"}, r"expected abilities from .*fills frames.*'fill frames'"),
        ("meets", {"floor"}, r"expected needs from .*coordinates.*, got 'floor'"),
        ("meets", {"unrelated process"}, "meet what the task says, got .*none of the recordings"),
    ],
)
def test_a_task_that_names_no_known_ability_or_need_or_does_not_meet_it_is_refused(
    field, value, complaint
):
    with pytest.raises(ConformanceError, match=complaint):
        check_task(replace(TASKS.get("toy-interpolation-1"), **{field: value}))


class FloorMean(Imputer):
    """Fills with the height of the floor."""

    needs: ClassVar = frozenset({"floor"})

    def fit(self, recordings, floor=None):
        if floor is None:
            raise ValueError("expected a floor")
        self.names_ = {recording.name for recording in recordings}
        self.floor_ = floor
        return self

    def impute(self, recordings):
        if not {recording.name for recording in recordings} <= self.names_:
            raise ValueError(f"not seen: {[recording.name for recording in recordings]}")
        return [Prediction.around(recording, self.floor_) for recording in recordings]


def test_one_entry_makes_all_know_a_new_need(registered, monkeypatch):
    registered("floor-mean", FloorMean)
    with pytest.raises(ConformanceError, match=r"needs among .*, got \['floor'\]"):
        check_model(FloorMean)
    floor = Need(
        "the height of the floor",
        lambda posed: "floor" in posed.train[0].channels,
        lambda posed: {"floor": 7.0},
    )
    monkeypatch.setitem(NEEDS, "floor", floor)
    check_model(FloorMean)
    task = TASKS.get("toy-interpolation-1")
    assert task.list_unmet(FloorMean()) == ["the height of the floor"]
    assert "floor-mean" not in {entrant.model for entrant in entrants(task)}
    assert "floor-mean" in {entrant.model for entrant in entrants(replace(task, meets={"floor"}))}
    assert "floor-mean" in find_candidates(ask(("floor", "hip")))
    with pytest.raises(UsageError, match="which needs the height of the floor"):
        require_candidate("floor-mean", ask(ANGLES))
    assert model_entry("floor-mean")["needs"] == ["the height of the floor"]
    (prediction,) = pose_imputing(ask(ANGLES)).fit(FloorMean()).impute([ask(ANGLES).given])
    assert prediction.mean[3, 0] == 7.0


@pytest.mark.parametrize("name", ["linear", "oracle", "rigid-body", "gp-independent"])
def test_a_wrapper_is_taken_for_what_it_wraps(registered, name):
    registered("wrapped", wrap(name))
    for task in map(TASKS.get, TASKS.names()):
        assert task.accepts(build_unfitted("wrapped")) == task.accepts(build_unfitted(name))
        models = {entrant.model for entrant in entrants(task)}
        assert ("wrapped" in models) == task.accepts(build_unfitted(name))
    for channels in (ANGLES, MARKERS):
        assert len({"wrapped", name} & {*find_candidates(ask(channels))}) != 1
    for key in ("abilities", "needs", "family"):
        assert model_entry("wrapped")[key] == model_entry(name)[key]
    assert interpolates("wrapped") == interpolates(name)
    names = [check.__name__ for check in model_checks(wrap(name))]
    assert names == [check.__name__ for check in model_checks(MODELS.get(name))]


@pytest.mark.parametrize("name", ["linear", "oracle"])
def test_a_wrapper_conforms_and_leaves_the_internals_of_what_it_wraps(name):
    check_model(wrap(name))
    one, two = (Subject(kind).fit_model(problem(GAP)) for kind in (wrap(name), MODELS.get(name)))
    arrays = [internals_of(model, problem(GAP)) for model in (one, two)]
    assert {*arrays[0]} == {*arrays[1]}


def test_a_report_names_the_family_of_what_a_wrapper_wraps(registered):
    registered("wrapped", wrap("pchip"))
    record = SimpleNamespace(address=SimpleNamespace(label="w"), model="wrapped")
    assert model_infos(TASKS.get("marker-gaps"), [record])["w"].family == "Interpolation"


def test_abilities_without_those_that_they_imply_are_refused():
    class Halved(MODELS.get("linear")):
        """Fills entries, but no frames."""

        provides = frozenset({"fills entries"})

    with pytest.raises(ConformanceError, match=r"that they imply, got \['fills frames'\]"):
        check_model(Halved)


def test_an_entrant_is_asked_with_its_own_parameters(registered):
    assert build_unfitted("knn", {"n_neighbors": 5, "unknown": 1}).n_neighbors == 5
    registered("wrapped", wrap("linear"))
    clusterer = Entrant("wrapped k-means", "wrapped", {"estimator": build_unfitted("k-means")})
    task = replace(TASKS.get("style-clustering"), entrants=(clusterer,))
    assert clusterer in entrants(task)
    assert clusterer not in entrants(replace(task, requires={"interpolates"}))


def test_a_model_that_cannot_be_built_is_refused_by_its_name(registered):
    class NeedsSize(MODELS.get("linear")):
        def __init__(self, size):
            self.size = size

    registered("needs-size", NeedsSize)
    with pytest.raises(UsageError, match="model 'needs-size': expected a class that can be built"):
        build_unfitted("needs-size")
