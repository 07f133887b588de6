"""Of a job that runs, exactly the part of its key is named that is new."""

import dataclasses
import importlib.metadata

import pytest

from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.inspection.explanation import Step, explain, in_words
from mocapbench.benchmark.inspection.output import explanation_table
from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.runs import keys
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.fitting import solve
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.runs.request import Request

MODEL = """\
from mocapbench.baselines.trivial import Trivial


class Mine(Trivial):
    def __init__(self, size=1):
        self.size = size


MODELS = {"mine": Mine}
"""
METRIC = """\
from mocapbench.metrics import Direction, Imputation, Score, metric


@metric(title="Worst", direction=Direction.LOWER)
def worst(outcome: Imputation):
    return Score(1.0, {})


METRICS = {"worst": worst}
"""
TASK = """\
import numpy as np

from mocapbench.baselines import FrameImputer
from mocapbench.benchmark import Case, ImputeProblem, Profile, Task, hide_frames
from mocapbench.datasets import Library, Recording
from mocapbench.reports import TaskPage


class Waves(Library):
    def where(self, key):
        return str(self.folders[0] / key) if (self.folders[0] / key).is_file() else ""

    def recording(self, key):
        values = np.frombuffer((self.folders[0] / key).read_bytes(), dtype=np.uint8)
        return Recording(key, np.arange(30) / 30, values[:, None].astype(float), ["wave"], [""])


def gap(seeds, archive):
    return ImputeProblem.of_one(archive.recording("waves:a"), hide_frames(10, 20, 30, 1))


LIBRARIES = {"waves": Waves}
TASKS = {
    "waves": Task(
        name="waves",
        version=1,
        requires={"fills frames"},
        cases=(Case("gap", gap, given=("waves:a",), parameters={"size": 2}),),
        profiles={"quick": Profile(("gap",), folds=2)},
        page=TaskPage(title="Waves", reference="", description="A gap.", metrics=("mse",)),
    )
}
"""
METRICS_ASKED = ("mse", "worst")


def _fit():
    return Fit({}, 1.0, 1.0, 1.0, 1, True)


class World:
    """A model, a metric, a task and a recording of a user's own, which change; and a run."""

    def __init__(self, folder, forget):
        self.out, self._folder, self._forget = folder / "out", folder, forget
        self.files = {"my_model.py": MODEL, "my_metric.py": METRIC, "my_task.py": TASK}
        self.content = bytes(range(30))
        self.request = Request(tasks=("waves",), models=("mine",), metrics=METRICS_ASKED)
        self.change_task = lambda task: task

    def jobs(self):
        self._forget()
        keys._installed_version.cache_clear()
        (self._folder / "a").unlink(missing_ok=True)
        if self.content is not None:
            (self._folder / "a").write_bytes(self.content)
        for name, text in self.files.items():
            (self._folder / name).write_text(text)
            load_plugin(self._folder / name)
        TASKS.add("waves", self.change_task(TASKS.get("waves")))
        return plan(self.request, archive_at(self._folder))

    def run(self, status=Status.OK, *, fits=True):
        """Leave the records of a run."""
        store, jobs = RunDirectory.create(self.out), self.jobs()
        store.keep_keys({job.key: (job.address, job.parts) for job in jobs})
        for job in jobs:
            store.save(job.record(status))
            if fits:
                store.save_fit(job.fit_key, _fit())

    def explained(self):
        """Return the one explanation of both folds."""
        one, other = explain(self.jobs(), self.out)
        assert dataclasses.replace(one, address=other.address) == other
        return one

    def replace(self, name, old, new):
        assert old in self.files[name]
        self.files[name] = self.files[name].replace(old, new)


@pytest.fixture
def world(tmp_path, forget):
    return World(tmp_path, forget)


def test_without_a_run_nothing_is_known_and_nothing_is_written(world):
    found = world.explained()
    assert (found.step, found.cause, found.changes) == (Step.FIT, "no record yet", {})
    assert not world.out.exists()


def test_what_is_done_is_skipped(world):
    world.run()
    found = world.explained()
    assert (found.step, found.cause, found.changes) == (Step.SKIP, "done", {})


def _parameter(world, monkeypatch):
    def change(task):
        case = dataclasses.replace(task.cases[0], parameters={"size": 3})
        return dataclasses.replace(task, cases=(case,))

    world.change_task = change


def _version(world, monkeypatch):
    world.change_task = lambda task: dataclasses.replace(task, version=2)


def _model(world, monkeypatch):
    world.replace("my_model.py", "self.size = size", "self.size = size + 0")


def _metric(world, monkeypatch):
    world.replace("my_metric.py", "Score(1.0", "Score(2.0")


def _task(world, monkeypatch):
    world.replace("my_task.py", "hide_frames(10", "hide_frames(11")


def _byte(world, monkeypatch):
    world.content = bytes([*range(29), 255])


def _seed(world, monkeypatch):
    world.request = dataclasses.replace(world.request, seed=1)


def _fewer_metrics(world, monkeypatch):
    world.request = dataclasses.replace(world.request, metrics=("mse",))


def _more_metrics(world, monkeypatch):
    world.request = dataclasses.replace(world.request, metrics=(*METRICS_ASKED, "smse"))


def _library(world, monkeypatch):
    right = importlib.metadata.version
    monkeypatch.setattr(
        importlib.metadata, "version", lambda name: "0.1" if name == "scipy" else right(name)
    )


