"""`mocapbench inspect`: what it says of files, as text and as JSON."""

import json

import numpy as np
import pytest

from mocapbench.benchmark import Reading
from mocapbench.benchmark.recording_checks import check_file, describe_check


def parse(printed):
    """Return what was printed as JSON, without the errors that follow."""
    return json.JSONDecoder().raw_decode(printed)[0]


@pytest.fixture
def walk(tmp_path):
    """Return a table of two markers and a stray one, with a gap, a spike and missing rows."""
    times = np.arange(120) / 60
    lines = [",".join(["time", *(f"{m}.{a} [mm]" for m in ("KNEE", "HIP", "*12") for a in "xyz")])]
    for frame, time in enumerate(times.tolist()):
        if 100 <= frame < 103:
            continue
        at = [100 * time + 40 * (frame == 70), 50 * np.sin(time), 500.0 + np.cos(3 * time)]
        hip = ["", "", ""] if 30 <= frame < 40 else [value + 400 for value in [*at[:0:-1], time]]
        lines.append(",".join([f"{time:.6f}", *map(str, [*at, *hip, *at])]))
    path = tmp_path / "walk.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_findings_are_listed_as_json(cli, walk):
    assert cli("inspect", walk, "--json") == 0
    (check,) = parse(cli.printed)
    assert check["rate"] == pytest.approx(60.0)
    assert (check["frames"], check["markers"], check["units"]) == (117, ["KNEE", "HIP"], ["mm"])
    assert check["unlabelled"] == ["*12"]
    assert any("3 rows are missing" in text for text in check["remarks"])
    told = {(row["kind"], *row["markers"], row["start"], row["stop"]) for row in check["findings"]}
    assert told == {
        ("gap", "HIP", 30, 40),
        ("spike", "KNEE", 70, 71),
        ("rows", 99, 101),
    }
    (spike,) = (row for row in check["findings"] if row["kind"] == "spike")
    assert spike == {
        "kind": "spike",
        "markers": ["KNEE"],
        "start": 70,
        "stop": 71,
        "time": pytest.approx(70 / 60, abs=1e-6),
        "size": pytest.approx(40.0, abs=1.0),
        "unit": "mm",
    }


def test_findings_are_listed_as_text(cli, walk):
    assert cli("inspect", walk) == 0
    assert "117 frames, 60 frames per second" in cli.printed
    assert "HIP: frames 30 to 39 (10, from 0.50 s)" in cli.printed
    assert "KNEE: frame 70 (1.17 s), 40 mm" in cli.printed
    assert "between frames 99 and 100 (1.65 s), 3" in cli.printed
    assert cli.printed.index("spikes: 1") < cli.printed.index("gaps: 1")


def write_table(path, names, values):
    """Write a table of columns (N, D) at 100 frames a second, with blanks in place of NaN."""
    cells = [
        [f"{k / 100:.2f}", *("" if np.isnan(v) else f"{v:.4f}" for v in row)]
        for k, row in enumerate(values.tolist())
    ]
    path.write_text("\n".join(map(",".join, [["time", *names], *cells])) + "\n")
    return path


@pytest.mark.slow
def test_many_findings_are_few_lines_and_the_longest_gap_comes_first(tmp_path):
    rng = np.random.default_rng(0)
    values = np.cumsum(rng.normal(size=(1000, 60)), axis=0)
    for marker in range(20):
        for k in range(20):
            start = 50 * k + marker
            values[start : start + 1 + (marker + k) % 9, 3 * marker : 3 * marker + 3] = np.nan
    values[500:560, 30:33] = np.nan
    names = [f"M{marker}.{axis} [mm]" for marker in range(20) for axis in "xyz"]
    path = write_table(tmp_path / "many.csv", names, values)
    lines = [*describe_check(check_file(path, Reading()))]
    assert len(lines) < 60
    (gaps,) = (k for k, line in enumerate(lines) if line.startswith("  gaps:"))
    assert lines[gaps + 1].startswith("    M10: ")
    assert "frames 500 to 563 (64, from 5.00 s);" in lines[gaps + 1]


