import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.gp.prior.kernels import KERNELS
from mocapbench.baselines.gp.prior.pivoted import PivotedRoot

TIMES = np.linspace(0.0, 6.0, 40)


@pytest.mark.parametrize("name", KERNELS)
@given(scale=st.floats(0.05, 20.0))
def test_the_root_reproduces_the_kernel_matrix(name, scale):
    gram = KERNELS[name].value(np.subtract.outer(TIMES, TIMES), scale)
    root = PivotedRoot.of(KERNELS[name], scale, TIMES).values
    residual = gram - root @ root.T
    assert np.trace(residual) < 1e-14 * len(TIMES) + 1e-13
    np.testing.assert_allclose(residual, 0.0, atol=2e-14)


@pytest.mark.parametrize("name", KERNELS)
@given(scale=st.floats(0.2, 5.0))
def test_the_extension_is_the_root_at_its_own_times(name, scale):
    root = PivotedRoot.of(KERNELS[name], scale, TIMES)
    np.testing.assert_allclose(root.at(TIMES), root.values, atol=1e-8)


def test_a_smooth_kernel_has_few_columns_and_a_rough_one_has_all():
    ranks = {name: PivotedRoot.of(KERNELS[name], 2.0, TIMES).values.shape[1] for name in KERNELS}
    assert ranks["rbf"] < 25
    assert ranks["matern12"] == ranks["matern32"] == len(TIMES)
