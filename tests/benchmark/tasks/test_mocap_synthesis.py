"""Synthesis of motion: what rows share, what judges them, and real motions among each other."""

import os
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.bundle import bundle
from mocapbench.benchmark.runs.plan import Request, entrants, plan
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.runs.solve import build_model
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import THESIS_CHANNELS, open_archive

GOLDENS = Path(__file__).parents[2] / "goldens"
SYNTHESIS = ("walking-synthesis", "exaggerated-synthesis", "soccer-synthesis")
ROWS = [(name, case.name) for name in SYNTHESIS for case in TASKS.get(name).cases]
CONTROL = TASKS.get("control-similarity")


@pytest.fixture(scope="module")
def jobs():
    return plan(Request(profile="paper", tasks=SYNTHESIS), open_archive())


def _problem(name, case):
    task, archive = TASKS.get(name), open_archive()
    case = task.case(case)
    if not all(map(archive.available, case.needs)):
        pytest.skip("MOCAPBENCH_DATA names no recordings, or not these")
    return task.problem(case, Seeds(0, task.name, task.version, case.asked, 0), archive)


def test_cases_that_ask_the_same_share_seeds_and_fits_and_no_record(jobs):
    asked = {(job.seeds, job.label): job.fit_key for job in jobs}
    assert all(asked[job.seeds, job.label] == job.fit_key for job in jobs)
    assert len(set(asked.values())) == len(asked) < len(jobs)
    assert len({job.key for job in jobs}) == len(jobs)


@pytest.mark.parametrize("name", SYNTHESIS)
def test_what_is_asked_follows_from_the_training_recordings(name):
    asked = {case.asked: case.sources for case in TASKS.get(name).cases}
    assert all(asked[case.asked] == case.sources for case in TASKS.get(name).cases)


def test_only_what_needs_a_missing_recording_lacks_data(jobs):
    lacking = {job.case for job in jobs if "cmu:38_02" in job.digests}
    rows = {"38(2)", "all five"}
    assert lacking == rows | {f"{row} from three walks" for row in rows}


def test_a_job_has_the_digest_of_every_recording_that_it_takes(jobs):
    for job in jobs:
        assert set(job.digests) == set(TASKS.get(job.seeds.task).case(job.case).needs)


def test_rows_over_several_references_do_not_count_beside_those_of_each(jobs):
    layouts = bundle([job.record(Status.DATA_MISSING, "fetch it") for job in jobs], {}).layouts
    assert {layout.name for layout in layouts} == set(SYNTHESIS)
    for layout in layouts:
        counted = [c for c in layout.cases if not (c.pooled or c.synthetic)]
        assert all(case.published == case.settings["reference"] for case in counted)
        assert {case.published for case in layout.cases if case.pooled} == {None}


def test_rows_with_one_question_are_fitted_once(cli, tmp_path):
    arguments = ("--tasks", CONTROL.name, "--cases", "synthetic 1 vs *", "--offline")
    assert cli("run", *arguments, "--out", tmp_path) == 0
    assert len(list((tmp_path / "records").glob("*.json"))) == 2
    assert len(list((tmp_path / "predictions").glob("*.npz"))) == 1


@pytest.mark.parametrize(("name", "case"), ROWS)
def test_recordings_share_90_frames_of_39_channels_from_time_0(name, case):
    problem = _problem(name, case)
    assert problem.times[0] == 0.0
    for recording in problem.train:
        np.testing.assert_array_equal(recording.times, problem.times)
        assert recording.values.shape == (90, 39)
    assert {reference.shape for reference in problem.references} == {(90, 39)}


def test_kicks_that_models_learn_from_are_none_of_the_unseen():
    rows = [c for c in TASKS.get("soccer-synthesis").cases if c.name.startswith("unseen only")]
    assert [len(case.references) for case in rows] == [3, 3]
    assert not any(set(case.references) & set(case.sources) for case in rows)


@pytest.mark.slow
@pytest.mark.recordings
def test_figures_are_named_after_what_models_learn_from(cli, tmp_path):
    _problem("walking-synthesis", "35(1)")
    which = ("--tasks", "walking-synthesis", "--cases", "35(1)", "--models", "mohgp-3", "--offline")
    assert cli("run", *which, "--profile", "smoke", "--out", tmp_path) == 0
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Coregionalisation by mohgp-3, all joints: two walks" in page


@pytest.mark.recordings
def test_frames_are_those_of_the_footnotes():
    problem = _problem("soccer-synthesis", "10(6)")
    whole = open_archive().recording("cmu:10_06").select(THESIS_CHANNELS).values
    np.testing.assert_array_equal(problem.train[1].values[[0, -1]], whole[[130, 565]])
    np.testing.assert_array_equal(problem.references[0][[0, -1]], whole[[130, 361]])
    assert problem.times[-1] == pytest.approx(435 / 120)


@pytest.mark.recordings
def test_short_kicks_are_cut_as_the_references_are():
    long, short = (
        _problem("soccer-synthesis", case) for case in ("10(5)", "10(5) from short kicks")
    )
    np.testing.assert_array_equal(short.train[0].values, short.references[0])
    assert not np.array_equal(long.train[0].values, long.references[0])


@pytest.mark.parametrize("name", SYNTHESIS)
def test_generated_references_are_of_other_walkers(name):
    case = TASKS.get(name).case("synthetic")
    walkers = [{uri.partition("_")[0] for uri in of} for of in (case.sources, case.references)]
    assert not set.intersection(*walkers)


def test_real_recordings_are_replayed_and_no_model_takes_part():
    assert [entrant.label for entrant in entrants(CONTROL)] == ["replay"]


def _similarity(case):
    problem = _problem(CONTROL.name, case)
    model = problem.fit(build_model("replay", {}, 0))
    outcome = problem.outcome(problem.solve(model, 0))
    return {name: METRICS.get(name)(outcome).value for name in ("mcc", "mlc")}


def test_a_recording_is_like_itself_and_likeness_is_mutual():
    itself = _similarity("synthetic 1 vs synthetic 1")
    one, other = (
        _similarity("synthetic 1 vs synthetic 2"),
        _similarity("synthetic 2 vs synthetic 1"),
    )
    assert itself["mlc"] == pytest.approx(1.0)
    assert one == pytest.approx(other)
    assert one["mcc"] < itself["mcc"]


def test_pairs_are_those_of_the_four_tables():
    rows, columns = (Counter(c.settings[key] for c in CONTROL.cases) for key in CONTROL.crossed)
    assert {rows[name] for name in ("12(1)", "16(15)", "38(2)", "35(1)", "39(4)")} == {10}
    assert {columns[name] for name in ("12(1)", "38(2)", "10(5)", "11(1)")} == {5}


@pytest.mark.slow
@pytest.mark.recordings
@pytest.mark.skipif("MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names nothing")
def test_real_recordings_are_as_similar_as_they_were(num_regression):
    archive = open_archive()
    here = [
        c.name for c in CONTROL.cases if not c.synthetic and all(map(archive.available, c.needs))
    ]
    found = {case: _similarity(case) for case in here}
    values = {name: [found[case][name] for case in here] for name in ("mcc", "mlc")}
    golden = GOLDENS / "control-similarity.csv"
    num_regression.check(values, default_tolerance={"rtol": 1e-9, "atol": 1e-12}, fullpath=golden)
