"""Tables as programs export them: read with names, units and rate, and written as they were."""

import re

import numpy as np
import pytest
from vendor_tables import GAP, RATE, TABLES, TIMES

from mocapbench.benchmark.testing import check_format
from mocapbench.datasets import CSVFormat, FormatError, FormatWarning
from mocapbench.datasets.formats.tables.sheet import read_sheet

CSV = CSVFormat()
NEW = 123456.5


def written(table, folder):
    path = folder / table.name
    path.write_text(table.text, encoding="utf-8", newline="")
    return path


@pytest.fixture(params=TABLES)
def table(request):
    return TABLES[request.param]


def test_names_units_rate_and_gaps_are_read(table, tmp_path):
    path = written(table, tmp_path)
    recording = CSV.load(path, None if table.rate else RATE)
    assert recording.channels == table.channels
    assert recording.units == table.units
    np.testing.assert_allclose(recording.values, table.values)
    np.testing.assert_allclose(recording.times, TIMES)
    assert not recording.visible[GAP].all()
    if table.rate is None:
        with pytest.raises(FormatError, match=r"a column 'time' in seconds, or a rate.*--rate 100"):
            CSV.load(path, None)


def test_nothing_but_cells_that_are_new_is_written(table, tmp_path):
    path, out = written(table, tmp_path), tmp_path / f"out-{table.name}"
    recording = CSV.load(path, RATE)
    rng = np.random.default_rng(0)
    new = rng.random(recording.values.shape) < 0.3
    CSV.save(out, np.full(new.shape, NEW), np.zeros_like(new), path)
    assert out.read_bytes() == path.read_bytes()
    new[GAP] = ~recording.visible[GAP]  # what is missing as 0, 0, 0 is filled as a whole
    CSV.save(out, np.full(new.shape, NEW), new, path)
    again = CSV.load(out, RATE)
    np.testing.assert_array_equal(again.values[~new], recording.values[~new])
    assert (again.values[new] == NEW).all()
    before, after = (_pieces(one.read_text(encoding="utf-8")) for one in (path, out))
    if len(before) == len(after):  # else rows were added
        changed = [two for one, two in zip(before, after, strict=True) if one != two]
        assert set(changed) == {str(NEW)}
        assert len(changed) == new.sum()


def _pieces(text):
    """Return the cells of a text, with what separates lines."""
    for separator in "\t, ":
        text = text.replace(separator, "\0")
    return text.replace("\n", "\0\n\0").split("\0")


@pytest.mark.filterwarnings("ignore")
def test_each_program_s_table_keeps_the_promises_of_a_format(table, tmp_path):
    if table.rate is None:
        pytest.skip("its rate is not in the file")
    check_format(CSVFormat, written(table, tmp_path))


@pytest.mark.filterwarnings("ignore")
def test_a_cell_too_many_too_few_and_a_word_in_a_number_are_named(table, tmp_path):
    path = written(table, tmp_path)
    sheet = read_sheet(path)
    place, split = sheet.table.rows[-1], sheet.table.cells
    lines = table.text.splitlines(keepends=True)
    cells = split.split(lines[place])
    separator = split.separator or " "
    word = split.replace_cells(lines[place], {sheet.columns.channels[-1]: "1.2x"})
    many = lines[place].rstrip("\r\n") + separator.join(["", "7.5", "7.5", "7.5"]) + "\n"
    few = lines[place][: lines[place].rindex(next(filter(None, cells[2:]))) - 1] + "\n"
    for wrong, complaint in (
        (many, r"expected \d+ cells.* got \d+ cells"),
        (few, r"expected \d+ cells.* got \d+ cells"),
        (word, r"expected a number.* got '1\.2x' in column"),
    ):
        path.write_text("".join([*lines[:place], wrong, *lines[place + 1 :]]), newline="")
        with pytest.raises(FormatError, match=rf"line {place + 1}: {complaint}.*; \w+"):
            CSV.load(path, RATE)


