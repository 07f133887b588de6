"""Every parameter of every model of cyclic motion refuses what it cannot be."""

import inspect

import numpy as np
import pytest

from mocapbench.baselines.cpm import CPM
from mocapbench.baselines.cyclic_alignment import CyclicAlignment
from mocapbench.baselines.k_cpm import KCPM
from mocapbench.baselines.k_means import KMeans
from mocapbench.datasets import Recording

MODELS = (CyclicAlignment, CPM, KCPM, KMeans)
WALKS = [
    Recording(f"w{k}", np.arange(30) / 30, np.sin(np.arange(30) / (1 + k))[:, None], ("a",), ("",))
    for k in range(3)
]

NOT_COUNTS = (0, -1, 2.5, np.nan, "3", True, None, [2])
NOT_POSITIVE = (0.0, -1e-3, np.nan, np.inf, "0.1", True, None)
REFUSED = {
    **dict.fromkeys(
        ("n_styles", "n_frames", "max_jump", "n_restarts", "max_iter", "n_inner"), NOT_COUNTS
    ),
    "n_states": (6, 0, -8, 20.0, np.nan, "20", True),
    "refine_iter": (-1, 2.5, np.nan, "3", False, None),
    **dict.fromkeys(("tol", "regularisation", "closeness", "smoothness"), NOT_POSITIVE),
    "learn_closeness": (0, 1, "yes", None, np.nan),
    "prior": ("flat", "", None, 1, np.nan, ["paper"]),
    "grouping": ("alike", "", None, 1, np.nan, ["random"]),
    "random_state": (-1, 0.5, np.nan, "0", True, np.random.RandomState),
}
WRONG = [
    pytest.param(model, name, value, id=f"{model.__name__}-{name}-{value!r}"[:60])
    for model in MODELS
    for name in inspect.signature(model).parameters
    for value in REFUSED[name]
]


@pytest.mark.parametrize(("model", "name", "value"), WRONG)
def test_what_a_parameter_cannot_be_is_named_with_what_it_can(model, name, value):
    with pytest.raises(ValueError, match=rf"expected {name} .*got ") as caught:
        model(**{name: value}).fit(WALKS)
    assert repr(value) in str(caught.value)


@pytest.mark.parametrize("model", [CyclicAlignment, CPM, KCPM])
def test_a_jump_goes_less_than_half_the_way_round(model):
    model(n_states=3, max_jump=1, max_iter=1).fit(WALKS)
    with pytest.raises(ValueError, match="at least 7, got 6"):
        model(n_states=6).fit(WALKS)


@pytest.mark.parametrize("model", MODELS)
def test_numbers_of_other_libraries_and_generators_are_taken(model):
    parameters = {"n_restarts": np.int64(1), "random_state": np.random.default_rng(0)}
    given = inspect.signature(model).parameters
    budget = {name: np.int32(2) for name in ("max_iter", "n_styles") if name in given}
    model(**parameters, **budget).fit(WALKS)
