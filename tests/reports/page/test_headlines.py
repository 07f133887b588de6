import numpy as np
import pytest

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.analysis.wins import wins
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.bundle.task_page import RowNotes
from mocapbench.reports.page.lead_headlines import lead_headlines
from mocapbench.reports.page.published_headlines import published_headlines
from mocapbench.reports.page.win_headlines import win_headlines

PUBLISHED = {"mohgp-1": "MOHGP", "mohgp-3": "MOHGP"}
VALUES = {
    "observed 40": {"mohgp-1": [0.2], "mohgp-3": [0.1], "gp-independent": [0.15]},
    "observed 20": {"mohgp-1": [0.4], "mohgp-3": [0.3], "gp-independent": [0.2]},
}


def results_of(bundle):
    return task_results(bundle, bundle.layouts[0])


def test_the_best_entrant_of_each_case_is_named(small):
    headlines = lead_headlines(results_of(small(VALUES, published_models=PUBLISHED)), "mse")
    assert {headline.subject for headline in headlines} == {"mohgp-3", "gp-independent"}
    texts = {headline.subject: headline.text for headline in headlines}
    assert texts["mohgp-3"] == (
        "is best in 1 of 2 cases (observed 40) by MSE: "
        "0.10 on average, next best gp-independent with 0.15. Not tested: one fold."
    )


def test_a_model_that_the_paper_lacks_can_win(small):
    found = wins(results_of(small(VALUES, published_models=PUBLISHED)), "mse")
    assert [(w.winner, w.loser, len(w.cases), w.shared) for w in found] == [
        ("gp-independent", "mohgp-1", 2, 2),
        ("gp-independent", "mohgp-3", 1, 2),
    ]


def test_the_sentence_says_so_plainly(small):
    found = win_headlines(results_of(small(VALUES, published_models=PUBLISHED)), "mse")
    assert found[0].subject == "gp-independent has a better mean than mohgp-1"
    assert found[0].text.startswith("in both cases: ")
    assert found[1].text == (
        "in 1 of 2 cases (observed 20): 0.20 on average against 0.30. "
        "Over both cases, 95 % interval of the lead −0.93 to 0.98: may be chance."
    )


def test_other_winners_follow_in_the_same_sentence(small):
    values = {"row": {"mohgp-1": [0.4], "spline": [0.3], "gp-independent": [0.2]}}
    (found,) = win_headlines(results_of(small(values, published_models=PUBLISHED)), "mse")
    assert found.subject == "spline has a better mean than mohgp-1"
    assert found.text.endswith("Not tested: one fold. Also, not tested: gp-independent.")


def rows(*pairs):
    """Return two cases of five folds with these leads of a over b."""
    noise = np.array([0.01, -0.02, 0.0, 0.02, -0.01])
    return {
        f"row {number}": {"a": list(1.0 + noise), "b": list(1.0 + lead + 2.0 * noise)}
        for number, lead in enumerate(pairs, 1)
    }


@pytest.mark.parametrize(
    ("leads", "words"),
    [
        ((0.5, 0.5), "The lead is more than chance."),
        (
            (0.005, 0.005),
            "Case by case the lead may be chance: the test does not separate it from b.",
        ),
        (
            (0.5, 0.005),
            "More than chance in 1 case; elsewhere the test does not separate it from b.",
        ),
    ],
)
def test_a_lead_is_reported_with_its_test(small, leads, words):
    (found,) = lead_headlines(results_of(small(rows(*leads))), "mse")
    assert found.text.endswith(words)


def test_windows_of_one_recording_test_no_lead(small):
    (found,) = lead_headlines(results_of(small(rows(0.5, 0.5), independent_folds=False)), "mse")
    assert found.text.endswith(
        "Not tested: overlapping windows of one recording count as one unit."
    )


def test_a_win_is_tested_over_all_shared_cases(small):
    values = rows(0.5, 0.5, 0.49, 0.51)
    results = results_of(small(values, published_models={"b": "MOHGP"}))
    (win,) = wins(results, "mse")
    assert (win.overall.contrast.n, win.overall.separable) == (4, True)
    (found,) = win_headlines(results, "mse")
    assert found.text.endswith("95 % interval of the lead 0.49 to 0.51: more than chance.")


def test_the_papers_models_do_not_beat_each_other(small):
    values = {"row": {"mohgp-1": [0.4], "mohgp-3": [0.2], "gp-independent": [0.9]}}
    assert wins(results_of(small(values, published_models=PUBLISHED)), "mse") == []


WITH_INTERPOLATION = {
    "observed 40": {"mohgp-1": [0.2, 0.4], "hold": [0.5, 0.7], "makima": [0.4, 0.6]},
    "observed 20": {"mohgp-1": [0.4, 0.4], "hold": [0.6, 0.6], "makima": [0.9, 0.9]},
    "observed 10": {"mohgp-1": [0.9, 0.9], "hold": [0.9, 0.9], "makima": [0.8, 0.8]},
}


def leads_with_interpolation(small, values, **options):
    results = results_of(small(values, interpolations=("hold", "makima"), **options))
    return {found.subject: found.text for found in lead_headlines(results, "mse")}


def test_the_best_interpolation_is_named_beside_every_winner(small):
    """Over the cases that the winner leads: hold has 0.60 and 0.60 there, makima 0.50 and 0.90."""
    texts = leads_with_interpolation(small, WITH_INTERPOLATION)
    assert texts["mohgp-1"].endswith(" Best interpolation: hold, 0.60.")
    assert texts["makima"].endswith(" The best model is itself an interpolation.")


