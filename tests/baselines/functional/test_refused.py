"""Every parameter of both models refuses what it cannot be."""

import inspect

import numpy as np
import pytest

from mocapbench.baselines.fam import FAM
from mocapbench.baselines.k_fam import KFAM

NOT_COUNTS = (0, -1, 2.5, np.nan, "3", True, None, [2])
NOT_POSITIVE = (0.0, -1e-3, np.nan, np.inf, "0.1", True, None)
REFUSED = {
    **dict.fromkeys(("n_styles", "n_harmonics", "n_restarts", "max_iter"), NOT_COUNTS),
    "n_components": (-1, 2.5, np.nan, "3", False, None),
    **dict.fromkeys(("tol", "smoothness"), NOT_POSITIVE),
    "random_state": (-1, 0.5, np.nan, "0", True, np.random.RandomState),
}
WRONG = [
    pytest.param(model, name, value, id=f"{model.__name__}-{name}-{value!r}"[:60])
    for model in (FAM, KFAM)
    for name in inspect.signature(model).parameters
    for value in REFUSED[name]
]


@pytest.mark.parametrize(("model", "name", "value"), WRONG)
def test_what_a_parameter_cannot_be_is_named_with_what_it_can(waves, model, name, value):
    with pytest.raises(ValueError, match=rf"expected {name} .*got ") as caught:
        model(**{name: value}).fit(waves([20.0, 25.0]).recordings)
    assert repr(value) in str(caught.value)
