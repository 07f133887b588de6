"""`mocapbench fill`, from files to files."""

import csv
import glob
import os
import re
import shutil
import tempfile
from pathlib import Path

import ezc3d
import format_files
import numpy as np
import pytest
import vendor_tables
from c3d_files import text, write_bytes
from left_behind import leave_lock
from shared_files import shared

from mocapbench.basics.temporaries import PREFIX
from mocapbench.benchmark import FORMATS, format_for
from mocapbench.benchmark.cli import fill as command
from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.filling import workers
from mocapbench.benchmark.filling.choosing import choice
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.datasets import AcclaimFormat, C3DFormat, CSVFormat, FormatError, TRCFormat
from mocapbench.datasets.formats import memory

HEADER = "time,hip [deg],knee [deg],height [cm]"
N_FRAMES = 120


def rows(gap=range(50, 60), columns=(2,)):
    """Return the lines of a file with a gap in some columns."""
    times = np.arange(N_FRAMES) / 60
    curves = [times, 20 * np.sin(7 * times), 30 * np.cos(7 * times), 90 + times]
    return [
        [
            "" if frame in gap and column in columns else f"{curve[frame]:.4f}"
            for column, curve in enumerate(curves)
        ]
        for frame in range(N_FRAMES)
    ]


def save(path, lines, header=HEADER):
    path.write_text("\n".join([header, *map(",".join, lines)]) + "\n")
    return path


@pytest.fixture
def walk(tmp_path):
    return save(tmp_path / "walk.csv", rows())


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


def test_gaps_are_filled_and_nothing_else_changes(cli, walk, out):
    assert cli("fill", walk, "--model", "cubic-spline", "--out", out) == 0
    before, after = (p.read_text().splitlines() for p in (walk, out / "walk.csv"))
    assert [n for n, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]] == [
        *range(51, 61)
    ]
    filled = CSVFormat().read(out / "walk.csv")
    truth = 30 * np.cos(7 * filled.times)
    np.testing.assert_allclose(filled.values[:, 1], truth, atol=0.5)


def test_the_table_has_every_filled_entry(cli, walk, out):
    assert cli("fill", walk, "--model", "trivial", "--out", out) == 0
    with (out / "walk.csv.entries.csv").open(newline="") as file:
        table = list(csv.DictReader(file))
    assert [int(row["frame"]) for row in table] == [*range(50, 60)]
    assert {(row["channel"], row["unit"]) for row in table} == {("knee", "deg")}
    assert all(float(row["sd"]) > 0 for row in table)


@pytest.mark.slow
def test_the_best_model_is_chosen_and_the_page_shows_the_ranking(cli, walk, out):
    assert cli("fill", walk, "--effort", "low", "--out", out) == 0
    page = (out / "walk.csv.html").read_text()
    assert "held-out gap" in page
    assert "linear</th>" in page
    assert "cubic-spline" in page
    assert "http" not in page.replace("http://www.w3.org", "").replace("http-equiv", "")


SLEEPY = """
import time
from mocapbench.baselines import LinearImputer
class Sleepy(LinearImputer):
    def impute_uncalibrated(self, recordings):
        time.sleep(600)
MODELS = {"sleepy": Sleepy}
"""


@pytest.mark.slow
def test_a_choice_that_a_limit_of_time_had_a_part_in_has_its_own_exit_code(
    cli, walk, out, tmp_path, monkeypatch
):
    plugin = tmp_path / "sleepy.py"
    plugin.write_text(SLEEPY)
    monkeypatch.setattr(workers, "_TIMES", 0.0)
    monkeypatch.setattr(workers, "_LEAST_LIMIT", 5.0)
    monkeypatch.setattr(workers, "_WAITING", 1.0)
    monkeypatch.setattr(choice, "find_candidates", lambda _: ("linear", "sleepy"))
    effort = ("--effort", "high", "--plugin", plugin)
    assert cli("fill", walk, *effort, "--out", out) == ExitCode.NOT_REPEATABLE == 6
    said = "This cannot be repeated elsewhere: sleepy exceeded a limit of time or memory of this"
    assert said in " ".join(cli.printed.split())
    assert "Not compared: sleepy." in " ".join(cli.printed.split())
    assert said in (out / "walk.csv.html").read_text()
    assert CSVFormat().read(out / "walk.csv").visible.all()


@pytest.mark.slow
def test_a_fill_can_be_repeated_to_the_bit_whatever_the_jobs_and_the_order_of_files(
    cli, walk, tmp_path, out
):
    trained = [save(tmp_path / f"{n}.csv", rows(gap=range(n))) for n in range(2)]
    for number, (jobs, order) in enumerate(((1, trained), (2, trained[::-1]))):
        train = [part for path in order for part in ("--train", path)]
        options = ("--effort", "low", "--jobs", jobs, "--out", out / str(number))
        assert cli("fill", walk, *train, *options) == 0
    for name in ("walk.csv", "walk.csv.entries.csv"):
        assert (out / "0" / name).read_bytes() == (out / "1" / name).read_bytes()


