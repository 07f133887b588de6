import numpy as np
import pytest

from mocapbench.baselines import GPDM, GPLVM
from mocapbench.benchmark.problems.internals import internals_of


@pytest.fixture(scope="module")
def train(posed):
    return posed("missing-frames", "synthetic 1").train


def test_spaces_of_other_than_three_dimensions_leave_their_parameters_only(train):
    internals = internals_of(GPDM(n_latent=6, max_iter=1, fill_iter=1).fit(train), train)
    names = ("SNR(α)", "CLS(α)", "SNR(β)", "CLS(β)")
    assert set(internals) == {f"property-{name}" for name in names}


def test_the_cloud_is_as_confident_as_the_model(train):
    model = GPLVM(max_iter=1).fit(train)
    cloud = internals_of(model, train)["latent-cloud"].astype(float)
    np.testing.assert_allclose(model.confidence(cloud[:, :3]), cloud[:, 3], rtol=1e-4, atol=1e-4)
