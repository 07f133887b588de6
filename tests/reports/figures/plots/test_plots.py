"""Figures for papers: numbers on axes are those of their tables, and these are those of the run."""

import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from matplotlib.collections import LineCollection, PathCollection, QuadMesh
from matplotlib.figure import Figure

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.error_parts import ErrorParts
from mocapbench.reports.bundle.pictures import HeatMaps
from mocapbench.reports.export.means import tabulate_means
from mocapbench.reports.export.selection import select_results
from mocapbench.reports.figures.plots.base import NothingToDrawError
from mocapbench.reports.figures.plots.drawing import FIGURE_FORMATS, draw_figure, render_figure
from mocapbench.reports.figures.plots.kinds import FIGURE_KINDS
from mocapbench.reports.figures.plots.look import LOOKS, MARKERS, colour_of, dashes_of, scales_of
from mocapbench.reports.figures.plots.run_figures import describe_figure, tabulate_figures
from mocapbench.reports.figures.styles import N_SHAPES, DrawingStyle, model_styles
from mocapbench.reports.resources import styles as style_sheets
from mocapbench.reports.spreadsheet import csv_text

TOY, WALKING, FRAMES = "toy-interpolation-1", "walking-interpolation", "missing-frames"
MATRIX = np.array([[2.0, -1.0, 0.5], [-1.0, 1.0, 0.25], [0.5, 0.25, 0.1]])
MAPS = HeatMaps(
    FRAMES, "Covariance", "", ("a", "a", "b"), {"truth": MATRIX, "knn": MATRIX / 2}, 2, 2
)
PLACES = {"seconds": (0.5, 1.0, 2.0), "recordings": (0, 3, 10)}
SIZE = (8.0, 8.4 / 2.54)
DRAWN = {
    "error-bars": ("value", "mean"),
    "by-case": ("mean",),
    "along-gap": ("position", "mean"),
    "gap-length": ("x", "mean"),
    "recordings": ("x", "mean"),
    "calibration": ("nominal", "coverage"),
    "ranks": ("mean_rank",),
    "covariances": ("value",),
    "stick-figures": ("x", "y"),
    "cost": ("mean", "seconds"),
}
"""By kind, the columns whose numbers stand on axes."""
each_kind = pytest.mark.parametrize("kind", FIGURE_KINDS)


@pytest.fixture(scope="module")
def whole(bundle):
    """Return the bundle with something of everything that figures show."""
    rng = np.random.default_rng(5)
    errors = {
        (FRAMES, "35-03 four-walkers", n): rng.random((4, 20)) for n in ("knn", "cubic-spline")
    }
    motions = bundle.illustrations[-1]
    named = dict(zip(("knn", "cubic-spline"), motions.motions.values(), strict=True))
    motions = replace(motions, motions=named, beside="knn")
    parts = ErrorParts({FRAMES: "rms_per_frame"}, errors)
    layouts = [place_along(layout) for layout in bundle.layouts]
    return replace(bundle, layouts=tuple(layouts), parts=parts, illustrations=(motions, MAPS))


def place_along(layout):
    """Return a layout whose cases differ in the length of gaps and in training recordings."""
    if layout.name != WALKING:
        return layout
    lengths = ({"seconds": s, "recordings": 3} for s in PLACES["seconds"])
    more = ({"seconds": 0.5, "recordings": n} for n in (0, 10))
    cases = [
        replace(case, columns=own)
        for case, own in zip(layout.cases, (*lengths, *more), strict=True)
    ]
    page = replace(layout.page, along=("seconds", "recordings"))
    return replace(layout, page=page, cases=tuple(replace(c, synthetic=False) for c in cases))


def tables_of(whole, kind):
    """Return the tables of a kind by name, of which there are some."""
    found = {name: table for (_, _, name), table in tabulate_figures(whole, [kind])[0].items()}
    assert found
    return found


def numbers_of(axes):
    """Return all numbers that are drawn, points and ends of lines."""
    points = [line.get_xydata() for line in axes.lines]
    for drawn in axes.collections:
        match drawn:
            case PathCollection():
                points.append(drawn.get_offsets())
            case LineCollection():
                points += drawn.get_segments()
            case QuadMesh():
                points.append(drawn.get_array())
    return np.concatenate([np.ravel(np.ma.getdata(one)) for one in points]).astype(float)


