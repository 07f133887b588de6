"""Merging is a union: in any order, any grouping and any number of times, it is the same."""

import math
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mocapbench.basics.whole_files import write_bytes
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.merging import merge as module
from mocapbench.benchmark.merging.merge import merge
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Status

ROWS = [
    (task, case, label, fold)
    for task in ("t", "u")
    for case in ("a", "bb")
    for label in ("x", "y")
    for fold in (0, 1)
]
ROW = ROWS[0]
STATUSES = st.sampled_from([Status.OK, Status.OK, Status.FAILED, Status.TIMEOUT])
SOME_RUN = st.dictionaries(st.sampled_from(ROWS), STATUSES, min_size=1)


def _files(path):
    """Return what a run directory holds of results, by name."""
    found = [p for p in Path(path).rglob("*") if p.suffix in {".json", ".npz"}]
    below = {p.relative_to(path).as_posix(): p.read_bytes() for p in found}
    return {name: content for name, content in below.items() if "/" in name}


def _plan(path):
    return RunDirectory(path).load_plan()


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(SOME_RUN, min_size=3, max_size=3), st.sets(st.sampled_from(ROWS)))
def test_merging_is_a_union(write_run, runs, left):
    with TemporaryDirectory() as folder:
        a, b, c, ab, ba, abc, bc, a_bc, again = (
            Path(folder) / name for name in ("a", "b", "c", "ab", "ba", "abc", "bc", "a_bc", "aab")
        )
        for path, run in zip((a, b, c), runs, strict=True):
            write_run(path, sorted(run, reverse=path is b), statuses=run, left=left)
        merge([a, b], ab)
        merge([b, a], ba)
        assert _files(ab) == _files(ba)
        assert set(_plan(ab)["keys"]) == set(_plan(ba)["keys"])
        assert RunDirectory(ab).load_keys().keys() >= RunDirectory(ab).record_keys()
        merge([ab, c], abc)
        merge([b, c], bc)
        merge([a, bc], a_bc)
        assert _files(abc) == _files(a_bc)
        assert _plan(abc) == _plan(a_bc)
        merge([a, ab, b, a], again)
        before = _files(ab), _plan(ab)
        merge([a, b], ab)
        assert (_files(again), _plan(again)) == before == (_files(ab), _plan(ab))


def test_jobs_are_in_table_order_and_that_of_the_first_run_goes_first(write_run, tmp_path):
    first = [("u", "b", "y", 0), ("u", "b", "x", 0), ("u", "a", "y", 0)]
    second = [("t", "a", "x", 0), ("u", "a", "y", 1), ("u", "b", "y", 1), ("u", "b", "x", 0)]
    one, other = write_run(tmp_path / "1", first), write_run(tmp_path / "2", second)
    merge([one, other], tmp_path / "out")
    found = [
        (record.address.task, record.address.case, record.address.label, record.address.fold)
        for record in RunDirectory(tmp_path / "out").planned()
    ]
    expected = [("u", "b", "y", 1), ("u", "b", "x", 0), ("u", "a", "y", 0), ("u", "a", "y", 1)]
    assert found == [("u", "b", "y", 0), *expected, ("t", "a", "x", 0)]


def test_different_scores_of_one_job_are_refused_with_both_values_and_places(write_run, tmp_path):
    one = write_run(tmp_path / "1", [ROW], scores={ROW: 0.125})
    other = write_run(tmp_path / "2", [ROW], scores={ROW: 0.25})
    with pytest.raises(UsageError, match="expected equal scores") as refused:
        merge([one, other], tmp_path / "out")
    message = str(refused.value)
    assert "t · a · x · fold 1: mse 0.125 in" in message
    (key,) = RunDirectory(one).record_keys()
    for value, path in (("0.125", one), ("0.25", other)):
        assert f"mse {value}" in message or f", {value} in" in message
        assert str(RunDirectory(path).record_path(key)) in message
    assert sorted(path.name for path in tmp_path.iterdir()) == ["1", "2"]


