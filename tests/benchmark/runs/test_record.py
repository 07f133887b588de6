import json
import math
import unicodedata
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.runs.record import Record, RecordError, Status
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
    missing=st.lists(TEXT).map(tuple),
    fetch=TEXT,
)


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
