"""The conformance kit names the fault of a model that does not conform."""

import pickle
import re
import runpy
from pathlib import Path

import pytest

from mocapbench.baselines import MOHGP, Model, Trivial
from mocapbench.benchmark.testing import ConformanceError, check_model, model_checks

NONCONFORMING = runpy.run_path(str(Path(__file__).parents[1] / "broken_models.py"))["NONCONFORMING"]


@pytest.mark.parametrize("model", NONCONFORMING, ids=lambda model: model.__name__)
def test_the_fault_of_a_model_is_named(model):
    """Every check is run: another than the one concerned may be the first that fails."""
    messages = []
    for check in model_checks(model):
        try:
            check(model)
        except ConformanceError as error:
            messages.append(str(error))
    assert messages
    assert all(message.startswith(f"{model.__name__}: expected") for message in messages)
    assert any(re.search(NONCONFORMING[model], message) for message in messages)


def test_a_check_can_be_handed_to_a_process_that_starts_anew():
    for check in model_checks(MOHGP):
        again = pickle.loads(pickle.dumps(check))
        assert again.__name__ == check.__name__
    with pytest.raises(ConformanceError, match=r"^MOHGP: expected"):
        again(MOHGP, n_components=-1)


def test_parameters_reach_the_model():
    with pytest.raises(ConformanceError, match="n_components"):
        check_model(MOHGP, n_components=-1)


def test_a_parameter_that_the_model_does_not_have_is_an_error():
    with pytest.raises(ConformanceError, match="max_itr"):
        check_model(Trivial, max_itr=20)


class _Unable(Model):
    """Inherits no ability."""

    def fit(self, recordings):
        return self


@pytest.mark.parametrize("model", [Trivial(), "trivial", int, _Unable])
def test_what_is_no_model_is_refused(model):
    with pytest.raises(ConformanceError, match=r"expected a .*: pass the class itself"):
        check_model(model)
