import json
import math
import pickle
import unicodedata
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.foreign_files import ForeignFileError
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

TEXT = st.text(max_size=20)
FLOATS = st.floats(allow_infinity=False)
KEYS = st.text("0123456789abcdef", min_size=64, max_size=64)
RECORDS = st.builds(
    Record,
    key=KEYS,
    fit_key=KEYS,
    address=st.builds(Address, TEXT, st.integers(1, 9), TEXT, st.integers(0, 9), TEXT),
    seed=st.integers(0, 9),
    model=TEXT,
    parameters=st.dictionaries(TEXT, st.integers() | TEXT),
    status=st.sampled_from(Status),
    message=TEXT,
    traceback=TEXT,
    scores=st.dictionaries(TEXT, FLOATS),
    parts=st.dictionaries(TEXT, st.dictionaries(TEXT, st.lists(FLOATS, max_size=3)), max_size=2),
    provenance=st.dictionaries(TEXT, TEXT, max_size=2),
    warnings=st.lists(TEXT).map(tuple),
    fit_seconds=st.none() | st.floats(0, 1e6),
    converged=st.none() | st.booleans(),
    engine=TEXT,
    missing=st.lists(TEXT).map(tuple),
    fetch=TEXT,
)


@given(RECORDS)
def test_a_record_survives_json(record):
    back = Record.from_json(record.to_json())
    assert back.to_json() == record.to_json()
    assert back.status is record.status
    assert all(math.isnan(back.scores[k]) == math.isnan(v) for k, v in record.scores.items())


@given(RECORDS)
def test_records_of_one_provenance_share_it_from_wherever_they_come(record):
    others = [
        Record.from_json(record.to_json()),
        replace(record, seed=10, provenance={**record.provenance}),
        pickle.loads(pickle.dumps(record)),
    ]
    assert all(other.provenance is record.provenance for other in others)
    assert pickle.loads(pickle.dumps(record)).to_json() == record.to_json()


@given(RECORDS)
def test_a_number_of_a_part_takes_eight_bytes_and_keeps_its_bits(record):
    numbers = [0.1, float("nan"), -0.0, 5e-324]
    kept = replace(record, parts={"mse": {"frame": numbers}})
    for each in (kept, Record.from_json(kept.to_json())):
        assert memoryview(each.parts["mse"]["frame"]).nbytes == 8 * len(numbers)
        assert list(map(repr, each.parts["mse"]["frame"])) == list(map(repr, numbers))


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
    with pytest.raises(ForeignFileError):
        Record.from_json(text[:cut])


@given(st.recursive(st.none() | st.booleans() | FLOATS | TEXT, st.lists))
def test_foreign_json_is_refused(document):
    with pytest.raises(ForeignFileError):
        Record.from_json(json.dumps(document))


DEEP = json.loads("[" * 20 + "]" * 20)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"scores": {"mse": "abc"}}, r"at scores\[...\], expected a number or null, got text"),
        ({"fold": -1}, "at fold, expected a whole number >= 0"),
        ({"fold": 10**30}, "at fold, expected a whole number"),
        ({"fold": True}, "at fold, expected a whole number or null, got true or false"),
        ({"message": 3}, "at message, expected text, got a whole number"),
        ({"message": "a" * 1_000_001}, "at message, expected text of length <= 1000000"),
        ({"label": "a" * 10_001}, "at label, expected text of length <= 10000"),
        ({"fit_key": "../../.ssh/id"}, "at fit_key, expected text that names a file"),
        ({"status": "fine"}, "at status, invalid enum value 'fine'"),
        ({"parameters": {"rank": DEEP}}, r"at parameters\[...\]"),
        ({"parts": {"mse": [1.0]}}, r"at parts\[...\], expected a table, got a list"),
        ({"warnings": "careful"}, "at warnings, expected a list, got text"),
        ({"other": 1}, "expected no entry other, got one"),
        ({"format": 2}, "at format, invalid enum value 2"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_an_entry_of_another_kind_is_refused_with_its_place(record, change, said):
    document = {**json.loads(record.to_json()), **change}
    with pytest.raises(ForeignFileError, match=said):
        Record.from_json(json.dumps(document))


@pytest.mark.parametrize("entry", ["key", "scores", "fetch"])
def test_a_record_without_an_entry_is_refused(record, entry):
    document = json.loads(record.to_json())
    del document[entry]
    with pytest.raises(ForeignFileError, match=f"expected the entry {entry}, got none"):
        Record.from_json(json.dumps(document))


@given(st.integers(), st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_of_any_size_stay_what_they_are(whole, number):
    record = Record("k", "f", Address("t", 1, "c"), 0, "m", {"a": whole, "b": [number]}, Status.OK)
    assert Record.from_json(record.to_json()).parameters == record.parameters


def test_a_job_took_its_fit_and_its_prediction(record):
    assert replace(record, fit_seconds=2.0, predict_seconds=0.5).seconds == 2.5
    assert replace(record, fit_seconds=2.0, predict_seconds=None).seconds == 2.0
    assert replace(record, fit_seconds=None, predict_seconds=0.5).seconds is None
