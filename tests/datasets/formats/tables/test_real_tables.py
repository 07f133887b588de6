"""Tables of laboratories, of makers of software, and of public reports of errors."""

import shutil

import numpy as np
import pandas as pd
import pytest
from shared_files import shared, shared_like

from mocapbench.datasets import CSVFormat, FormatError, frame_rate

CSV = CSVFormat()
NEW = 1234567.5
SUFFIXES = {".csv", ".tsv", ".mot", ".sto"}
FILES = [path for path in shared_like("wild/**/*") if path.suffix in SUFFIXES]
REFUSED = "optitrack_head_cut.csv"
READ = [path for path in FILES if path.name != REFUSED]


@pytest.mark.skipif(not READ, reason="files of laboratories are not beside the repository")
@pytest.mark.filterwarnings("ignore:.* expected .* rows")
@pytest.mark.parametrize("path", READ, ids=lambda path: path.name)
def test_every_table_is_read_and_no_other_character_is_written(path, tmp_path):
    recording, out = CSV.load(path, 100.0), tmp_path / path.name
    CSV.write(out, recording, path)
    assert out.read_bytes() == path.read_bytes()
    new = np.random.default_rng(0).random(recording.values.shape) < 0.2
    new[~recording.visible.all(axis=1)] = False
    CSV.save(out, np.full(new.shape, NEW), new, path)
    again = CSV.load(out, 100.0)
    np.testing.assert_array_equal(again.values[~new], recording.values[~new])
    assert (again.values[new] == NEW).all()
    before, after = (one.read_bytes().splitlines() for one in (path, out))
    rows = len(recording.times)
    assert before[:-rows] == after[:-rows] or len(before) > 2 * rows  # the head, or a long table


@pytest.mark.parametrize(
    ("file", "shape", "rate", "units", "channel"),
    [
        ("real/nexus_markers.csv", (580, 153), 100.0, {"mm"}, "Daphnee:XIPH.y"),
        ("real/inverse_kin.mot", (88, 25), 100.0, {"deg", "m"}, "elbow_flexion"),
        ("real/orientation_quats.sto", (6, 28), 100.0, {""}, "calcn_r_imu.qw"),
        ("real/gait10dof18musc_ik_CRLF_line_ending.mot", (15, 10), 60.0, {"deg", "m"}, "pelvis_tx"),
        ("real/walk01_pos.csv", (101, 72), 24.0, {""}, "Hips.x"),
        ("cases/08-vendor-csv-tsv/optitrack.csv", (120, 15), 100.0, {"m"}, "A:LKNE.z"),
        ("cases/08-vendor-csv-tsv/vicon.csv", (120, 15), 100.0, {"mm"}, "S:LKNE.z"),
        ("cases/08-vendor-csv-tsv/qtm.tsv", (120, 15), 100.0, {"mm"}, "LKNE.z"),
        ("cases/08-vendor-csv-tsv/ik.mot", (120, 3), 100.0, {"deg"}, "knee_r"),
        ("cases/08-vendor-csv-tsv/Time_Seconds.csv", (120, 15), 100.0, {""}, "LKNE.z"),
    ],
)
@pytest.mark.filterwarnings("ignore:.* expected .* rows")
def test_what_is_known_of_real_tables(file, shape, rate, units, channel):
    recording = CSV.read(shared("wild", file))
    assert recording.values.shape == shape
    assert frame_rate(recording) == pytest.approx(rate, rel=1e-3)
    assert {*recording.units} == units
    assert channel in recording.channels


@pytest.mark.parametrize("file", ["optitrack.csv", "vicon.csv", "qtm.tsv"])
def test_two_gaps_of_ninety_entries_are_found(file):
    assert (~CSV.read(shared("wild/cases/08-vendor-csv-tsv", file)).visible).sum() == 90


def test_a_table_of_a_row_a_marker_and_frame_has_ninety_gaps():
    recording = CSV.read(shared("wild/cases/14-long-table/long.csv"), 100.0)
    assert recording.values.shape == (120, 15)
    assert (~recording.visible).sum() == 90


def test_a_table_whose_head_was_cut_is_refused_by_the_program_s_name(tmp_path):
    path = shutil.copy(shared("wild/cases/08-vendor-csv-tsv", REFUSED), tmp_path)
    with pytest.raises(FormatError, match=r"line 1: .* axes alone; .* OptiTrack Motive or Vicon"):
        CSV.read(path)


@pytest.mark.filterwarnings("ignore:.* expected .* rows")
def test_pandas_finds_what_was_filled_in_a_table_of_nexus(tmp_path):
    path, out = shared("wild/real/nexus_markers.csv"), tmp_path / "out.csv"
    recording = CSV.read(path)
    filled = recording.with_values(np.where(recording.visible, recording.values, NEW))
    CSV.write(out, filled, path)
    table = pd.read_csv(out, skiprows=5, header=None)
    np.testing.assert_array_equal(table.values[:, 2 : 2 + 153], filled.values)