def has_all(drawn, wanted):
    """Return whether each wanted number is among those that are drawn."""
    near = np.isclose(np.asarray(wanted, float)[:, None], drawn[None, :], rtol=1e-9, atol=1e-12)
    return bool(near.any(axis=1).all())


@each_kind
def test_numbers_on_axes_are_those_of_the_table(whole, kind):
    styles = model_styles(whole.layouts)
    for table in tables_of(whole, kind).values():
        figure = Figure((4.0, 4.0), layout="constrained")
        draw_figure(figure, FIGURE_KINDS[kind], table, styles)
        panels = [panel for _, panel in table.groupby("panel", sort=False)]
        for axes, panel in zip(figure.axes, panels, strict=False):
            for column in DRAWN[kind]:
                assert has_all(numbers_of(axes), panel[column].to_numpy(float)), column


def test_numbers_of_recordings_stand_apart_by_their_ratios_and_zero_beside_them():
    curve = {0.0: 5.0, 3.0: 4.0, 10.0: 3.0, 30.0: 2.5, 100.0: 2.0}
    rows = [("", "cm", "knn", x, mean, mean - 1, mean + 1) for x, mean in curve.items()]
    names = ["panel", "quantity", "label", "x", "mean", "low", "high"]
    axes = Figure((3.3, 3.0)).subplots()
    FIGURE_KINDS["recordings"].draw(
        axes, pd.DataFrame(rows, columns=names), {"knn": DrawingStyle("h1", 0, "knn")}
    )
    ticks = axes.get_xticks()
    assert [*ticks] == [0, 3, 10, 30, 100]
    assert np.diff(axes.transData.transform(np.column_stack([ticks, ticks]))[:, 0]).min() > 25


def caption_of(whole, kind):
    (table,) = tables_of(whole, kind).values()
    return describe_figure(whole, TOY, kind, table)


def test_a_caption_says_that_all_motion_is_generated_and_which_models_are_left_out(
    bundle, monkeypatch
):
    toy = select_results(bundle, [TOY])
    (layout,) = toy.layouts
    made = replace(layout, cases=tuple(replace(case, synthetic=True) for case in layout.cases))
    for one, said in ((layout, False), (made, True)):
        whole = replace(toy, layouts=(one,))
        assert (", generated motion (synthetic)." in caption_of(whole, "error-bars")) == said
    assert f"Of {len(layout.labels)} models the best are drawn" in caption_of(whole, "by-case")
    monkeypatch.setattr("mocapbench.reports.figures.plots.choice.MOST_CURVES", len(layout.labels))
    assert "the best are drawn" not in caption_of(whole, "by-case")


def test_recordings_that_are_missing_are_neither_drawn_nor_told(small):
    names = [*"abcdefgh", "synthetic"]
    nothing = {"knn": [np.nan, np.nan]}
    bundle = small({**dict.fromkeys(names, nothing), "synthetic": {"knn": [1.0, 2.0]}})
    (layout,) = bundle.layouts
    cases = tuple(replace(case, synthetic=case.name == "synthetic") for case in layout.cases)
    whole = replace(bundle, layouts=(replace(layout, cases=cases),))
    (table,) = tables_of(whole, "error-bars").values()
    assert [*table["value"]] == [1.0, 2.0]
    caption = describe_figure(whole, "small", "error-bars", table)
    assert ", synthetic, generated motion (synthetic). Large markers" in caption


@each_kind
def test_the_table_is_read_back_from_its_file(whole, kind, tmp_path):
    for name, table in tables_of(whole, kind).items():
        (tmp_path / f"{name}.csv").write_text(csv_text(table), encoding="utf-8")
        again = pd.read_csv(
            tmp_path / f"{name}.csv",
            keep_default_na=False,
            na_values={column: [""] for column in table.select_dtypes("number")},
            float_precision="round_trip",
        )
        assert [*again] == [*table]
        for column in table.select_dtypes("number"):
            assert np.array_equal(again[column], table[column], equal_nan=True)


