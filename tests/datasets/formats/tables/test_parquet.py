"""Parquet files: nulls, types of columns, what is kept, and what cannot be read."""

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from mocapbench.datasets import (
    CSVFormat,
    FormatError,
    FormatWarning,
    ParquetFormat,
    TextColumnsWarning,
)
from mocapbench.datasets.formats.tables import parquet

PARQUET, CSV = ParquetFormat(), CSVFormat()


@pytest.fixture
def given(tmp_path):
    """A file with columns of several types, a gap in each channel, and a note about itself."""
    table = pa.table(
        {
            "time": pa.array([0.0, 0.1, 0.2]),
            "hip [mm]": pa.array([0.1, None, 0.3], pa.float32()),
            "knee [deg]": pa.array([170.0, float("nan"), -170.0]),
            "steps": pa.array([1, None, 2], pa.int64()),
            "side": pa.array(["left", None, "right"]),
            "at": pa.array(pd.to_datetime(["2026-01-01", "2026-01-02", "2026-01-03"])),
        }
    ).replace_schema_metadata({"subject": "35"})
    pq.write_table(table, tmp_path / "walk.parquet")
    return tmp_path / "walk.parquet"


def test_numbers_are_channels_and_nulls_are_hidden(given):
    with pytest.warns(TextColumnsWarning, match=r"^walk.parquet: left out, .* numbers: side, at$"):
        walk = PARQUET.read(given)
    assert (walk.channels, walk.units) == (("hip", "knee", "steps"), ("mm", "deg", ""))
    assert walk.visible.tolist() == [[True] * 3, [False] * 3, [True] * 3]
    assert walk.values[2, 1] == 190.0


@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
def test_what_is_visible_and_what_is_no_channel_stays(given, tmp_path):
    walk, out = PARQUET.read(given), tmp_path / "out.parquet"
    filled = walk.with_values(np.where(walk.visible, walk.values, [[0.7, 181.0, 1.5]]))
    PARQUET.write(out, filled, like=given)
    before, after = pq.read_table(given), pq.read_table(out)
    assert after.schema.metadata == before.schema.metadata
    assert after.column_names == before.column_names
    for name in ("time", "side", "at"):
        assert after.column(name).equals(before.column(name))
    assert after.column("hip [mm]").to_pylist() == [np.float32(v) for v in (0.1, 0.7, 0.3)]
    assert after.schema.field("hip [mm]").type == pa.float32()
    assert after.column("knee [deg]").to_pylist() == [170.0, -179.0, -170.0]
    assert after.column("steps").to_pylist() == [1.0, 1.5, 2.0]


def test_an_index_of_pandas_is_no_channel(tmp_path):
    frame = pd.DataFrame({"time": [0.0, 0.1], "hip": [1.0, 2.0]}, index=[7, 9])
    frame.to_parquet(tmp_path / "walk.parquet")
    assert PARQUET.read(tmp_path / "walk.parquet").channels == ("hip",)


def test_times_may_have_another_unit_and_frames_alone_take_a_rate(tmp_path):
    path = tmp_path / "walk.parquet"
    pd.DataFrame({"time_ms": [0.0, 10.0], "hip": [1.0, 2.0]}).to_parquet(path)
    assert PARQUET.read(path).times.tolist() == [0.0, 0.01]
    pd.DataFrame({"frame": [5, 6, 8], "hip": [1.0, 2.0, 3.0]}).to_parquet(path)
    assert PARQUET.read(path, rate=10.0).times.tolist() == pytest.approx([0.0, 0.1, 0.3])


MOMENTS = pd.to_datetime("2026-01-31T23:59:59.98") + pd.to_timedelta(10 * np.arange(6), "ms")
CLOCKS = {
    "timestamps": pa.array(MOMENTS),
    "timestamps of a zone": pa.array(MOMENTS, pa.timestamp("ms", "Europe/Vienna")),
    "durations": pa.array(pd.to_timedelta(5 + 10 * np.arange(6), "ms")),
    "times of the day": pa.array(5000 + 10_000 * np.arange(6), pa.time64("us")),
}