def test_an_interpolation_that_lacks_a_fold_is_not_the_best(small):
    values = {"row": {"mohgp-1": [0.1, 0.2], "hold": [0.6, 0.8], "makima": [0.3, np.nan]}}
    assert "Best interpolation: hold, 0.70." in leads_with_interpolation(small, values)["mohgp-1"]


def test_the_best_interpolation_follows_the_metrics_direction(small):
    values = {"row": {"mohgp-1": [0.5], "hold": [0.2], "makima": [0.7]}}
    bundle = small(values, metric="coverage_50", interpolations=("hold", "makima"))
    (found,) = lead_headlines(results_of(bundle), "coverage_50")
    assert "Best interpolation: makima, 0.70." in found.text


def test_without_interpolation_the_headline_names_none(small):
    values = {"row": {"mohgp-1": [0.1], "knn": [0.6]}}
    assert "nterpolation" not in leads_with_interpolation(small, values)["mohgp-1"]


def test_the_oracle_neither_leads_nor_beats(small):
    values = {"row": {"mohgp-1": [0.4], "oracle": [0.1], "gp-independent": [0.9]}}
    results = results_of(small(values, published_models=PUBLISHED))
    assert [headline.subject for headline in lead_headlines(results, "mse")] == ["mohgp-1"]
    assert wins(results, "mse") == []


def test_a_lone_entrant_is_called_so(small):
    (found,) = lead_headlines(results_of(small({"row": {"a": [1.0]}})), "mse")
    assert found.text == "is the only entrant with a score in the only case (MSE)."


@pytest.mark.parametrize("real", [True, False])
def test_generated_motion_counts_only_where_there_is_no_other(small, real):
    cases = (
        CaseLayout("observed 40", {}, synthetic=not real),
        CaseLayout("observed 20", {}, synthetic=True),
    )
    results = results_of(small(VALUES, published_models=PUBLISHED, cases=cases))
    texts = " ".join(
        f.text for f in (*lead_headlines(results, "mse"), *win_headlines(results, "mse"))
    )
    assert ("observed 20" in texts) is not real
    assert ("synthetic" in texts) is not real


def test_without_scores_there_is_nothing_to_say(small):
    results = results_of(small({"row": {"a": [float("nan")]}}))
    assert lead_headlines(results, "mse") == []
    assert win_headlines(results, "mse") == []


def spline_on_35_03(small, value, *, synthetic=False):
    return small(
        {"row": {"cubic-spline": [value]}},
        metric="rms_per_frame",
        task="missing-frames",
        cases=(CaseLayout("row", {}, synthetic=synthetic, notes=RowNotes(published="35-03")),),
        published_metrics={"rms_per_frame": "RMS per frame"},
    )


def test_a_published_value_better_than_all_of_ours_is_reported(small):
    (found,) = published_headlines(results_of(spline_on_35_03(small, 62.98)), "rms_per_frame")
    assert found.text == "in 1 of 1 case (row: B-GPDM 12.15)."


def test_no_published_headline_where_an_entrant_is_better_or_the_motion_generated(small):
    better = spline_on_35_03(small, 12.0)
    generated = spline_on_35_03(small, 62.98, synthetic=True)
    for bundle in (better, generated):
        assert published_headlines(results_of(bundle), "rms_per_frame") == []


def test_a_win_follows_the_metrics_direction(small):
    values = {"row": {"mohgp-1": [0.2], "gp-independent": [0.45]}}
    bundle = small(values, metric="coverage_50", published_models=PUBLISHED)
    assert [w.winner for w in wins(results_of(bundle), "coverage_50")] == ["gp-independent"]
    near = {"row": {"mohgp-1": [0.5], "gp-independent": [0.2]}}
    bundle = small(near, metric="coverage_50", published_models=PUBLISHED)
    assert wins(results_of(bundle), "coverage_50") == []


@pytest.mark.parametrize(
    ("not_comparable", "found"), [({}, 1), ({"mohgp-1": "trained on other walks"}, 0)]
)
def test_a_value_that_is_not_comparable_is_no_better_value(small, not_comparable, found):
    """The paper prints 22.546 for its ICM, and otherwise 23.082 or more (less is taken as better).

    MOHGP-LMC, 25.248, is printed twice and counts once.
    """
    notes = RowNotes(published="35(1)", not_comparable=not_comparable)
    bundle = small(
        {"row": {"mohgp-1": [23.0], "mohgp-3": [24.0]}},
        task="walking-synthesis",
        cases=(CaseLayout("row", {}, notes=notes),),
        published_models={"mohgp-1": "MOHGP-ICM", "mohgp-3": "MOHGP"},
        published_metrics={"mse": "MCC"},
    )
    assert len(published_headlines(results_of(bundle), "mse")) == found


def test_the_next_best_is_one_model_over_all_cases(small):
    """Each case has another runner-up; the mean of runners-up is that of no model."""
    values = {
        "one": {"a": [1.0], "b": [2.0], "c": [9.0]},
        "two": {"a": [1.0], "b": [8.0], "c": [3.0]},
    }
    (found,) = lead_headlines(results_of(small(values)), "mse")
    assert "1.00 on average, next best b with 5.00." in found.text


def test_a_model_that_lacks_a_case_is_not_next_best(small):
    values = {"one": {"a": [1.0], "b": [2.0]}, "two": {"a": [1.0], "c": [3.0]}}
    (found,) = lead_headlines(results_of(small(values)), "mse")
    assert "1.00 on average, and no other entrant has every score there." in found.text