def test_a_seed_is_one_of_the_choice_and_effort_a_word(cli, walk, out):
    assert cli("fill", walk, "--effort", "huge", "--out", out) == 2
    assert cli("fill", walk, "--seed=-1", "--out", out) == 2
    assert cli("fill", walk, "--jobs", "0", "--out", out) == 2
    assert not out.exists()


@pytest.mark.slow
def test_progress_is_shown_where_there_is_no_terminal(cli, walk, out, monkeypatch):
    monkeypatch.setattr(command, "_PLAIN_INTERVAL", 0.0)
    assert cli("fill", walk, "--effort", "low", "--out", out) == 0
    assert re.search(r"walk.csv: \d+ of \d+ hold-outs filled, \d+ s walk.csv: ", cli.printed)


def test_named_frames_of_a_motion_are_replaced_and_its_page_shows_it(cli, tmp_path, out):
    recording, given = format_files.walk(), tmp_path / "walker.amc"
    format_files.write_acclaim(given, recording)
    named = ("--frames", "20:30", "--channels", "lfemur", "--model", "linear")
    assert cli("fill", given, *named, "--out", out) == 0
    shutil.copy(tmp_path / "walker.asf", out)
    before, after = (AcclaimFormat().read(p).values for p in (given, out / "walker.amc"))
    channels = [k for k, name in enumerate(recording.channels) if name.startswith("lfemur")]
    others = np.ones(before.shape, dtype=bool)
    others[20:30, channels] = False
    np.testing.assert_array_equal(after[others], before[others])
    line = np.linspace(before[19], before[30], 12)[1:-1, channels]
    np.testing.assert_allclose(after[20:30, channels], line, atol=1e-4)
    assert "The motion" in (out / "walker.amc.html").read_text()


def test_nothing_is_overwritten(cli, walk, tmp_path, out):
    assert cli("fill", walk, "--model", "linear", "--out", tmp_path) == 2
    assert "which would be overwritten" in cli.printed
    assert cli("fill", walk, "--model", "linear", "--out", out) == 0
    kept = {path: path.read_bytes() for path in out.iterdir()}
    assert cli("fill", walk, "--model", "hold", "--out", out) == 2
    assert kept == {path: path.read_bytes() for path in out.iterdir()}


def test_a_folder_that_cannot_be_written_to_is_refused_before_anything_is_tried(
    cli, walk, tmp_path, monkeypatch
):
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path) != tmp_path)
    assert cli("fill", walk, "--model", "linear", "--out", tmp_path / "new" / "deep") == 2
    assert "expected a folder that can be written to" in cli.printed
    assert not (tmp_path / "new").exists()


@pytest.mark.slow
def test_a_file_without_room_for_hold_outs_is_refused_and_others_are_filled(
    cli, walk, tmp_path, out
):
    lost = save(tmp_path / "lost.csv", rows(gap=range(N_FRAMES)))
    whole = save(tmp_path / "whole.csv", rows(gap=()))
    fill = ("fill", walk, lost, "--train", whole, "--effort", "low", "--out", out)
    assert cli(*fill) == 2
    assert "lost" in cli.printed
    assert "expected a visible stretch to try models on" in cli.printed
    assert {path.name for path in out.glob("*.csv.html")} == {"walk.csv.html"}


def test_files_of_one_name_are_refused(cli, walk, tmp_path, out):
    (tmp_path / "other").mkdir()
    other = shutil.copy(walk, tmp_path / "other")
    assert cli("fill", walk, other, "--model", "linear", "--out", out) == 2
    assert "different names" in cli.printed


def test_a_model_that_cannot_fill_the_mask_is_refused_with_those_that_can(cli, walk, out):
    assert cli("fill", walk, "--model", "aligned-window", "--out", out) == 2
    assert "some channels are visible, got 'aligned-window'; choose" in cli.printed
    assert "cubic-spline" in cli.printed


def test_a_model_of_whole_frames_fills_whole_frames(cli, walk, tmp_path, out):
    whole = save(tmp_path / "whole.csv", rows(columns=(1, 2, 3)))
    complete = save(tmp_path / "complete.csv", rows(gap=()))
    chosen = ("--model", "aligned-window", "--train", complete)
    assert cli("fill", whole, *chosen, "--out", out) == 0


