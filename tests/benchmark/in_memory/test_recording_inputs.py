"""What a notebook has becomes the recording that it is, or is refused with what was expected."""

import re

import numpy as np
import pandas as pd
import pytest

import mocapbench
from mocapbench.datasets import CSVFormat, Recording

xarray = pytest.importorskip("xarray")


def to_frame(recording, units=True):
    labels = zip(recording.channels, recording.units, strict=True)
    names = [f"{channel} [{unit}]" if units else channel for channel, unit in labels]
    return pd.DataFrame(recording.values, recording.times, names)


def to_dataset(recording, **about):
    values = recording.values.reshape(-1, 4, 3).transpose(0, 2, 1)
    position = xarray.DataArray(
        values,
        dims=("time", "space", "keypoints"),
        coords={
            "time": recording.times,
            "space": list("xyz"),
            "keypoints": ["LKNE", "LANK", "RKNE", "RANK"],
        },
        attrs={"units": "mm"},
    )
    return xarray.Dataset({"position": position}, attrs=about)


def assert_same(one, other):
    np.testing.assert_array_equal(one.times, other.times)
    np.testing.assert_array_equal(one.values, other.values)
    assert (one.channels, one.units) == (other.channels, other.units)


def test_a_recording_stays_what_it_is(gappy):
    assert mocapbench.read(gappy) is gappy


def test_a_table_with_an_index_in_seconds_is_the_recording(gappy):
    assert_same(mocapbench.read(to_frame(gappy)), gappy)


def test_a_table_with_a_column_of_times_is_the_recording(gappy):
    table = to_frame(gappy).reset_index(names="time")
    assert_same(mocapbench.read(table), gappy)


def test_a_table_of_durations_is_the_recording(gappy):
    table = to_frame(gappy).set_axis(pd.to_timedelta(gappy.times, "s"))
    read = mocapbench.read(table)
    np.testing.assert_allclose(read.times, gappy.times, atol=1e-9)


def test_a_table_whose_rows_are_frames_needs_a_rate(gappy):
    table = to_frame(gappy).reset_index(drop=True)
    with pytest.raises(ValueError, match=r"expected a column 'time' in seconds, or a rate.* rate="):
        mocapbench.read(table)
    assert_same(mocapbench.read(table, rate=60), gappy)


def test_levels_of_columns_are_names_of_channels(gappy):
    table = to_frame(gappy, units=False)
    table.columns = pd.MultiIndex.from_tuples([tuple(c.split(".")) for c in gappy.channels])
    assert mocapbench.read(table).channels == gappy.channels


def test_a_table_is_read_as_the_same_table_in_a_csv_file(gappy, tmp_path):
    table = to_frame(gappy).reset_index(names="time")
    table.to_csv(tmp_path / "walk.csv", index=False)
    assert_same(mocapbench.read(table), CSVFormat().read(tmp_path / "walk.csv"))


def test_an_array_has_the_rate_that_is_named(gappy):
    read = mocapbench.read(gappy.values, rate=60, names=gappy.channels, units=gappy.units)
    assert_same(read, gappy)


def test_what_a_mask_hides_is_hidden(gappy):
    values = np.ma.masked_array(np.where(gappy.visible, gappy.values, -9999.0), ~gappy.visible)
    read = mocapbench.read(values, rate=30)
    np.testing.assert_array_equal(read.visible, gappy.visible)
    np.testing.assert_array_equal(
        mocapbench.GapFiller(rate=30).fit_transform(values),
        mocapbench.GapFiller(rate=30).fit_transform(gappy.values),
    )


def test_the_rate_of_a_table_is_a_number(gappy):
    table = pd.DataFrame(gappy.values, columns=gappy.channels)
    with pytest.raises(ValueError, match=r"expected rate= in frames per second, above 0, got '60'"):
        mocapbench.read(table, rate="60")


def test_a_dataset_of_movement_is_the_recording(gappy):
    assert_same(mocapbench.read(to_dataset(gappy)), gappy)
    assert_same(mocapbench.read(to_dataset(gappy).position), gappy)
    assert_same(mocapbench.read(to_dataset(gappy).transpose()), gappy)
    assert_same(mocapbench.read(to_dataset(gappy).rename(keypoints="keypoint")), gappy)
    assert_same(mocapbench.read(to_dataset(gappy).expand_dims(individuals=["id_0"])), gappy)


def test_individuals_stand_before_the_names_of_their_keypoints(gappy):
    both = xarray.concat([to_dataset(gappy)] * 2, pd.Index(["Ann", "Bob"], name="individuals"))
    read = mocapbench.read(both)
    assert {"Ann:LKNE.x", "Bob:RANK.z"} <= {*read.channels}
    np.testing.assert_array_equal(read.select(["Bob:LKNE.x"]).values[:, 0], gappy.values[:, 0])


def test_keypoints_of_less_confidence_are_hidden(walk):
    dataset = to_dataset(walk())
    confidence = np.ones((240, 4))
    confidence[10:20, 1] = 0.2
    dataset["confidence"] = (("time", "keypoints"), confidence)
    read = mocapbench.read(dataset, min_likelihood=0.5)
    hidden = np.zeros((240, 12), dtype=bool)
    hidden[10:20, 3:6] = True
    np.testing.assert_array_equal(~read.visible, hidden)


