"""What was filled can be held in one's hand: arrays, tables, pictures, files."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from scipy.stats import norm

import mocapbench

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")


@pytest.fixture
def filled(gappy):
    return mocapbench.fill(gappy, "marker-kriging")


def test_deviations_are_0_where_entries_were_visible(filled, gappy):
    assert (filled.std[gappy.visible] == 0).all()
    assert (filled.std[~gappy.visible] > 0).all()
    np.testing.assert_array_equal(filled.mask, ~gappy.visible)


@pytest.mark.parametrize("level", [0.5, 0.95])
def test_an_interval_is_that_of_the_normal_distribution(filled, level):
    low, high = filled.interval(level)
    bounds = norm(filled.recording.values[filled.mask], filled.std[filled.mask]).interval(level)
    np.testing.assert_allclose((low[filled.mask], high[filled.mask]), bounds)


@pytest.mark.parametrize("level", [0, 1, 95])
def test_a_level_is_between_0_and_1(filled, level):
    with pytest.raises(ValueError, match="expected a level between 0 and 1"):
        filled.interval(level)


def test_what_was_not_to_be_filled_stays_hidden(gappy):
    filled = mocapbench.fill(gappy, "linear", max_gap=0.5)
    assert not filled.recording.visible[120:170, 6:9].any()
    assert np.isnan(filled.std[120:170, 6:9]).all()


def test_a_table_of_it_is_read_as_the_recording(filled):
    table = filled.to_dataframe()
    np.testing.assert_array_equal(mocapbench.read(table).values, filled.recording.values)
    assert table.index.name == "time"
    assert table.attrs["units"]["LKNE.x"] == "mm"


def test_a_dataset_of_it_is_read_as_the_recording(filled):
    pytest.importorskip("xarray")
    dataset = filled.to_xarray()
    again = mocapbench.read(dataset)
    np.testing.assert_array_equal(
        again.select(filled.recording.channels).values, filled.recording.values
    )
    assert dataset.position.dims == ("time", "space", "keypoints", "individuals")
    assert dataset["std"].sel(keypoints="LKNE", space="x").values.squeeze()[55] == filled.std[55, 0]


def test_only_coordinates_have_the_layout_of_movement(gappy):
    pytest.importorskip("xarray")
    knees = gappy.select(["LKNE.x", "LKNE.y", "RKNE.x"])
    with pytest.raises(ValueError, match=r"got no channel RKNE.y; use to_dataframe\(\)"):
        mocapbench.fill(knees, "linear").to_xarray()
    table = pd.DataFrame({"hip.rx [deg]": [1.0, np.nan, 2.0]}, [0.0, 0.1, 0.2])
    with pytest.raises(ValueError, match="expected channels that are coordinates"):
        mocapbench.fill(table, "linear").to_xarray()


def test_it_is_saved_as_a_table_that_is_read_as_the_recording(filled, tmp_path):
    path = filled.save(tmp_path / "filled.csv")
    again = mocapbench.read(path)
    np.testing.assert_array_equal(again.values, filled.recording.values)
    assert again.units == filled.recording.units


def test_it_is_saved_as_the_file_that_was_read(filled, tmp_path, gappy):
    filled_file = mocapbench.fill(gappy.frames(range(200)), "linear").save(tmp_path / "walk.csv")
    lines = filled_file.read_text().splitlines()
    cells = lines[31].split(",")
    lines[31] = ",".join([*cells[:4], "", *cells[5:]])
    filled_file.write_text("\n".join(lines))
    again = mocapbench.fill(filled_file, "linear").save(tmp_path / "again.csv")
    others = [k for k in range(len(lines)) if k != 31]
    saved = again.read_text().splitlines()
    assert [saved[k] for k in others] == [lines[k] for k in others]
    assert saved[31].split(",")[4] != ""


def test_nothing_is_overwritten(filled, tmp_path):
    (tmp_path / "walk.csv").write_text("mine")
    with pytest.raises(ValueError, match="expected a new file"):
        filled.save(tmp_path / "walk.csv")
    assert (tmp_path / "walk.csv").read_text() == "mine"


def test_what_is_of_no_file_is_saved_as_a_table_alone(filled, tmp_path):
    with pytest.raises(ValueError, match=r"expected a file called \*.csv"):
        filled.save(tmp_path / "walk.c3d")
    assert not (tmp_path / "walk.c3d").exists()


def test_a_picture_has_an_axis_for_each_channel_with_what_was_filled(filled, walk):
    axes = filled.plot("LKNE", truth=walk())
    assert [one.get_ylabel() for one in axes] == ["LKNE.x (mm)", "LKNE.y (mm)", "LKNE.z (mm)"]
    lines = {line.get_label(): line for line in axes[0].lines}
    assert {*lines} == {"filled", "visible", "truth"}
    shown = np.flatnonzero(np.isfinite(lines["filled"].get_ydata()))
    assert shown.tolist() == [*range(49, 61)]
    np.testing.assert_array_equal(lines["truth"].get_ydata(), walk().values[:, 0])
    (band,) = axes[0].collections
    (path,) = band.get_paths()
    low, high = filled.interval(0.95)
    assert path.vertices[:, 1].min() == low[49:61, 0].min()
    assert path.vertices[:, 1].max() == high[49:61, 0].max()


def test_a_pattern_draws_several_and_an_unknown_name_none(filled):
    assert len(filled.plot("*.x")) == 4
    with pytest.raises(ValueError, match="did you mean LKNE"):
        filled.plot("LKNEE")


def test_a_notebook_shows_what_was_done(filled):
    shown = filled._repr_html_()
    assert "marker-kriging filled 180 entries in 2 gaps" in shown
    assert "marker-kriging filled 180 entries" in repr(filled)
    assert "--" not in shown


def test_without_a_choice_there_is_no_ranking(filled):
    assert filled.ranking.empty
    assert "may_be_chance" in filled.ranking


def test_every_gap_has_a_row_whose_rule_leaves_it_open_and_changes_nothing_else(filled, gappy):
    assert filled.gaps["marker"].tolist() == ["LKNE", "RKNE"]
    again = mocapbench.fill(gappy, "marker-kriging", leave=filled.gaps["leave"][0])
    assert not again.recording.visible[50:60, :3].any()
    np.testing.assert_array_equal(again.recording.values[120:170], filled.recording.values[120:170])


def test_a_rule_names_a_marker_with_blanks_and_quotes_whole(gappy):
    names = [name.replace("LKNE", "left knee's") for name in gappy.channels]
    named = mocapbench.fill(replace(gappy, channels=tuple(names)), "linear")
    assert named.gaps["leave"][0] == "left knee's:50-59"
    again = mocapbench.fill(named.given, "linear", leave=named.gaps["leave"][0])
    assert not again.recording.visible[50:60, :3].any()