@pytest.mark.parametrize("kind", CLOCKS)
@pytest.mark.parametrize("name", ["timestamp", "time_ms"])
def test_moments_are_times(tmp_path, kind, name):
    path = tmp_path / "walk.parquet"
    pq.write_table(pa.table({name: CLOCKS[kind], "x": [1.0, None, *[3.0] * 4]}), path)
    walk = PARQUET.read(path)
    assert walk.channels == ("x",)
    np.testing.assert_allclose(np.diff(walk.times), 0.01)
    PARQUET.write(tmp_path / "out.parquet", walk.with_values(np.ones((6, 1))), path)
    assert (
        pq.read_table(tmp_path / "out.parquet")
        .column(name)
        .equals(pq.read_table(path).column(name))
    )


def test_rows_that_are_missing_are_said(tmp_path):
    path = tmp_path / "walk.parquet"
    pq.write_table(pa.table({"time": [0.0, 0.1, 0.2, 0.5, 0.6], "x": [1.0] * 5}), path)
    with pytest.warns(FormatWarning, match="2 rows are missing, behind row 3, .*--insert"):
        PARQUET.read(path)


def lay_long(**keys):
    """Return a table with a row for each marker of each frame but of 5 and 6, and one row fewer."""
    frames, markers = (part.ravel() for part in np.mgrid[0:12, 0:3])
    kept = ~np.isin(frames, [5, 6]) & ~((frames == 8) & (markers == 1))
    frames, markers = frames[kept], markers[kept]
    values = np.round(np.random.default_rng(0).uniform(-9, 9, (len(frames), 2)), 3)
    named = {name: np.array(words)[markers] for name, words in keys.items()}
    return pd.DataFrame({"frame": frames, "time": frames / 100} | named).assign(
        x=values[:, 0], y=values[:, 1], visibility=0.25 + 0.25 * markers
    )


def lay_wide(**columns):
    """Return a table of which rows are missing behind the third."""
    frames = np.array([0, 1, 2, 5, 6, 7, 8, 9])
    moving = pd.DataFrame({"frame": frames, "hip [mm]": frames * 1.5, "side": "left"})
    return moving.assign(**{name: make(frames) for name, make in columns.items()})


TABLES = {
    "markers": lay_long(keypoint=["LKNE", "RKNE", "Fuß"]),
    "numbers": lay_long(landmark=[11, 12, 40]),
    "sides and joints": lay_long(side=["l", "r", "r"], joint=["hip", "hip", "knee"]),
    "frames": lay_wide(),
    "times": lay_wide(time=lambda frames: frames / 120).drop(columns="frame"),
    "clock": lay_wide(
        timestamp=lambda frames: [f"2026-01-31T10:00:{k / 10 + 1:06.3f}Z" for k in frames]
    ).drop(columns="frame"),
}


def write_both(folder, name):
    """Write a table as CSV and as Parquet."""
    table = TABLES[name]
    table.to_csv(folder / "walk.csv", index=False)
    table.to_parquet(folder / "walk.parquet", index=False)
    rate = 100.0 if name == "frames" else None
    return [(kind, folder / f"walk.{kind.suffixes[0][1:]}", rate) for kind in (PARQUET, CSV)]


@pytest.mark.filterwarnings("ignore::mocapbench.datasets.FormatWarning")
@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize("inserts", [False, True])
def test_a_table_says_what_it_says_as_text(tmp_path, name, inserts):
    read, sure, filled = [], [], []
    for kind, path, rate in write_both(tmp_path, name):
        kind = kind.with_missing_rows() if inserts else kind  # noqa: PLW2901
        walk, out = kind.read(path, rate), path.with_stem("out")
        kind.write(out, walk.with_values(np.where(walk.visible, walk.values, 7.25)), like=path)
        read += [walk, kind.read(out, rate)]
        sure.append(kind.likelihoods(path))
        filled.append(pd.read_csv(out) if kind.suffixes[0] == ".csv" else pd.read_parquet(out))
    assert read[0].channels == read[1].channels == read[2].channels
    for ours, theirs in zip(read[:2], read[2:], strict=True):
        np.testing.assert_allclose(ours.times, theirs.times)
        np.testing.assert_allclose(ours.values, theirs.values)
    assert (sure[0] is None) == (sure[1] is None)
    assert sure[0] is None or np.array_equal(sure[0], sure[1], equal_nan=True)
    pd.testing.assert_frame_equal(*filled, check_dtype=False)
    types = pq.read_schema(tmp_path / "walk.parquet").types
    assert pq.read_schema(tmp_path / "out.parquet").types == types


