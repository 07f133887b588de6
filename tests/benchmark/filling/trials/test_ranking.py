import numpy as np
import pytest

from mocapbench.benchmark.filling.trials.ranking import rank
from mocapbench.benchmark.filling.trials.scores import TrialScores

ERRORS = {
    "bad": [2.0, 2.1, 2.2, 1.9, 2.0],
    "as good": [1.1, 1.1, 1.0, 1.0, 1.05],
    "good": [1.0, 1.2, 0.9, 1.1, 1.0],
}


def ranking_of(errors, places=None):
    scores = {model: TrialScores(np.array(e), {"deg": 1.0}, None) for model, e in errors.items()}
    n = len(next(iter(errors.values())))
    return rank(scores, np.ones(n), np.arange(n) if places is None else np.array(places))


def test_models_that_the_test_does_not_separate_from_the_first_share_its_place():
    found = ranking_of(ERRORS)
    assert found.order == ("good", "as good", "bad")
    assert found.sharing == ("good", "as good")


def test_rivals_are_next_to_the_first_and_err_little_more():
    """One gap in which all but two fail leaves models of any error unseparated."""
    errors = {"one": [1, 1, 1, 1, 1], "near": [1, 2, 1, 2, 1], "far": [1, 1, 1, 1, 99]}
    found = ranking_of(errors)
    assert found.sharing == ("one", "near", "far")
    assert found.rivals == ("near",)
    behind = ranking_of({**errors, "near": [1.2, 1.3, 1.2, 1.3, 1.2], "last": [1, 1, 1, 1, 3]})
    assert "near" not in behind.sharing
    assert behind.rivals == ()


def test_a_constant_lead_separates_and_a_tie_does_not():
    errors = [1.0, 2.0, 3.0, 1.0, 2.0]
    found = ranking_of({"a": errors, "b": [error + 0.5 for error in errors], "c": errors})
    assert found.sharing == ("a", "c")


def test_a_lone_model_has_the_place_to_itself():
    assert ranking_of({"bad": ERRORS["bad"]}).sharing == ("bad",)


@pytest.mark.parametrize(("n_places", "tested"), [(4, False), (5, True)])
def test_of_few_places_nothing_is_told_however_many_trial_gaps_there_are(n_places, tested):
    places = np.arange(40) % n_places
    found = ranking_of({"a": np.ones(40), "b": 1.0 + places % 2}, places)
    assert (found.n, found.n_places, found.tested) == (40, n_places, tested)
    assert found.sharing == (("a", "b") if tested else ("a",))


def test_repeating_every_trial_gap_at_its_place_changes_no_verdict():
    rng = np.random.default_rng(0)
    for lead in (0.1, 0.3, 0.5, 0.7):
        errors = {"good": rng.random(8), "behind": lead + rng.random(8), "bad": 3 + rng.random(8)}
        repeated = {model: np.repeat(each, 6) for model, each in errors.items()}
        found = ranking_of(repeated, np.repeat(np.arange(8), 6))
        assert found.sharing == ranking_of(errors).sharing


def test_places_do_not_change_the_order():
    errors = {"one": [1.0, 1.0, 1.0, 9.0], "two": [2.0, 2.0, 2.0, 2.0]}
    assert ranking_of(errors, [0, 0, 0, 1]).order == ranking_of(errors).order == ("two", "one")
