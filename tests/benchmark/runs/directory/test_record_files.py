from dataclasses import replace


def test_what_is_saved_is_loaded(store, record):
    store.save(record)
    assert store.load(record.key) == record
    assert store.records() == [record]
    assert store.damaged == []


def test_scores_of_a_metric_that_was_renamed_are_loaded_under_its_name(store, record):
    old = {"spread": 1.0, "mse": 2.0, "of a package that is gone": 3.0}
    parts = {"spread": {"output": [1.0]}}
    store.save(replace(record, scores=old, parts=parts, left_out={"spread": 1}))
    back = store.load(record.key)
    assert back.scores == {"variance_ratio": 1.0, "mse": 2.0, "of a package that is gone": 3.0}
    assert (back.parts, back.left_out) == (
        {"variance_ratio": {"output": [1.0]}},
        {"variance_ratio": 1},
    )


def test_a_damaged_record_is_reported_and_not_trusted(store, record):
    store.save(record)
    path = store.path / "records" / record.key[:2] / f"{record.key}.json"
    path.write_bytes(path.read_bytes()[:-20])
    assert store.load(record.key) is None
    assert str(path) in store.damaged[0]


def test_a_record_under_another_name_is_not_trusted(store, record):
    store.save(record)
    folder = store.path / "records"
    (folder / record.key[:2] / f"{record.key}.json").rename(folder / f"{'x' * 64}.json")
    assert store.load("x" * 64) is None
    assert "holds the record" in store.damaged[0]
