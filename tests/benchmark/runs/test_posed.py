"""All entrants of a fold are posed one problem, or a run says that they were not."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from mocapbench.benchmark import ImputeProblem, hide_frames
from mocapbench.benchmark.runs.posed import PosedProblems, problem_digest
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.datasets import Recording

VALUES = np.arange(20.0).reshape(10, 2)
HIDDEN = hide_frames(3, 6, 10, 2)


def pose(values=VALUES, hidden=HIDDEN, name="wave"):
    wave = Recording(name, np.arange(10.0), values, ("a", "b"), ("", ""))
    return ImputeProblem.of_one(wave, hidden)


def test_problems_that_are_equal_have_one_digest():
    assert problem_digest(pose()) == problem_digest(pose(VALUES.copy(), HIDDEN.copy()))


def test_arrays_that_are_shared_count_as_equal_ones_do():
    """A cache may hand out one object twice, or two equal ones."""
    one = pose()
    assert problem_digest(one) == problem_digest(replace(one, given=pose().given))


@pytest.mark.parametrize(
    "other",
    [
        pose(VALUES + 1e-12),
        pose(hidden=hide_frames(4, 7, 10, 2)),
        pose(name="other"),
        replace(pose(), truth=(VALUES + 1.0,)),
        replace(pose(), train=()),
        replace(pose(), scales=np.ones(2)),
    ],
    ids=["given", "hidden", "name", "truth", "train", "scales"],
)
def test_whatever_differs_in_a_problem_counts(other):
    assert problem_digest(other) != problem_digest(pose())


@dataclass
class Holds:
    value: object


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ((1, 2), (1, 3)),
        (("ab", "c"), ("a", "bc")),
        ((("a",), "b"), (("a", "b"),)),
        (((), ()), (((),),)),
        ({"a": {"b": 1}, "c": 2}, {"a": {"b": 1, "c": 2}}),
        ([1], (1,)),
        ({"a": 1}, {"a": 2}),
        ({"a"}, {"b"}),
        (np.array(["a", None]), np.array(["b", None])),
        (np.zeros(2), np.zeros((2, 1))),
        (1, 1.0),
        (True, 1),
    ],
)
def test_values_of_every_kind_are_told_apart(one, other):
    assert problem_digest(Holds(one)) == problem_digest(Holds(one))
    assert problem_digest(Holds(one)) != problem_digest(Holds(other))


def test_objects_that_cannot_be_looked_into_count_by_their_class():
    assert problem_digest(Holds(SimpleNamespace(a=1))) == problem_digest(
        Holds(SimpleNamespace(a=2))
    )
    assert problem_digest(Holds(print)) != problem_digest(Holds(SimpleNamespace()))


ADDRESS = Address("waves", 1, "gap", 0, "knn")


def record(label="knn", problem="one", cpu="A", seed=0, **address):
    return Record(
        f"key of {label}",
        "fit",
        ADDRESS._replace(label=label, **address),
        seed,
        label,
        {},
        Status.OK,
        scores={"mse": 1.0},
        parts={"mse": {"frame": [1.0]}},
        left_out={"mse": 1},
        provenance={"CPU": cpu},
        problem=problem,
    )


def test_a_job_that_was_posed_another_problem_has_failed():
    posed = PosedProblems()
    assert posed.check_record(record()).status is Status.OK
    assert posed.check_record(record("lds")).status is Status.OK
    failed = posed.check_record(record("trivial", "two"))
    assert failed.status is Status.FAILED
    assert "the problem of this fold that was posed to knn, got another" in failed.message
    assert (failed.scores, failed.parts, failed.left_out) == ({}, {}, {})
    assert posed.check_record(record("hold", "two")).status is Status.FAILED


@pytest.mark.parametrize(
    "other",
    [{"fold": 1}, {"case": "gap 2"}, {"task": "steps"}, {"version": 2}, {"seed": 1}, {"cpu": "B"}],
    ids=lambda other: next(iter(other)),
)
def test_other_folds_seeds_and_machines_are_not_compared(other):
    posed = PosedProblems()
    posed.check_record(record())
    checked = record("trivial", "two", **other)
    assert posed.check_record(checked) is checked


def test_records_without_a_digest_stay_as_they_are():
    posed = PosedProblems()
    for one in (record(), record("earlier", ""), record("lds")):
        assert posed.check_record(one) is one


def test_digests_that_were_made_otherwise_are_not_compared():
    posed = PosedProblems()
    for one in (record(problem="1f"), record("lds", "2:ab"), record("hold", "2:ab")):
        assert posed.check_record(one) is one
    assert posed.check_record(record("trivial", "2:cd")).status is Status.FAILED
    assert problem_digest(pose()).partition(":")[:2] == ("3", ":")


RANDOM = """\
import numpy as np
from mocapbench.baselines import FrameImputer
from mocapbench.benchmark import Case, ImputeProblem, Profile, Task, hide_frames
from mocapbench.datasets import Recording
from mocapbench.reports import TaskPage


def wave(seeds, archive):
    values = RNG.normal(size=(30, 1))
    wave = Recording("wave", np.arange(30.0), values, ("height",), ("",))
    return ImputeProblem.of_one(wave, hide_frames(5, 9, 30, 1))


TASKS = {
    "waves": Task(
        name="waves",
        version=1,
        requires={"fills frames"},
        cases=(Case("gap", wave),),
        profiles={"smoke": Profile(("gap",), folds=1)},
        page=TaskPage(title="Waves", reference="", description="A gap.", metrics=("mse",)),
    )
}
"""


def test_a_run_of_a_task_that_draws_by_itself_fails_all_but_one_job(cli, records, tmp_path):
    (tmp_path / "waves.py").write_text(RANDOM.replace("RNG", "np.random.default_rng()"))
    run = ("run", "--plugin", tmp_path / "waves.py", "--profile", "smoke", "--tasks", "waves")
    chosen = ("--models", "linear,hold,trivial", "--offline", "--no-report")
    for _ in range(2):  # again from what the first left
        assert cli(*run, *chosen, "--out", tmp_path / "run") == 3
        assert "3 jobs: 1 ok, 2 failed" in cli.printed
        assert "`check_task` tests" in cli.printed
    statuses = sorted(document["status"] for document in records(tmp_path / "run").values())
    assert statuses == ["failed", "failed", "ok"]


def test_a_run_of_a_task_that_draws_from_its_seeds_fails_none(cli, records, tmp_path):
    (tmp_path / "waves.py").write_text(RANDOM.replace("RNG", "seeds.generator('data')"))
    run = ("run", "--plugin", tmp_path / "waves.py", "--profile", "smoke", "--tasks", "waves")
    chosen = ("--models", "linear,hold,trivial", "--offline", "--no-report")
    assert cli(*run, *chosen, "--out", tmp_path / "run") == 0
    assert len({d["problem"] for d in records(tmp_path / "run").values()}) == 1
