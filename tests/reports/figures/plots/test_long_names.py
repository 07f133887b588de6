"""Names of models leave room for what is drawn, or it is said that there is none."""

import pandas as pd
import pytest
from matplotlib.figure import Figure

from mocapbench.reports.figures.plots.base import NothingToDrawError
from mocapbench.reports.figures.plots.drawing import draw_figure, render_figure
from mocapbench.reports.figures.plots.kinds import FIGURE_KINDS
from mocapbench.reports.figures.plots.look import shorten_labels
from mocapbench.reports.figures.styles import DrawingStyle

LONG = ["a" * 300, "a" * 299 + "b", "a" * 150 + "c" + "a" * 149]


def make_table(labels):
    numbers = {"value": 1.0, "mean": 1.0, "low": 0.5, "high": 1.5, "n": 3, "n_of": "fold"}
    about = {"task": "t", "metric": "mse", "quantity": "MSE", "panel": "walk", "unit": "u"}
    return pd.DataFrame([{**about, "label": label, **numbers} for label in labels])


def make_styles(labels):
    return {label: DrawingStyle(f"h{number}", number) for number, label in enumerate(labels)}


def test_long_names_are_cut_in_the_middle_and_stay_apart():
    table, styles = shorten_labels(make_table([*LONG, "knn"]), make_styles([*LONG, "knn"]))
    shown = table["label"].tolist()
    assert shown[3] == "knn"
    assert shown[0] == "a" * 24 + "…" + "a" * 12
    assert len({*shown}) == 4
    assert max(map(len, shown)) <= 41
    assert [*styles] == shown


def test_beside_long_names_there_is_room_for_what_is_drawn():
    figure = Figure((3.3, 3.3), layout="constrained")
    draw_figure(figure, FIGURE_KINDS["error-bars"], make_table(LONG), make_styles(LONG))
    figure.draw_without_rendering()
    assert figure.axes[0].get_position().width > 0.15


def test_where_there_is_no_room_it_is_said():
    table, styles = make_table(LONG), make_styles(LONG)
    with pytest.raises(NothingToDrawError, match=r"no room in 2.5 cm"):
        render_figure("error-bars", table, styles, (8.0, 1.0), ["png"])
