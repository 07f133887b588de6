"""Figures of scores: rows and places follow the numbers, and every figure names itself."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.reports.analysis.comparisons import comparisons
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.error_parts import ErrorParts
from mocapbench.reports.bundle.model_info import ModelInfo
from mocapbench.reports.figures.scores.along import curves_along
from mocapbench.reports.figures.scores.best import best_labels, mean_values
from mocapbench.reports.figures.scores.cost import cost_against_error, front
from mocapbench.reports.figures.scores.dots import dot_plot
from mocapbench.reports.figures.scores.forest import forest
from mocapbench.reports.figures.scores.gap_error import gap_error
from mocapbench.reports.figures.scores.joint_errors import joint_errors
from mocapbench.reports.figures.scores.reliability import reliability
from mocapbench.reports.figures.styles import model_styles

LABELS = ("knn", "linear", "nn", "oracle")
SPREAD = (0.9, 1.0, 1.2)


def _values(*cases, labels=LABELS, scale=1.0):
    return {
        case: {
            label: [scale * (place + 1.0) * share for share in SPREAD]
            for place, label in enumerate(labels)
        }
        for case in cases
    }


@pytest.fixture
def drawn(small):
    """Return the results of a small bundle and the styles of its labels."""

    def drawn(values, **options):
        bundle = small(values, **options)
        return task_results(bundle, bundle.layouts[0]), model_styles(bundle.layouts)

    return drawn


def _roots(figure):
    assert " id=" not in figure.svg
    roots = list(ElementTree.fromstring(figure.svg))
    assert all(root.attrib["role"] == "img" and root.attrib["aria-label"] for root in roots)
    return roots


def _models(root):
    return [g.attrib["data-model"] for g in root.iter("g") if "data-model" in g.attrib]


def test_rows_are_sorted_by_mean_and_every_fold_is_a_tick(drawn):
    results, styles = drawn(_values("easy", "hard"))
    figure = dot_plot(results, "mse", styles)
    for root in _roots(figure):
        assert _models(root) == list(LABELS)
        ticks = [p.attrib["d"].count("M") for p in root.iter("path") if p.get("class") == "fold"]
        assert ticks == [len(SPREAD)] * len(LABELS)


def test_metrics_that_are_better_higher_have_the_highest_on_top(drawn):
    results, styles = drawn(_values("easy", "hard"), metric="mcc")
    assert _models(_roots(dot_plot(results, "mcc", styles))[0]) == list(LABELS[::-1])


def test_folds_that_are_not_independent_and_single_folds_have_no_interval(drawn):
    dependent, styles = drawn(_values("easy", "hard"), independent_folds=False)
    single, _ = drawn({case: {label: [1.0] for label in LABELS} for case in ("x", "y")})
    for results in (dependent, single):
        assert 'class="interval"' not in dot_plot(results, "mse", styles).svg
    assert "no interval" in dot_plot(dependent, "mse", styles).caption


@pytest.mark.parametrize("n_cases", [1, 7])
def test_one_case_or_many_are_left_to_the_strips_of_the_table(drawn, n_cases):
    results, styles = drawn(_values(*(f"case {place}" for place in range(n_cases))))
    assert dot_plot(results, "mse", styles) is None


def test_an_axis_that_spans_little_is_remarked_on(drawn):
    values = {case: {"knn": [100.0, 100.2], "nn": [100.1, 100.4]} for case in ("x", "y")}
    results, styles = drawn(values)
    assert "The axis spans 0.4 % of the values." in dot_plot(results, "mse", styles).caption


@pytest.fixture
def along(drawn):
    def along(columns, values=None, **options):
        results, styles = drawn(values or _values(*"abcd"), **options)
        cases = tuple(
            replace(case, columns=own)
            for case, own in zip(results.layout.cases, columns, strict=False)
        )
        moved = replace(results, layout=replace(results.layout, cases=cases))
        return curves_along(moved, "mse", "seconds", styles)

    return along


TWO_PANELS = [{"hidden": place, "seconds": s} for place in ("arm", "leg") for s in (0.5, 1.0)]


@pytest.mark.parametrize(
    ("known", "shown", "said"),
    [(("linear", "nn"), ["knn", "oracle", "linear"], True), (LABELS, [*LABELS], False)],
)
def test_of_interpolations_beside_models_the_best_alone_is_drawn(along, known, shown, said):
    figure = along(TWO_PANELS, interpolations=known)
    assert [label for label, _, _ in figure.legend] == shown
    assert ("the best interpolation, linear" in figure.caption) == said
    assert {label for root in _roots(figure) for label in _models(root)} == {*shown}


def test_cases_alike_in_all_other_columns_share_a_panel(along):
    figure = along(TWO_PANELS)
    arm, leg = _roots(figure)
    headings = [
        [text for text in root.itertext() if text.startswith("hidden")] for root in (arm, leg)
    ]
    assert headings == [["hidden: arm"], ["hidden: leg"]]
    lines = [path for path in arm.iter("path") if path.get("class") == "line"]
    assert len(lines) == len(LABELS)
    assert _bands(arm) == 3
    assert [label for label, _, _ in figure.legend] == list(LABELS)


@pytest.mark.parametrize(("spread", "said"), [((1.0, 2.0), False), ((1.0, 100.0), True)])
def test_points_that_are_geometric_means_are_said_to_be(along, spread, said):
    values = {case: {"knn": list(spread)} for case in "ab"}
    caption = along(TWO_PANELS[:2], values).caption
    assert ("geometric means over folds" in caption) == said


def _bands(root):
    return sum(path.get("class") == "band" for path in root.iter("path"))


def test_folds_that_are_not_independent_have_no_bands(along):
    assert _bands(_roots(along(TWO_PANELS, independent_folds=False))[0]) == 0


@pytest.mark.parametrize(("n_folds", "n_bands"), [(1, 0), (2, 0), (3, 1), (4, 1)])
def test_too_few_folds_have_no_bands(along, n_folds, n_bands):
    values = {case: {"knn": [1.0, 1.1, 1.3, 1.2][:n_folds]} for case in "ab"}
    assert _bands(_roots(along(TWO_PANELS[:2], values))[0]) == n_bands


def test_a_single_number_makes_no_curve(along):
    assert along([{"hidden": place, "seconds": 0.5} for place in "abcd"]) is None


def test_the_best_are_ranked_and_have_an_interpolation_among_them(drawn):
    results, _ = drawn(_values("x"), interpolations=("nn",))
    assert best_labels(results, "mse", LABELS, 1) == ["knn", "nn"]
    assert "oracle" not in best_labels(results, "mse", LABELS, 9)


def test_the_best_of_others_is_among_the_best(drawn):
    families = {"knn": "Neighbours", "linear": "Interpolation", "nn": "Your models", "oracle": "X"}
    models = {label: ModelInfo(label, family=family) for label, family in families.items()}
    results, _ = drawn(_values("x"), interpolations=("linear",), models=models)
    assert best_labels(results, "mse", LABELS, 1) == ["knn", "nn", "linear"]
    assert best_labels(results, "mse", {"knn", "linear"}, 1) == ["knn", "linear"]


def test_means_cover_labels_that_have_every_case(drawn):
    values = _values("x", "y")
    del values["y"]["nn"]
    results, _ = drawn(values)
    means = mean_values(results, "mse")
    assert "nn" not in means
    assert means["knn"] == pytest.approx(np.mean(SPREAD))


@given(points=st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), min_size=1, max_size=20))
def test_the_front_holds_what_nothing_beats(points):
    best = [points[place] for place in front(points)]
    for loss, cost in best:
        assert not any(a <= loss and b <= cost and (a, b) != (loss, cost) for a, b in points)
    assert all(any(a <= loss and b <= cost for a, b in best) for loss, cost in points)
    assert best == sorted(best)


def test_cost_has_a_point_a_model_and_names_the_front(drawn):
    results, styles = drawn(_values("x"))
    (root,) = _roots(cost_against_error(results, styles))
    assert sorted(_models(root)) == sorted(LABELS)
    assert root.attrib["aria-label"].endswith("on the front: knn")


def test_two_models_make_no_picture_of_cost(drawn):
    results, styles = drawn(_values("x", labels=("knn", "nn")))
    assert cost_against_error(results, styles) is None


def test_reliability_draws_a_point_for_each_level(bundle):
    results = task_results(bundle, bundle.layouts[0])
    figure = reliability(results, model_styles(bundle.layouts))
    (root,) = _roots(figure)
    curves = [g for g in root.iter("g") if "data-model" in g.attrib]
    levels = {m for m in results.scores["metric"] if m.startswith("coverage")}
    assert curves
    for curve in curves:
        assert sum(path.get("class") == "dot" for path in curve.iter("path")) == len(levels)


def test_without_predictive_distributions_there_is_no_reliability(drawn):
    assert reliability(*drawn(_values("x"))) is None


def test_the_forest_has_a_row_for_every_published_value_table_by_table(bundle):
    results = task_results(bundle, bundle.layouts[0])
    pairs = comparisons(results, "mse")
    figure = forest(results, pairs, model_styles(bundle.layouts))
    roots = _roots(figure)
    assert len(roots) == len({pair.published.source for pair in pairs})
    assert sum(len(_models(root)) for root in roots) == len(pairs)
    told = " ".join(title.text for root in roots for title in root.iter("title"))
    assert all(
        f"published {pair.published.value:.4g}, {pair.verdict.value}" in told for pair in pairs
    )


def test_without_published_values_there_is_no_forest(drawn):
    results, styles = drawn(_values("x"))
    assert forest(results, [], styles) is None


def _parts(labels, errors):
    return {("small", "x", label): errors * (place + 1.0) for place, label in enumerate(labels)}


def test_the_error_along_the_gap_is_of_the_best_over_all_windows(drawn):
    results, styles = drawn(_values("x"), interpolations=("linear",))
    windows = np.linspace(1.0, 2.0, 20) * np.ones((7, 1))
    parts = ErrorParts({"small": "mse"}, _parts(LABELS, windows))
    figure = gap_error(results, parts, styles)
    (root,) = _roots(figure)
    labels = {
        kind: [
            g.get("data-model")
            for g in root.iter("g")
            if g.find(f"path[@class='{kind}']") is not None
        ]
        for kind in ("band", "line")
    }
    assert labels == {"band": ["knn", "nn"], "line": ["knn", "linear", "nn"]}
    assert "mean over 7 gaps" in figure.caption


def test_without_gaps_there_is_no_error_along_them(drawn):
    results, styles = drawn(_values("x"))
    assert gap_error(results, ErrorParts({"small": "mse"}), styles) is None


POSE = pd.DataFrame(
    {"parent": [-1, 0, 0], "x": [0, 0, 50], "y": [0, 60, 30], "z": 0}, ["root", "head", "hand"]
)


def test_a_body_has_a_disc_for_each_joint_of_an_area_like_its_error(drawn):
    results, styles = drawn(_values("x"), metric="mpjpe", interpolations=("nn",))
    parts = ErrorParts(
        by_joint=_parts(LABELS, np.array([np.nan, 1.0, 4.0])), rest_poses={"small": POSE}
    )
    roots = _roots(joint_errors(results, parts, styles))
    assert [_models(root) for root in roots] == [["knn"], ["linear"], ["nn"]]
    radii = [[float(c.attrib["r"]) for c in root.iter("circle")] for root in roots]
    for of_model in radii:
        assert of_model[1] / of_model[0] == pytest.approx(2.0, abs=0.05)
    assert radii[2][1] == 13.0
    assert "hand: 4.0 cm" in set(roots[0].itertext())


def test_without_a_body_there_are_no_errors_by_joint(drawn):
    results, styles = drawn(_values("x"), metric="mpjpe")
    parts = ErrorParts(by_joint=_parts(LABELS, np.ones(3)))
    assert joint_errors(results, parts, styles) is None