def test_a_model_that_fails_says_why_and_leaves_nothing(cli, walk, out, tmp_path):
    plugin = tmp_path / "bad.py"
    plugin.write_text(
        "from mocapbench.baselines import Imputer\n"
        "class Bad(Imputer):\n"
        "    def fit(self, recordings):\n        return self\n"
        "    def impute(self, recordings):\n        raise ValueError('out of ideas')\n"
        "MODELS = {'bad': Bad}\n"
    )
    assert cli("fill", walk, "--model", "bad", "--plugin", plugin, "--out", out) == 2
    assert "bad did not fill it: ValueError: out of ideas (bad.py, line 6); choose" in cli.printed
    assert not out.exists()


def changed(row, column, text):
    lines = rows()
    lines[row][column] = text
    return lines


HARDSHIPS = {
    "no gap": (rows(gap=()), HEADER, "expected a gap"),
    "all hidden": (
        rows(gap=range(N_FRAMES), columns=(1, 2, 3)),
        HEADER,
        "expected visible entries",
    ),
    "NaN in the time column": (changed(7, 0, "nan"), HEADER, "a time for every frame"),
    "times that repeat": (changed(7, 0, "0.1000"), HEADER, "every time after the one before"),
    "times that fall": (changed(7, 0, "0.0100"), HEADER, "every time after the one before"),
    "text among numbers": (changed(7, 1, "n/a!"), HEADER, "expected"),
    "a missing cell": ([*rows()[:5], ["1"]], HEADER, "expected"),
}


@pytest.mark.parametrize("name", HARDSHIPS)
def test_a_file_that_cannot_be_filled_ends_in_one_message(cli, tmp_path, out, name):
    lines, header, message = HARDSHIPS[name]
    path = save(tmp_path / "bad.csv", lines, header)
    assert cli("fill", path, "--model", "linear", "--out", out) == 2
    assert message in cli.printed
    assert cli.printed.count("error:") == 1
    assert not out.exists()


def test_a_channel_never_visible_is_refused_unless_others_have_it(cli, walk, tmp_path, out):
    named = ("--frames", f"0:{N_FRAMES}", "--channels", "knee", "--model", "linear", "--out", out)
    assert cli("fill", walk, *named) == 2
    assert "expected a visible entry of a channel to fill, got none of knee" in cli.printed
    other = save(tmp_path / "other.csv", rows(gap=()))
    assert cli("fill", walk, *named, "--train", other) == 0


def test_an_empty_channel_stays_empty_while_others_are_filled(cli, tmp_path, out):
    lines = rows()
    for line in lines:
        line[1] = ""
    path = save(tmp_path / "walk.csv", lines)
    assert cli("fill", path, "--model", "linear", "--out", out) == 0
    printed = " ".join(cli.printed.split())
    assert "Nothing is visible that hip could be filled from. It stays as it is" in printed
    assert "stay hidden" not in printed
    filled = CSVFormat().read(out / "walk.csv")
    np.testing.assert_array_equal(filled.visible.sum(axis=0), [0, N_FRAMES, N_FRAMES])


MARKER = "time,RKNE.x [mm],RKNE.y [mm],RKNE.z [mm]"


def marker_with(tmp_path, word, height):
    """Return a file of a marker, whose frames 20 to 29 have a word for each coordinate."""
    lines = rows(gap=())
    for frame, line in enumerate(lines):
        around = [f"{2 * np.sin(frame):.4f}", f"{2 * np.cos(1.3 * frame):.4f}", str(height)]
        line[1:] = [word] * 3 if 20 <= frame < 30 else around
    return save(tmp_path / "marker.csv", lines, MARKER)


def test_zeros_that_are_far_from_a_marker_are_filled(cli, tmp_path, out):
    path = marker_with(tmp_path, "0", 90)
    assert cli("fill", path, "--model", "linear", "--out", out) == 0
    said = "RKNE is exactly 0, 0, 0 in 10 frames, far from where it is before and after: this is"
    assert said in " ".join(cli.printed.split())
    assert said in " ".join((out / "marker.csv.html").read_text().split())
    values = CSVFormat().read(out / "marker.csv").values
    assert (values[20:30, 2] == 90).all()
    assert cli("fill", path, "--model", "linear", "--missing", "none", "--out", out / "none") == 2
    assert "expected a gap, got all entries visible" in cli.printed


def test_zeros_near_a_marker_are_said_kept_and_filled_on_demand(cli, tmp_path, out):
    path = marker_with(tmp_path, "0", 1)
    assert cli("fill", path, "--model", "linear", "--out", out) == 2
    said = "RKNE is exactly 0, 0, 0 in 10 frames and elsewhere in others: if that marks missing"
    assert said in " ".join(cli.printed.split())
    assert cli("fill", path, "--model", "linear", "--missing", "zeros", "--out", out) == 0
    assert "30 entries count as missing, as --missing says" in " ".join(cli.printed.split())
    assert (CSVFormat().read(out / "marker.csv").values[20:30, 2] == 1).all()


