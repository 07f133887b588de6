"""A reader of Markdown shows names as they are written, and tables keep their shape."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from mocapbench.basics.words import printable
from mocapbench.reports.markdown import escape, table_lines

reader = MarkdownIt("commonmark").enable(["table", "strikethrough"])
markup = st.text("\\`*_[]()<>!|~#&;:-+=\n\r\t ab1.", max_size=20)
texts = st.text(max_size=20) | markup
HOSTILE = (
    "<script>",
    "a|b",
    "`x`",
    "a\nb",
    "[x](http://elsewhere)",
    "![x](y)",
    "&lt;",
    "\\",
    "*x*",
)


def shown(inline):
    """Return what a reader shows of inline Markdown, which must be nothing but text."""
    assert {child.type for child in inline.children} <= {"text", "text_special"}
    return "".join(child.content for child in inline.children)


def as_one_line(text):
    return " ".join(printable(text).split())


def cells(lines):
    """Return the cells of Markdown that must be one table."""
    tokens = reader.parse("\n".join(lines))
    assert (tokens[0].type, tokens[-1].type) == ("table_open", "table_close")
    assert sum(token.type == "table_open" for token in tokens) == 1
    return [shown(token) for token in tokens if token.type == "inline"]


@given(texts)
def test_a_heading_shows_the_text_alone(text):
    _, inline, _ = reader.parse(f"# {escape(text)} against it")
    assert shown(inline) == f"{as_one_line(text)} against it".strip()


@given(st.lists(st.tuples(texts, texts, texts), max_size=3))
def test_a_table_shows_each_text_in_its_cell(rows):
    table = cells(table_lines(("one", "two", "three"), rows))
    assert table[3:] == [as_one_line(text) for row in rows for text in row]


@pytest.mark.parametrize("text", HOSTILE)
def test_markup_in_a_name_is_shown(text):
    assert cells(table_lines((text,), [(text,)])) == [" ".join(text.split())] * 2


@pytest.mark.parametrize("text", ["<script>", "`x`", "[x](http://elsewhere)", "*x*", "~~x~~"])
def test_the_reader_knows_markup(text):
    """Else the tests above would prove nothing."""
    _, inline, _ = reader.parse(f"# {text}")
    assert {child.type for child in inline.children} != {"text"}
