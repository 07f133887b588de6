import tomllib
from contextlib import suppress

import pytest
from hypothesis import given, reject
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

DEEP, HUGE = "a = " + "[" * 10_000, "a = " + "9" * 10_000
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


LONG = "".join(f'a{n} = ["x", # ] }}\n  {{ b = "}}" }}]\n' for n in range(1500))


def test_each_part_of_a_long_file_is_read_once_to_find_a_key(monkeypatch):
    text, read = f"{LONG}[hide]\nshare = 1\n", []
    monkeypatch.setattr(
        tomllib, "loads", lambda text, loads=tomllib.loads: read.append(text) or loads(text)
    )
    assert line_of(text, "hide.share") == 3002
    assert line_of(text, "hide.shares") == 3001
    assert sum(map(len, read)) < 6 * len(text)


KEY = st.sampled_from(["a", "b", '"c d"', "e.f"])
VALUE = st.sampled_from(
    [
        "1",
        '"x\\"[#"',
        "'[ # '",
        '"""\n[t]\na = 1\n"""',
        "'''[\n'''",
        "[\n1, # ]\n2]",
        "{ a = [\n] }",
    ]
)
ENTRY = st.builds("{} = {}".format, KEY, VALUE) | st.sampled_from(["", "# [", "[t]", "[t.u] # x"])


def find_line_by_longer_beginnings(text, key):
    """Return the line of a key as reading one line more at a time finds it."""
    lines, before = text.split("\n"), 0
    for end in range(1, len(lines) + 1):
        with suppress(tomllib.TOMLDecodeError):
            value = tomllib.loads("\n".join(lines[:end]) + "\n")
            for name in key.split("."):
                value = value.get(name) if isinstance(value, dict) else None
            if value is not None:
                return before + 1
            before = end
    return None


@given(
    st.lists(ENTRY, max_size=8), st.sampled_from(["a", "b", "c d", "e.f", "t.a", "t.u.b", "t.e.f"])
)
def test_a_key_stands_where_reading_line_by_line_finds_it(entries, key):
    text = "\n".join(entries)
    try:
        tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        reject()
    expected = find_line_by_longer_beginnings(text, key)
    if expected is not None:
        assert line_of(text, key) == expected


@pytest.mark.parametrize(
    "text", ["files = ", "files = [\n", "[hide\n", "a = 1\na = 2\n", "\0", DEEP, HUGE]
)
def test_what_is_no_toml_is_refused_with_the_place(text):
    with pytest.raises(
        TaskFileError, match=r"my.toml: expected TOML, got: .*; write lines .* with / between"
    ):
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
