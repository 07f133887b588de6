"""``mocapbench fill``, as the user takes gaps in hand: the table of gaps, and options for some."""

import numpy as np
import pandas as pd
import pytest
from left_behind import leave_lock

from mocapbench.basics.temporaries import PREFIX
from mocapbench.benchmark.cli import fill as command
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling import output_files
from mocapbench.datasets import CSVFormat

MARKERS = ("LKNE", "RKNE", "C7", "T10")


def write_markers(path, gaps, n_frames=200):
    """Write markers that go in circles, of which frames [first, stop) are empty in some."""
    times = np.arange(n_frames) / 100
    channels = [f"{marker}.{axis}" for marker in MARKERS for axis in "xyz"]
    values = 90 * np.sin(5 * times[:, None] + np.arange(len(channels))) + 1000
    frame = pd.DataFrame(values.round(3), columns=channels)
    for marker, first, stop in gaps:
        frame.loc[first : stop - 1, [f"{marker}.{axis}" for axis in "xyz"]] = np.nan
    frame.insert(0, "time", times)
    frame.to_csv(path, index=False)
    return path


@pytest.fixture
def walk(tmp_path):
    gaps = [("LKNE", 20, 30), ("LKNE", 90, 95), ("C7", 120, 160)]
    return write_markers(tmp_path / "walk.csv", gaps)


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


def read_gaps(folder, name="walk.csv"):
    return pd.read_csv(folder / f"{name}.gaps.csv")


def test_the_table_of_gaps_is_beside_the_file_in_the_terminal_and_on_the_page(cli, walk, out):
    assert cli("fill", walk, "--model", "linear", "--out", out) == 0
    gaps = read_gaps(out)
    assert [*gaps["marker"]] == ["LKNE", "LKNE", "C7"]
    assert [*gaps["last"] + 1 - gaps["first"]] == [10, 5, 40]
    assert sorted(path.name for path in out.iterdir()) == [
        *("walk.csv", "walk.csv.entries.csv", "walk.csv.gaps.csv", "walk.csv.html")
    ]
    page = (out / "walk.csv.html").read_text()
    for frames in ("20-29", "90-94", "120-159"):
        assert frames in cli.printed
        assert f"<td>{frames}</td>" in page
    assert "--leave C7:120-159" in cli.printed
    assert page.count("<code>--leave ") == 3


def test_a_gap_is_left_open_by_the_option_of_its_row_and_the_rest_is_the_same(cli, walk, out):
    assert cli("fill", walk, "--model", "linear", "--out", out / "all") == 0
    option = "--leave", read_gaps(out / "all")["leave"][0]
    assert option == ("--leave", "LKNE:20-29")
    assert cli("fill", walk, "--model", "linear", *option, "--out", out / "some") == 0
    assert "1 gap was left open by --leave or --only: LKNE." in cli.printed
    whole, some = ((out / name / "walk.csv").read_text().splitlines() for name in ("all", "some"))
    assert some[21:31] == walk.read_text().splitlines()[21:31]
    assert some[:21] + some[31:] == whole[:21] + whole[31:]
    entries = pd.read_csv(out / "some" / "walk.csv.entries.csv")
    assert not entries["frame"].between(20, 29).any()


def test_only_named_gaps_are_filled_each_by_its_model(cli, walk, out):
    rules = ("--only", "C7,LKNE:90-94", "--model", "C7=makima,*=linear")
    assert cli("fill", walk, *rules, "--out", out) == 0
    gaps = read_gaps(out)
    assert [*zip(gaps["marker"], gaps["first"], gaps["model"], strict=True)] == [
        ("LKNE", 90, "linear"),
        ("C7", 120, "makima"),
    ]
    assert np.isnan(CSVFormat().read(out / "walk.csv").values[20:30, :3]).all()


def test_values_of_named_frames_stay_where_they_are_left(cli, walk, out):
    named = ("--frames", "40:50", "--channels", "RKNE,T10", "--leave", "T10", "--model", "linear")
    assert cli("fill", walk, *named, "--out", out) == 0
    before, after = (CSVFormat().read(path) for path in (walk, out / "walk.csv"))
    changed = (before.values != after.values) & before.visible
    assert {before.channels[k] for k in np.nonzero(changed)[1]} == {"RKNE.x", "RKNE.y", "RKNE.z"}