@pytest.mark.parametrize("task", [TOY, WALKING, FRAMES])
def test_error_bars_are_those_of_the_table_for_a_paper(bundle, task):
    (layout,) = (layout for layout in bundle.layouts if layout.name == task)
    results, metric = task_results(bundle, layout), layout.page.metrics[0]
    (table,) = FIGURE_KINDS["error-bars"].tabulate(bundle, results, ()).values()
    means = tabulate_means(results, [metric]).set_index(["case", "label"])
    compared = table.drop_duplicates(["panel", "label"])
    assert {*compared["panel"]} <= {*means.index.get_level_values("case")}
    for row in compared.itertuples():
        ours = means.loc[(row.panel, row.label)]
        assert (row.mean, row.n, row.n_of) == (ours["mean"], ours["n"], ours["n_of"])
        half = ours["half_width"]
        assert np.allclose([row.low, row.high], [row.mean - half, row.mean + half], equal_nan=True)


def test_every_unit_is_a_dot_and_windows_of_one_recording_are_folds(small):
    values = {"a": {"x": [1.0, 2.0, 4.0], "y": [2.0, 3.0, 9.0]}}
    for independent, n in ((True, 3), (False, 1)):
        bundle = small(values, independent_folds=independent)
        results = task_results(bundle, bundle.layouts[0])
        (table,) = FIGURE_KINDS["error-bars"].tabulate(bundle, results, ()).values()
        assert [*table["value"][table["label"] == "x"]] == [1.0, 2.0, 4.0]
        assert {*table["n"]} == {n}
        assert table["low"].isna().all() == (n == 1)


def test_points_and_intervals_by_case_are_those_of_the_run_and_of_the_paper(bundle):
    results = task_results(bundle, bundle.layouts[0])
    (table,) = FIGURE_KINDS["by-case"].tabulate(bundle, results, ()).values()
    assert [*dict.fromkeys(table["metric"])] == ["mse", "smse_pooled", "msll"]
    for row in table[~table["published"]].itertuples():
        ours = results.estimate(row.case, row.label, row.metric)
        assert (row.mean, row.n) == (ours.mean, ours.n)
        assert row.high - row.mean == pytest.approx(ours.half_width)
    theirs = table[table["published"]]
    assert {*theirs["label"]} == {"MOHGP (published)", "MOA (published)"}
    case = results.cases[0]
    known = results.published_value(case, "mohgp-3", "mse")
    (row,) = theirs[
        (theirs["case"] == case.name)
        & (theirs["metric"] == "mse")
        & (theirs["label"] == "MOHGP (published)")
    ].itertuples()
    assert (row.mean, row.high - row.mean) == (known.value, pytest.approx(known.two_sd))


def test_curves_along_gaps_are_means_and_quartiles(whole):
    (table,) = tables_of(whole, "along-gap").values()
    for label, own in table.groupby("label"):
        errors = whole.parts.along_gap[FRAMES, "35-03 four-walkers", str(label)]
        assert np.allclose(own["mean"], errors.mean(axis=0))
        assert np.allclose(own["low"], np.quantile(errors, 0.25, axis=0))
        assert {*own["n"]} == {4}


def test_curves_along_a_column_join_cases_alike_in_all_others(whole):
    (table,) = tables_of(whole, "gap-length").values()
    assert {*table["x"]} == {*PLACES["seconds"]}
    (table,) = tables_of(whole, "recordings").values()
    assert {*table["x"]} == {*PLACES["recordings"]}


def test_all_that_bars_join_is_in_one_group(small):
    ordered = {f"row {n}": {"a": [1.0 * n], "b": [2.0 * n], "c": [3.0 * n]} for n in range(1, 9)}
    bundle = small(ordered)
    results = task_results(bundle, bundle.layouts[0])
    (table,) = FIGURE_KINDS["ranks"].tabulate(bundle, results, ()).values()
    assert dict(zip(table["label"], table["groups"], strict=True)) == {
        "a": "1",
        "b": "1 2",
        "c": "2",
    }
    assert [*table["mean_rank"]] == [1.0, 2.0, 3.0]


