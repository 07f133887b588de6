import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.store import Store


def test_one_run_at_a_time(store):
    with (
        store.locked(),
        pytest.raises(UsageError, match="another run is writing"),
        Store.open(store.path).locked(),
    ):
        pass
    with store.locked():
        pass