@pytest.mark.parametrize("n_gaps", [12, 13])
def test_of_many_gaps_those_with_most_cautions_are_printed_and_how_many_more(
    cli, tmp_path, out, n_gaps
):
    gaps = [("T10", 190, 200), *(("LKNE", 5 + 14 * k, 9 + 14 * k) for k in range(n_gaps - 1))]
    path = write_markers(tmp_path / "many.csv", gaps)
    assert cli("fill", path, "--ends", "fill", "--model", "linear", "--out", out) == 0
    said = cli.printed
    assert "T10 190-199" in " ".join(said.split())
    assert said.count(" linear ") >= (n_gaps if n_gaps == 12 else 10)
    assert ("3 more gaps are in" in said) == (n_gaps == 13)
    assert len(read_gaps(out, "many.csv")) == n_gaps


def test_a_rule_that_names_no_gap_ends_with_2_before_any_model_runs(cli, walk, out, monkeypatch):
    monkeypatch.setattr(command.filling, "fill", None)
    assert cli("fill", walk, "--leave", "LKNEE", "--out", out) == 2
    assert "--leave: expected a gap to fill, got 'LKNEE', which names none: did you" in cli.printed
    assert cli("fill", walk, "--model", "LKNE=lineal", "--out", out) == 2
    assert "linear" in cli.printed
    assert not out.exists()


def test_the_table_of_gaps_is_written_with_the_others_or_none_is(cli, walk, out, monkeypatch):
    write_text = output_files.write_text

    def fail(path, text):
        if path.name == "walk.csv.gaps.csv":
            raise OSError(28, "No space left on device")
        write_text(path, text)

    monkeypatch.setattr(output_files, "write_text", fail)
    assert cli("fill", walk, "--model", "linear", "--out", out) == 2
    assert not out.exists()
    out.mkdir()
    (out / "walk.csv.gaps.csv").write_text("mine")
    assert cli("fill", walk, "--model", "linear", "--out", out) == 2
    assert "walk.csv.gaps.csv, which would be overwritten" in cli.printed


def test_of_two_fills_of_one_file_at_once_the_second_is_refused(cli, walk, out):
    files = (walk, *(out / f"walk.csv{end}" for end in (".entries.csv", ".gaps.csv", ".html")))
    outputs = tuple(out / path.name for path in files)
    with output_files.reserve_outputs(outputs) as drafts:
        assert cli("fill", walk, "--model", "linear", "--out", out) == 2
        assert f"{out / 'walk.csv'}: another process is writing it" in cli.printed
        for path in drafts:
            path.write_text("of the first")
    assert [path.read_text() for path in outputs] == ["of the first"] * 4
    assert cli("fill", walk, "--model", "linear", "--out", out) == 2
    assert "would be overwritten" in cli.printed


def test_what_another_process_has_filled_meanwhile_is_not_overwritten(out):
    outputs = tuple(out / name for name in "abcd")
    out.mkdir()
    outputs[3].write_text("theirs")
    with (
        pytest.raises(UsageError, match="would be overwritten"),
        output_files.reserve_outputs(outputs),
    ):
        pass
    assert [path.read_text() for path in out.iterdir()] == ["theirs"]


def test_a_fill_that_was_killed_before_its_files_counted_is_no_hindrance(cli, walk, out):
    drafts = out / f"{PREFIX}walk.csv" / "drafts"
    leave_lock(drafts.parent)
    drafts.mkdir(parents=True)
    (drafts / "walk.csv").write_text("half")
    assert cli("fill", walk, "--model", "linear", "--out", out) == 0
    assert len([*out.iterdir()]) == 4


def test_a_fill_that_was_killed_once_its_files_counted_is_finished_by_the_next(cli, walk, out):
    assert cli("fill", walk, "--model", "linear", "--out", out) == 0
    left = out / f"{PREFIX}walk.csv" / "decided"
    leave_lock(left.parent)
    left.mkdir(parents=True)
    (out / "walk.csv.html").rename(left / "walk.csv.html")
    assert cli("fill", walk, "--model", "linear", "--out", out) == 2
    assert "would be overwritten" in cli.printed
    assert (out / "walk.csv.html").exists()
    assert len([*out.iterdir()]) == 4
