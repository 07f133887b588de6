import hashlib
from dataclasses import replace

import numpy as np

from mocapbench.benchmark.runs.fitting.fit import Fit


def test_records_and_predictions_of_earlier_versions_are_read(store, record):
    """They lay side by side, without the folders between."""
    store.save(record)
    store.save_fit("key", Fit({"mean-0": np.zeros((2, 3))}, 1.0, 1.0, 1.0, None, None))
    for path in [*store.path.glob("records/*/*"), *store.path.glob("predictions/*/*")]:
        path.rename(path.parents[1] / path.name)
    assert store.load(record.key) == record
    assert store.records() == [record]
    assert store.load_fit("key") is not None


def test_no_folder_holds_more_than_a_small_part_of_many_records(store, record):
    keys = [hashlib.sha256(bytes([n, m])).hexdigest() for n in range(8) for m in range(125)]
    for key in keys:
        store.save(replace(record, key=key))
    assert [found.key for found in store.records()] == sorted(keys)
    assert max(len([*folder.iterdir()]) for folder in (store.path / "records").iterdir()) < 20
