import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.task_files.document import Document, TaskFileError, line_of

TEXT = '''# a comment with files = 1
title = """
files = "no key, but a text"
"""

files = [
    "a.csv",
]
"quoted key" = 1

[hide]
channels = ["x"]
runs = { seconds = 0.5,
count = 3 }
'''.replace("0.5,\n", "0.5, ")  # inline tables have one line

LINES = {
    "title": 2,
    "files": 6,
    "quoted key": 9,
    "hide": 11,
    "hide.channels": 12,
    "hide.runs": 13,
    "hide.runs.count": 13,
    "hide.nothing": 11,  # the table that lacks it
    "nothing": None,
}


@pytest.mark.parametrize(("key", "line"), LINES.items())
def test_a_key_is_found_where_it_stands(key, line):
    assert line_of(TEXT, key) == line


@given(before=st.lists(st.sampled_from(["", "# x = 1", "y = 2", "[z]"]), unique=True, max_size=4))
def test_what_stands_before_a_key_moves_its_line(before):
    text = "\n".join([*before, "key = 1"])
    key = "z.key" if "[z]" in before else "key"
    assert line_of(text, key) == len(before) + 1


@pytest.mark.parametrize("text", ["files = ", "files = [\n", "[hide\n", "a = 1\na = 2\n", "\0"])
def test_what_is_no_toml_is_refused_with_the_place(text):
    with pytest.raises(TaskFileError, match=r"my.toml: expected TOML, got: .*; write lines"):
        _ = Document("my.toml", text).values


@given(st.text(max_size=40))
def test_any_text_is_toml_or_refused(text):
    try:
        expected = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        with pytest.raises(TaskFileError):
            _ = Document("my.toml", text).values
    else:
        assert Document("my.toml", text).values == expected


def test_an_error_has_file_line_and_key():
    error = Document("my.toml", TEXT).error("hide.runs", "gaps", "none", "write some")
    assert str(error) == "my.toml, line 13, key hide.runs: expected gaps, got none; write some"


def test_an_unknown_key_is_met_with_the_nearest():
    with pytest.raises(TaskFileError, match=r"line 1, key filez: .* did you mean files\?"):
        Document("my.toml", "filez = 1").require_known("", ("files", "hide"))
