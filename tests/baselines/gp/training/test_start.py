import numpy as np
import pytest

from mocapbench.baselines.gp.training.coordinates import parameter_bounds
from mocapbench.baselines.gp.training.start import perturb_start, start_from_data, vary_start


def _start(example, n_components=2, rank=1):
    by_layer = dict.fromkeys(example.structure.layers, n_components)
    within = example.reduction.within_variance
    return start_from_data(example.replicates, example.tree, by_layer, rank, within)


@pytest.mark.parametrize("structure", ["hierarchical", "pooled", "independent"])
@pytest.mark.parametrize("masks", ["complete", "mixed", "frames"])
@pytest.mark.parametrize("n_components", [1, 4])
def test_starts_are_within_bounds_where_gradients_do_not_vanish(
    structure, masks, n_components, case
):
    example = case(np.random.default_rng(2), structure=structure, masks=masks, n_times=9)
    start = _start(example, n_components, rank=2)
    lower, upper = parameter_bounds(start, example.replicates.times)
    assert ((start.flat >= lower.flat) & (start.flat <= upper.flat)).all()
    for layer in start.layers.values():
        assert (np.abs(layer.weights).sum(axis=1) > 0).all()
        assert (layer.kappa_roots > 0).all()


def test_every_layer_has_its_own_number_of_components(case):
    example = case(np.random.default_rng(3), n_outputs=4, n_times=9)
    sizes = {"parent": 3, "child": 1}
    within = example.reduction.within_variance
    start = start_from_data(example.replicates, example.tree, sizes, 2, within)
    assert start.shapes == {"parent": (3, 4, 2), "child": (1, 4, 2)}
    np.testing.assert_allclose(
        np.diff(start.layers["parent"].log_lengthscales), np.log(2.0), rtol=1e-12
    )


def test_random_starts_have_the_same_shapes_and_differ(case):
    start = _start(case(np.random.default_rng(4), n_times=9), rank=2)
    rng = np.random.default_rng(0)
    one, two = perturb_start(start, rng), perturb_start(start, rng)
    assert one.shapes == two.shapes == start.shapes
    assert (one.flat != two.flat).all()
    assert (perturb_start(start, np.random.default_rng(0)).flat == one.flat).all()


# The order of three log-lengthscales in the second, third and fifth start: last layer, those above.
ORDERS = {1: ([2, 1, 0], [0, 1, 2]), 2: ([0, 1, 2], [2, 1, 0]), 4: ([1, 2, 0], [1, 2, 0])}


@pytest.mark.parametrize("structure", ["hierarchical", "pooled"])
def test_starts_after_the_first_assign_shorter_lengthscales_otherwise(structure, case):
    first = _start(case(np.random.default_rng(5), structure=structure, n_times=9), 3)
    listed = vary_start(first, 5, np.random.default_rng(0))
    assert listed[0] is first
    last = [*first.layers][-1]
    for start in listed[1:]:
        for name, layer in start.layers.items():
            mine, before = layer, first.layers[name]
            np.testing.assert_allclose(mine.weights, 0.5 * before.weights, rtol=1e-12)
            np.testing.assert_array_equal(mine.kappa, before.kappa)
        np.testing.assert_array_equal(start.log_noise, first.log_noise)
    for number, (in_last, above) in ORDERS.items():
        for name, layer in listed[number].layers.items():
            logs = first.layers[name].log_lengthscales[in_last if name == last else above]
            np.testing.assert_allclose(layer.log_lengthscales, logs - 1.5 * np.log(2.0), atol=1e-12)
    for name, layer in listed[3].layers.items():
        logs = first.layers[name].log_lengthscales
        expected = logs.mean() + 0.1 * (logs - logs.mean()) - 1.5 * np.log(2.0)
        np.testing.assert_allclose(layer.log_lengthscales, expected, atol=1e-12)


@pytest.mark.parametrize("n", [1, 2, 5, 7])
@pytest.mark.parametrize(("n_components", "n_same"), [(1, 3), (2, 0)])
def test_starts_differ_and_those_after_the_fifth_are_random(n, n_components, n_same, case):
    first = _start(case(np.random.default_rng(5), n_times=9), n_components)
    listed = vary_start(first, n, np.random.default_rng(0))
    n_same = min(n_same, max(n - 2, 0))
    assert len(listed) == len({start.flat.tobytes() for start in listed}) == n - n_same
    rng = np.random.default_rng(0)
    for random in listed[5 - n_same :]:
        np.testing.assert_array_equal(random.flat, perturb_start(first, rng).flat)


def test_reversed_and_moved_on_are_one_start_with_two_components_in_one_layer(case):
    first = _start(case(np.random.default_rng(5), structure="pooled", n_times=9), 2)
    assert len(vary_start(first, 7, np.random.default_rng(0))) == 6


def test_components_exchange_their_lengthscales_in_random_starts(case):
    start = _start(case(np.random.default_rng(4), n_times=9), n_components=3)
    rng = np.random.default_rng(0)
    drawn = np.array(
        [perturb_start(start, rng).layers["child"].log_lengthscales for _ in range(400)]
    )
    mean = start.layers["child"].log_lengthscales.mean()
    np.testing.assert_allclose(drawn.mean(axis=0), mean, atol=0.15)


def test_the_start_does_not_depend_on_the_signs_of_singular_vectors(case, monkeypatch):
    example, svd = case(np.random.default_rng(0), n_times=9), np.linalg.svd
    start = _start(example)

    def turned(matrix, **options):
        left, singular, right = svd(matrix, **options)
        return -left, singular, -right

    monkeypatch.setattr(np.linalg, "svd", turned)
    np.testing.assert_array_equal(_start(example).flat, start.flat)
