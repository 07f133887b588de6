import joblib
import numpy as np
import pytest


@pytest.fixture(scope="session")
def stored(tmp_path_factory):
    """Return a function that writes arrays as the store does, and reads them again."""
    path = tmp_path_factory.mktemp("store") / "arrays.npz"

    def write_and_read(arrays):
        np.savez_compressed(path, **arrays)
        with np.load(path, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}

    return write_and_read


@pytest.fixture(scope="session")
def survives(stored):
    """Return a function that says whether a value comes back from its arrays exactly.

    The hash covers types, shapes and bytes of all that a value consists of. Arrays under other
    names must not matter.
    """

    def check(value, write, read, other):
        arrays = {**write(value), **other}
        whole = joblib.hash(value)
        return all(joblib.hash(read(a)) == whole for a in (arrays, stored(arrays)))

    return check