@pytest.mark.parametrize("word", ["-99", "5.5"])
def test_a_number_for_missing_values_can_be_named(cli, tmp_path, out, word):
    path = marker_with(tmp_path, word, 90)
    assert cli("fill", path, "--model", "linear", f"--missing={word}", "--out", out) == 0
    before, after = (p.read_text().splitlines() for p in (path, out / "marker.csv"))
    changed = [n for n, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]]
    assert changed == [*range(21, 31)]


@pytest.mark.parametrize("word", ["nothing", "nan", "inf", ""])
def test_what_marks_missing_values_is_a_word_or_a_number(cli, walk, out, word):
    assert cli("fill", walk, f"--missing={word}", "--model", "linear", "--out", out) == 2
    assert "--missing: expected zeros, held, none or a number such as 9999999, got" in cli.printed


def test_what_a_killed_fill_left_goes_even_where_all_is_filled_already(
    cli, walk, tmp_path, out, monkeypatch
):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    assert cli("fill", walk, "--model", "linear", "--out", out) == 0
    left = tmp_path / f"{PREFIX}12345678"
    leave_lock(left)
    left.mkdir()
    (left / "problem-0").touch()
    assert cli("fill", walk, "--model", "linear", "--out", out) == 2
    assert "would be overwritten" in cli.printed
    assert not left.exists()


def test_files_with_nothing_to_fill_are_left_out_and_the_others_filled(cli, walk, tmp_path, out):
    complete = save(tmp_path / "complete.csv", rows(gap=()))
    other = save(tmp_path / "other.csv", rows(gap=range(20, 22)))
    fill = ("fill", walk, complete, other, "--model", "linear", "--out", out)
    assert cli(*fill) == 0
    assert f"left out: {complete}: expected a gap, got all entries visible" in cli.printed
    assert {path.name for path in out.glob("*.csv.html")} == {"walk.csv.html", "other.csv.html"}
    assert not (out / "complete.csv").exists()
    assert cli(*fill[:-1], out / "short", "--max-gap", "0.05") == 0
    assert f"left out: {walk}: expected a gap of 0.05 s or less" in cli.printed
    assert {path.name for path in (out / "short").glob("*.html")} == {"other.csv.html"}


def test_a_file_that_cannot_be_read_is_said_by_the_exit_code_and_others_are_filled(
    cli, walk, tmp_path, out
):
    broken = save(tmp_path / "broken.csv", changed(7, 1, "n/a!"))
    complete = save(tmp_path / "complete.csv", rows(gap=()))
    assert cli("fill", walk, complete, broken, "--model", "linear", "--out", out) == 2
    assert "broken.csv, line 9: expected a number" in cli.printed
    assert f"left out: {complete}" in cli.printed
    assert {path.name for path in out.glob("*.html")} == {"walk.csv.html"}
    assert cli("fill", broken, complete, "--model", "linear", "--out", out / "none") == 2
    assert "broken.csv, line 9: expected a number" in cli.printed
    assert not (out / "none").exists()


def test_what_cannot_be_written_is_refused_before_any_model_runs(
    cli, walk, tmp_path, out, monkeypatch
):
    def refuse(self, path, values, new, like):
        raise FormatError(like.name, "another file", "this one", "export it again")

    csv_given = shutil.copy(walk, tmp_path / "other.csv")
    trc = format_files.sample("trc", tmp_path)
    monkeypatch.setattr(TRCFormat, "save", refuse)
    monkeypatch.setattr(Workers, "submit", lambda *args, **kwargs: pytest.fail("a model runs"))
    assert cli("fill", trc, "--model", "linear", "--out", out) == 2
    assert "expected another file, got this one; export it again" in cli.printed
    monkeypatch.undo()
    monkeypatch.setattr(TRCFormat, "save", refuse)
    assert cli("fill", trc, csv_given, "--model", "linear", "--out", out) == 2
    assert {path.name for path in out.glob("*.html")} == {"other.csv.html"}
    (out / "walk.csv.html").write_text("mine")
    assert cli("fill", walk, trc, "--model", "linear", "--out", out) == 2
    assert "walk.csv.html, which would be overwritten" in cli.printed


PICKY = """
import numpy as np
from mocapbench.baselines import LinearImputer
class Picky(LinearImputer):
    def impute(self, recordings):
        if max((~one.visible).sum() for one in recordings) > 20:
            raise ValueError("too much is hidden")
        return super().impute(recordings)
MODELS = {"picky": Picky}
"""


