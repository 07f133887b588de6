"""CSV in which no text begins a formula, no number changes, and no two names become one."""

import csv
import re
from io import StringIO

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.basics.words import printable
from mocapbench.reports.spreadsheet import csv_text, guard_text, unguard_text

FORMULA = "=+-@\t\r\n＝＋－＠"
names = st.text() | st.text(f"'{FORMULA}a", max_size=5)
numbers = st.floats(allow_nan=False, allow_infinity=False)


@given(names)
def test_no_guarded_text_begins_a_formula(text):
    assert guard_text(text)[:1] not in set(FORMULA)


@given(names)
def test_what_was_guarded_comes_back(text):
    assert unguard_text(guard_text(text)) == text


@given(names.filter(lambda text: not text.lstrip("'").startswith(tuple(FORMULA))))
def test_other_text_stays_as_it_is(text):
    assert guard_text(text) == text == unguard_text(text)


@given(st.lists(st.tuples(numbers, st.integers(-(2**53), 2**53), st.booleans()), min_size=1))
def test_numbers_stay_numbers_to_the_last_bit(rows):
    frame = pd.DataFrame(rows, columns=["float", "integer", "flag"])
    assert csv_text(frame) == frame.to_csv(index=False, lineterminator="\n")


def test_numbers_among_text_stay_numbers():
    frame = pd.DataFrame({"mixed": [-1, None, "-1", -2.5, True]}, dtype=object)
    assert csv_text(frame) == 'mixed\n-1\n""\n\'-1\n-2.5\nTrue\n'


def test_counts_with_gaps_are_written_as_before():
    columns = {"flag": [True, None], "count": [-3, None], "label": ["a", None]}
    frame = pd.DataFrame(columns, dtype=object)
    assert csv_text(frame) == frame.to_csv(index=False, lineterminator="\n")


def test_text_and_headings_are_guarded():
    frame = pd.DataFrame({"=label": ["=1+1", "@sum", "knn"], "-value": [-1.5, 0.0, 2.0]})
    assert csv_text(frame) == "'=label,'-value\n'=1+1,-1.5\n'@sum,0.0\nknn,2.0\n"


@given(st.lists(st.tuples(names, names), min_size=1))
def test_every_text_stays_in_its_cell(rows):
    frame = pd.DataFrame(rows, columns=["one", "two"])
    _, *read = csv.reader(StringIO(csv_text(frame), newline=""), strict=True)
    lines = [[printable(re.sub("\r\n?", "\n", text)) for text in row] for row in rows]
    assert [[*map(unguard_text, row)] for row in read] == lines
    assert not {text[:1] for row in read for text in row} & set(FORMULA)


@pytest.mark.parametrize("text", ["\0=1+1", "\u202e=1+1", "\x1b[2J=1+1"])
def test_what_is_left_out_hides_no_formula(text):
    frame = pd.DataFrame({text: [text, "a\u2067b"]})
    assert csv_text(frame) == "'=1+1\n'=1+1\nab\n"


def test_a_table_without_rows_or_text_is_written():
    assert csv_text(pd.DataFrame(columns=["a", "b"])) == "a,b\n"
    assert csv_text(pd.DataFrame({"a": [1]})) == "a\n1\n"


def test_what_is_written_is_left_as_it_was():
    frame = pd.DataFrame({"label": ["=1"]})
    csv_text(frame)
    assert frame["label"].to_list() == ["=1"]


def test_texts_that_take_memory_once_are_written_as_others():
    texts = ["=1+1", "M1.x", None, "a\x01", "M1.x", "a"]
    plain = pd.DataFrame({"text": pd.Series(texts, dtype=object), "number": range(6)})
    once = plain.assign(text=pd.Categorical(texts))
    assert csv_text(once) == csv_text(plain)
