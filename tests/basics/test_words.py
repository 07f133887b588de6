"""Counts follow their nouns; what is left of a text shows, and nothing of it is obeyed."""

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.basics.words import format_count, join_names, printable

BIDIRECTIONAL = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}
MARKS = "\N{LEFT-TO-RIGHT MARK}\N{RIGHT-TO-LEFT MARK}\N{ARABIC LETTER MARK}"
# What sequences are made of, so that examples hold many, whole and broken.
pieces = st.sampled_from([*"\x1b\x9b\x9d\x9c\x07[]\\;:?08mJP #a\n\t\r", "\x1b[", "\x1b]8;;"])
hostile = st.one_of(st.text(), st.lists(pieces).map("".join))


def obeyed(character):
    """Return whether a terminal acts on a character instead of showing it."""
    is_control = unicodedata.category(character) == "Cc" and character not in "\n\t"
    return is_control or unicodedata.bidirectional(character) in BIDIRECTIONAL or character in MARKS


@given(hostile)
def test_nothing_that_is_left_is_obeyed(text):
    assert not any(map(obeyed, printable(text)))


@given(hostile)
def test_every_line_stays_a_line(text):
    assert printable(text).count("\n") == text.count("\n")


@given(st.text().filter(lambda text: not any(map(obeyed, text))))
def test_text_that_shows_stays_as_it_is(text):
    assert printable(text) == text


@given(hostile)
def test_twice_is_once(text):
    assert printable(printable(text)) == printable(text)


@pytest.mark.parametrize(
    "sequence",
    [
        "\x1b[2J",
        "\x1b[38;5;1m",
        "\x1b[?1049h",
        "\x1b[0 q",
        "\x9b2J",
        "\x1b]0;a title\x07",
        "\x1b]8;;http://elsewhere\x1b\\",
        "\x9d52;c;Y3VybA==\x9c",
        "\x1bP1$r0m\x1b\\",
        "\x1b_an application\x1b\\",
        "\x1bc",
        "\x1b(0",
        "\x1b7",
    ],
    ids=ascii,
)
def test_of_an_escape_sequence_nothing_is_left(sequence):
    assert printable(f"one{sequence}two") == "onetwo"


def test_a_sequence_without_an_end_hides_nothing():
    assert printable("\x1b]8;;http://elsewhere\nthe message") == "8;;http://elsewhere\nthe message"


@pytest.mark.parametrize(
    ("count", "text"), [(0, "0 cases"), (1, "1 case"), (2, "2 cases"), (21, "21 cases")]
)
def test_the_noun_follows_its_count(count, text):
    assert format_count(count, "case") == text


def test_an_irregular_plural_is_named():
    texts = [format_count(count, "entry", "entries") for count in (0, 1, 2)]
    assert texts == ["0 entries", "1 entry", "2 entries"]


@pytest.mark.parametrize(
    ("names", "text"),
    [
        ([], "none"),
        (["a"], "a"),
        (["a", "b"], "a and b"),
        (["a", "b", "c"], "a, b and c"),
        (["a", "b", "c", "d"], "a, b, c and 1 more"),
        (["a", "b", "c", "d", "e"], "a, b, c and 2 more"),
    ],
)
def test_names_stand_in_a_row_and_what_is_too_many_is_counted(names, text):
    assert join_names(names, 3) == text
