"""In-betweening on files of the structure of LaFAN1, from the zip to scores in closed form."""

from hashlib import sha256

import numpy as np
import pytest
from lafan1_files import write_zip

from mocapbench.baselines import HoldImputer, LinearImputer, Prediction
from mocapbench.benchmark import METRICS, TASKS, Address, Request, Seeds, archive_at, plan
from mocapbench.datasets import Archive, LaFAN1Library
from mocapbench.reports.paper.published import published_values

TASK = TASKS.get("lafan1")
STEP, DEGREES = 2.0, 3.0  # of the path and of the heading, a frame
LENGTHS = (150, 120)


def walk(subject, take, n_frames):
    """Return a straight path along z, at a height of its own; those who are learnt from sway."""
    path, frames = np.zeros((n_frames, 3)), np.arange(n_frames)
    path[:, 1], path[:, 2] = 90.0 + subject + take, STEP * frames
    if subject < 5:
        path[:, 0] = np.sin(frames)
    angles = np.zeros((n_frames, 22, 3))
    angles[:, 0, 0] = 90.0  # about z, so that y, which faces forward, is not upright
    return path, angles


def spin(subject, take, n_frames):
    """Return a body that stands and turns about the vertical."""
    path, angles = walk(subject, take, n_frames)
    path[:, [0, 2]] = 0.0
    angles[:, 0] = 0.0
    angles[:, 0, 1] = DEGREES * np.arange(n_frames)
    angles[:, 0, 2] = 90.0  # first about x, which takes y from upright to forward
    return path, angles


def pose(folder, make_take, case):
    file = write_zip(folder / "lafan1.zip", make_take, LENGTHS)
    library = LaFAN1Library(folder, expected=sha256(file.read_bytes()).hexdigest())
    seeds = Seeds(0, Address("lafan1", 1, case, 0))
    return TASK.case(case).problem(seeds, Archive({"lafan1": library}))


def score(problem, model, metric):
    solution = problem.solve(model.fit(problem.train), 0)
    return METRICS.get(metric)(problem.outcome(solution)).value


@pytest.fixture(scope="module")
def walking(tmp_path_factory):
    return pose(tmp_path_factory.mktemp("walk"), walk, "15 frames")


@pytest.fixture(scope="module")
def spinning(tmp_path_factory):
    return pose(tmp_path_factory.mktemp("spin"), spin, "30 frames")


def test_windows_are_those_of_subject_5_and_others_are_learnt_from(walking):
    n_windows = sum(len(range(0, n - 65, 40)) for n in LENGTHS)
    assert len(walking.given) == n_windows
    for window in walking.given:
        assert window.values.shape == (26, 3 + 4 * 22)
        assert window.visible.all(axis=1).tolist() == [True] * 10 + [False] * 15 + [True]
    assert len(walking.train) == 4 * sum(len(range(0, n - 50, 50)) for n in LENGTHS)
    assert all(recording.visible.all() for recording in walking.train)


def test_a_straight_path_is_held_with_an_error_in_closed_form_and_interpolated_without(walking):
    """All joints move by the same steps, so that their coordinates vary alike along the path."""
    along = STEP * np.sqrt((50**2 - 1) / 12)  # of even steps in windows of 50, all centred
    np.testing.assert_allclose(walking.body.spread[:, 2], along)
    behind = STEP * np.arange(1, 16)
    assert score(walking, HoldImputer(), "l2p") == pytest.approx(
        np.sqrt(22) * behind.mean() / along
    )
    assert score(walking, HoldImputer(), "mpjpe_global") == pytest.approx(behind.mean())
    assert score(walking, HoldImputer(), "l2q") == pytest.approx(0.0, abs=1e-9)
    for metric in ("l2p", "mpjpe_global"):
        assert score(walking, LinearImputer(), metric) == pytest.approx(0.0, abs=1e-5)


def test_a_body_that_turns_is_held_with_an_error_in_closed_form(spinning):
    """A rotation by α is 2 sin(α/4) from none as a quaternion, in each of 22 joints."""
    angles = np.deg2rad(DEGREES) * np.arange(1, 31)
    expected = np.mean(np.sqrt(22) * 2 * np.sin(angles / 4))
    assert score(spinning, HoldImputer(), "l2q") == pytest.approx(expected)


def test_spectra_are_compared_of_rotations_in_space(spinning):
    """A held rotation is a level alone; of the truth, the real part of the spectrum is known."""
    hold = HoldImputer().fit(spinning.train)
    outcome = spinning.outcome(spinning.solve(hold, 0))
    n_windows = len(spinning.given)
    truth = outcome.truth.reshape(n_windows, 41, 88)[:, 10:40]
    power = np.fft.fft(truth, axis=1).real ** 2
    total = power.sum(axis=1)
    shares = np.cumsum(power / np.where(total, total, 1.0)[:, None], axis=1)
    expected = np.average((1.0 - shares).sum(axis=1), weights=total)
    assert METRICS.get("npss_real_part")(outcome).value == pytest.approx(expected)


def test_the_length_of_a_quaternion_does_not_matter(spinning):
    doubled = tuple(
        Prediction(np.hstack([values[:, :3], 2 * values[:, 3:]])) for values in spinning.truth
    )
    outcome = spinning.outcome(doubled)
    assert METRICS.get("l2q")(outcome).value == pytest.approx(0.0, abs=1e-9)
    assert METRICS.get("mpjpe_global")(outcome).value == pytest.approx(0.0, abs=1e-9)


def test_a_quaternion_of_zeros_stands_for_no_rotation(spinning):
    rotations, _ = spinning.body.place(np.zeros((1, 3 + 4 * 22)))
    np.testing.assert_array_equal(rotations[0], np.tile([1.0, 0, 0, 0], (22, 1)))


def test_only_what_a_hidden_channel_moves_is_scored(walking):
    depends = walking.body.dependence(walking.given[0].channels)
    names = [segment.name for segment in walking.body.skeleton.segments]
    channels = walking.given[0].channels
    moving = np.flatnonzero(depends[names.index("LeftFoot")])
    foot = {channels[place].partition(".")[0] for place in moving}
    assert foot == {"Hips", "LeftUpLeg", "LeftLeg"}
    assert depends[0].sum() == 3


def test_without_the_file_all_its_cases_are_missing(tmp_path):
    jobs = plan(Request("paper", ("lafan1",), ("linear",)), archive_at(tmp_path))
    assert {job.address.case for job in jobs} == {f"{n} frames" for n in (5, 15, 30, 45)}
    assert {job.missing for job in jobs} == {tuple(f"lafan1:subject{n}" for n in (5, 1, 2, 3, 4))}


def test_zero_velocity_stands_beside_its_published_values():
    values = published_values("lafan1")
    assert values["30 frames", "L2P", "zero velocity"].value == 6.6
    assert {metric for _, metric, _ in values} == {"L2Q", "L2P", "NPSS"}
    assert TASK.page.published_models == {"zero-velocity": "zero velocity"}
