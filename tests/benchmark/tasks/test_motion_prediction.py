"""Motion prediction: the contest's windows, joints and numbers, and the corrected ones."""

import csv

import numpy as np
import pytest
from shared_files import shared

from mocapbench.baselines import HoldImputer
from mocapbench.benchmark import METRICS, TASKS, Address, Request, Seeds, archive_at, plan
from mocapbench.benchmark.tasks.motion_prediction import ACTIONS, TRAININGS
from mocapbench.datasets import (
    PREDICTED,
    GaitLibrary,
    Recording,
    original_recordings,
    rotations_of,
)
from mocapbench.metrics.horizons import HORIZONS
from mocapbench.reports import CaseLayout
from mocapbench.reports.analysis.units import unit_names

NAMES = ("motion-prediction", "motion-prediction-8-windows", "motion-prediction-corrected")
SYNTHETIC = "synthetic gait"
MM_TRUE = 25.4 / 0.45
N_KEPT = 166  # of 332 rows, the rest pose included


def pose(name, case, archive=None):
    task = TASKS.get(name)
    return task.case(case).problem(Seeds(0, Address(name, 1, case, 0)), archive or archive_at())


def write_rows(folder, key, rows):
    part, name = key.split("/")
    path = folder / part / name.rpartition("_")[0] / f"{name}.txt"
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savetxt(path, rows, fmt="%.9g", delimiter=",")


@pytest.fixture(scope="module")
def walks():
    """Return the rows of files, by key: another walk in each."""
    library, walks = GaitLibrary(), {}
    for number, key in enumerate(original_recordings()):
        walk = f"{1 + number // 8:02}_{1 + number % 8:02}"
        made = rotations_of(library.recording(walk), library.skeleton(walk))
        walks[key] = made.values[: 160 + number]
    return walks


@pytest.fixture
def archive(walks, tmp_path):
    for key, rows in walks.items():
        write_rows(tmp_path, key, rows)
    return archive_at(tmp_path)


def test_a_case_is_an_action_and_a_list_of_training_files():
    for name in NAMES:
        cases = {case.name: case for case in TASKS.get(name).cases}
        assert set(cases) == {
            *(
                f"{action.replace('_', '-')} {files} files"
                for action in ACTIONS
                for files in (40, 35)
            ),
            SYNTHETIC,
        }
        (tested, *training) = cases["basketball-signal 40 files"].given
        assert tested == "rotations:test/basketball_signal_1"
        assert training == [f"rotations:train/{a}_{n}" for a in ACTIONS for n in range(1, 6)]
    assert len(ACTIONS) == 8
    assert [len(uris) for uris in TRAININGS.values()] == [40, 35]


