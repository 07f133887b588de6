import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.runs.fitting.fit import Fit


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_predictions_survive_and_truncated_ones_are_reported(store, data):
    fit = Fit(
        {"mean-0": np.arange(6.0).reshape(2, 3)}, 1.5, 0.5, 100.0, 7, True, "dense", ("careful",)
    )
    store.save_fit("key", fit)
    back = store.load_fit("key")
    assert store.has_fit("key")
    np.testing.assert_array_equal(back.arrays["mean-0"], fit.arrays["mean-0"])
    assert (back.fit_seconds, back.iterations, back.engine) == (1.5, 7, "dense")
    assert back.warnings == ("careful",)
    path = store.path / "predictions" / "ke" / "key.npz"
    path.write_bytes(path.read_bytes()[: data.draw(st.integers(0, path.stat().st_size - 1))])
    store.damaged.clear()
    assert store.load_fit("key") is None
    assert len(store.damaged) == 1
    assert not store.has_fit("key")


def test_predictions_under_another_name_are_not_trusted(store):
    store.save_fit("key", Fit({"mean-0": np.zeros((2, 3))}, 1.0, 1.0, 1.0, None, None))
    folder = store.path / "predictions"
    (folder / "ke" / "key.npz").rename(folder / "other.npz")
    assert store.load_fit("other") is None
    assert "another job" in store.damaged[0]
    store.damaged.clear()
    assert not store.has_fit("other")
    assert "another job" in store.damaged[0]
