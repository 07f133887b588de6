import numpy as np
from hypothesis import given

from mocapbench.baselines.gp.latents import Latents
from mocapbench.baselines.gp.unit_pairs import unit_pairs


def test_the_pairs_leave_nothing_out_of_the_products_of_loadings(cases):
    @given(cases)
    def law(case):
        for block in case.reduction.blocks:
            latents = Latents.of(case.kernel, block, case.parameters)
            for pair in unit_pairs(latents):
                left, right = (latents.loadings[unit].T for unit in pair.units)
                products = np.zeros((len(left), len(right), len(block.observed[0])))
                products[pair.blocks] = pair.products
                np.testing.assert_array_equal(products, left[:, None] * right[None])

    law()
