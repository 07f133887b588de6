import pytest

from mocapbench.baselines.gp.solvers.threads import thread_mapper


@pytest.mark.parametrize("n_threads", [1, 2, 3])
def test_results_come_in_order(n_threads):
    with thread_mapper(n_threads) as mapper:
        assert list(mapper(lambda x: x * x, range(20))) == [x * x for x in range(20)]
