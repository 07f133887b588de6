"""Quaternions are read without changes of sign, and are filled as rotations."""

import numpy as np
import pytest

from mocapbench.datasets import CSVFormat, Recording, unwrap_angles
from mocapbench.datasets.formats.angle_wrapping import wrap_angles

CSV = CSVFormat()
N = 60
GAP = slice(20, 30)
NAMES = [
    ("Hips.qw", "Hips.qx", "Hips.qy", "Hips.qz"),
    ("pelvis_q0", "pelvis_q1", "pelvis_q2", "pelvis_q3"),
    ("quat_x", "quat_y", "quat_z", "quat_w"),
    ("QW", "QX", "QY", "QZ"),
]


def turn(rng, n_frames=N):
    """Return quaternions (N, 4) of a body that turns, of which many have the other sign."""
    half = np.linspace(0.0, 2.0, n_frames)[:, None] + 0.2 * np.sin(np.arange(n_frames) / 9)[:, None]
    axis = np.array([[0.6, 0.0, 0.8]])
    quaternions = np.hstack([np.cos(half), np.sin(half) * axis])
    return quaternions * rng.choice([-1.0, 1.0], (n_frames, 1)), quaternions


def record(values, names=NAMES[0]):
    return Recording("turn", np.arange(len(values)) / 100.0, values, names, [""] * len(names))


@pytest.mark.parametrize("names", NAMES)
def test_neighbours_are_alike_also_across_a_gap(names):
    stated, smooth = turn(np.random.default_rng(0))
    stated[GAP] = np.nan
    read = unwrap_angles(record(stated, names)).values
    seen = ~np.isnan(stated[:, 0])
    sign = np.sign(stated[0, 0] * smooth[0, 0])
    np.testing.assert_allclose(read[seen], sign * smooth[seen])
    assert np.isnan(read[GAP]).all()


@pytest.mark.parametrize(
    "names",
    [
        ("Hips.qw", "Hips.qx", "Hips.qy", "Hips.tz"),
        ("Hips.qw", "Hips.qx", "Knee.qy", "Knee.qz"),
        ("seqw", "seqx", "seqy", "seqz"),
    ],
)
def test_other_channels_stay(names):
    stated, _ = turn(np.random.default_rng(0))
    assert np.array_equal(unwrap_angles(record(stated, names)).values, stated)


def test_four_numbers_of_other_lengths_stay():
    stated = 3.0 * turn(np.random.default_rng(0))[0]
    assert np.array_equal(unwrap_angles(record(stated)).values, stated)


@pytest.mark.parametrize("seed", range(6))
def test_what_is_filled_is_a_rotation_that_continues_the_file(tmp_path, seed):
    """A straight line between two rotations, number by number, is shorter than 1."""
    stated, smooth = turn(np.random.default_rng(seed))
    stated[GAP] = np.nan
    given, out = tmp_path / "turn.csv", tmp_path / "out.csv"
    rows = [",".join("" if np.isnan(v) else f"{v:.12f}" for v in row) for row in stated]
    given.write_text("\n".join([",".join(NAMES[0]), *rows, ""]))
    walk = CSV.read(given, rate=100.0)
    weight = np.linspace(0.0, 1.0, 12)[1:-1, None]
    line = walk.values[19] * (1.0 - weight) + walk.values[30] * weight
    filled = walk.values.copy()
    filled[GAP] = line
    CSV.write(out, walk.with_values(filled), like=given)
    written = CSV.read_as_stated(out, rate=100.0).values
    np.testing.assert_allclose(np.linalg.norm(written, axis=1), 1.0)
    assert np.linalg.norm(line, axis=1).min() < 0.999
    inside = np.abs((written[GAP] * smooth[GAP]).sum(axis=1))
    assert inside.min() > 0.999
    assert (written[19] * written[20]).sum() > 0.9
    lines, before = (path.read_text().splitlines() for path in (out, given))
    assert [k for k in range(N) if lines[k + 1] != before[k + 1]] == list(range(20, 30))


def test_a_quaternion_of_which_numbers_stay_keeps_its_length():
    stated, _ = turn(np.random.default_rng(2))
    original = stated.copy()
    original[25, 1:3] = np.nan
    new = np.isnan(original)
    values = np.where(new, 0.25, unwrap_angles(record(original)).values)
    written = wrap_angles(values, record(original), new)
    assert np.abs(written[new]).tolist() == [0.25, 0.25]
    assert np.array_equal(written[~new], values[~new])


def test_four_zeros_stay_zeros():
    stated, _ = turn(np.random.default_rng(3))
    new = np.zeros(stated.shape, dtype=bool)
    new[GAP] = True
    original = record(np.where(new, np.nan, stated))
    assert not wrap_angles(np.zeros_like(stated), original, new).any()


@pytest.mark.parametrize("values", [np.full((N, 4), np.nan), np.ones((1, 4)) / 2, np.zeros((0, 4))])
def test_few_or_no_quaternions_are_no_fault(values):
    new = np.isnan(values)
    assert np.array_equal(
        wrap_angles(np.zeros_like(values), record(values), new), np.zeros_like(values)
    )
