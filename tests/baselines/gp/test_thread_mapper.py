import pytest
from threadpoolctl import threadpool_info

from mocapbench.baselines.gp.threads import thread_mapper


@pytest.mark.parametrize("n_threads", [1, 2, 3])
def test_results_come_in_order_and_blas_has_one_thread(n_threads):
    with thread_mapper(n_threads) as mapper:
        assert list(mapper(lambda x: x * x, range(20))) == [x * x for x in range(20)]
        pools = [pool for pool in threadpool_info() if pool["user_api"] == "blas"]
        assert pools
        assert {pool["num_threads"] for pool in pools} == {1}