def _fitting(world, monkeypatch):
    monkeypatch.setattr(solve, "__name__", "mocapbench.benchmark.runs.fitting.fit")


CHANGES = {
    "parameter size 2 → 3": (_parameter, Step.FIT),
    "task version 1 → 2": (_version, Step.FIT),
    "model code": (_model, Step.FIT),
    "metric worst": (_metric, Step.SCORE),
    "task code": (_task, Step.FIT),
    "recording waves:a": (_byte, Step.FIT),
    "seed 0 → 1": (_seed, Step.FIT),
    "metric worst left out": (_fewer_metrics, Step.SCORE),
    "metric smse added": (_more_metrics, Step.SCORE),
    "version of scipy": (_library, Step.FIT),
    "fitting code": (_fitting, Step.FIT),
}


@pytest.mark.parametrize(("named", "change", "step"), [(k, *v) for k, v in CHANGES.items()])
def test_exactly_the_part_that_is_new_is_named(world, monkeypatch, named, change, step):
    world.run()
    change(world, monkeypatch)
    found = world.explained()
    assert found.cause == "new since its last record"
    assert len(found.changes) == 1
    assert in_words(found.changes).startswith(named)
    assert found.step is step
    keys._installed_version.cache_clear()


def test_several_new_parts_are_all_named(world, monkeypatch):
    world.run()
    for change in (_model, _metric, _byte):
        change(world, monkeypatch)
    assert set(world.explained().changes) == {"model code", "metric worst", "recording waves:a"}


def test_the_record_most_like_the_job_is_compared_with(world, monkeypatch):
    world.run()
    original = world.request
    world.request = dataclasses.replace(original, seed=5, metrics=("mse",))
    world.run()
    world.request = original
    _metric(world, monkeypatch)
    assert [*world.explained().changes] == ["metric worst"]


def test_a_broken_job_is_tried_again(world):
    world.run(Status.TIMEOUT, fits=False)
    found = world.explained()
    assert (found.step, found.cause) == (Step.FIT, "tried again, since it ended as: timeout")


def test_a_damaged_record_is_no_record(world):
    world.run()
    for path in world.out.rglob("records/*/*"):
        path.write_text("{")
    found = world.explained()
    assert (found.step, found.cause) == (Step.SCORE, "its record is damaged")


def test_jobs_without_recordings_cannot_run_until_they_are_there(world):
    there, world.content = world.content, None
    assert world.explained().step is Step.CANNOT
    world.run(Status.DATA_MISSING, fits=False)
    found = world.explained()
    assert (found.step, found.cause) == (Step.SKIP, "its recordings are still missing")
    world.content = there
    found = world.explained()
    ((part, (before, _)),) = found.changes.items()
    assert (found.step, part, before) == (Step.FIT, "recording waves:a", '"missing"')


def test_a_job_that_never_ended_is_nothing_to_compare_with(world, monkeypatch):
    world.run(fits=False)
    for path in world.out.rglob("records/*/*"):
        path.unlink()
    _seed(world, monkeypatch)
    found = world.explained()
    assert (found.step, found.cause, found.changes) == (Step.FIT, "no record yet", {})


def test_of_jobs_that_share_predictions_one_fits(world):
    def change(task):
        twin = dataclasses.replace(task.cases[0], name="twin", problem_name="gap")
        first = dataclasses.replace(task.cases[0], problem_name="gap")
        profile = dataclasses.replace(task.profile("quick"), cases=("gap", "twin"))
        return dataclasses.replace(task, cases=(first, twin), profiles={"quick": profile})

    world.change_task = change
    steps = [found.step for found in explain(world.jobs(), world.out)]
    assert steps == [Step.FIT, Step.FIT, Step.SCORE, Step.SCORE]
    world.run(fits=False)
    for path in world.out.rglob("records/*/*"):
        path.unlink()
    steps = [found.step for found in explain(world.jobs(), world.out)]
    assert steps == [Step.FIT, Step.FIT, Step.SCORE, Step.SCORE]


@pytest.mark.slow
def test_thousands_of_jobs_are_explained_in_a_few_lines(world):
    archive, metric = archive_at(), METRICS.get("mse")
    jobs = plan(Request("quick", metrics=("mse",)), archive)
    store = RunDirectory.create(world.out)
    store.keep_keys({job.key: (job.address, job.parts) for job in jobs})
    for job in jobs:
        store.save(job.record(Status.OK))
    METRICS.add("mse", dataclasses.replace(metric, statistic=METRICS.get("smse").statistic))
    changed = plan(Request("quick", metrics=("mse",)), archive)
    explanations = explain(changed, world.out)
    table, kinds = explanation_table(explanations), {(e.address.task, e.step) for e in explanations}
    assert len(jobs) > 50 * len(kinds)
    assert table.row_count == len(kinds)
    assert set(table.columns[4].cells) == {"new since its last record: metric mse"}
    assert sum(map(int, table.columns[2].cells)) == len(jobs)


def test_values_that_differ_within_a_line_are_not_shown(world):
    world.run()
    items = explain(world.jobs(), world.out)
    values = [
        dataclasses.replace(item, changes={"p": ("1", str(n))}) for n, item in enumerate(items)
    ]
    assert [*explanation_table(values).columns[4].cells] == ["done: p"]
    same = [dataclasses.replace(i, changes={"p": ("1", "2")}) for i in items]
    assert [*explanation_table(same).columns[4].cells] == ["done: p 1 → 2"]