def test_frames_of_a_dataset_need_a_rate(gappy):
    dataset = to_dataset(gappy, time_unit="frames")
    with pytest.raises(ValueError, match="expected times in seconds, got frames; name rate="):
        mocapbench.read(dataset)
    assert_same(mocapbench.read(dataset, rate=60), gappy)


def test_a_file_is_a_recording_that_knows_its_file(gappy, tmp_path):
    path = tmp_path / "walk.csv"
    to_frame(gappy).reset_index(names="time").to_csv(path, index=False)
    read = mocapbench.read(path)
    assert_same(read, gappy)
    assert read.path == path
    assert mocapbench.read(str(path), rate=30).times[1] == pytest.approx(1 / 30)


def test_spikes_of_a_file_are_hidden_if_that_is_asked_for(walk, tmp_path):
    values = walk().values.copy()
    values[100, 3:6] += 500
    path = tmp_path / "walk.csv"
    to_frame(walk().with_values(values)).reset_index(names="time").to_csv(path, index=False)
    assert mocapbench.read(path).visible.all()
    read = mocapbench.read(path, hide_spikes=True)
    assert not read.visible[100, 3:6].any()
    assert any("spike" in text for text in read.remarks)


def damage(recording):
    table = to_frame(recording)
    return {
        "empty": lambda: table.iloc[:0],
        "text": lambda: table.assign(note="a"),
        "objects": lambda: table.astype({table.columns[0]: object}),
        "integers": lambda: table.fillna(0).astype(int),
        "twice": lambda: pd.concat([table, table.iloc[:, :1]], axis=1),
        "unsorted": lambda: table.iloc[::-1],
        "same time": lambda: table.iloc[[0, 1, 1, 2]],
        "lacking": lambda: table.drop(table.index[100:110]),
        "infinite": lambda: table.replace(table.iloc[0, 3], np.inf),
        "times": lambda: table.set_axis([*table.index[:-1], np.nan]),
    }


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        ("empty", "expected a row a frame and a column a channel, got shape (0, 12)"),
        ("text", "expected columns of numbers, got others in note"),
        ("objects", "expected columns of numbers, got others in LKNE.x [mm]"),
        ("integers", "expected floating-point numbers, NaN where an entry is hidden, got integers"),
        ("twice", "expected columns of different names, got 'LKNE.x [mm]' 2 times"),
        ("unsorted", "expected every time after the one before, got"),
        ("same time", "expected every time after the one before, got"),
        (
            "lacking",
            "got none for 10 frames, the first after 1.65 s",
        ),
        ("infinite", "expected finite numbers"),
        ("times", "expected a time for every frame, got none for frame 239"),
    ],
)
def test_a_table_that_is_no_recording_is_refused(gappy, fault, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        mocapbench.read(damage(gappy)[fault]())


@pytest.mark.parametrize(
    ("values", "options", "said"),
    [
        (np.zeros(5), {"rate": 30}, "expected an array (frames, channels), got shape (5,)"),
        (np.zeros((5, 0)), {"rate": 30}, "expected an array (frames, channels), got shape (5, 0)"),
        (np.zeros((5, 2), int), {"rate": 30}, "expected floating-point numbers"),
        (np.zeros((5, 2), object), {"rate": 30}, "expected floating-point numbers"),
        (np.zeros((5, 2)), {}, "expected rate= in frames per second, above 0, got None"),
        (np.zeros((5, 2)), {"rate": -1}, "expected rate= in frames per second, above 0, got -1"),
        (
            np.zeros((5, 2)),
            {"rate": "60"},
            "expected rate= in frames per second, above 0, got '60'",
        ),
        (
            np.zeros((5, 2)),
            {"rate": True},
            "expected rate= in frames per second, above 0, got True",
        ),
        (np.zeros((5, 2)), {"rate": 30, "names": ["a"]}, "expected names= of 2 channels"),
        (np.zeros((5, 2)), {"rate": 30, "names": "aa"}, "expected distinct channel names"),
        (np.zeros((5, 2)), {"rate": 30, "units": ["mm"]}, "one unit for each"),
        (np.zeros((5, 2)), {"missing": "zeros"}, "expected options rate, names, units, name"),
        ([[1.0]], {}, "expected the path of a file, a DataFrame, an array"),
    ],
)
def test_an_array_that_is_no_recording_is_refused(values, options, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        mocapbench.read(values, **options)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda d: d.rename(keypoints="joints"), "expected positions with the dimensions time"),
        (lambda d: d.astype(int), "expected floating-point positions"),
        (lambda d: d.drop_vars("position"), "expected positions with the dimensions time"),
    ],
)
def test_a_dataset_of_another_layout_is_refused(walk, change, said):
    with pytest.raises(ValueError, match=said):
        mocapbench.read(change(to_dataset(walk())))


def test_only_a_dataset_with_confidence_can_hide_what_is_unlikely(gappy):
    with pytest.raises(ValueError, match="expected a variable confidence"):
        mocapbench.read(to_dataset(gappy), min_likelihood=0.5)


def test_what_is_read_is_a_recording(gappy, walk):
    for source in (to_frame(gappy), to_dataset(gappy), walk()):
        assert isinstance(mocapbench.read(source), Recording)
