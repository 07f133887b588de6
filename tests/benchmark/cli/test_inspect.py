"""`mocapbench inspect`: what it says of files, as text and as JSON."""

import json

import numpy as np
import pytest


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
    assert {("gap", "HIP", 30, 40), ("spike", "KNEE", 70, 71)} <= told


def test_findings_are_listed_as_text(cli, walk):
    assert cli("inspect", walk) == 0
    assert "117 frames, 60 frames per second" in cli.printed
    assert "HIP: frames 30 to 39 (10 frames)" in cli.printed
    assert "KNEE: frames 70 to 70 (1 frame), 40" in cli.printed


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