def test_a_model_that_fails_on_one_file_leaves_the_others(cli, walk, tmp_path, out):
    plugin = tmp_path / "picky.py"
    plugin.write_text(PICKY)
    long = save(tmp_path / "long.csv", rows(gap=range(20, 70)))
    fill = ("fill", long, walk, "--plugin", plugin, "--model", "picky", "--out", out)
    assert cli(*fill) == 2
    assert "picky did not fill it: " in cli.printed
    assert {path.name for path in out.glob("*.html")} == {"walk.csv.html"}


def test_everything_hidden_is_refused(cli, walk, out):
    named = ("--frames", f"0:{N_FRAMES}", "--model", "linear", "--out", out)
    assert cli("fill", walk, *named) == 2
    assert "expected visible entries to fill the others from, got none" in cli.printed


def test_channels_of_files_to_learn_from_are_matched_by_name(cli, walk, tmp_path, out):
    """Those of a file in another order, with one besides, are learnt from as if it were alike."""
    alike = save(tmp_path / "alike.csv", rows(gap=()))
    columns = [[line[k] for k in (0, 3, 2, 1, 1)] for line in rows(gap=())]
    header = "time,height [cm],knee [deg],hip [deg],*12.x [mm]"
    other = save(tmp_path / "other.csv", columns, header)
    for train in (alike, other):
        named = ("--model", "pca-regression", "--train", train)
        assert cli("fill", walk, *named, "--out", out / train.stem) == 0
    one, two = ((out / path.stem / "walk.csv").read_text() for path in (alike, other))
    assert one == two


def test_unlabelled_markers_change_nothing_of_the_others(cli, walk, tmp_path, out):
    """Nor must files to learn from have them."""
    fragment = [[*line, "3" if 5 < frame < 9 else ""] for frame, line in enumerate(rows())]
    raw = save(tmp_path / "raw.csv", fragment, f"{HEADER},*12.x [mm]")
    train = save(tmp_path / "train.csv", rows(gap=()))
    for path in (walk, raw):
        named = ("--model", "pca-regression", "--train", train, "--out", out)
        assert cli("fill", path, *named) == 0
    filled, beside = (CSVFormat().read(out / name).values for name in ("walk.csv", "raw.csv"))
    np.testing.assert_array_equal(beside[:, :-1], filled)
    np.testing.assert_array_equal(beside[:, -1], CSVFormat().read(raw).values[:, -1])


@pytest.mark.parametrize(
    "other",
    [
        (HEADER.replace("hip", "ankle"), 1, "channels"),
        (HEADER, 2, "frames per second"),
    ],
)
def test_files_to_learn_from_must_be_alike(cli, walk, tmp_path, out, other):
    header, step, message = other
    lines = rows(gap=())
    for frame, line in enumerate(lines):
        line[0] = f"{frame * step / 60:.4f}"
    path = save(tmp_path / "other.csv", lines, header)
    assert cli("fill", walk, "--train", path, "--model", "linear", "--out", out) == 2
    assert message in cli.printed


@pytest.mark.parametrize(
    "file",
    [
        ("walk.xyz", b"time,a\n0,1\n", ".csv"),
        ("walk.csv", b"\xff\xfe\x00", "expected"),
        ("walk.csv", None, "No such file"),
    ],
)
def test_what_is_no_recording_is_refused(cli, tmp_path, out, file):
    name, content, message = file
    path = tmp_path / "in" / name
    path.parent.mkdir()
    if content is not None:
        path.write_bytes(content)
    assert cli("fill", path, "--model", "linear", "--out", out) == 2
    assert message in cli.printed
    assert not out.exists()


def test_a_file_larger_than_memory_is_refused(cli, walk, out, monkeypatch):
    class Full:
        available = 1000

    monkeypatch.setattr(memory.psutil, "virtual_memory", Full)
    assert cli("fill", walk, "--model", "linear", "--out", out) == 2
    assert "memory" in cli.printed


@pytest.mark.parametrize("frames", ["120", "9:", "a:b", "-3:4"])
def test_frames_are_two_numbers(cli, walk, out, frames):
    assert cli("fill", walk, f"--frames={frames}", "--out", out) == 2
    assert "expected A:B" in cli.printed


@pytest.mark.parametrize("name", FORMATS.names())
def test_files_of_every_format_are_filled_and_read_back(cli, tmp_path, out, name):
    (tmp_path / "in").mkdir()
    given = format_files.sample(name, tmp_path / "in")
    # Neither .amc nor .bvh state gaps; the channels' names end in their axis everywhere.
    assert cli("fill", given, "--frames", "40:46", "--model", "makima", "--out", out) == 0
    for skeleton in (tmp_path / "in").glob("*.asf"):
        shutil.copy(skeleton, out)
    before, after = (format_for(path).read(path) for path in (given, out / given.name))
    assert after.visible[40:46].all()
    kept = before.visible.copy()
    kept[40:46] = False
    np.testing.assert_allclose(after.values[kept], before.values[kept], atol=1e-9)
    moved = np.abs(after.values[40:46] - before.values[40:46])
    assert np.nanmax(moved) < 0.25 * np.nanmax(np.ptp(before.values[30:56], axis=0)) + 0.5