PROGRAMS = {
    "motive": "OptiTrack Motive",
    "nexus": "Vicon Nexus",
    "qualisys": "Qualisys Track Manager",
    "deeplabcut": "DeepLabCut",
    "opensim": "OpenSim",
}
HEADED = {name: PROGRAMS.get(name.split()[0].strip(",")) for name in TABLES}
HEADED = {name: program for name, program in HEADED.items() if program and "blocks" not in name}


@pytest.mark.parametrize("name", [*HEADED])
def test_a_head_that_is_cut_short_is_told_from_a_table_of_nobody(name, tmp_path):
    path = written(TABLES[name], tmp_path)
    lines = TABLES[name].text.splitlines(keepends=True)
    for n_lines in range(1, read_sheet(path).head.start):
        path.write_text("".join(lines[:n_lines]), newline="")
        with pytest.raises(FormatError, match=rf"expected .* {HEADED[name]}.*, got .*; \w+ "):
            CSV.load(path, RATE)


COMMAS = [name for name, table in TABLES.items() if table.name.endswith(".csv")]


@pytest.mark.parametrize("name", COMMAS)
def test_a_table_that_a_spreadsheet_of_another_country_saved_is_read_alike(name, tmp_path):
    """With semicolons between columns, and commas within numbers."""
    table = TABLES[name]
    lines = table.text.replace('"Take, 1"', "Take 1").replace(",", ";").splitlines(keepends=True)
    path = tmp_path / table.name
    text = "".join(re.sub(r"(?<=\d)\.(?=\d)", ",", line) for line in lines)
    path.write_text(text.replace("1,2", "1.2", 1) if "motive" in name else text, newline="")
    recording = CSV.load(path, None if table.rate else RATE)
    assert recording.channels == table.channels
    assert recording.units == table.units
    np.testing.assert_allclose(recording.values, table.values)
    np.testing.assert_allclose(recording.times, TIMES)


def test_trajectories_of_vicon_s_older_programs_are_read(tmp_path):
    rows = ["TRAJECTORIES", "120,Hz", ",LFHD,,,*1,,", "Field #,X,Y,Z,X,Y,Z", "1,1.5,2,3,4,5,6"]
    path = tmp_path / "old.csv"
    path.write_text("\r\n".join([*rows, "2,1.5,2,3,,,", ""]), newline="")
    walk = CSV.read(path)
    assert walk.channels == ("LFHD.x", "LFHD.y", "LFHD.z", "*1.x", "*1.y", "*1.z")
    assert (walk.times[1], {*walk.units}) == (pytest.approx(1 / 120), {"mm"})
    assert walk.visible.sum() == 9


def test_devices_alone_are_no_recording_of_motion(tmp_path):
    rows = ["Devices", "1000", ",,Force plate", "Frame,Sub Frame,Fx", ",,N", "1,0,0.5", "1,1,0.5"]
    path = tmp_path / "plate.csv"
    path.write_text("\n".join(rows))
    with pytest.raises(FormatError, match=r"a block Trajectories .* Vicon Nexus, got 'Devices' on"):
        CSV.read(path)


def test_a_force_may_be_zero(tmp_path):
    head = ["Model Outputs", "100", ",,Ann:PlateForce,,", "Frame,Sub Frame,X,Y,Z", ",,N,N,N"]
    path = tmp_path / "forces.csv"
    path.write_text("\n".join([*head, "1,0,5,0,9", "2,0,0,0,0", "3,0,5,0,9", ""]))
    assert CSV.read(path).visible.all()


