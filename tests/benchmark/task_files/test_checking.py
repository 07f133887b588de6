"""Every message names the file, the line and the key, and says what to write."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from format_files import walk, write_acclaim
from own_files import write_csv

from mocapbench.baselines import RigidBody
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.task_files.building import build_task
from mocapbench.benchmark.task_files.checking import check_document, open_task_file, open_task_files
from mocapbench.benchmark.task_files.document import Document, TaskFileError
from mocapbench.benchmark.task_files.hidden_settings import HIDE_KEYS, RUN_KEYS
from mocapbench.benchmark.task_files.settings import KEYS

GOOD = 'files = ["*.csv"]\nfolds = 2\n[hide]\nruns = { seconds = 0.1, count = 2 }\n'

WRONG = [
    (
        'filez = ["*.csv"]\n[hide]\nfraction = 0.2',
        r"line 1, key filez: .* did you mean files",
    ),
    (
        "[hide]\nfraction = 0.2",
        r"key files: expected the recordings to fill, got none; write",
    ),
    (
        'files = "../*.csv"\n[hide]\nfraction = 0.2',
        r"line 1, key files: .*without .. and : and a leading /",
    ),
    (
        'files = "/a.csv"\n[hide]\nfraction = 0.2',
        r"line 1, key files: .*without .. and : and a leading /",
    ),
    *(
        (
            f"files = '{path}'\n[hide]\nfraction = 0.2",
            r"line 1, key files: .*without .. and : and a leading /",
        )
        for path in (r"..\*.csv", r"\a.csv", r"\\server\a.csv", r"C:\a.csv")
    ),
    (
        'files = "*.c3d"\n[hide]\nfraction = 0.2',
        r"line 1, key files: .* that match '\*.c3d', got none; .* it holds a.csv and b.csv",
    ),
    (
        'files = "a.csv"',
        r"key hide: expected a table of what is hidden",
    ),
    (
        'files = "a.csv"\nhide = 3',
        r"line 2, key hide: expected a table",
    ),
    (
        'files = "a.csv"\n[hide]\nfractions = 0.2',
        r"line 3, key hide.fractions: .*mean fraction?",
    ),
    (
        'files = "*.csv"\n[hide]\nfraction = 1.0',
        r"line 3, key hide.fraction: .* got 1.0; write",
    ),
    (
        'files = "*.csv"\n[hide]\nfraction = [0.1, 0.1]',
        r"line 3, key hide.fraction: expected a share",
    ),
    (
        'files = "*.csv"\n[hide]\nfraction = true',
        r"line 3, key hide.fraction: .* got True; write",
    ),
    (
        'files = "*.csv"\n[hide]\n\nruns = 3',
        r"line 4, key hide.runs: expected a table of seconds",
    ),
    (
        'files = "*.csv"\n[hide]\nruns = { count = 3 }',
        r"line 3, key hide.runs.seconds: .* got none",
    ),
    (
        'files = "*.csv"\n[hide]\nruns = { seconds = "long" }',
        r"hide.runs.seconds: .* got 'long'; wr",
    ),
    (
        'files = "*.csv"\n[hide]\nruns = { seconds = [0.1, 0.005] }',
        r"line 3, key hide.runs.seconds: .* a frame or more, which is 0.02 s, got 0.005 s; hide",
    ),
    (
        'files = "*.csv"\n[hide]\nruns = { seconds = [0.1, 0.104] }',
        r"line 3, key hide.runs.seconds: .* in a.csv, got 0.1 and 0.104 s of 5 frames; leave one",
    ),
    (
        'files = "*.csv"\nmetrics = ["mse", "mpjpe"]\n[hide]\nfraction = 0.2',
        r"line 2, key metrics: .*, got 'mpjpe' for .csv without a whole skeleton; choose .*mse",
    ),
    (
        'files = "*.csv"\nmetrics = ["cumulative_scaled_error"]\n[hide]\nfraction = 0.2',
        r"line 2, key metrics: .*, got 'cumulative_scaled_error' for .csv",
    ),
    (
        'files = "*.csv"\n[hide]\nruns = { seconds = 1, count = 0 }',
        r"hide.runs.count: .* got 0; writ",
    ),
    (
        'files = "*.csv"\n[hide]\nruns = { seconds = 1, count = 10001 }',
        r"hide.runs.count: expected a whole number from 1 to 10,000, got 10001; writ",
    ),
    (
        f'files = "*.csv"\nfolds = {"9" * 20}\n[hide]\nfraction = 0.2',
        r"folds: expected a whole number from 1 to 10,000, got 9{20}; writ",
    ),
    (
        'files = "*.csv"\nrate = inf\n[hide]\nfraction = 0.2',
        r"rate: expected frames per second, got inf; writ",
    ),
    (
        'files = "*.csv"\nchannels = "a{99999999999999999999}"\n[hide]\nfraction = 0.2',
        r"channels: expected regular expressions",
    ),
    (
        f'files = "*.csv"\nrate = "{"x" * 10_000}"\n[hide]\nfraction = 0.2',
        r"rate: expected frames per second, got 'x{99} … x{99}'; writ",
    ),
    (
        'files = "*.csv"\n[hide]\nruns = { seconds = 1, together = "x" }',
        r"hide.runs.together: .*'x'",
    ),
    (
        'files = "*.csv"\n[hide]\nfraction = 0.1\nframes = "1:2"',
        r"key hide.fraction: .* all but one",
    ),
    (
        'files = "*.csv"\n[hide]\nframes = "9:3"',
        r'line 3, key hide.frames: .* "120:180"',
    ),
    (
        'files = "*.csv"\n[hide]\nframes = "50:70"',
        r"line 2, key hide: expected for a.csv frames with",
    ),
    (
        'files = "*.csv"\n[hide]\nchannels = "("\nfraction = 0.1',
        r"line 3, key hide.channels: expected",
    ),
    (
        'files = "*.csv"\n[hide]\nchannels = "toe"\nfraction = 0.1',
        r"line 2, key hide: .*match 'toe'",
    ),
    (
        'files = "*.csv"\n[hide]\npattern-of = "c.csv"',
        r"key hide.pattern-of: .*there, got 'c.csv'",
    ),
    (
        'files = "*.csv"\n[hide]\npattern-of = "a:b.csv"',
        r"line 3, key hide.pattern-of: expected a file of the folder, got 'a:b.csv'; write",
    ),
    (
        'files = "*.csv"\n[hide]\npattern-of = "a.csv"',
        r"line 2, key hide: .* gaps .* got none where",
    ),
    (
        'files = "*.csv"\n[hide]\nruns = { seconds = 2 }',
        r"line 2, key hide: .*100 frames each",
    ),
    (
        'files = "*.csv"\nfolds = 2\n[hide]\nframes = "1:9"',
        r"line 2, key folds: .* got 2; write folds",
    ),
    (
        'files = "*.csv"\nfolds = 0\n[hide]\nfraction = 0.2',
        r"line 2, key folds: expected a whole numb",
    ),
    (
        'files = "*.csv"\nfolds = true\n[hide]\nfraction = 0.2',
        r"line 2, key folds: .* got True",
    ),
    (
        'files = "*.csv"\nmodels = ["lineal"]\n[hide]\nfraction = 0.2',
        r"line 2, key models: .*linear",
    ),
    (
        'files = "*.csv"\nmodels = ["gpdm"]\n[hide]\nfraction = 0.2',
        r"models that can fill .* 'gpdm'; c",
    ),
    (
        'files = "*.csv"\nmodels = ["oracle"]\n[hide]\nfraction = 0.2',
        r"got 'oracle', which needs the process that generated the recordings; choose from",
    ),
    (
        'files = "*.csv"\nmodels = "knn"\n[hide]\nfraction = 0.2',
        r"line 2, key models: expected a list",
    ),
    (
        'files = "*.csv"\nmetrics = ["msee"]\n[hide]\nfraction = 0.2',
        r"line 2, key metrics: .*did you",
    ),
    (
        'files = "*.csv"\nmetrics = ["mcc"]\n[hide]\nfraction = 0.2',
        r"'mcc', of synthesis; choose from",
    ),
    (
        'files = "*.csv"\nchannels = "toe.*"\n[hide]\nfraction = 0.2',
        r"key channels: .*are hip.x, hip.y",
    ),
    (
        'files = "*.csv"\nframes = "90:"\n[hide]\nfraction = 0.2',
        r"line 2, key frames: .* got 0; choose",
    ),
    (
        'files = "*.csv"\nrate = -1\n[hide]\nfraction = 0.2',
        r"line 2, key rate: expected frames per sec",
    ),
    (
        'files = "a.csv"\n[hide]\nfraction = 0.2',
        r"key training: .* besides a.csv, got none; write trai",
    ),
    (
        'files = "*.csv"\ntraining = "c*"\n[hide]\nfraction = 0.2',
        r"line 2, key training: .* 'c\*', got",
    ),
    (
        'files = "*.csv"\ntraining = "none"\n[hide]\nchannels = "hip.*"',
        r"key hide.channels: .* to learn",
    ),
    (
        'files = "*.csv"\nname = "marker-gaps"\n[hide]\nfraction = 0.2',
        r"key name: .* no other task has",
    ),
    (
        'files = "*.csv"\nname = "a b"\n[hide]\nfraction = 0.2',
        r"line 2, key name: expected letters",
    ),
    (
        'files = "*.csv"\ntitle = 3\n[hide]\nfraction = 0.2',
        r"line 2, key title: expected a text, got 3",
    ),
]


@pytest.mark.parametrize(("text", "message"), WRONG)
def test_what_cannot_be_is_refused_with_the_place(check, text, message):
    with pytest.raises(TaskFileError, match=message) as refused:
        check(text)
    assert re.match(r"my.toml(, line \d+)?, key ", str(refused.value))
    assert "; " in str(refused.value)  # what to do


def test_folders_are_found_with_backslashes_between_them_too(folder):
    for name in "cd":
        write_csv(folder / "monday" / f"{name}.csv")
    text = "files = 'monday\\*.csv'\ntraining = 'monday\\[cd].csv'\n[hide]\nfraction = 0.2"
    found = check_document(Document("my.toml", text), folder)
    assert found.tests == found.training == ("monday/c.csv", "monday/d.csv")


def test_metrics_of_joints_are_accepted_for_whole_motions_with_a_skeleton(tmp_path):
    write_acclaim(tmp_path / "walk.amc", walk(60))
    text = 'files = "walk.amc"\nmetrics = ["mpjpe", "jerk_ratio"]\ntraining = "none"\n{}'
    document = Document("my.toml", text.format("[hide]\nruns = { seconds = 0.1 }\n"))
    assert check_document(document, tmp_path).tests == ("walk.amc",)
    fewer = Document("my.toml", text.format('channels = ["l.*"]\n[hide]\nfraction = 0.2\n'))
    with pytest.raises(TaskFileError, match=r"got 'jerk_ratio' for .amc without a whole skeleton"):
        check_document(fewer, tmp_path)


UNLIKE = {
    "channels": (
        {"channels": ("hip.x", "hip.y", "toe.x")},
        "the 3 channels of a.csv, got no knee.x",
    ),
    "rate": ({"rate": 100.0}, "50 frames per second, as in a.csv, got 100"),
}


@pytest.mark.parametrize(("differs", "message"), UNLIKE.values(), ids=UNLIKE)
def test_recordings_that_differ_are_refused_at_the_key_that_names_them(
    check, folder, differs, message
):
    write_csv(folder / "c.csv", **differs)
    with pytest.raises(TaskFileError, match=f"line 1, key files: expected for c.csv {message}"):
        check(GOOD)


def test_channels_that_only_some_have_may_be_left_out(check, folder):
    write_csv(folder / "c.csv", channels=("toe.x", "hip.y", "hip.x"))
    assert check('channels = ["hip.*"]\n' + GOOD).tests == ("a.csv", "b.csv", "c.csv")


def test_a_file_that_cannot_be_read_is_named(check, folder):
    (folder / "c.csv").write_text("time,x\n0,1\n0,2\n")
    with pytest.raises(
        TaskFileError, match=r"line 1, key files: expected for c.csv every time aft"
    ):
        check(GOOD)


def test_missing_entries_of_files_are_noticed(check, folder):
    assert check(GOOD).complete
    write_csv(folder / "b.csv", gaps=[(3, 9, 0)])
    assert not check(GOOD).complete


def test_coordinates_of_markers_are_noticed(check, folder):
    assert "coordinates" not in check(GOOD).meets
    for path in folder.iterdir():
        write_csv(path, channels=("knee.z", "knee.y", "knee.x"))
    file = check(GOOD)
    assert file.meets == ("coordinates",)
    assert build_task(file).accepts(RigidBody)
    assert not build_task(replace(file, meets=())).accepts(RigidBody)


def test_files_without_times_take_a_rate(check, folder):
    for path in folder.iterdir():
        path.write_text(path.read_text().replace("time", "frame"))
    with pytest.raises(TaskFileError, match=r"key files: expected for a.csv a column 'time'"):
        check(GOOD)
    assert check("rate = 50\n" + GOOD).tests == ("a.csv", "b.csv")


def test_the_two_options_go_together(folder, tmp_path):
    assert open_task_files([], None) == ()
    for paths, recordings in (([], folder), ([tmp_path / "my.toml"], None)):
        with pytest.raises(UsageError, match="expected --recordings and --task-file together"):
            open_task_files(paths, recordings)


def test_two_tasks_of_one_name_are_refused(folder, tmp_path):
    paths = [tmp_path / "one" / "my.toml", tmp_path / "two" / "my.toml"]
    for path in paths:
        path.parent.mkdir()
        path.write_text(GOOD)
    with pytest.raises(UsageError, match='different names, got my, my; write name = "…"'):
        open_task_files(paths, folder)


@pytest.mark.parametrize("name", ["missing.toml", "recordings"])
def test_a_task_file_that_is_none_is_refused_with_what_writes_one(folder, tmp_path, name):
    with pytest.raises(UsageError, match=r"expected a TOML file, got .* `mocapbench init"):
        open_task_file(tmp_path / name, folder)


def test_a_task_file_in_another_encoding_is_refused(folder, tmp_path):
    path = tmp_path / "my.toml"
    path.write_bytes('title = "Lücken"'.encode("latin-1"))
    with pytest.raises(UsageError, match="expected text in UTF-8"):
        open_task_file(path, folder)


def test_a_folder_of_recordings_that_is_none_is_refused(tmp_path):
    with pytest.raises(UsageError, match="--recordings: expected a folder"):
        open_task_file(tmp_path / "my.toml", tmp_path / "nowhere")


def test_a_name_that_cannot_be_part_of_an_address_is_refused(check, folder):
    write_csv(folder / "c:d.csv")
    with pytest.raises(
        TaskFileError, match=r"line 1, key files: expected for c:d.csv .* rename it"
    ):
        check(GOOD)


PAGE = (Path(__file__).parents[3] / "docs" / "own-recordings.md").read_text(encoding="utf-8")


def test_the_documentation_explains_every_key():
    explained = set(re.findall(r"`([a-z-]+)(?: = [^`]*)?`", PAGE))
    assert {*KEYS, *HIDE_KEYS, *RUN_KEYS} <= explained