def test_an_interrupt_has_its_own_exit_code(cli, walk, out, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(Workers, "submit", interrupt)
    assert cli("fill", walk, "--model", "linear", "--out", out) == 130
    assert not out.exists()


@pytest.mark.parametrize("stray", ["*{}", "New 000{}", "Unlabeled 120{}", "U_{}", ""])
def test_strays_are_left_alone_and_counted_whoever_made_the_file(cli, tmp_path, out, stray):
    values = np.random.default_rng(0).uniform(-9, 9, (60, 6, 3)).cumsum(axis=0)
    values[20:30, 1] = values[5:, 2:4] = np.nan
    labels = ["LKNE", "RKNE", *map(stray.format, range(2)), "LANK", "RANK"]
    given = write_bytes(tmp_path / "a.c3d", values, labels=[], parameters=named(labels))
    assert cli("fill", given, "--model", "linear", "--out", out) == 0
    assert "linear filled 30 entries in 1 gap." in cli.printed
    assert "2 unlabelled markers (" in cli.printed
    assert "2 unlabelled markers (" in (out / "a.c3d.html").read_text()


def named(labels, **groups):
    """Return the parameters of points that have labels, and of those that groups name."""
    named = {f"POINT:{group}": text(*names, width=16) for group, names in groups.items()}
    return {"POINT:LABELS": text(*labels, width=16), **named}


def test_results_of_a_model_are_filled_if_they_are_named(cli, tmp_path, out):
    values = np.random.default_rng(0).uniform(-9, 9, (60, 4, 3)).cumsum(axis=0)
    values[20:30, :3] = np.nan
    parameters = named(["LKNE", "LKneeAngles", "Power", "RKNE"], POWERS=["Power"])
    given = write_bytes(tmp_path / "a.c3d", values, labels=[], parameters=parameters)
    for channels, filled in ((None, [0]), ("LKnee*,Power", [1, 2]), ("*", [0, 1, 2])):
        folder = out / str(len(filled))
        options = ("--channels", channels) if channels else ()
        assert cli("fill", given, *options, "--model", "linear", "--out", folder) == 0
        points = ezc3d.c3d(str(folder / "a.c3d"))["data"]["points"][0, :, 20:30]
        assert [place for place in range(4) if not np.isnan(points[place]).any()] == [*filled, 3]
        shutil.rmtree(folder)


@pytest.mark.parametrize("rate", ["0", "-1", "nan"])
def test_a_rate_is_positive(cli, walk, out, rate):
    assert cli("fill", walk, f"--rate={rate}", "--model", "linear", "--out", out) == 2
    assert "positive rate" in cli.printed


def test_a_disagreeing_c3d_is_filled_and_one_that_cannot_be_understood_ends_with_2(
    cli, tmp_path, out
):
    values = np.random.default_rng(0).uniform(-9, 9, (60, 3, 3)).cumsum(axis=0)
    values[20:30, :2] = np.nan
    labels = ["LKNE", "Ann:LFEO", "RKNE"]
    given = write_bytes(tmp_path / "given.c3d", values, "DEC", labels=labels, header={3: 3})
    assert cli("fill", given, "--model", "linear", "--out", out) == 0
    assert "1 result of a model of the body (Ann:LFEO) stays as it is" in cli.printed
    filled = C3DFormat().read(out / "given.c3d")
    assert filled.visible[:, [0, 1, 2, 6, 7, 8]].all()
    assert not filled.visible[20:30, 3:6].any()
    data = bytearray(given.read_bytes())
    data[515] = 9
    given.write_bytes(data)
    assert cli("fill", given, "--model", "linear", "--out", tmp_path / "more") == 2
    assert "expected numbers of Intel, DEC or MIPS computers" in cli.printed


def test_points_that_the_file_finds_unlikely_are_filled_too(cli, tmp_path, out):
    path = tmp_path / "video.csv"
    path.write_text(vendor_tables.deeplabcut().text)
    named = ("--rate", 100, "--model", "linear", "--out")
    assert cli("fill", path, *named, out, "--min-likelihood", 0.5) == 0
    assert "filled 14 entries in 2 gaps" in cli.printed
    before, after = (one.read_text().splitlines() for one in (path, out / "video.csv"))
    changed = [k for k, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]]
    assert changed == [*range(13, 18), 23, 24]
    assert cli("fill", path, *named, tmp_path / "two") == 0
    assert "filled 10 entries in 1 gap" in cli.printed


