import numpy as np
import pytest

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.analysis.wins import wins
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.page.headlines import lead_headlines, win_headlines

PUBLISHED = {"mohgp-1": "MOHGP", "mohgp-3": "MOHGP"}
VALUES = {
    "observed 40": {"mohgp-1": [0.2], "mohgp-3": [0.1], "gp-independent": [0.15]},
    "observed 20": {"mohgp-1": [0.4], "mohgp-3": [0.3], "gp-independent": [0.2]},
}


def results_of(bundle):
    return task_results(bundle, bundle.layouts[0])


def lead_of(results, metric="mse"):
    (found,) = lead_headlines(results, metric)
    return " ".join(found)


def test_the_leader_is_named_with_the_next_best_over_the_same_cases(small):
    results = results_of(small(VALUES, published_models=PUBLISHED))
    assert lead_of(results) == (
        "gp-independent is best over both cases by MSE: 0.17, next best mohgp-3 0.20; "
        "too few to test (2 folds)."
    )


NOISE = np.array([0.01, -0.02, 0.0, 0.02, -0.01, 0.0])


def rows(lead):
    """Return a case of six folds with this lead of a over b."""
    return {"row": {"a": list(1.0 + NOISE), "b": list(1.0 + lead + 2.0 * NOISE)}}


@pytest.mark.parametrize(
    ("lead", "words"),
    [
        (0.5, "difference 0.50 (0.49 to 0.51), more than chance."),
        (0.005, "difference 0.0050 (−0.0098 to 0.0198), may be chance."),
    ],
)
def test_a_lead_is_reported_with_its_interval_and_its_test(small, lead, words):
    assert lead_of(results_of(small(rows(lead)))).endswith(words)


def test_windows_of_one_recording_test_no_lead(small):
    results = results_of(small(rows(0.5), independent_folds=False))
    assert lead_of(results).endswith("next best b 1.50; too few to test (1 case).")


def test_a_model_that_the_paper_lacks_can_win(small):
    results = results_of(small(VALUES, published_models=PUBLISHED))
    win = ("gp-independent", "too few to test (2 folds)")
    assert wins(results, "mse") == {"mohgp-1": win, "mohgp-3": win}
    (headline,) = win_headlines(results, "mse")
    assert headline == (
        "gp-independent",
        "has a better mean than mohgp-1, mohgp-3, too few to test (2 folds).",
    )


def test_only_the_strongest_winner_is_named(small):
    values = {"row": {"mohgp-1": [0.4], "spline": [0.3], "gp-independent": [0.2]}}
    (found,) = win_headlines(results_of(small(values, published_models=PUBLISHED)), "mse")
    assert found[0] == "gp-independent"


def test_a_win_is_tested_over_all_units(small):
    results = results_of(small(rows(0.5), published_models={"b": "MOHGP"}))
    assert wins(results, "mse") == {"b": ("a", "more than chance")}
    assert win_headlines(results, "mse") == [("a", "has a better mean than b, more than chance.")]


def test_a_winner_has_every_score_that_the_loser_has(small):
    values = {"row": {"mohgp-1": [0.4, 9.0], "knn": [0.3, np.nan]}}
    assert wins(results_of(small(values, published_models=PUBLISHED)), "mse") == {}


def test_a_task_has_few_words(bundle):
    for layout in bundle.layouts:
        results, metric = task_results(bundle, layout), layout.page.metrics[0]
        found = [
            *lead_headlines(results, metric),
            *win_headlines(results, metric),
        ]
        assert found
        assert sum(len(" ".join(line).split()) for line in found) <= 60


def test_the_papers_models_do_not_beat_each_other(small):
    values = {"row": {"mohgp-1": [0.4], "mohgp-3": [0.2], "gp-independent": [0.9]}}
    assert wins(results_of(small(values, published_models=PUBLISHED)), "mse") == {}


WITH_INTERPOLATION = {"mohgp-1": [0.1], "knn": [0.3], "hold": [0.6], "makima": [0.5]}


def lead_with_interpolation(small, labels, **options):
    return lead_of(results_of(small({"row": labels}, interpolations=("hold", "makima"), **options)))


