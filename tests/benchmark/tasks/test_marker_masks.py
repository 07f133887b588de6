"""Hidden markers: the paper's masks on its frames, fair training, and gaps as real files have."""

import os
from itertools import pairwise

import numpy as np
import pytest

from mocapbench.baselines import Prediction
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark import (
    METRICS,
    TASKS,
    Address,
    ImputeProblem,
    Request,
    Seeds,
    archive_at,
    plan,
)
from mocapbench.benchmark.tasks.marker_masks import (
    N_BESIDE,
    PAPERS,
    SHARE,
    STRETCHES,
    hide_alike,
    hide_as_in_files,
    hide_as_published,
)
from mocapbench.datasets import Recording
from mocapbench.datasets.occlusion.fixed_masks import fixed_masks, published_errors
from mocapbench.datasets.occlusion.real_gaps import real_gaps
from mocapbench.reports.paper.published import published_values

TASK = TASKS.get("marker-masks")
SYNTHETIC = "synthetic 3 markers"


def draw_seeds(fold, root=0):
    return Seeds(root, Address("marker-masks", 1, "a case", fold))


@pytest.fixture(scope="module")
def body():
    """Return 41 markers over 400 frames at 120 per second."""
    values = np.random.default_rng(0).normal(size=(400, 123))
    names = [f"m{marker:02}.{axis}" for marker in range(41) for axis in "xyz"]
    return Recording("body", np.arange(400) / 120, values, names, ("mm",) * 123)


def list_gaps(mask):
    """Return the hidden runs of each marker, all three coordinates of which are alike."""
    by_marker = mask.reshape(len(mask), -1, 3)
    assert (by_marker == by_marker[..., :1]).all()
    return {m: run_bounds(by_marker[:, m, 0]).tolist() for m in range(by_marker.shape[1])}


@pytest.mark.parametrize("n_hidden", [3, 6, 9])
def test_a_fold_hides_what_the_mask_of_the_paper_hides(body, n_hidden):
    for fold in (0, 49):
        gaps = list_gaps(hide_as_published(draw_seeds(fold), body, n_hidden=n_hidden))
        expected = {marker: [[start, stop]] for marker, start, stop in fixed_masks(n_hidden)[fold]}
        assert {marker: runs for marker, runs in gaps.items() if runs} == expected


def test_other_masks_hide_as_many_markers_for_as_long_wherever_the_papers_may(body):
    starts, markers = set(), set()
    for fold in range(50):
        gaps = list_gaps(hide_alike(draw_seeds(fold), body, n_hidden=6))
        runs = [run for of_marker in gaps.values() for run in of_marker]
        assert len(runs) == 6
        assert all(stop - start == SHARE * 400 for start, stop in runs)
        starts |= {start for start, _ in runs}
        markers |= {marker for marker, found in gaps.items() if found}
    assert starts == set(range(1, 31))
    assert markers == set(range(41))


def test_the_seed_of_the_run_decides_other_masks_and_not_the_papers(body):
    for hide, alike in ((hide_alike, False), (hide_as_published, True)):
        one, two = (hide(draw_seeds(3, root), body, n_hidden=3) for root in (0, 1))
        assert np.array_equal(one, two) == alike
        np.testing.assert_array_equal(one, hide(draw_seeds(3), body, n_hidden=3))


def test_real_gaps_are_as_long_and_as_many_as_those_of_one_file(body):
    """Gaps of one marker may join, so that some are longer and none is shorter."""
    for fold in range(10):
        seconds, groups = [*real_gaps().values()][fold % 2]
        lengths = {max(round(120 * length), 1) for group in groups for length in group}
        gaps = list_gaps(hide_as_in_files(draw_seeds(fold), body))
        found = [stop - start for runs in gaps.values() for start, stop in runs]
        assert min(found) >= min(lengths)
        assert all(length in lengths for length in found if length <= 5)
        n_groups = round(len(groups) * 400 / 120 / seconds)
        assert len(found) <= n_groups * max(map(len, groups))
        assert not any(runs and runs[0][0] < N_BESIDE for runs in gaps.values())
        assert not any(runs and runs[-1][1] > 400 - N_BESIDE for runs in gaps.values())


