import numpy as np
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

from mocapbench.baselines.gp_independent import GPIndependent
from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.datasets import Recording, ToyProcess

TIMES = np.linspace(0.0, 5.0, 20)


def _recordings(seed=0, n_outputs=2):
    rng = np.random.default_rng(seed)
    children = ToyProcess.random(rng, n_outputs=n_outputs, noise=0.01).draw(rng, TIMES, 3)
    return (*children[:2], children[2].hide(rng.random((20, n_outputs)) < 0.5))


def test_a_channel_is_predicted_as_if_it_were_alone():
    recordings = _recordings()
    together = GPIndependent(max_iter=30).fit(recordings).impute(recordings)[2]
    for d, channel in enumerate(recordings[0].channels):
        alone = [recording.select([channel]) for recording in recordings]
        (prediction,) = LMCIndependent(rank=0, max_iter=30).fit(alone).impute(alone[2:])
        np.testing.assert_array_equal(together.mean[:, [d]], prediction.mean)
        np.testing.assert_array_equal(together.variance[:, [d]], prediction.variance)


def test_a_prediction_rests_on_the_recording_alone():
    """Given the parameters it is scikit-learn's regression on the recording's own entries."""
    recordings = [recording.select(["output-1"]) for recording in _recordings(1)]
    model = GPIndependent().fit(recordings)
    (inner,) = model.models_
    (prediction,) = model.impute(recordings[2:])
    layer, scaling = inner.parameters_.layers["child"], inner.scaling_
    variance = float(layer.variances[0])
    kernel = ConstantKernel(variance, "fixed") * Matern(
        float(layer.lengthscales[0]), "fixed", nu=1.5
    ) + WhiteKernel(float(inner.parameters_.noise[0]), "fixed")
    seen = recordings[2].visible[:, 0]
    scaled = scaling.apply(recordings[2]).values[seen, 0]
    peer = GaussianProcessRegressor(kernel, alpha=0.0).fit(TIMES[seen, None], scaled)
    mean, deviation = peer.predict(TIMES[~seen, None], return_std=True)
    np.testing.assert_allclose(
        prediction.mean[~seen, 0], mean * scaling.scale + scaling.mean, rtol=1e-8
    )
    np.testing.assert_allclose(
        prediction.variance[~seen, 0], (deviation * scaling.scale) ** 2, rtol=1e-6
    )


def test_channels_may_have_times_of_their_own():
    one, two = (
        Recording(name, times, np.sin(times)[:, None], ("a",), ("",))
        for name, times in (("one", np.linspace(0, 6, 9)), ("two", np.linspace(0.3, 6.3, 9)))
    )
    gap = np.zeros((9, 1), dtype=bool)
    gap[4] = True
    (prediction,) = GPIndependent(kernel="rbf").fit([one, two.hide(gap)]).impute([two.hide(gap)])
    np.testing.assert_allclose(prediction.mean[gap], two.values[gap], atol=0.1)
