"""Parquet files: nulls, types of columns, what is kept, and what cannot be read."""

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from mocapbench.datasets import FormatError, FormatWarning, ParquetFormat, TextColumnsWarning
from mocapbench.datasets.formats.tables import parquet

PARQUET = ParquetFormat()


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


@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
@pytest.mark.parametrize("index", [["frame"], ["time"], ["frame", "time"]])
@pytest.mark.parametrize("rate", [None, 100.0])
def test_a_row_for_each_marker_of_each_frame_is_refused(tmp_path, index, rate):
    table = {"frame": [0, 0, 1, 1], "time": [0.0, 0.0, 0.01, 0.01], "marker": [*"abab"]}
    table = {name: table[name] for name in (*index, "marker")} | {"x": [1.0, 2.0, 3.0, 4.0]}
    pq.write_table(pa.table(table), tmp_path / "walk.parquet")
    with pytest.raises(FormatError, match="one row a frame, got several of frame 0; write one"):
        PARQUET.read(tmp_path / "walk.parquet", rate)


MOMENTS = pd.to_datetime("2026-01-31T23:59:59.98") + pd.to_timedelta([0, 10, 20, 30], "ms")
CLOCKS = {
    "timestamps": pa.array(MOMENTS),
    "timestamps of a zone": pa.array(MOMENTS, pa.timestamp("ms", "Europe/Vienna")),
    "durations": pa.array(pd.to_timedelta([5, 15, 25, 35], "ms")),
    "times of the day": pa.array([5000, 15000, 25000, 35000], pa.time64("us")),
}


@pytest.mark.parametrize("kind", CLOCKS)
def test_moments_are_times(tmp_path, kind):
    path = tmp_path / "walk.parquet"
    pq.write_table(pa.table({"timestamp": CLOCKS[kind], "x": [1.0, None, 3.0, 4.0]}), path)
    walk = PARQUET.read(path)
    assert walk.channels == ("x",)
    np.testing.assert_allclose(np.diff(walk.times), 0.01)
    PARQUET.write(tmp_path / "out.parquet", walk.with_values([[1.0], [2.0], [3.0], [4.0]]), path)
    assert (
        pq.read_table(tmp_path / "out.parquet")
        .column("timestamp")
        .equals(pq.read_table(path).column("timestamp"))
    )


def test_rows_that_are_missing_are_said(tmp_path):
    path = tmp_path / "walk.parquet"
    pq.write_table(pa.table({"time": [0.0, 0.1, 0.2, 0.5, 0.6], "x": [1.0] * 5}), path)
    with pytest.warns(FormatWarning, match="2 rows are missing, behind row 3, by .* they stay so"):
        PARQUET.read(path)


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
