"""What is computed anew when something changes, and what is not."""

import dataclasses
import functools
import importlib.metadata
import os
import pkgutil
import subprocess
import sys

import numpy as np
import pytest

from mocapbench import baselines, benchmark, datasets
from mocapbench.baselines import Calibrated, calibration, common
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS, find_calibration
from mocapbench.benchmark.runs import keys
from mocapbench.benchmark.runs.keys import fit_contents, key_of, metric_contents, score_contents
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.request import Request
from mocapbench.benchmark.runs.source_code import reading
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Case
from mocapbench.benchmark.tasks.seeds import Seeds

TASK = TASKS.get("toy-interpolation-1")
ADDRESS = Address(TASK.name, TASK.version, "test 1", 0, "trivial")
SEEDS = Seeds(0, ADDRESS)


def _key(case=TASK.cases[0], seeds=SEEDS, **changes):
    entrant = {"model": MODELS.get("trivial"), "parameters": {}, "digests": {}}
    return key_of(fit_contents(case, seeds, **{**entrant, **changes}))


def _key_of(task, model):
    """Return the fit key of a model on the first case of a task."""
    entrant = {"model": MODELS.get(model), "calibration": find_calibration(model)}
    return _key(TASKS.get(task).cases[0], **entrant)


@pytest.mark.parametrize(
    "changes",
    [
        {"seeds": Seeds(1, ADDRESS)},
        {"seeds": Seeds(0, ADDRESS._replace(task="other"))},
        {"seeds": Seeds(0, ADDRESS._replace(version=2))},
        {"seeds": Seeds(0, ADDRESS._replace(case="other"))},
        {"seeds": Seeds(0, ADDRESS._replace(fold=1))},
        {"seeds": Seeds(0, ADDRESS._replace(label="other"))},
        {"case": TASK.cases[1]},
        {"model": MODELS.get("cubic-spline")},
        {"parameters": {"a": 1}},
        {"digests": {"cmu:02_01": "abc"}},
        {"calibration": Calibrated},
    ],
    ids=lambda changes: str(next(iter(changes.values())))[:60],
)
def test_everything_that_can_change_the_result_changes_the_key(changes):
    assert _key(**changes) != _key()


def test_order_of_parameters_does_not():
    assert _key(parameters={"a": 1, "b": 2}) == _key(parameters={"b": 2, "a": 1})


def _score_key(metrics, case="row", references=None):
    return key_of(score_contents("fit", metric_contents(metrics), case, references or {}))


def test_a_metric_changes_the_score_key_alone():
    mse, msll = METRICS.get("mse"), METRICS.get("msll")
    assert _score_key([mse]) != _score_key([mse, msll])
    assert _score_key([mse, msll]) == _score_key([msll, mse])


def test_rows_and_references_change_the_score_key_alone():
    mse = METRICS.get("mse")
    shared = dataclasses.replace(TASK.cases[0], problem_name="what is posed")
    row, other = (dataclasses.replace(shared, name=name, columns={"row": name}) for name in "ab")
    assert _key(row) == _key(other) == _key()
    keys = [_score_key([mse], "a"), _score_key([mse], "b"), _score_key([mse], "a", {"r": "0"})]
    assert len({*keys, _score_key([mse], "a", {"r": "1"})}) == 4


def test_cases_that_share_a_problem_share_its_fits_whatever_references_each_binds():
    def case(name, reference):
        problem = functools.partial(_problem, 1, references=(reference,))
        return Case(name, problem, references=(reference,), problem_name="what is posed")

    assert _key(case("a", "cmu:01_01")) == _key(case("b", "cmu:02_01"))
    apart = [dataclasses.replace(case(name, name), problem_name="") for name in "ab"]
    assert _key(apart[0]) != _key(apart[1])


