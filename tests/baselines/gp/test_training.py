import numpy as np
import pytest

from mocapbench.baselines.gp.dense import Dense
from mocapbench.baselines.gp.solver import SingularCovarianceError
from mocapbench.baselines.gp.start import bounds, data_driven, perturbed
from mocapbench.baselines.gp.training import maximise


@pytest.fixture
def example(case):
    return case(np.random.default_rng(0), n_times=12, n_outputs=3, masks="mixed")


def _start(example, n_components=2, rank=1):
    reduction = example.reduction
    return data_driven(
        example.replicates,
        example.structure.layers,
        n_components,
        rank,
        reduction.within_variance,
    )


def _likelihood(example):
    solver, reduction = Dense(example.kernel), example.reduction
    return lambda parameters: reduction.evaluate(solver, parameters)


def test_training_improves_on_every_start_and_keeps_the_best(example):
    start = _start(example)
    starts = [start, perturbed(start, np.random.default_rng(1))]
    likelihood = _likelihood(example)
    limits = bounds(start, example.replicates.times)
    training = maximise(likelihood, starts, limits, 200)
    for search, begun in zip(training.searches, starts, strict=True):
        assert search.log_likelihood > likelihood(begun)[0]
        assert likelihood(search.parameters)[0] == pytest.approx(search.log_likelihood, rel=1e-12)
        assert (search.parameters.flat >= limits[0]).all()
        assert (search.parameters.flat <= limits[1]).all()
    assert training.best.log_likelihood == max(s.log_likelihood for s in training.searches)


def test_a_search_that_is_cut_short_says_so(example):
    start = _start(example)
    limits = bounds(start, example.replicates.times)
    (search,) = maximise(_likelihood(example), [start], limits, 2).searches
    assert not search.converged
    assert search.n_iterations <= 2


def test_a_search_survives_singular_covariances(example):
    start, likelihood = _start(example), _likelihood(example)
    limits = bounds(start, example.replicates.times)
    (free,) = maximise(likelihood, [start], limits, 200).searches
    halfway = 0.5 * (start.log_noise + free.parameters.log_noise)
    crossed = np.sign(free.parameters.log_noise - start.log_noise)

    def walled(parameters):
        if (crossed * (parameters.log_noise - halfway) > 0).any():
            raise SingularCovarianceError(parameters)
        return likelihood(parameters)

    (search,) = maximise(walled, [start], limits, 200).searches
    assert likelihood(start)[0] < search.log_likelihood < free.log_likelihood
    assert not search.converged
    assert "lengthscales" in search.message


def test_a_start_that_is_singular_is_an_error(example):
    start = _start(example)

    def singular(parameters):
        raise SingularCovarianceError(parameters)

    with pytest.raises(SingularCovarianceError, match="lengthscales"):
        maximise(singular, [start], bounds(start, example.replicates.times), 10)


@pytest.mark.parametrize("structure", ["hierarchical", "pooled", "independent"])
@pytest.mark.parametrize("masks", ["complete", "mixed", "frames"])
@pytest.mark.parametrize("n_components", [1, 4])
def test_starts_lie_within_bounds_where_gradients_are_alive(structure, masks, n_components, case):
    example = case(np.random.default_rng(2), structure=structure, masks=masks, n_times=9)
    start = _start(example, n_components, rank=2)
    lower, upper = bounds(start, example.replicates.times)
    assert ((start.flat >= lower) & (start.flat <= upper)).all()
    for layer in start.layers.values():
        assert (np.abs(layer.coregionalisation.weights).sum(axis=1) > 0).all()
        assert (layer.coregionalisation.kappa_roots > 0).all()
