"""The first task file of a folder is TOML that runs, whatever the names in it are."""

import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from own_files import write_csv

from mocapbench.baselines import LinearImputer
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.task_files.building import build_task
from mocapbench.benchmark.task_files.checking import open_task_file
from mocapbench.benchmark.task_files.template import draft

PIECES = st.sampled_from(
    [*"\"'\\#[]{}*?=,.;- \t\x01\x7f\x85\u2028\ue000üß漢😀$abcAB", "--", "${hide}", '"""']
)
LETTERS = st.lists(PIECES, min_size=1, max_size=12).map("".join)
LONG = st.integers(60, 200).map(lambda n: "long-" * (n // 5))
# A slash or NUL is in no file's name, a dot before it hides a file from patterns.
FILES = st.one_of(LETTERS, LONG, LETTERS.map(lambda name: f"{name}\n\r.")).filter(
    lambda name: len(name.encode()) < 240 and name[0] != "."
)
# A file of separated values has no quotes within quotes, and no line ends in a name.
CHANNELS = st.one_of(LETTERS, LONG).map(lambda name: f"c{name}".replace('"', "'").strip())


def quoted(channels):
    return [f'"{channel}.{axis}"' for channel in channels for axis in "xyz"]


def run_draft(folder, rate=None):
    """Return the recordings of the first task file of a folder, which is read again and tried."""
    path = folder.parent / "first.toml"
    path.write_text(draft(str(path), folder, rate)[0], encoding="utf-8")
    return open_task_file(path, folder)


@pytest.mark.slow
@settings(max_examples=40)
@given(
    st.lists(FILES, min_size=1, max_size=3, unique=True),
    st.lists(CHANNELS, min_size=1, max_size=3, unique=True),
    st.lists(LETTERS, max_size=2, unique=True),
)
@example(["walk [1]", "walk 1"], ["LKNE"], [])
@example(["a", "a ", "a.csv"], ["LKNE"], ["two words", "x" * 300, "\x7f", 'a"b\\'])
@example(["*"], ["*12"], ["-" * 120])
def test_the_first_task_file_runs_whatever_the_names_are(files, channels, models):
    before = dict(MODELS._added)
    with TemporaryDirectory() as directory:
        folder = Path(directory, "of recordings")
        for name in files:
            write_csv(folder / f"{name}.csv", channels=quoted(channels))
        try:
            for name in models:
                MODELS.add(name, type("Own", (LinearImputer,), {}))
            found = run_draft(folder)
        finally:
            MODELS._added.clear()
            MODELS._added.update(before)
    assert set(found.tests) == {f"{name}.csv" for name in files}
    assert set(models) <= set(tomllib.loads(found.text)["models"])


@pytest.mark.parametrize("rate", [0.001, 29.97, 1e9, 120.0])
def test_the_rate_of_the_first_task_file_is_the_one_given(tmp_path, rate):
    write_csv(tmp_path / "walks" / "a.csv")
    text = draft("first.toml", tmp_path / "walks", rate)[0]
    assert tomllib.loads(text)["rate"] == rate


def test_a_file_that_no_task_file_can_name_is_left_out(tmp_path):
    folder = tmp_path / "walks"
    for name in ("a", "b:c", "d?rate=5", "T\udceate"):
        write_csv(folder / f"{name}.csv")
    _, tests, left_out = draft("first.toml", folder, None)
    assert tests == ("a.csv",)
    assert len(left_out) == 3
    assert all("expected a file whose path is UTF-8" in reason for reason in left_out)
    assert run_draft(folder).tests == ("a.csv",)


def test_a_folder_that_no_run_can_name_is_refused(tmp_path):
    for name in ("a:b", "T\udceate"):
        write_csv(tmp_path / name / "a.csv")
        with pytest.raises(UsageError, match="whose path is UTF-8 without ':'"):
            draft("first.toml", tmp_path / name, None)


def test_a_name_with_brackets_stands_for_one_file_alone(tmp_path):
    folder = tmp_path / "walks"
    for name in ("walk [1]", "walk *"):
        write_csv(folder / f"{name}.csv")
    write_csv(folder / "walk 1.csv", channels=("another.x",))
    assert run_draft(folder).tests == ("walk *.csv", "walk [1].csv")


def test_cases_of_names_within_names_are_told_apart(tmp_path):
    folder = tmp_path / "walks"
    for name in ("a.csv", "a.CSV", "a.csv.csv"):
        write_csv(folder / name)
    cases = build_task(run_draft(folder)).cases
    assert len({case.columns["recording"] for case in cases}) == 3