def test_the_best_interpolation_is_named_where_it_is_not_first_or_second(small):
    text = lead_with_interpolation(small, WITH_INTERPOLATION)
    assert text.endswith(" Best interpolation: makima, 0.50.")
    second = lead_with_interpolation(small, {**WITH_INTERPOLATION, "hold": [0.2]})
    assert "next best hold" in second
    assert "Best interpolation" not in second


def test_an_interpolation_that_lacks_a_fold_is_not_the_best(small):
    labels = {label: [*folds, folds[0]] for label, folds in WITH_INTERPOLATION.items()}
    text = lead_with_interpolation(small, {**labels, "makima": [0.3, np.nan]})
    assert "Best interpolation: hold, 0.60." in text


def test_without_interpolation_the_headline_names_none(small):
    assert "nterpolation" not in lead_with_interpolation(small, {"mohgp-1": [0.1], "knn": [0.6]})


def test_the_oracle_neither_leads_nor_beats(small):
    values = {"row": {"mohgp-1": [0.4], "oracle": [0.1], "gp-independent": [0.9]}}
    results = results_of(small(values, published_models=PUBLISHED))
    assert [subject for subject, _ in lead_headlines(results, "mse")] == ["mohgp-1"]
    assert wins(results, "mse") == {}


def test_a_lone_entrant_is_called_so(small):
    (found,) = lead_headlines(results_of(small({"row": {"a": [1.0]}})), "mse")
    assert found[1] == "is the only entrant with a score in the only case (MSE)."


@pytest.mark.parametrize("real", [True, False])
def test_generated_motion_counts_only_where_there_is_no_other(small, real):
    cases = (
        CaseLayout("observed 40", {}, synthetic=not real),
        CaseLayout("observed 20", {}, synthetic=True),
    )
    results = results_of(small(VALUES, published_models=PUBLISHED, cases=cases))
    texts = " ".join(
        text for _, text in (*lead_headlines(results, "mse"), *win_headlines(results, "mse"))
    )
    assert ("both cases (2 synthetic)" in texts) is not real
    assert ("the only case by" in texts) is real


def test_without_scores_there_is_nothing_to_say(small):
    results = results_of(small({"row": {"a": [float("nan")]}}))
    assert lead_headlines(results, "mse") == []
    assert win_headlines(results, "mse") == []


def test_a_win_follows_the_metrics_direction(small):
    values = {"row": {"mohgp-1": [0.2], "gp-independent": [0.45]}}
    bundle = small(values, metric="coverage_50", published_models=PUBLISHED)
    assert wins(results_of(bundle), "coverage_50")["mohgp-1"][0] == "gp-independent"
    near = {"row": {"mohgp-1": [0.5], "gp-independent": [0.2]}}
    bundle = small(near, metric="coverage_50", published_models=PUBLISHED)
    assert wins(results_of(bundle), "coverage_50") == {}


def test_the_next_best_is_one_model_over_all_cases(small):
    """Each case has another runner-up; the mean of runners-up is that of no model."""
    values = {
        "one": {"a": [1.0], "b": [2.0], "c": [9.0]},
        "two": {"a": [1.0], "b": [8.0], "c": [3.0]},
    }
    assert "by MSE: 1.00, next best b 5.00;" in lead_of(results_of(small(values)))


def test_a_model_that_lacks_a_case_is_not_next_best(small):
    values = {"one": {"a": [1.0], "b": [2.0]}, "two": {"a": [1.0], "c": [3.0]}}
    assert "by MSE, 1.00; no other entrant has every score." in lead_of(results_of(small(values)))


def test_two_means_are_told_apart_by_their_digits(small):
    text = lead_of(results_of(small({"row": {"a": [17.304], "b": [17.3046]}})))
    assert "17.304, next best b 17.305;" in text


def test_two_with_the_same_mean_are_level(small):
    text = lead_of(results_of(small({"row": {"a": [0.5], "b": [0.5], "c": [0.7]}})))
    assert text.startswith("a is level with b over the only case by MSE, 0.50.")
    text = lead_of(results_of(small({"row": {name: [0.5] for name in "abcdef"}})))
    assert text.startswith("a is level with b, c, d and 2 more over the only case by MSE, 0.50.")
