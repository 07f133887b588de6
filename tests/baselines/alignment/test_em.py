"""When the iterations of EM stop."""

from dataclasses import replace

import pytest

from mocapbench.baselines.alignment.updates import expectation_maximisation


def run(posed, gains, *, tol, max_iter=10, calls=None):
    """Run EM with an objective that rises by the given gains, one an iteration."""
    values, log = iter([0.0, *[sum(gains[: i + 1]) for i in range(len(gains))]]), []

    def update(name):
        def step(state, sequences, hyper):
            log.append(name)
            return replace(state)

        return step

    outcome = expectation_maximisation(
        posed.state,
        posed.sequences,
        replace(posed.hyper, n_inner=2, tol=tol),
        e_step=(update("E"),),
        m_step=(update("M"),),
        max_iter=max_iter,
        objective=lambda *_: next(values),
    )
    return outcome, log


def test_it_stops_when_the_objective_gains_too_little(pose):
    posed = pose(0)
    n_visible = posed.sequences.counts.sum()
    outcome, log = run(posed, [10 * n_visible, n_visible, 0.1 * n_visible, 9.0], tol=0.5)
    assert outcome.converged
    assert len(outcome.objectives) == 4
    assert log == ["E", "E", "M"] * 3


def test_it_stops_at_the_largest_number_of_iterations(pose):
    outcome, log = run(pose(0), [1.0] * 5, tol=0.0, max_iter=4)
    assert not outcome.converged
    assert outcome.objectives == pytest.approx((0.0, 1.0, 2.0, 3.0, 4.0))
    assert log == ["E", "E", "M"] * 4