def test_a_file_without_gaps_that_has_likelihoods_names_the_option(cli, tmp_path, out):
    """DeepLabCut gives a position for every frame, however unlikely."""
    path = tmp_path / "video.csv"
    path.write_text(vendor_tables.deeplabcut().text.replace(",,", ",7,7"))
    assert cli("fill", path, "--rate", 100, "--model", "linear", "--out", out) == 2
    said = "got all entries visible; name what to fill with --frames, such as 120:180; "
    assert f"{said}--min-likelihood 0.6, for instance," in " ".join(cli.printed.split())


def test_likelihoods_that_are_not_there_are_refused(cli, walk, out):
    assert cli("fill", walk, "--min-likelihood", 0.5, "--out", out) == 2
    assert "expected a column of likelihoods for --min-likelihood, such as" in cli.printed
    assert not out.exists()


@pytest.mark.slow
@pytest.mark.parametrize("model", ["linear", "best"])
def test_rows_that_are_missing_are_said_or_added_and_filled(cli, walk, out, tmp_path, model):
    lines = walk.read_text().splitlines(keepends=True)
    walk.write_text("".join(lines[:80] + lines[84:]))
    named = ("--model", model, "--effort", "low", "--out")
    assert cli("fill", walk, *named, out) == 0
    said = (
        "warning: walk.csv: 4 rows are missing, behind line 80, by the steps of 'time'; --insert-"
    )
    assert said in cli.printed
    assert len((out / "walk.csv").read_text().splitlines()) == len(lines) - 4
    assert cli("fill", walk, "--insert-missing", *named, tmp_path / "two") == 0
    filled = (tmp_path / "two" / "walk.csv").read_text().splitlines()
    times = [[float(line.split(",")[0]) for line in some[1:]] for some in (filled, lines)]
    np.testing.assert_allclose(*times, atol=1.5e-4)
    assert all(cell for line in filled for cell in line.split(","))
    assert {*walk.read_text().splitlines()} - {*filled} == {*walk.read_text().splitlines()[51:61]}


@pytest.mark.parametrize("name", vendor_tables.TABLES)
def test_tables_of_every_program_are_filled(cli, tmp_path, out, name):
    table = vendor_tables.TABLES[name]
    path = tmp_path / table.name
    path.write_text(table.text, newline="")
    rate = () if table.rate else ("--rate", 100)
    assert cli("fill", path, *rate, "--channels", "*", "--model", "linear", "--out", out) == 0
    filled = CSVFormat().read(out / table.name, 100.0)
    assert filled.visible.all()
    assert filled.channels == table.channels


def walk_in_and_out(recording):
    """Hide a gap, what is before somebody comes and after, and more of the first three channels."""
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[:9] = hidden[50:] = hidden[:14, :3] = hidden[46:, :3] = hidden[25:30, :3] = True
    return recording.hide(hidden)


WITH_GAPS = {
    "bvh": ("walk.bvh", format_files.write_bvh, format_files.walk),
    "c3d": ("markers.c3d", format_files.write_c3d, format_files.markers),
    "csv": ("walk.csv", format_files.write_csv, format_files.walk),
    "npz": ("walk.npz", format_files.write_npz, format_files.poses),
    "parquet": ("walk.parquet", format_files.write_parquet, format_files.walk),
    "trc": ("markers.trc", format_files.write_trc, format_files.markers),
}


@pytest.fixture(params=WITH_GAPS)
def seen_for_a_while(request, tmp_path):
    """Return a file of each format that has gaps, of somebody who walks in and out, and all."""
    file, write, make = WITH_GAPS[request.param]
    path = tmp_path / file
    write(path, walk_in_and_out(make()))
    return path, make().values


def test_nothing_is_invented_before_and_after_somebody_is_there(cli, seen_for_a_while, out):
    path, truth = seen_for_a_while
    assert cli("fill", path, "--model", "makima", "--out", out) == 0
    n_open = 19 * truth.shape[1] + 9 * 3
    assert f"filled 15 entries in 1 gap, and left {n_open} open at the ends." in cli.printed
    assert f"left {n_open} open at the ends" in (out / f"{path.name}.html").read_text()
    before, after = (format_for(file).read(file).values for file in (path, out / path.name))
    moved = np.abs(after[25:30, :3] - truth[25:30, :3]).max()
    assert moved < 0.25 * np.ptp(truth[15:40, :3], axis=0).max() + 0.5
    kept = after.copy()
    kept[25:30, :3] = np.nan
    np.testing.assert_array_equal(kept, before)


