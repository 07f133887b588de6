import numpy as np

from mocapbench.benchmark import Solved, draw_covariances


def test_covariances_are_shown_beside_the_true_ones_layer_by_layer(posed):
    problem = posed("covariance-recovery", "correlated outputs")
    solutions = {
        "mohgp": {layer: 2.0 * truth for layer, truth in problem.truth.items()},
        "moa": {"child": problem.truth["child"]},
    }
    solved = Solved("covariance-recovery", problem, solutions)
    child, parent = draw_covariances(solved)
    assert list(child.maps) == ["truth", "mohgp", "moa"]
    assert list(parent.maps) == ["truth", "mohgp"]
    truth, double, same = child.maps.values()
    np.testing.assert_array_equal(double, 2.0 * truth)
    np.testing.assert_array_equal(same, truth)
    every_other = np.concatenate([np.arange(d * 50, d * 50 + 50, 2) for d in range(3)])
    np.testing.assert_array_equal(truth, problem.truth["child"][np.ix_(every_other, every_other)])
    assert child.labels[::25] == ("output-1", "output-2", "output-3")
