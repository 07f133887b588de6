import numpy as np
import pytest

from mocapbench.benchmark.filling.trials.ranking import rank
from mocapbench.benchmark.filling.trials.scores import Scores

ERRORS = {
    "bad": [2.0, 2.1, 2.2, 1.9, 2.0],
    "as good": [1.1, 1.1, 1.0, 1.0, 1.05],
    "good": [1.0, 1.2, 0.9, 1.1, 1.0],
}


def ranking_of(errors):
    scores = {model: Scores(np.array(e), {"deg": 1.0}, None) for model, e in errors.items()}
    return rank(scores, np.ones(len(next(iter(errors.values())))))


def test_models_that_the_test_does_not_separate_from_the_first_share_its_place():
    found = ranking_of(ERRORS)
    assert found.order == ("good", "as good", "bad")
    assert found.sharing == ("good", "as good")


@pytest.mark.parametrize("n", [1, 2])
def test_a_constant_lead_separates_and_a_tie_does_not(n):
    found = ranking_of({"a": [1.0, 2.0][:n], "b": [1.5, 2.5][:n], "c": [1.0, 2.0][:n]})
    assert found.sharing == ("a", "c")


def test_a_lone_model_has_the_place_to_itself():
    assert ranking_of({"bad": ERRORS["bad"]}).sharing == ("bad",)