def test_bytes_at_the_ends_stay_whatever_they_are(cli, seen_for_a_while, tmp_path, out):
    """What is filled is what is filled if the gap alone is named, where nothing else is touched."""
    path, _ = seen_for_a_while
    channels = format_for(path).read(path).channels[:3]
    gap = ("--frames", "25:30", "--channels", ",".join(map(glob.escape, channels)))
    assert cli("fill", path, "--model", "linear", "--out", out) == 0
    assert cli("fill", path, "--model", "linear", *gap, "--out", tmp_path / "named") == 0
    assert (out / path.name).read_bytes() == (tmp_path / "named" / path.name).read_bytes()
    if path.suffix in {".bvh", ".csv", ".trc"}:
        lines = [file.read_bytes().splitlines() for file in (path, out / path.name)]
        changed = [k for k, pair in enumerate(zip(*lines, strict=True)) if pair[0] != pair[1]]
        assert changed == [*range(changed[0], changed[0] + 5)]


def test_ends_are_filled_on_request_but_not_where_nobody_is_there(cli, seen_for_a_while, out):
    path, truth = seen_for_a_while
    assert cli("fill", path, "--ends", "fill", "--model", "linear", "--out", out) == 0
    assert f"filled 42 entries in 3 gaps, and left {19 * truth.shape[1]} open" in cli.printed
    assert "2 gaps are at the beginning or the end of the recording" in cli.printed
    visible = format_for(path).read(out / path.name).visible
    assert visible[9:50].all()
    assert not visible[:9].any()
    assert not visible[50:].any()


@pytest.mark.parametrize("mark", ["NaN", "0", "9999999"])
def test_marks_of_missing_values_at_the_ends_stay(cli, tmp_path, out, mark):
    values = np.random.default_rng(0).uniform(-9, 9, (60, 6)).cumsum(axis=0) + 900
    hidden = np.zeros((60, 6), dtype=bool)
    hidden[:9] = hidden[50:] = hidden[25:30, :3] = hidden[9:12, 3:] = True
    cells = np.where(hidden, mark, np.char.mod("%.4f", values)).tolist()
    header = "time,a.x [mm],a.y [mm],a.z [mm],b.x [mm],b.y [mm],b.z [mm]"
    path = save(
        tmp_path / "a.csv",
        [[f"{k / 60:.6f}", *row] for k, row in enumerate(cells)],
        header,
    )
    assert cli("fill", path, "--model", "linear", "--out", out) == 0
    assert "filled 15 entries in 1 gap, and left 123 open at the ends." in cli.printed
    before, after = (file.read_text().splitlines() for file in (path, out / "a.csv"))
    changed = [k for k, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]]
    assert changed == [*range(26, 31)]
    assert [line.split(",")[4:] for line in after] == [line.split(",")[4:] for line in before]


@pytest.mark.slow
def test_a_file_that_is_open_at_its_ends_only_is_left_out_with_the_option(cli, walk, tmp_path, out):
    ends = save(tmp_path / "ends.csv", rows(gap=range(9)))
    assert cli("fill", ends, "--model", "linear", "--out", out) == 2
    said = "expected a gap between visible entries, got none, but 9 hidden entries before the first"
    assert said in cli.printed
    assert "(knee); --ends fill fills them" in cli.printed
    assert not out.exists()
    assert cli("fill", ends, walk, "--model", "linear", "--out", out) == 0
    assert "left out: " in cli.printed
    names = ["walk.csv", "walk.csv.entries.csv", "walk.csv.gaps.csv"]
    assert sorted(path.name for path in out.glob("*.csv")) == names
    assert cli("fill", ends, "--ends", "fill", "--effort", "low", "--out", out) == 0
    assert CSVFormat().read(out / "ends.csv").visible.all()


@pytest.mark.slow
def test_a_model_is_chosen_by_the_gaps_and_not_by_the_ends(cli, tmp_path, out):
    """Somebody is there for half of the time, so that copies of the ends would fit nowhere."""
    path = save(tmp_path / "a.csv", rows(gap={*range(40), *range(55, 60), *range(80, 120)}))
    for ends in ("open", "fill"):
        options = ("--ends", ends, "--effort", "low", "--out", out / ends)
        assert cli("fill", path, *options) == 0
        assert "held-out gaps are down to" not in cli.printed


def test_the_walk_of_somebody_who_comes_and_goes_is_filled_within(cli, out):
    path = shared("wild", "cases", "05-walk-in-walk-out", "walk.c3d")
    for ends in ("open", "fill"):
        options = ("--ends", ends, "--model", "rigid-body", "--out", out / ends)
        assert cli("fill", path, *options) == 0
        assert "rigid-body filled 90 entries in 2 gaps, and left 5760 open at" in cli.printed
        assert "Nothing is visible in 160 frames at the beginning or the end" in cli.printed
        points = ezc3d.c3d(str(out / ends / "walk.c3d"))["data"]["points"][:3]
        assert np.isnan(points[:, :, [*range(90), *range(230, 300)]]).all()
        assert not np.isnan(points[:, :, 90:230]).any()
