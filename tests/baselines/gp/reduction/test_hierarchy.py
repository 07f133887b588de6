"""Trees of replicates, compared with the joint Gaussian and with each other.

Likelihoods, gradients, predictions and draws of random trees are compared with the joint Gaussian
where those of the other structures are, in `test_solvers` and `test_joint`.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.dense import Dense

AT = np.array([-0.4, 0.7, 1.3, 5.0])
BALANCED = tuple((kind, subject) for kind in "ab" for subject in "xyz" for _ in range(2))
RAGGED = tuple((kind,) for kind in "abbcccddd")


@pytest.fixture
def example(case):
    """Return a function that draws a case with the given paths."""

    def draw(paths, masks="complete", seed=0):
        structure = "nested" if len(paths[0]) > 1 else "grouped"
        how = {"structure": structure, "n_replicates": len(paths), "masks": masks}
        return replace(case(np.random.default_rng(seed), n_times=4, **how), paths=paths)

    return draw


def evaluate(case, parameters=None):
    solvers = [Dense(case.kernel)] * len(case.reduction.blocks)
    return case.reduction.evaluate(solvers, parameters or case.parameters)


def with_layers(case, structure, layers):
    """Return the same data with other layers."""
    parameters = Parameters(layers, case.parameters.log_noise)
    return replace(case, structure=structure, parameters=parameters)


@pytest.mark.parametrize("paths", [BALANCED, RAGGED], ids=["balanced", "ragged"])
@pytest.mark.parametrize("masks", ["complete", "mixed"])
def test_likelihood_and_gradient_are_those_of_the_joint_gaussian(
    paths, masks, example, brute_force
):
    drawn = example(paths, masks)
    value, gradient = evaluate(drawn)
    truth = brute_force(drawn)
    assert value == pytest.approx(truth.log_likelihood(drawn.parameters), rel=1e-10)
    expected = truth.gradient(drawn.parameters)
    np.testing.assert_allclose(gradient, expected, atol=1e-6 * np.abs(expected).max())


def check_nodes_above(case, truth, replicate):
    """Check the curves of all nodes on the way from the root to a replicate."""
    layers = case.structure.layers
    process = case.process((Dense(case.kernel),) * len(case.reduction.blocks))
    curves = [process.reduction.nodes[case.tree[layer][replicate]] for layer in layers]
    inferred = process.infer(curves, [AT] * len(curves))
    for level, (mean, variance) in enumerate(inferred, start=1):
        expected = truth.posterior(AT, replicate, layers[:level])
        np.testing.assert_allclose(mean.T, expected[0], atol=1e-8)
        np.testing.assert_allclose(variance.T, expected[1], atol=1e-8)


def test_every_node_conditions_the_joint_gaussian(cases, brute_force):
    @settings(deadline=None, max_examples=50)
    @given(cases.filter(lambda case: case.structure.depth), st.integers(0, 4))
    def law(case, which):
        check_nodes_above(case, brute_force(case), which % len(case.replicates.data))

    law()


@pytest.mark.parametrize("paths", [BALANCED, RAGGED], ids=["balanced", "ragged"])
def test_siblings_of_one_shape_keep_their_own_curves(paths, example, brute_force):
    drawn = example(paths)
    for replicate in range(len(paths)):
        check_nodes_above(drawn, brute_force(drawn), replicate)


def test_a_group_without_visible_entries_is_a_draw_around_its_parent(example, brute_force):
    drawn = example((("a", "x"), ("a", "x"), ("b", "x"), ("b", "y")))
    drawn.replicates.observed[2:] = False
    drawn.replicates.data[2:] = 0.0
    check_nodes_above(drawn, brute_force(drawn), 3)


def test_the_cost_of_a_balanced_tree_does_not_grow_with_its_groups_or_their_sizes(example):
    few, many = (
        example(tuple((str(i), str(j)) for i in range(n) for j in range(n) for _ in range(n)))
        for n in (2, 4)
    )
    for drawn, n in ((few, 2), (many, 4)):
        blocks = drawn.reduction.blocks
        assert [block.n_visible for block in blocks] == [2 * 4] * 4
        assert [len(block.data) for block in blocks] == [1, n**3, n**2, n]
        assert [block.multiplicity for block in blocks] == [1, n**3 - n**2, n**2 - n, n - 1]
        assert [len(block.units) for block in blocks] == [4, 1, 2, 3]


def test_the_order_of_replicates_does_not_change_the_shape_of_a_group(example):
    """Two groups, each with one replicate that is complete and one that is not."""
    drawn = example((("a",), ("a",), ("b",), ("b",)))
    drawn.replicates.observed[[0, 3], 1] = False
    drawn.replicates.data[[0, 3], 1] = 0.0
    means, deviations = drawn.reduction.blocks
    assert means.data.shape[:2] == (1, 2)
    assert deviations.data.shape[:2] == (2, 2)
    assert deviations.multiplicity == 1


def test_names_and_order_of_groups_do_not_matter(cases):
    @settings(deadline=None, max_examples=50)
    @given(cases.filter(lambda case: case.structure.depth))
    def law(case):
        swapped = tuple(tuple({"0": "z", "1": "a"}[name] for name in path) for path in case.paths)
        value, gradient = evaluate(case)
        renamed, by_renamed = evaluate(replace(case, paths=swapped))
        assert renamed == pytest.approx(value, rel=1e-12)
        np.testing.assert_allclose(by_renamed, gradient, rtol=1e-9, atol=1e-9)

    law()


@pytest.mark.parametrize("masks", ["complete", "mixed"])
def test_groups_of_one_make_two_layers_with_the_sum_of_the_lower_kernels(masks, case, example):
    drawn = example(tuple((str(r),) for r in range(5)), masks)
    parent, group, child = drawn.parameters.layers.values()
    twin = with_layers(
        replace(drawn, paths=None),
        case(np.random.default_rng(0)).structure,
        {"parent": parent, "child": _sum(group, child)},
    )
    assert evaluate(drawn)[0] == pytest.approx(evaluate(twin)[0], rel=1e-11)


@pytest.mark.parametrize("masks", ["complete", "mixed"])
def test_one_group_of_all_makes_two_layers_with_the_sum_of_the_upper_kernels(masks, case, example):
    drawn = example((("all",),) * 5, masks)
    parent, group, child = drawn.parameters.layers.values()
    twin = with_layers(
        replace(drawn, paths=None),
        case(np.random.default_rng(0)).structure,
        {"parent": _sum(parent, group), "child": child},
    )
    assert evaluate(drawn)[0] == pytest.approx(evaluate(twin)[0], rel=1e-11)


@pytest.mark.parametrize("masks", ["complete", "mixed"])
def test_without_variance_of_groups_there_are_two_layers(masks, case, example):
    drawn = example(RAGGED, masks)
    parent, group, child = drawn.parameters.layers.values()
    silent = with_layers(
        drawn, drawn.structure, {"parent": parent, "group-1": group.zeros(), "child": child}
    )
    twin = with_layers(
        replace(drawn, paths=None),
        case(np.random.default_rng(0)).structure,
        {"parent": parent, "child": child},
    )
    assert evaluate(silent)[0] == pytest.approx(evaluate(twin)[0], rel=1e-11)


def _sum(one, two):
    """Return the layer whose components are those of both."""
    return LayerParameters(*map(np.concatenate, zip(one.leaves, two.leaves, strict=True)))