def test_a_file_of_angles_has_spikes_of_channels_and_no_segments(cli, tmp_path):
    times = np.arange(300) / 100
    values = np.stack([40 * np.sin(3 * times), 20 * np.cos(2 * times)], axis=1)
    values[120, 1] += 15.0
    path = write_table(tmp_path / "angles.csv", ["knee.rx [deg]", "hip.rx [deg]"], values)
    assert cli("inspect", path) == 0
    assert "hip.rx: frame 120 (1.20 s), 15 deg" in cli.printed
    assert "no markers, so neither swaps nor segments are sought" in cli.printed
    assert cli("inspect", path, "--json") == 0
    (check,) = parse(cli.printed)
    assert (check["markers"], check["others"]) == ([], ["knee.rx", "hip.rx"])


def test_switches_and_constants_have_no_leaps(cli, tmp_path):
    rng = np.random.default_rng(0)
    values = np.stack([rng.random(300) < 0.1, np.arange(300) > 150, np.full(300, 4.25)], axis=1)
    path = write_table(tmp_path / "switches.csv", ["contact", "phase", "mass"], values * 1.0)
    assert cli("inspect", path, "--json") == 0
    (check,) = parse(cli.printed)
    assert (check["others"], check["findings"]) == (["contact", "phase", "mass"], [])


@pytest.mark.parametrize("mark", [0.0, 9999999.0])
def test_values_that_mark_missing_ones_are_found_where_they_are(cli, tmp_path, mark):
    times = np.arange(300)[:, None] / 100
    values = 900.0 + 50 * np.sin(2 * times + np.arange(6))
    values[100:110, :3] = values[200:205, :3] = mark
    names = [f"{marker}.{axis} [mm]" for marker in ("A", "B") for axis in "xyz"]
    assert cli("inspect", write_table(tmp_path / "marks.csv", names, values), "--json") == 0
    (check,) = parse(cli.printed)
    found = {(row["kind"], *row["markers"], row["start"], row["stop"]) for row in check["findings"]}
    kind = "number" if mark else "zeros"
    assert found == {(k, "A", *at) for k in (kind, "gap") for at in ((100, 110), (200, 205))}


def test_a_step_over_missing_rows_is_no_leap(cli, tmp_path):
    values = np.arange(400)[:, None] * 9.0 + np.array([100, 0, 0, 0, 0, 500])
    names = [f"{marker}.{axis} [mm]" for marker in ("A", "B") for axis in "xyz"]
    path = write_table(tmp_path / "rows.csv", names, values)
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:200], *lines[240:]]) + "\n")
    assert cli("inspect", path, "--json") == 0
    (check,) = parse(cli.printed)
    (found,) = check["findings"]
    assert (found["kind"], found["start"], found["stop"], found["size"]) == ("rows", 198, 200, 40)


def test_each_file_is_told_where_one_cannot_be_read(cli, walk, tmp_path):
    damaged = tmp_path / "damaged.c3d"
    damaged.write_bytes(b"nothing")
    assert cli("inspect", damaged, walk, tmp_path / "absent.trc", "--json") == 2
    first, second, third = parse(cli.printed)
    assert "damaged.c3d" in first["error"]
    assert second["findings"]
    assert "absent.trc" in third["error"]
    assert "damaged.c3d: expected" in cli.printed


@pytest.mark.parametrize("text", ["", "time,a.x,a.y,a.z\n", "time,a.x,a.y,a.z\n0,1,2,3\n"])
def test_little_or_nothing_in_a_file_gives_no_traceback(cli, tmp_path, text):
    path = tmp_path / "little.csv"
    path.write_text(text)
    assert cli("inspect", path, "--rate", "60") in (0, 2)