@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
@pytest.mark.parametrize("kind", ["string", "large", "dictionary"])
def test_rows_that_are_added_have_names_in_the_type_of_their_column(tmp_path, kind):
    path = tmp_path / "walk.parquet"
    table = pa.table(TABLES["markers"])
    names = {
        "string": table.column("keypoint"),
        "large": table.column("keypoint").cast(pa.large_string()),
        "dictionary": table.column("keypoint").cast(pa.string()).dictionary_encode(),
    }
    pq.write_table(table.set_column(2, "keypoint", names[kind]), path)
    inserting = PARQUET.with_missing_rows()
    walk = inserting.read(path)
    inserting.write(tmp_path / "out.parquet", walk.with_values(np.full((12, 6), 7.25)), like=path)
    out = pq.read_table(tmp_path / "out.parquet")
    assert out.schema.types == pq.read_schema(path).types
    assert out.column("keypoint").to_pylist() == ["LKNE", "RKNE", "Fuß"] * 12
    assert out.column("frame").to_pylist() == np.repeat(range(12), 3).tolist()


@pytest.mark.parametrize("kind", CLOCKS)
def test_rows_that_are_added_have_moments(tmp_path, kind):
    path = tmp_path / "walk.parquet"
    times = pa.chunked_array([CLOCKS[kind]])
    table = pa.table({"timestamp": times, "x": [1.0] * 6})
    pq.write_table(table.take([0, 1, 3, 4, 5]), path)
    inserting = PARQUET.with_missing_rows()
    walk = inserting.read(path)
    inserting.write(tmp_path / "out.parquet", walk.with_values(np.nan_to_num(walk.values)), path)
    assert pq.read_table(tmp_path / "out.parquet").column("timestamp").equals(times)


@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
def test_rows_that_nothing_tells_apart_are_refused(tmp_path):
    path = tmp_path / "walk.parquet"
    pq.write_table(pa.table({"frame": [0, 0, 1, 1], "x": [1.0, 2.0, 3.0, 4.0]}), path)
    with pytest.raises(FormatError, match=r"one row for each frame, .* got 0 again, after row 1;"):
        PARQUET.read(path, rate=100.0)


@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
def test_long_notes_are_left_alone(tmp_path):
    path = tmp_path / "walk.parquet"
    notes = ["note" * 100, None, "x" * 9000, None]
    table = {"time": [0.0, 0.1, 0.2, 0.4], "note": notes, "x": [1.0, None, 3.0, 4.0]}
    pq.write_table(pa.table(table), path)
    kind = PARQUET.with_missing_rows()
    walk = kind.read(path)
    kind.write(tmp_path / "out.parquet", walk.with_values(np.full((5, 1), 2.5)), like=path)
    out = pq.read_table(tmp_path / "out.parquet").to_pydict()
    assert out["note"] == [*notes[:3], None, None]
    assert out["x"] == [1.0, 2.5, 3.0, 2.5, 4.0]


@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
def test_rows_are_added_also_beside_names_that_are_no_text(tmp_path):
    path, inserting = tmp_path / "walk.parquet", PARQUET.with_missing_rows()
    TABLES["markers"].to_parquet(path, index=False, compression=None)
    path.write_bytes(path.read_bytes().replace("Fuß".encode(), b"F\xff\xfeu"))
    walk = inserting.read(path)
    inserting.write(tmp_path / "out.parquet", walk.with_values(np.full((12, 6), 7.25)), like=path)
    assert np.isin(7.25, PARQUET.read(tmp_path / "out.parquet").values)


@pytest.mark.parametrize("keep", [0, 3, 100, 900])
def test_a_file_that_is_cut_short(given, keep):
    given.write_bytes(given.read_bytes()[:keep])
    with pytest.raises(
        FormatError, match=r"expected a Parquet file, got Arrow.*; export the record"
    ):
        PARQUET.read(given)


def test_a_small_file_that_unfolds_to_more_than_it_may_take(tmp_path, monkeypatch):
    """A column of equal values takes next to no place in a file."""
    monkeypatch.setattr(parquet, "_MEMORY", 2**26)
    zeros = pa.DictionaryArray.from_arrays(np.zeros(2**24, dtype=np.int8), pa.array([0.0]))
    pq.write_table(pa.table({"hip": zeros}), tmp_path / "walk.parquet")
    assert (tmp_path / "walk.parquet").stat().st_size < 2**18
    with pytest.raises(FormatError, match=r"got .*(memory|malloc|crash)"):
        PARQUET.read(tmp_path / "walk.parquet", rate=1.0)
