"""What all formats share: suffixes, memory, libraries that lack, output that is whole or absent."""

import pickle

import numpy as np
import pytest
from format_files import sample, walk

from mocapbench.benchmark.cli.ending.failures import exit_code
from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.registry import FORMATS
from mocapbench.datasets import CSVFormat, Format, FormatError, MissingExtraError
from mocapbench.datasets.formats import base, memory

NAMES = FORMATS.names()

# Samples of tables have a column of text.
pytestmark = pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")


@pytest.mark.parametrize("name", NAMES)
def test_what_is_not_filled_stays_a_gap(name, tmp_path):
    path = sample(name, tmp_path)
    kind = FORMATS.get(name)()
    recording = kind.read(path)
    partly = recording.with_values(np.where(np.arange(60)[:, None] < 25, 1.0, recording.values))
    kind.write(tmp_path / f"out{path.suffix}", partly, like=path)
    out = kind.load(tmp_path / f"out{path.suffix}", None)
    still = ~recording.visible & (np.arange(60)[:, None] >= 25)
    assert np.array_equal(~out.visible, still)


@pytest.mark.parametrize("name", NAMES)
def test_a_relative_path_is_one_from_the_folder_of_now(name, tmp_path, monkeypatch):
    """Also where a process reads that was started in another folder."""
    kind, values = FORMATS.get(name)(), []
    for folder in ("first", "second"):
        (tmp_path / folder).mkdir()
        monkeypatch.chdir(tmp_path / folder)
        path = sample(name, tmp_path / folder)
        values.append(kind.read(path.relative_to(tmp_path / folder)).values)
        path.unlink()
    np.testing.assert_array_equal(*values)


@pytest.mark.parametrize("name", NAMES)
def test_a_file_that_is_not_there(name, tmp_path):
    kind = FORMATS.get(name)()
    path = tmp_path / f"absent{kind.suffixes[0]}"
    with pytest.raises(FormatError, match="expected a file that can be used, got No such file"):
        kind.read(path)


@pytest.mark.parametrize("name", NAMES)
def test_a_wrong_suffix_names_the_right_one(name, tmp_path):
    kind = FORMATS.get(name)()
    known = " or ".join(rf"\*\{suffix}" for suffix in kind.suffixes)
    expected = rf"expected a file called {known}, got '.doc'; name a file"
    with pytest.raises(FormatError, match=expected):
        kind.read(tmp_path / "walk.doc")


@pytest.mark.parametrize("name", NAMES)
def test_a_file_larger_than_memory_is_refused_with_the_number(name, tmp_path, monkeypatch):
    path = sample(name, tmp_path)

    class Full:
        available = 1000

    monkeypatch.setattr(memory.psutil, "virtual_memory", Full)
    with pytest.raises(
        FormatError, match=r"in the 0 MiB of memory .*, got 0 MiB that take \d+ MiB"
    ):
        FORMATS.get(name)().read(path)


@pytest.mark.parametrize(("name", "package"), [("parquet", "pyarrow")])
def test_a_library_that_lacks_is_named_with_what_installs_it(name, package, tmp_path, monkeypatch):
    monkeypatch.setattr(base, "find_spec", lambda _: None)
    path = tmp_path / f"walk.{name}"
    advice = rf"walk.{name}: reading .{name} needs {package}; pip install 'mocapbench\[{name}\]'"
    with pytest.raises(MissingExtraError, match=advice) as raised:
        FORMATS.get(name)().read(path)
    assert exit_code(raised.value) == ExitCode.USAGE


@pytest.mark.parametrize("rate", [0.0, -1.0, float("nan"), float("inf")])
def test_a_rate_is_positive(tmp_path, rate):
    with pytest.raises(FormatError, match=r"expected a positive rate, got .*; name frames per sec"):
        CSVFormat().read(sample("csv", tmp_path), rate=rate)


def test_another_recording_cannot_be_written(tmp_path):
    path = sample("csv", tmp_path)
    with pytest.raises(
        FormatError, match=r"the 60 frames and 62 channels of walk.csv, got 59 frames"
    ):
        CSVFormat().write(tmp_path / "out.csv", walk(59), like=path)


def test_a_link_to_the_input_is_the_input(tmp_path):
    path = sample("csv", tmp_path)
    (tmp_path / "link.csv").symlink_to(path)
    with pytest.raises(FormatError, match="another file than the one read, got the same; choose"):
        CSVFormat().write(tmp_path / "link.csv", CSVFormat().read(path), like=path)


class Failing(CSVFormat):
    """Writes a part and fails."""

    def save(self, path, values, new, like):
        path.write_text("a part")
        raise ValueError("a value that it cannot hold")


def test_what_cannot_be_written_leaves_nothing_behind(tmp_path):
    path = sample("csv", tmp_path)
    (tmp_path / "out.csv").write_text("from before")
    with pytest.raises(FormatError, match="got a value that it cannot hold; export"):
        Failing().write(tmp_path / "out.csv", CSVFormat().read(path), like=path)
    assert (tmp_path / "out.csv").read_text() == "from before"
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["out.csv", "walk.csv"]


def test_a_format_has_no_skeleton_unless_it_says_so(tmp_path):
    assert CSVFormat().skeleton(sample("csv", tmp_path)) is None
    path = sample("acclaim", tmp_path)
    assert FORMATS.get("acclaim")().skeleton(path).segments[0].name == "root"


@pytest.mark.parametrize(
    "error",
    [
        FormatError("a.csv", "b", "c", "d", line=3),
        MissingExtraError("a.parquet", "pyarrow", "parquet"),
    ],
)
def test_errors_pass_between_processes(error):
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again)) == (type(error), str(error))


def test_a_format_must_load_and_save():
    with pytest.raises(TypeError, match="abstract"):
        Format()
