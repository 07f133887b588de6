"""Changes of the replicates that must not change the likelihood."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import Replicates
from mocapbench.baselines.gp.solvers.dense import Dense

STRUCTURES = ("hierarchical", "pooled", "independent")


def log_likelihood(case):
    reduction = case.reduction
    return reduction.evaluate([Dense(case.kernel)] * len(reduction.blocks), case.parameters)[0]


def reordered(replicates, index, axis):
    return Replicates(
        np.take(replicates.times, index) if axis == 2 else replicates.times,
        np.take(replicates.data, index, axis),
        np.take(replicates.observed, index, axis),
    )


@pytest.mark.parametrize("axis", [0, 2], ids=["replicates", "frames"])
def test_the_order_of_replicates_and_frames_does_not_matter(axis, cases):
    @settings(deadline=None, max_examples=50)
    @given(cases, st.randoms(use_true_random=False))
    def law(case, random):
        index = list(range(case.replicates.data.shape[axis]))
        random.shuffle(index)
        order = np.arange(len(case.replicates.data)) if axis else index
        paths = case.paths and tuple(case.paths[r] for r in order)
        shuffled = replace(case, replicates=reordered(case.replicates, index, axis), paths=paths)
        assert log_likelihood(shuffled) == pytest.approx(log_likelihood(case), rel=1e-9, abs=1e-9)

    law()


def test_the_order_of_outputs_does_not_matter(cases, with_outputs):
    @settings(deadline=None, max_examples=50)
    @given(cases, st.randoms(use_true_random=False))
    def law(case, random):
        index = list(range(case.replicates.data.shape[1]))
        random.shuffle(index)
        shuffled = replace(
            case,
            replicates=reordered(case.replicates, index, 1),
            parameters=with_outputs(case.parameters, index),
        )
        assert log_likelihood(shuffled) == pytest.approx(log_likelihood(case), rel=1e-9, abs=1e-9)

    law()


@pytest.mark.parametrize("structure", STRUCTURES)
def test_a_replicate_without_visible_entries_does_not_change_the_likelihood(structure, case):
    example = case(np.random.default_rng(3), structure=structure)
    shape = (1, *example.replicates.data.shape[1:])
    more = Replicates(
        example.replicates.times,
        np.concatenate([example.replicates.data, np.zeros(shape)]),
        np.concatenate([example.replicates.observed, np.zeros(shape, dtype=bool)]),
    )
    extended = replace(example, replicates=more)
    assert log_likelihood(extended) == pytest.approx(log_likelihood(example), rel=1e-12)


def test_one_replicate_of_a_hierarchy_is_one_draw_of_the_summed_layers(case, brute_force):
    example = case(np.random.default_rng(4), n_replicates=1, masks="complete")
    assert len(example.reduction.blocks) == 1
    expected = brute_force(example).log_likelihood(example.parameters)
    assert log_likelihood(example) == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("structure", STRUCTURES)
def test_the_likelihood_of_copies_of_one_replicate(structure, case, brute_force):
    example = case(np.random.default_rng(5), structure=structure, n_replicates=1)
    copies = Replicates(
        example.replicates.times,
        np.repeat(example.replicates.data, 6, axis=0),
        np.repeat(example.replicates.observed, 6, axis=0),
    )
    example = replace(example, replicates=copies)
    expected = brute_force(example).log_likelihood(example.parameters)
    assert log_likelihood(example) == pytest.approx(expected, rel=1e-10)


def test_cost_does_not_grow_with_complete_replicates(case):
    few, many = (
        case(np.random.default_rng(6), n_replicates=n, masks="complete").reduction.blocks
        for n in (3, 50)
    )
    assert [block.n_visible for block in few] == [block.n_visible for block in many]


def test_without_a_child_layer_the_hierarchy_is_the_pooled_model(case):
    example = case(np.random.default_rng(7), rank=1)
    parent = example.parameters.layers["parent"]
    silent = example.parameters.layers["child"].zeros()
    hierarchy = replace(
        example,
        parameters=Parameters({"parent": parent, "child": silent}, example.parameters.log_noise),
    )
    twin = case(np.random.default_rng(7), structure="pooled")
    twin = replace(
        twin,
        replicates=example.replicates,
        parameters=Parameters({"parent": parent}, example.parameters.log_noise),
    )
    assert log_likelihood(hierarchy) == pytest.approx(log_likelihood(twin), rel=1e-9)