def test_of_many_differences_only_some_are_shown(write_run, tmp_path):
    one, other = (
        write_run(tmp_path / name, ROWS, scores=dict.fromkeys(ROWS, score))
        for name, score in (("1", 0.5), ("2", 1.5))
    )
    with pytest.raises(UsageError, match=f"… and {len(ROWS) - 10} more"):
        merge([one, other], tmp_path / "out")


def test_an_undefined_score_is_equal_to_itself(write_run, tmp_path):
    one, other = (write_run(tmp_path / name, [ROW], scores={ROW: math.nan}) for name in ("1", "2"))
    merge([one, other], tmp_path / "out")
    assert len(RunDirectory(tmp_path / "out").planned()) == 1


@pytest.mark.parametrize("order", [1, -1])
def test_a_job_that_went_well_counts_rather_than_one_that_broke(write_run, tmp_path, order):
    runs = [
        write_run(tmp_path / "1", [ROW], statuses={ROW: Status.FAILED}),
        write_run(tmp_path / "2", [ROW]),
    ]
    merge(runs[::order], tmp_path / "out")
    (record,) = RunDirectory(tmp_path / "out").planned()
    assert record.status is Status.OK


@pytest.mark.parametrize("order", [1, -1])
def test_a_job_without_its_recordings_gives_way_to_one_with_them(write_run, tmp_path, order):
    missing, there = {"recording r": '"missing"'}, {"recording r": '"0"'}
    runs = [
        write_run(tmp_path / "1", [ROW], statuses={ROW: Status.DATA_MISSING}, parts=missing),
        write_run(tmp_path / "2", [ROW], parts=there),
    ]
    merge(runs[::order], tmp_path / "out")
    (record,) = RunDirectory(tmp_path / "out").planned()
    assert record.status is Status.OK
    assert len(RunDirectory(tmp_path / "out").records()) == 2


def test_two_jobs_of_one_row_are_refused_and_what_differs_is_named(write_run, tmp_path):
    one = write_run(tmp_path / "1", [ROW], parts={"seed": "0", "model code": "sha256:a"})
    other = write_run(tmp_path / "2", [ROW], parts={"seed": "1", "model code": "sha256:b"})
    with pytest.raises(UsageError, match="two for t · a · x · fold 1, which differ in") as refused:
        merge([one, other], tmp_path / "out")
    assert "seed 0 → 1" in str(refused.value)
    assert "model code" in str(refused.value)
    assert not (tmp_path / "out").exists()


def test_damaged_files_are_named_and_left_out_unless_another_run_has_them_whole(
    write_run, tmp_path
):
    one, other = write_run(tmp_path / "1", ROWS[:2]), write_run(tmp_path / "2", ROWS[:1])
    victims = [
        *RunDirectory(one).path.rglob("records/*/*"),
        *RunDirectory(one).path.rglob("predictions/*/*"),
    ]
    assert len(victims) == 4
    for path in victims:
        path.write_bytes(path.read_bytes()[:-30])
    merged = merge([one, other], tmp_path / "out")
    assert all(any(str(path) in message for message in merged.damaged) for path in victims)
    assert _files(tmp_path / "out") == _files(other)
    assert len(_plan(tmp_path / "out")["keys"]) == 2


@pytest.mark.parametrize("harm", [Path.unlink, lambda path: path.write_text("{")])
def test_without_a_plan_all_records_of_a_run_count_as_planned(write_run, tmp_path, harm):
    one, other = write_run(tmp_path / "1", ROWS[:1]), write_run(tmp_path / "2", ROWS[1:4])
    harm(other / "plan.json")
    merged = merge([one, other], tmp_path / "out")
    assert "plan.json" in merged.damaged[0]
    assert len(RunDirectory(tmp_path / "out").planned()) == 4


def test_plans_of_earlier_versions_tell_their_rows_by_the_records(write_run, tmp_path):
    one, other = write_run(tmp_path / "1", ROWS[:2]), write_run(tmp_path / "2", ROWS[1:4])
    old = {name: _plan(one)[name] for name in ("keys", "provenance")}
    RunDirectory(one).save_plan(old)
    merge([one, other], tmp_path / "out")
    assert _plan(tmp_path / "out")["keys"][:2] == old["keys"]
    assert len(RunDirectory(tmp_path / "out").planned()) == 4