@pytest.mark.parametrize("name", METRICS.names())
def test_a_metric_is_named_by_its_own_source(name, append):
    """Also where the function is bound to arguments, which count too."""
    metric = METRICS.get(name)
    before = _score_key([metric])
    statistic = functools.partial(metric.statistic, level=0.123)
    assert _score_key([dataclasses.replace(metric, statistic=statistic)]) != before
    right = metric.statistic
    while isinstance(right, functools.partial):
        right = right.func
    append(right.__module__)
    assert _score_key([metric]) != before
    append("mocapbench.metrics.base")
    assert _score_key([metric]) != before


def test_a_metric_is_not_named_by_the_source_of_another(append):
    before = _score_key([METRICS.get("mse")])
    append("mocapbench.metrics.similarity")
    assert _score_key([METRICS.get("mse")]) == before


FIT_PATH = [
    ("benchmark.problems.base", "toy-interpolation-1", "trivial"),
    ("benchmark.problems.impute", "toy-interpolation-1", "trivial"),
    ("benchmark.problems.masks", "toy-interpolation-1", "trivial"),
    ("benchmark.problems.internals", "toy-interpolation-1", "trivial"),
    ("benchmark.problems.synthesise", "toy-synthesis", "control"),
    ("benchmark.problems.cluster", "style-clustering", "k-means"),
    ("benchmark.problems.recover", "covariance-recovery", "mohgp"),
    ("benchmark.tasks.seeds", "toy-interpolation-1", "trivial"),
    ("benchmark.tasks.address", "toy-interpolation-1", "trivial"),
    ("benchmark.tasks.toy_interpolation", "toy-interpolation-1", "trivial"),
    ("benchmark.tasks.thesis_recordings", "walking-synthesis", "moa"),
    ("benchmark.tasks.hlm_recordings", "style-clustering", "k-means"),
    ("benchmark.runs.fitting.solve", "toy-interpolation-1", "trivial"),
    ("benchmark.runs.fitting.fit", "toy-interpolation-1", "trivial"),
    ("datasets.process", "toy-interpolation-1", "trivial"),
    ("datasets.recording", "toy-interpolation-1", "trivial"),
    ("datasets.preprocessing", "walking-interpolation", "trivial"),
    ("datasets.features", "missing-frames", "trivial"),
    ("baselines.protocols", "toy-interpolation-1", "trivial"),
    ("baselines.trivial", "toy-interpolation-1", "trivial"),
    ("datasets.formats.angle_wrapping", "missing-frames", "pose-kriging"),
    ("baselines.common.ascent", "missing-frames", "lds"),
    ("baselines.common.cholesky", "toy-interpolation-1", "mohgp"),
    ("basics.mask_runs", "missing-frames", "knn"),
    ("baselines.common.heading", "missing-frames", "pose-kriging"),
    ("baselines.common.markers", "marker-gaps", "rigid-body"),
    ("baselines.common.rigid", "marker-gaps", "marker-kriging"),
    ("baselines.common.pose_units", "missing-frames", "pose-viterbi"),
    ("baselines.common.prototypes", "style-clustering", "k-fam"),
    ("baselines.calibrated", "toy-interpolation-1", "mohgp"),
    ("baselines.calibration.error_ratios", "toy-interpolation-1", "mohgp"),
    ("baselines.calibration.held_out_gaps", "missing-frames", "lds"),
    ("baselines.calibration.held_out_recordings", "subject-35-missing", "channel-kriging"),
    ("baselines.calibration.left_out_entries", "toy-interpolation-1", "mohgp"),
    ("baselines.calibration.variance_check", "missing-frames", "lds"),
    ("baselines.calibration.ways", "missing-frames", "lds"),
    ("baselines.common.checks", "toy-interpolation-1", "trivial"),
    ("baselines.common.cycle_settings", "missing-frames", "fam"),
    ("baselines.common.padded_sequences", "missing-frames", "lds"),
    ("baselines.common.recordings", "toy-interpolation-1", "trivial"),
    ("baselines.common.scaling", "toy-interpolation-1", "mohgp"),
    ("baselines.common.shortest_path", "missing-frames", "pose-viterbi"),
    ("baselines.common.signs", "toy-interpolation-1", "mohgp"),
    ("baselines.gp.solvers.solver", "toy-interpolation-1", "mohgp"),
    ("baselines.common.transitions", "missing-frames", "knn"),
    ("baselines.common.validation", "toy-interpolation-1", "mohgp"),
    ("baselines.gp.prior.kernels", "toy-interpolation-1", "mohgp"),
    ("baselines.gp.solvers.latent_split.split_gradient", "toy-interpolation-1", "mohgp"),
    ("baselines.gpdm.regression", "missing-frames", "gpdm"),
    ("baselines.alignment.aligner", "missing-frames", "cyclic-alignment"),
    ("baselines.functional.components", "missing-frames", "fam"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("module", "task", "model"), FIT_PATH)
def test_code_that_poses_or_fits_is_part_of_the_fit_key(append, module, task, model):
    before = _key_of(task, model)
    append(f"mocapbench.{module}")
    assert _key_of(task, model) != before


def test_every_module_that_models_have_in_common_is_among_those():
    shared = {
        f"baselines.{package.__name__.rpartition('.')[2]}.{module.name}"
        for package in (calibration, common)
        for module in pkgutil.iter_modules(package.__path__)
    }
    assert shared <= {module for module, _, _ in FIT_PATH}


@pytest.mark.parametrize(
    "module",
    [
        "baselines.knn",
        "baselines.mohgp",
        "benchmark.figures.gap_error",
        "benchmark.gate.rule",
        "benchmark.problems.cluster",
        "benchmark.registry",
        "benchmark.runs.evaluate",
        "benchmark.runs.directory",
        "benchmark.tasks.missing_frames",
        "benchmark.tasks.pages.toy_interpolation",
        "metrics.base",
        "metrics.errors",
        "reports.bundle.task_page",
    ],
)
def test_other_code_is_not(append, module):
    importlib.import_module(f"mocapbench.{module}")
    before = _key()
    append(f"mocapbench.{module}")
    assert _key() == before


@pytest.mark.parametrize("line", ["# a remark", '"""A text."""', "\n\n"])
@pytest.mark.parametrize("module", ["trivial", "protocols"])
def test_prose_is_not(append, module, line):
    before = _key()
    append(f"mocapbench.baselines.{module}", line)
    assert _key() == before


@pytest.fixture
def covered(monkeypatch, forget):
    """Return the modules that the fit keys of all models and all problems cover."""
    read, covered = reading._source, set()

    def source(module):
        covered.add(module)
        return read(module)

    monkeypatch.setattr(reading, "_source", source)
    forget()
    for model in map(MODELS.get, MODELS.names()):
        _key(model=model)
    for case in (case for name in TASKS.names() for case in TASKS.get(name).cases):
        _key(case)
    return covered


def _modules(*packages):
    """Return the full names of the modules that compute something, packages apart."""
    found = (pkgutil.walk_packages(p.__path__, f"{p.__name__}.") for p in packages)
    return {module.name for modules in found for module in modules if not module.ispkg}


def test_no_module_of_the_fit_path_is_forgotten(covered):
    ours = _modules(baselines, datasets, benchmark)
    used_elsewhere = {
        "mocapbench.baselines.declarations.abilities",  # words for people
        "mocapbench.benchmark.problems.blending",  # figures
        "mocapbench.benchmark.problems.cycle",
    }
    harness = {name for name in ours if name.startswith("mocapbench.benchmark.")}
    posing = tuple(f"mocapbench.benchmark.{part}." for part in ("problems", "tasks"))
    poses = {name for name in harness if name.startswith(posing) and ".pages." not in name}
    solves = {f"mocapbench.benchmark.runs.fitting.{name}" for name in ("solve", "fit")}
    users_files = {name for name in ours if name.startswith("mocapbench.datasets.formats")}
    expected = (ours - harness | poses | solves) - used_elsewhere - users_files
    assert expected - covered == set()
    assert {name for name in covered & harness if not name.startswith(posing)} <= solves | {
        "mocapbench.benchmark.errors"
    }


def test_versions_of_the_numerical_libraries_count(monkeypatch):
    before = _key()
    right = importlib.metadata.version
    for library in ("numpy", "scipy", "scikit-learn"):
        monkeypatch.setattr(
            importlib.metadata, "version", lambda n, ours=library: "0" if n == ours else right(n)
        )
        keys._installed_version.cache_clear()
        assert _key() != before, library
    monkeypatch.setattr(importlib.metadata, "version", right)
    keys._installed_version.cache_clear()
    assert _key() == before


def _problem(*arguments, **options):
    """Pose nothing; only its name, its source and its arguments matter here."""


@dataclasses.dataclass(frozen=True)
class Design:
    noise: float
    grid: tuple[float, ...] = ()


class Posed:
    """A problem as an object that is called."""

    def __init__(self, noise):
        self.noise = noise

    def __repr__(self):
        return f"Posed({self.noise})"

    def __call__(self, seeds, archive):
        return _problem(self.noise)

    def pose(self, seeds, archive):
        return _problem(self.noise)


def _key_posed_by(problem):
    return _key(Case("case", problem))


@pytest.mark.parametrize(
    "bind",
    [
        lambda value: functools.partial(_problem, value),
        lambda value: functools.partial(_problem, noise=value),
        lambda value: functools.partial(functools.partial(_problem, 0.5), value),
        lambda value: functools.partial(_problem, Design(value)),
        lambda value: functools.partial(_problem, (Design(0.1), Design(value))),
        lambda value: functools.partial(_problem, {"noise": value}),
        lambda value: functools.partial(_problem, np.linspace(0.0, value, 5000)),
        lambda value: functools.partial(_problem, functools.partial(_problem, value)),
        lambda value: functools.partial(_problem, Posed(value)),
        Posed,
        lambda value: Posed(value).pose,
    ],
)
def test_what_is_bound_to_a_problem_counts(bind):
    assert _key_posed_by(bind(0.1)) == _key_posed_by(bind(0.1))
    assert _key_posed_by(bind(0.1)) != _key_posed_by(bind(0.1 + 1e-15))


def test_the_name_of_a_bound_argument_counts():
    one, other = (functools.partial(_problem, **{name: 1}) for name in ("noise", "seed"))
    assert _key_posed_by(one) != _key_posed_by(other)


@pytest.mark.parametrize(
    "value", [object(), (object(),), Design(object()), iter([1]), np.random.default_rng(0)]
)
def test_an_argument_that_cannot_be_told_apart_is_refused(value):
    with pytest.raises(UsageError, match=r"expected arguments .* got .* at 0x.*; use a dataclass"):
        _key_posed_by(functools.partial(_problem, value))


PLUGIN = """\
import numpy as np

from mocapbench.baselines.trivial import Trivial
from mocapbench.benchmark import Case, ImputeProblem, Profile, Task, hide_frames
from mocapbench.baselines import FrameImputer
from mocapbench.datasets import Library, Recording
from mocapbench.metrics import Direction, Imputation, Score, metric
from mocapbench.reports import TaskPage


class Mine(Trivial):
    '''Prose.'''

    def __init__(self, size=1):
        self.size = size


class Waves(Library):
    def where(self, key):
        return str(self.folders[0] / key) if (self.folders[0] / key).is_file() else ""

    def recording(self, key):
        values = np.frombuffer((self.folders[0] / key).read_bytes(), dtype=np.uint8)
        return Recording(key, np.arange(30) / 30, values[:, None].astype(float), ["wave"], [""])


def gap(seeds, archive):
    return ImputeProblem.of_one(archive.recording("waves:a"), hide_frames(10, 20, 30, 1))


@metric(title="Worst", direction=Direction.LOWER)
def worst(outcome: Imputation):
    return Score(1.0, {})


MODELS = {"mine": Mine}
LIBRARIES = {"waves": Waves}
METRICS = {"worst": worst}
TASKS = {
    "waves": Task(
        name="waves",
        version=1,
        requires={"fills frames"},
        cases=(Case("gap", gap, given=("waves:a",), parameters={"size": 2}),),
        profiles={"quick": Profile(("gap",), folds=1)},
        page=TaskPage(title="Waves", reference="", description="A gap.", metrics=("mse",)),
    )
}
"""


@pytest.fixture
def planned(tmp_path, forget):
    """Return a function from a plugin's text and a recording to the keys of its one job."""

    def planned(text=PLUGIN, content=bytes(range(30)), model="mine"):
        (tmp_path / "plugin.py").write_text(text)
        (tmp_path / "a").write_bytes(content)
        forget()
        load_plugin(tmp_path / "plugin.py")
        request = Request(tasks=("waves",), models=(model,), metrics=("mse", "worst"))
        (job,) = plan(request, archive_at(tmp_path))
        return job.fit_key, job.key

    return planned


def test_a_byte_of_a_recording_changes_both_keys(planned):
    (fit, score), again = planned(), planned()
    assert (fit, score) == again
    other_fit, other_score = planned(content=bytes([*range(29), 255]))
    assert other_fit != fit
    assert other_score != score


@pytest.mark.parametrize("model", ["mine", "cubic-spline"])
@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("hide_frames(10", "hide_frames(11"),
        ("version=1", "version=2"),
        ("Score(1.0", "Score(2.0"),
        ("self.size = size", "self.size = size + 0"),
    ],
)
def test_code_of_a_users_file_changes_the_keys_of_what_it_adds(planned, model, old, new):
    """A file is one module: all of its code counts for each of what it defines."""
    before = planned(model=model)
    assert old in PLUGIN
    after = planned(PLUGIN.replace(old, new), model=model)
    assert before[0] != after[0]
    assert before[1] != after[1]


