import numpy as np
import pytest

from mocapbench.baselines.gp.training.bounds import bounds
from mocapbench.baselines.gp.training.start import data_driven, perturbed, starts


def _start(example, n_components=2, rank=1):
    by_layer = dict.fromkeys(example.structure.layers, n_components)
    within = example.reduction.within_variance
    return data_driven(example.replicates, example.tree, by_layer, rank, within)


@pytest.mark.parametrize("structure", ["hierarchical", "pooled", "independent"])
@pytest.mark.parametrize("masks", ["complete", "mixed", "frames"])
@pytest.mark.parametrize("n_components", [1, 4])
def test_starts_are_within_bounds_where_gradients_do_not_vanish(
    structure, masks, n_components, case
):
    example = case(np.random.default_rng(2), structure=structure, masks=masks, n_times=9)
    start = _start(example, n_components, rank=2)
    lower, upper = bounds(start, example.replicates.times)
    assert ((start.flat >= lower.flat) & (start.flat <= upper.flat)).all()
    for layer in start.layers.values():
        assert (np.abs(layer.coregionalisation.weights).sum(axis=1) > 0).all()
        assert (layer.coregionalisation.kappa_roots > 0).all()


def test_every_layer_has_its_own_number_of_components(case):
    example = case(np.random.default_rng(3), n_outputs=4, n_times=9)
    sizes = {"parent": 3, "child": 1}
    within = example.reduction.within_variance
    start = data_driven(example.replicates, example.tree, sizes, 2, within)
    assert start.shapes == {"parent": (3, 4, 2), "child": (1, 4, 2)}
    np.testing.assert_allclose(
        np.diff(start.layers["parent"].log_lengthscales), np.log(2.0), rtol=1e-12
    )


def test_random_starts_have_the_same_shapes_and_differ(case):
    start = _start(case(np.random.default_rng(4), n_times=9), rank=2)
    rng = np.random.default_rng(0)
    one, two = perturbed(start, rng), perturbed(start, rng)
    assert one.shapes == two.shapes == start.shapes
    assert (one.flat != two.flat).all()
    assert (perturbed(start, np.random.default_rng(0)).flat == one.flat).all()


@pytest.mark.parametrize("n", [1, 2, 4])
def test_starts_are_the_first_one_on_another_scale_and_random_ones(n, case):
    first = _start(case(np.random.default_rng(5), n_times=9))
    listed = starts(first, n, np.random.default_rng(0))
    assert len(listed) == n
    assert listed[0] is first
    for second in listed[1:2]:
        for name, layer in second.layers.items():
            np.testing.assert_allclose(
                layer.lengthscales, 0.5**1.5 * first.layers[name].lengthscales, rtol=1e-12
            )
            mine, others = layer.coregionalisation, first.layers[name].coregionalisation
            np.testing.assert_allclose(mine.weights, 0.5 * others.weights, rtol=1e-12)
            np.testing.assert_array_equal(mine.kappa, others.kappa)
        np.testing.assert_array_equal(second.log_noise, first.log_noise)
    rng = np.random.default_rng(0)
    for random in listed[2:]:
        np.testing.assert_array_equal(random.flat, perturbed(first, rng).flat)
