import hashlib
import json
import math
import unicodedata
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import atomic_write
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.record import Record, RecordError, Status
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.tasks.address import Address

TEXT = st.text(max_size=20)
FLOATS = st.floats(allow_infinity=False)
RECORDS = st.builds(
    Record,
    key=st.text("0123456789abcdef", min_size=64, max_size=64),
    fit_key=TEXT,
    address=st.builds(Address, TEXT, st.integers(1, 9), TEXT, st.integers(0, 9), TEXT),
    seed=st.integers(0, 9),
    model=TEXT,
    parameters=st.dictionaries(TEXT, st.integers() | TEXT),
    status=st.sampled_from(Status),
    message=TEXT,
    traceback=TEXT,
    scores=st.dictionaries(TEXT, FLOATS),
    warnings=st.lists(TEXT).map(tuple),
    fit_seconds=st.none() | st.floats(0, 1e6),
    converged=st.none() | st.booleans(),
    engine=TEXT,
)


@pytest.fixture
def store(tmp_path):
    return Store.create(tmp_path / "run")


@pytest.fixture
def record():
    return Record("k" * 64, "f", Address("t", 1, "c", 0, "label"), 0, "model", {}, Status.OK)


@given(RECORDS)
def test_a_record_survives_json(record):
    back = Record.from_json(record.to_json())
    assert back.to_json() == record.to_json()
    assert back.status is record.status
    assert all(math.isnan(back.scores[k]) == math.isnan(v) for k, v in record.scores.items())


@given(st.text(st.characters(max_codepoint=0xA0)))
def test_texts_of_a_record_have_no_control_characters(text):
    fields = {"message": text, "traceback": text, "engine": text, "warnings": (text,)}
    record = Record("k", "f", Address("t", 1, "c", 0, "l"), 0, "m", {}, Status.FAILED, **fields)
    for kept in (record.message, record.traceback, record.engine, *record.warnings):
        assert not {c for c in kept if unicodedata.category(c) == "Cc"} - {"\n", "\t"}


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("two\nlines,\ta tab, ° and …", "two\nlines,\ta tab, ° and …"),
        ("a NUL\0 and \x1b[31mred\x1b[0m", "a NUL and red"),
    ],
)
def test_the_text_of_a_message_is_kept(record, text, kept):
    assert replace(record, message=text).message == kept


@given(RECORDS, st.data())
def test_a_truncated_record_is_refused(record, data):
    text = record.to_json()
    cut = data.draw(st.integers(0, len(text) - 1))
    with pytest.raises(RecordError, match="not a whole record"):
        Record.from_json(text[:cut])


@given(st.recursive(st.none() | st.booleans() | FLOATS | TEXT, st.lists))
def test_foreign_json_is_refused(document):
    with pytest.raises(RecordError):
        Record.from_json(json.dumps(document))


def test_a_score_that_is_no_number_is_refused(record):
    document = json.loads(record.to_json())
    with pytest.raises(RecordError):
        Record.from_json(json.dumps({**document, "scores": {"mse": "abc"}}))


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


def test_one_run_at_a_time(store):
    with (
        store.locked(),
        pytest.raises(UsageError, match="another run is writing"),
        Store.open(store.path).locked(),
    ):
        pass
    with store.locked():
        pass


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    with pytest.raises(RuntimeError), atomic_write(path) as file:
        file.write(b"new")
        raise RuntimeError
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
    assert path.read_text() == "old"


def test_a_folder_that_is_not_ours_is_refused(tmp_path):
    (tmp_path / "thesis.txt").write_text("years of work")
    with pytest.raises(UsageError, match="name a new or empty folder"):
        Store.create(tmp_path)
    with pytest.raises(UsageError, match="is not a mocapbench run"):
        Store.open(tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.txt"]


def test_a_file_in_place_of_the_folder_is_refused(tmp_path):
    path = tmp_path / "file"
    path.touch()
    with pytest.raises(UsageError, match="expected a folder"):
        Store.create(path)


def test_a_damaged_plan_says_what_to_do(store):
    with pytest.raises(UsageError, match="run `mocapbench run` again"):
        store.load_plan()
    for foreign in ("{}", "5", "[]", '{"keys": 3, "provenance": {}}'):
        (store.path / "plan.json").write_text(foreign)
        with pytest.raises(UsageError, match="is not a plan"):
            store.load_plan()
    (store.path / "plan.json").write_text("{")
    with pytest.raises(UsageError, match="run `mocapbench run` again"):
        store.load_plan()


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