OTHERS = {
    "samples": ["NO_OF_SAMPLES\t2", "TOT_NO_OF_CHAN\t2", "CHANNEL_NAMES\tEMG1\tEMG2", "1\t2"],
    "samples, version 2": ["FILE_VERSION\t2.0.0", "TOT_NO_OF_CHAN\t2", "CHANNEL_NAMES\tA", "1"],
    "forces": ["NO_OF_SAMPLES\t2", "FORCE_PLATE_NAME\tPlate 1", "Force_X\tForce_Y", "1\t2"],
    "2D": ["NO_OF_FRAMES\t2", "NO_OF_CAMERAS\t2", "DATA_INCLUDED\t2D", "", "1\t2"],
}


@pytest.mark.parametrize("kind", OTHERS)
def test_what_is_no_motion_is_refused_by_the_program_s_name(kind, tmp_path):
    path = tmp_path / "walk_a.tsv"
    path.write_text("\r\n".join([*OTHERS[kind], ""]), newline="")
    with pytest.raises(FormatError, match=r"got analogue .* of Qualisys Track Manager; export 3D"):
        CSV.read(path, 100.0)


def test_qualisys_may_name_the_version_of_its_table(tmp_path):
    table, path = TABLES["qualisys"], tmp_path / "walk.tsv"
    path.write_text(f"FILE_VERSION\t2.0.0\r\n{table.text}", newline="")
    walk = CSV.load(path, None)
    assert (walk.channels, walk.units) == (table.channels, table.units)
    np.testing.assert_allclose(walk.values, table.values)


@pytest.mark.parametrize("name", ["nexus, zeros", "qualisys", "qualisys 6D"])
def test_a_marker_missing_as_zeros_is_filled_as_a_whole_or_not_at_all(name, tmp_path):
    """A coordinate alone would leave the others at 0, as if they had been measured."""
    path, out = written(TABLES[name], tmp_path), tmp_path / f"out-{TABLES[name].name}"
    walk = CSV.load(path, None)
    lost = ~walk.visible
    first = np.zeros_like(lost)
    first[:, np.flatnonzero(lost.any(axis=0))[0]] = True
    CSV.save(out, np.full(lost.shape, NEW), lost & first, path)
    assert out.read_bytes() == path.read_bytes()


def test_a_count_of_rows_that_the_head_has_otherwise_is_said(tmp_path):
    table = TABLES["qualisys"]
    path = tmp_path / table.name
    path.write_text(table.text.replace("NO_OF_FRAMES\t40", "NO_OF_FRAMES\t50"), newline="")
    with pytest.warns(FormatWarning, match="expected 50 rows, as its head says, got 40: the file"):
        assert len(CSV.read(path).times) == 40


@pytest.mark.parametrize("name", ["motive 1.24", "nexus", "qualisys", "two lines", "opensim, tabs"])
def test_lines_of_an_old_macintosh_are_lines(name, tmp_path):
    table = TABLES[name]
    path = tmp_path / table.name
    path.write_text(table.text.replace("\r\n", "\n").replace("\n", "\r"), newline="")
    recording = CSV.load(path, None)
    assert recording.channels == table.channels
    np.testing.assert_allclose(recording.values, table.values)


def test_points_of_deeplabcut_in_space_have_no_unit(tmp_path):
    path = tmp_path / "space.csv"
    path.write_text("scorer,s,s,s\nbodyparts,a,a,a\ncoords,x,y,z\n0,1,2,3\n1,1,2,3\n")
    walk = CSV.read(path, 30.0)
    assert (walk.channels, walk.units) == (("a.x", "a.y", "a.z"), ("",) * 3)


def test_qualisys_may_count_frames_and_times_without_saying_so(tmp_path):
    table = TABLES["qualisys"]
    lines = table.text.splitlines(keepends=True)
    start = len(lines) - len(TIMES)
    rows = [f"{k + 1}\t{k / 100:.5f}\t{line}" for k, line in enumerate(lines[start:])]
    path = tmp_path / table.name
    path.write_text("".join([*lines[:start], *rows]), newline="")
    walk = CSV.load(path, None)
    assert walk.channels == table.channels
    np.testing.assert_allclose(walk.values, table.values)