def test_every_window_of_every_second_row_is_tested(archive, walks):
    problem = pose("motion-prediction", "soccer 40 files", archive)
    n_kept = -(-len(walks["test/soccer_1"]) // 2)
    assert len(problem.given) == n_kept - 34
    for start, (given, truth) in enumerate(zip(problem.given, problem.truth, strict=True)):
        assert given.visible.all(axis=1).tolist() == [True] * 10 + [False] * 25
        assert given.times[0] == pytest.approx(start / 60)
        assert truth.shape == (35, 75)
    np.testing.assert_array_equal(problem.truth[0][1:], problem.truth[1][:-1])


def test_models_learn_from_whole_recordings_of_all_actions_and_from_no_test(archive):
    problem = pose("motion-prediction", "soccer 35 files", archive)
    names = [recording.name for recording in problem.train]
    assert names == list(TRAININGS["35 files"])
    assert not any("test/" in name for name in names)
    assert all(recording.visible.all() for recording in problem.train)


def test_eight_windows_are_those_of_the_contests_seed(archive, walks):
    """Of 82 frames, as running has, the first draws of numpy's Mersenne twister are known."""
    problem = pose("motion-prediction-8-windows", "soccer 40 files", archive)
    n_kept = -(-len(walks["test/soccer_1"]) // 2)
    rng = np.random.RandomState(1234567890)
    expected = [rng.randint(0, n_kept - 75) + 40 for _ in range(8)]
    starts = [round(given.times[0] * 60) for given in problem.given]
    assert starts == expected
    every = pose("motion-prediction", "soccer 40 files", archive).truth
    for start, truth in zip(starts, problem.truth, strict=True):
        np.testing.assert_array_equal(truth, every[start])


def test_the_corrected_task_has_true_lengths_and_no_rest_pose(archive):
    printed = pose("motion-prediction", "soccer 40 files", archive)
    corrected = pose("motion-prediction-corrected", "soccer 40 files", archive)
    assert len(corrected.given) == len(printed.given) - 1
    for one, other in zip(corrected.truth, printed.truth[1:], strict=True):
        np.testing.assert_allclose(one, other * MM_TRUE / 70)
    for one, other in zip(corrected.train, printed.train, strict=True):
        np.testing.assert_allclose(one.values, other.values[1:] * MM_TRUE / 70)


def test_the_first_frame_of_the_printed_task_is_the_rest_pose(archive):
    """The same for all recordings."""
    truths = [
        pose("motion-prediction", f"{a} 40 files", archive).truth for a in ("soccer", "walking")
    ]
    np.testing.assert_allclose(truths[0][0][0], truths[1][0][0], atol=1e-6)
    assert np.abs(truths[0][1][0] - truths[1][1][0]).max() > 1


def test_positions_are_of_38_joints_of_which_6_are_fixed_and_7_coincide(posed):
    poses = (
        posed("motion-prediction", SYNTHETIC)
        .outcome(posed("motion-prediction", SYNTHETIC).solve(hold(posed), 0))
        .poses
    )
    assert poses.truth.shape[1:] == (38, 3)
    moving = poses.hidden.any(axis=0)
    assert (~moving).sum() == 6
    distinct = np.unique(poses.truth[:, moving].round(9), axis=1)
    assert distinct.shape[1] == len(PREDICTED)


def hold(posed, name="motion-prediction"):
    problem = posed(name, SYNTHETIC)
    return HoldImputer().fit(problem.train)


@pytest.mark.parametrize(("name", "mm"), [*zip(NAMES, (70, 70, MM_TRUE), strict=True)])
def test_scores_of_zero_velocity_are_those_of_the_formula(posed, name, mm):
    problem = posed(name, SYNTHETIC)
    outcome = problem.outcome(problem.solve(hold(posed, name), 0))
    unit = mm / 10  # centimetres
    windows = map(Recording.with_values, problem.given, problem.truth)
    joints = problem.body.positions(*windows)
    joints = joints.reshape(-1, 35, 38, 3)
    assert unit == pytest.approx(problem.body.centimetres)
    for frame in HORIZONS:
        expected = np.linalg.norm(joints[:, 9 + frame] - joints[:, 9], axis=-1).mean() * 10
        assert METRICS.get(f"mpjpe_at_{frame}")(outcome).value == pytest.approx(expected)


def test_a_file_that_is_too_short_is_named(walks, tmp_path):
    for key, rows in walks.items():
        write_rows(tmp_path, key, rows[: 40 if key == "train/running_3" else None])
    with pytest.raises(ValueError, match=r"rotations:train/running_3: expected 35 frames or more"):
        pose("motion-prediction", "soccer 35 files", archive_at(tmp_path))


def test_where_a_training_file_is_absent_the_case_is_missing_and_names_it(walks, tmp_path):
    for key, rows in walks.items():
        if key != "train/washwindow_1":
            write_rows(tmp_path, key, rows)
    archive = archive_at(tmp_path)
    request = Request("paper", ("motion-prediction",), ("zero-velocity",), ("walking *",))
    missing = {job.address.case: job.missing for job in plan(request, archive)}
    assert missing == {
        "walking 40 files": ("rotations:train/washwindow_1",),
        "walking 35 files": (),
    }


def test_all_actions_share_what_is_learnt():
    request = Request("paper", ("motion-prediction",), ("ridge-forecast",), ("* 35 files",))
    jobs = plan(request, archive_at())
    assert len(jobs) == 8
    assert len({job.training_key for job in jobs}) == 1


def read_published():
    path = shared("cmu-prediction", "published.csv")
    return list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))


@pytest.mark.parametrize(
    ("name", "manner"), [*zip(NAMES, ("all windows", "8 seeds"), strict=False)]
)
@pytest.mark.parametrize("action", ["basketball", "running", "soccer", "walking"])
def test_zero_velocity_on_the_contests_files_is_what_was_computed_elsewhere(name, manner, action):
    archive = archive_at(shared("cmu-prediction", "data"))
    case = TASKS.get(name).case(f"{action} 35 files")
    few = case.problem.keywords | {"training": ()}
    problem = case.problem.func(Seeds(0, Address(name, 1, case.name, 0)), archive, **few)
    model = HoldImputer().fit(problem.given[:1])
    outcome = problem.outcome(problem.solve(model, 0))
    computed = {
        row["horizon_ms"]: float(row["value"])
        for row in read_published()
        if (row["source"], row["action"]) == ("computed", action)
        if row["manner"] == f"3-D mm, {manner}"
    }
    ours = {
        str(printed): METRICS.get(f"mpjpe_at_{frame}")(outcome).value
        for frame, printed in HORIZONS.items()
    }
    assert ours == pytest.approx(computed, abs=1e-4)


@pytest.mark.parametrize("name", NAMES)
def test_a_recording_is_one_unit_of_statistics_however_many_windows_it_has(name):
    task = TASKS.get(name)
    cases = [task.case(case) for case in task.profile("paper").cases]
    units = [
        unit_names(CaseLayout(case.name, {}), [0], independent=task.independent_folds)
        for case in cases
    ]
    assert task.max_folds == 1
    assert len({unit for (unit,) in units}) == len(cases) == 8