def test_gaps_of_a_group_overlap_in_markers_of_their_own(body, monkeypatch):
    groups = [(0.5, 0.25, 0.1, 0.1)]
    monkeypatch.setattr(
        "mocapbench.benchmark.tasks.marker_masks.real_gaps", lambda: {"one": (3.0, groups)}
    )
    starts = set()
    for fold in range(20):
        gaps = list_gaps(hide_as_in_files(draw_seeds(fold), body))
        runs = sorted((run for found in gaps.values() for run in found), key=np.ptp)
        assert [np.ptp(run) for run in runs] == [12, 12, 30, 60]
        *others, (begin, end) = runs
        assert all(start < end and stop > begin for start, stop in others)
        starts.add(begin)
    assert len(starts) > 10


def test_a_gap_longer_than_the_recording_leaves_its_ends_visible(body, monkeypatch):
    monkeypatch.setattr(
        "mocapbench.benchmark.tasks.marker_masks.real_gaps", lambda: {"one": (3.3, [(9.0, 9.0)])}
    )
    gaps = list_gaps(hide_as_in_files(draw_seeds(0), body))
    assert sorted(run for run in gaps.values() if run) == [[[5, 395]]] * 2


def test_no_frame_that_is_tested_is_learnt_from():
    for tested, *learnt in STRETCHES.values():
        spans = sorted([tested, *learnt])
        assert all(before[1] <= after[0] for before, after in pairwise(spans))
    assert STRETCHES[PAPERS] == ((50, 450), (450, 850), (1050, 1450), (1450, 1850))


def test_models_see_other_stretches_and_what_is_visible(posed):
    problem = posed("marker-masks", SYNTHETIC)
    assert isinstance(problem, ImputeProblem)
    *others, own = problem.train
    (given,) = problem.given
    np.testing.assert_array_equal(own.values, given.values)
    assert len({recording.name for recording in problem.train}) == len(problem.train) == 2
    (other,) = others
    assert other.visible.all()
    assert other.times[0] > given.times[-1]


def test_a_perfect_fill_has_no_error_and_a_shift_costs_itself(posed):
    problem = posed("marker-masks", SYNTHETIC)
    for shift in (0.0, -2.0):
        outcome = problem.outcome((Prediction(problem.truth[0] + shift),))
        assert METRICS.get("mae")(outcome).value == pytest.approx(abs(shift))


def test_what_is_published_of_a_case_is_the_mean_over_its_masks():
    values = published_values("marker-masks")
    for n in (3, 6, 9):
        case = f"{n} markers"
        (value,) = (v.value for (row, _, _), v in values.items() if row == case)
        assert value == pytest.approx(np.mean(published_errors(n)))
        assert TASK.page.published_folds[case] == published_errors(n)


def test_without_the_recordings_their_cases_are_missing(tmp_path, monkeypatch):
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path))
    jobs = plan(Request("paper", ("marker-masks",), ("linear",), folds=1), archive_at())
    missing = {job.address.case: job.missing for job in jobs}
    assert missing["3 markers"] == ("cmu:135_02.c3d",)
    assert missing["85_02 real gaps"] == ("cmu:85_02.c3d",)
    assert all(missing.values())


@pytest.mark.recordings
@pytest.mark.skipif("MOCAPBENCH_DATA" not in os.environ, reason="names no recordings")
@pytest.mark.parametrize("case", [case.name for case in TASK.cases])
def test_recordings_have_41_complete_markers_and_400_tested_frames(posed, case):
    problem = posed("marker-masks", case)
    if not TASK.case(case).synthetic:
        assert problem.truth[0].shape == (400, 123)
        assert np.isfinite(problem.truth[0]).all()
        assert {*problem.given[0].units} == {"mm"}