def test_a_cases_parameters_change_the_key_of_a_model_that_has_them():
    task = TASKS.get("style-clustering")

    def planned(**parameters):
        case = dataclasses.replace(task.cases[0], parameters=parameters)
        TASKS.add(task.name, dataclasses.replace(task, cases=(case,)))
        request = Request(tasks=(task.name,), cases=(case.name,), models=("k-means",), folds=1)
        (job,) = plan(request, archive_at())
        return job.fit_key

    assert planned(n_styles=2) != planned(n_styles=3)
    assert planned(n_styles=2, unknown=1) == planned(n_styles=2, unknown=2)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("'''Prose.'''", "'''Other prose.'''"),
        ("MODELS =", "# A remark.\n\n\nMODELS ="),
        ('        name="waves",\n', '        name=("waves"),\n'),
    ],
)
def test_prose_of_a_users_file_changes_no_key(planned, old, new):
    assert old in PLUGIN
    assert planned(PLUGIN.replace(old, new, 1)) == planned()


def test_the_order_of_registration_changes_no_key(planned, tmp_path):
    before = planned()
    (tmp_path / "models.py").write_text(
        "from mocapbench.baselines.trivial import Trivial\nMODELS = {'aaa': Trivial}\n"
    )
    load_plugin(tmp_path / "models.py")
    MODELS._added = dict(reversed(MODELS._added.items()))
    TASKS._added = dict(reversed(TASKS._added.items()))
    assert planned() == before


def test_the_order_of_metrics_changes_no_key():
    toy = {"tasks": (TASK.name,), "models": ("trivial",), "cases": ("test 1",), "folds": 1}
    one, other = (
        plan(Request(**toy, metrics=metrics), archive_at())
        for metrics in (("mse", "smse"), ("smse", "mse"))
    )
    assert one == other


@pytest.mark.slow
def test_keys_are_the_same_in_every_process():
    script = (
        "from mocapbench.benchmark import Request, archive_at, plan\n"
        f"request = Request('smoke', tasks=({TASK.name!r}, 'toy-synthesis'))\n"
        "print(*((job.key, job.fit_key) for job in plan(request, archive_at())))\n"
    )
    printed = {
        subprocess.run(
            [sys.executable, "-c", script],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
            timeout=120,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(printed) == 1
    assert printed.pop().count("(") > 10
