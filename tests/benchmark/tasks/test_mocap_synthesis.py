"""Synthesis of motion: what rows share, and what samples are compared with."""

import numpy as np
import pytest

from mocapbench.benchmark import TASKS, Request, Status, archive_at, bundle, plan
from mocapbench.datasets import THESIS_CHANNELS

NAMES = ("walking-synthesis", "exaggerated-synthesis", "soccer-synthesis")
ROWS = [(name, case.name) for name in NAMES for case in TASKS.get(name).cases]


@pytest.fixture(scope="module")
def jobs():
    return plan(Request(profile="paper", tasks=NAMES), archive_at())


@pytest.fixture
def pose_or_skip(posed):
    """Return a function that poses a problem, or skips the test if its recordings are not here."""

    def pose(name, case):
        if not all(map(archive_at().available, TASKS.get(name).case(case).recordings)):
            pytest.skip("MOCAPBENCH_DATA names no recordings, or not these")
        return posed(name, case)

    return pose


def test_cases_of_one_problem_share_seeds_and_fits_and_no_record(jobs):
    fits = {(job.seeds, job.address.label): job.fit_key for job in jobs}
    assert all(fits[job.seeds, job.address.label] == job.fit_key for job in jobs)
    assert len(set(fits.values())) == len(fits) < len(jobs)
    assert len({job.key for job in jobs}) == len(jobs)


@pytest.mark.parametrize("name", NAMES)
def test_cases_of_one_problem_have_one_set_of_training_recordings(name):
    sources = {case.problem_name: case.given for case in TASKS.get(name).cases}
    assert all(sources[case.problem_name] == case.given for case in TASKS.get(name).cases)


def test_only_what_needs_a_missing_recording_lacks_data(jobs):
    lacking = {job.address.case for job in jobs if "cmu:38_02" in job.digests}
    rows = {"38(2)", "all five"}
    assert lacking == rows | {f"{row} from three walks" for row in rows}


def test_a_job_has_the_digest_of_every_recording_that_it_takes(jobs):
    for job in jobs:
        case = TASKS.get(job.address.task).case(job.address.case)
        assert set(job.digests) == set(case.recordings)


def test_rows_over_several_references_do_not_count_beside_those_of_each(jobs):
    layouts = bundle([job.record(Status.DATA_MISSING, "fetch it") for job in jobs], {}).layouts
    assert {layout.name for layout in layouts} == set(NAMES)
    for layout in layouts:
        means = [case for case in layout.cases if case.averages_references]
        single = [c for c in layout.cases if not (c.averages_references or c.synthetic)]
        rows = layout.page.published_rows
        assert rows == {case.name: case.columns["reference"] for case in single}
        assert means


@pytest.mark.parametrize(("name", "case"), ROWS)
def test_recordings_share_90_frames_of_39_channels_from_time_0(pose_or_skip, name, case):
    problem = pose_or_skip(name, case)
    assert problem.times[0] == 0.0
    for recording in problem.train:
        np.testing.assert_array_equal(recording.times, problem.times)
        assert recording.values.shape == (90, 39)
    assert {reference.shape for reference in problem.references} == {(90, 39)}


def test_kicks_that_models_learn_from_are_none_of_the_unseen():
    rows = [c for c in TASKS.get("soccer-synthesis").cases if c.name.startswith("unseen only")]
    assert [len(case.references) for case in rows] == [3, 3]
    assert not any(set(case.references) & set(case.given) for case in rows)


@pytest.mark.slow
@pytest.mark.recordings
def test_figures_are_named_after_what_models_learn_from(pose_or_skip, cli, tmp_path):
    pose_or_skip("walking-synthesis", "35(1)")
    which = ("--tasks", "walking-synthesis", "--cases", "35(1)", "--models", "mohgp-3", "--offline")
    assert cli("run", *which, "--profile", "smoke", "--out", tmp_path) == 0
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Coregionalisation by mohgp-3, all joints: two walks" in page


@pytest.mark.recordings
def test_frames_are_those_of_the_footnotes(pose_or_skip):
    problem = pose_or_skip("soccer-synthesis", "10(6)")
    whole = archive_at().recording("cmu:10_06").select(THESIS_CHANNELS).values
    np.testing.assert_array_equal(problem.train[1].values[[0, -1]], whole[[130, 565]])
    np.testing.assert_array_equal(problem.references[0][[0, -1]], whole[[130, 361]])
    assert problem.times[-1] == pytest.approx(435 / 120)


@pytest.mark.recordings
def test_short_kicks_are_cut_as_the_references_are(pose_or_skip):
    long, short = (
        pose_or_skip("soccer-synthesis", case) for case in ("10(5)", "10(5) from short kicks")
    )
    np.testing.assert_array_equal(short.train[0].values, short.references[0])
    assert not np.array_equal(long.train[0].values, long.references[0])


@pytest.mark.parametrize("name", NAMES)
def test_generated_references_are_of_other_walkers(name):
    case = TASKS.get(name).case("synthetic")
    walkers = [{uri.partition("_")[0] for uri in of} for of in (case.given, case.references)]
    assert not set.intersection(*walkers)