def test_the_line_of_costs_joins_what_nothing_else_beats(small):
    values = {"a": {"good": [1.0] * 3, "fair": [2.0] * 3, "poor": [3.0] * 3}}
    bundle = small(values)
    seconds = bundle.records["label"].map({"good": 5.0, "fair": 1.0, "poor": 2.0})
    bundle = replace(
        bundle, records=bundle.records.assign(fit_seconds=seconds, predict_seconds=0.0)
    )
    results = task_results(bundle, bundle.layouts[0])
    (table,) = FIGURE_KINDS["cost"].tabulate(bundle, results, ()).values()
    assert {*table["label"][table["on_front"]]} == {"good", "fair"}


def test_a_figure_that_a_run_has_no_data_for_is_left_out_with_the_reason(small):
    bundle = small({"a": {"x": [1.0], "y": [2.0]}})
    tables, lacking = tabulate_figures(bundle, [*FIGURE_KINDS])
    assert {kind for _, kind, _ in tables} == {"error-bars", "by-case", "cost"}
    assert {kind for kind, _ in lacking} == {*FIGURE_KINDS} - {"error-bars", "by-case", "cost"}
    assert all(tasks == ["small"] for tasks in lacking.values())
    with pytest.raises(NothingToDrawError, match="coverage of intervals at two levels"):
        FIGURE_KINDS["calibration"].tabulate(bundle, task_results(bundle, bundle.layouts[0]), ())


@each_kind
def test_the_same_table_gives_the_same_bytes_and_no_date(whole, kind):
    styles, table = model_styles(whole.layouts), next(iter(tables_of(whole, kind).values()))
    first, second = (render_figure(kind, table, styles, SIZE, FIGURE_FORMATS) for _ in range(2))
    assert first == second
    assert b"CreationDate" not in first["pdf"]
    assert b"<dc:date>" not in first["svg"]


def test_fonts_are_embedded_and_text_stays_text(whole):
    table = next(iter(tables_of(whole, "ranks").values()))
    files = render_figure("ranks", table, model_styles(whole.layouts), SIZE, ("pdf", "svg"))
    assert b"/FontFile2" in files["pdf"]
    assert b"/Type3" not in files["pdf"]
    assert f">{table['label'].iloc[0]}</text>" in files["svg"].decode()


@pytest.mark.parametrize("look", LOOKS)
def test_a_figure_is_as_wide_as_asked_whatever_the_settings_of_the_user(whole, look, monkeypatch):
    monkeypatch.setitem(__import__("matplotlib").rcParams, "font.size", 30.0)
    table, (points, _) = next(iter(tables_of(whole, "cost").values())), LOOKS[look]
    styles = model_styles(whole.layouts)
    text = render_figure("cost", table, styles, (points, 5.0), ("svg",))["svg"].decode()
    assert re.search(r'width="([\d.]+)pt"', text)[1] == "360"
    assert f"font-size: {points:g}px" in text or f"font: {points:g}px" in text


def test_colours_markers_and_dashes_are_those_of_the_page(bundle):
    styles, sheet = model_styles(bundle.layouts), str(style_sheets())
    light = sheet.partition(":root {")[2].partition("}")[0]
    for style in styles.values():
        number = style.hue.removeprefix("h")
        name = "reference" if number == "r" else number
        assert f"--series-{name}: {colour_of(style)};" in light
    assert len({MARKERS[shape] for shape in range(N_SHAPES)}) == N_SHAPES
    assert dashes_of(DrawingStyle("h0", 0)) == (0.0, None)
    assert len({dashes_of(DrawingStyle("h0", shape)) for shape in range(N_SHAPES)}) == N_SHAPES
    assert scales_of(["knn"], styles)["color"] == {"knn": colour_of(styles["knn"])}


def test_a_caption_says_the_protocol_and_what_is_drawn(whole):
    for (task, kind, _), table in tabulate_figures(whole, [*FIGURE_KINDS])[0].items():
        text = describe_figure(whole, task, kind, table)
        assert "profile paper" in text
        assert text.endswith(".")
