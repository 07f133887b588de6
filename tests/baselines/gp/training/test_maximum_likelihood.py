from itertools import count

import numpy as np
import pytest

from mocapbench.baselines.gp.solvers.dense import Dense
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError
from mocapbench.baselines.gp.training import maximum_likelihood as module
from mocapbench.baselines.gp.training.coordinates import Coordinates, parameter_bounds
from mocapbench.baselines.gp.training.maximum_likelihood import Budget, maximise
from mocapbench.baselines.gp.training.start import perturb_start, start_from_data


@pytest.fixture
def example(case):
    return case(np.random.default_rng(0), n_times=12, n_outputs=3, masks="mixed")


def _start(example):
    return start_from_data(
        example.replicates,
        example.tree,
        dict.fromkeys(example.structure.layers, 2),
        1,
        example.reduction.within_variance,
    )


def _likelihood(example):
    solver, reduction = Dense(example.kernel), example.reduction
    return lambda parameters: reduction.evaluate([solver] * len(reduction.blocks), parameters)


def _best(searches):
    return max(searches, key=lambda search: search.log_likelihood)


def _train(example, likelihood, starts, *, report=None, **budget):
    draws = {name: 1 + (name == "child") for name in example.structure.layers}
    coordinates = Coordinates.around(starts[0], draws, example.replicates.times)
    spent = Budget(**({"tol": 1e-7, "max_iter": 200, "max_seconds": None} | budget))
    return maximise(likelihood, starts, coordinates, spent, report or (lambda *_: None))


def test_training_improves_on_every_start_and_keeps_the_best(example):
    start = _start(example)
    starts = [start, perturb_start(start, np.random.default_rng(1))]
    likelihood = _likelihood(example)
    lower, upper = parameter_bounds(start, example.replicates.times)
    training = _train(example, likelihood, starts)
    for search, begun in zip(training, starts, strict=True):
        assert search.log_likelihood > likelihood(begun)[0]
        assert likelihood(search.parameters)[0] == pytest.approx(search.log_likelihood, rel=1e-12)
        assert (search.parameters.flat >= lower.flat - 1e-12).all()
        assert (search.parameters.flat <= upper.flat + 1e-12).all()
    assert _best(training).log_likelihood == max(s.log_likelihood for s in training)


def test_every_iteration_is_reported_and_they_rise_to_the_result(example):
    start, reported = _start(example), []
    (search,) = _train(
        example, _likelihood(example), [start], report=lambda *line: reported.append(line)
    )
    numbers, iterations, log_likelihoods, seconds = zip(*reported, strict=True)
    assert set(numbers) == {0}
    assert list(iterations) == list(range(1, search.n_iterations + 1))
    assert log_likelihoods[-1] == search.log_likelihood
    assert list(log_likelihoods) == sorted(log_likelihoods)
    assert list(seconds) == sorted(seconds)


def test_a_search_that_runs_out_of_iterations_has_not_converged(example):
    (search,) = _train(example, _likelihood(example), [_start(example)], max_iter=2)
    assert not search.converged
    assert search.n_iterations == 2


def test_a_looser_tolerance_ends_sooner_and_lower(example):
    likelihood, start = _likelihood(example), _start(example)
    loose, tight = (_best(_train(example, likelihood, [start], tol=tol)) for tol in (1e-3, 1e-9))
    assert loose.converged
    assert tight.converged
    assert loose.n_evaluations < tight.n_evaluations
    assert loose.log_likelihood < tight.log_likelihood


def test_a_spent_time_limit_ends_all_searches_at_the_best_point(example, monkeypatch):
    clock = count()
    monkeypatch.setattr(module, "perf_counter", lambda: float(next(clock)))
    likelihood, start = _likelihood(example), _start(example)
    training = _train(example, likelihood, [start, start], max_seconds=20.0)
    (search,) = training
    assert "max_seconds" in search.message
    assert not search.converged
    assert 1 < search.n_evaluations <= 20
    assert likelihood(search.parameters)[0] == pytest.approx(search.log_likelihood, rel=1e-12)
    assert search.log_likelihood > likelihood(start)[0]


def test_with_no_time_there_is_one_evaluation(example, monkeypatch):
    clock = count()
    monkeypatch.setattr(module, "perf_counter", lambda: float(next(clock)))
    likelihood, start = _likelihood(example), _start(example)
    (search,) = _train(example, likelihood, [start, start], max_seconds=0.5)
    assert search.n_evaluations == 1
    np.testing.assert_allclose(search.parameters.flat, start.flat, rtol=1e-12)


def _walled(example, start):
    """Return a likelihood that is singular from half way to its maximum on."""
    likelihood = _likelihood(example)
    free = _best(_train(example, likelihood, [start]))
    halfway = 0.5 * (start.log_noise + free.parameters.log_noise)
    crossed = np.sign(free.parameters.log_noise - start.log_noise)

    def walled(parameters):
        if (crossed * (parameters.log_noise - halfway) > 0).any():
            raise SingularCovarianceError(parameters)
        return likelihood(parameters)

    return walled, free


def test_a_search_survives_singular_covariances(example):
    start = _start(example)
    walled, free = _walled(example, start)
    (search,) = _train(example, walled, [start])
    assert walled(start)[0] < search.log_likelihood < free.log_likelihood
    assert not search.converged
    assert "lengthscales" in search.message


def test_a_restart_after_a_singular_covariance_stays_within_the_budget(example):
    likelihood, start = _likelihood(example), _start(example)
    reported, evaluations = [], count(1)

    def fails_once(parameters):
        if next(evaluations) == 12:
            raise SingularCovarianceError(parameters)
        return likelihood(parameters)

    (search,) = _train(
        example, fails_once, [start], max_iter=10, report=lambda *line: reported.append(line)
    )
    assert search.n_evaluations > 12
    assert search.n_iterations == len(reported) == 10
    assert [iteration for _, iteration, *_ in reported] == list(range(1, 11))


def test_a_start_that_is_singular_is_an_error(example):
    def singular(parameters):
        raise SingularCovarianceError(parameters)

    with pytest.raises(SingularCovarianceError, match="lengthscales"):
        _train(example, singular, [_start(example)])