def test_the_plan_says_where_it_comes_from(write_run, tmp_path):
    one, other = write_run(tmp_path / "1", ROWS[:1]), write_run(tmp_path / "2", ROWS[1:])
    merge([one, other], tmp_path / "out")
    about = _plan(tmp_path / "out")["provenance"]
    assert about["merged from"] == f"{one}; {other}"
    assert about["profile"] == "smoke"
    assert about["started"] == "when 1 started and when 2 started"


@pytest.mark.parametrize("named", [True, False])
def test_a_run_that_is_there_takes_part(write_run, tmp_path, named):
    out, other = write_run(tmp_path / "1", ROWS[:2]), write_run(tmp_path / "2", ROWS[1:4])
    RunDirectory(out).save_check({"of": "what is no longer all"})
    merge([out, other] if named else [other], out)
    assert len(RunDirectory(out).planned()) == 4
    assert not (out / "check.json").exists()
    with pytest.raises(UsageError, match="expected two run directories or more"):
        merge([out], out)


def test_a_single_run_is_no_merge(write_run, tmp_path):
    one = write_run(tmp_path / "1", ROWS[:2])
    with pytest.raises(UsageError, match="expected two run directories or more"):
        merge([one], tmp_path / "out")


def test_what_is_not_a_run_is_refused_and_left_alone(write_run, tmp_path):
    one, other = write_run(tmp_path / "1", ROWS[:2]), write_run(tmp_path / "2", ROWS[:2])
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("years of work")
    with pytest.raises(UsageError, match="name a new or empty folder"):
        merge([one, other], tmp_path / "mine")
    with pytest.raises(UsageError, match="is not a mocapbench run"):
        merge([one, tmp_path / "mine"], tmp_path / "out")
    assert not (tmp_path / "out").exists()
    assert [path.name for path in (tmp_path / "mine").iterdir()] == ["thesis.txt"]


def test_a_run_that_another_one_writes_to_is_not_merged_into(write_run, tmp_path):
    out, other = write_run(tmp_path / "1", ROWS[:1]), write_run(tmp_path / "2", ROWS[1:4])
    before = _files(out)
    with RunDirectory(out).locked(), pytest.raises(UsageError, match="another run is writing"):
        merge([other], out)
    assert _files(out) == before
    with RunDirectory(other).locked():
        assert merge([out, other], tmp_path / "out").busy == (other,)


class DiskFullError(OSError):
    """As the system raises it."""


@pytest.mark.parametrize("written", [0, 1, 5])
def test_a_merge_that_fails_leaves_no_new_folder(write_run, tmp_path, monkeypatch, written):
    one, other = write_run(tmp_path / "1", ROWS[:3]), write_run(tmp_path / "2", ROWS[3:6])
    count = iter(range(written))

    def failing(path, content):
        if next(count, None) is None:
            raise DiskFullError
        write_bytes(path, content)

    monkeypatch.setattr(module, "write_bytes", failing)
    with pytest.raises(DiskFullError):
        merge([one, other], tmp_path / "out")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["1", "2"]


def test_a_merge_that_fails_leaves_the_plan_of_an_existing_run(write_run, tmp_path, monkeypatch):
    out, other = write_run(tmp_path / "1", ROWS[:3]), write_run(tmp_path / "2", ROWS[3:6])
    plan, count = _plan(out), iter(range(4))

    def failing(path, content):
        if next(count, None) is None:
            raise DiskFullError
        write_bytes(path, content)

    with monkeypatch.context() as patched, pytest.raises(DiskFullError):
        patched.setattr(module, "write_bytes", failing)
        merge([other], out)
    assert _plan(out) == plan
    assert RunDirectory(out).damaged == []
    merge([other], out)
    assert len(RunDirectory(out).planned()) == 6
