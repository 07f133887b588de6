import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.runs.directory.key_file import KeyEntry, read_keys, write_keys
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.tasks.address import Address

TEXT = st.text(max_size=5)
ADDRESS = st.builds(Address, TEXT, st.integers(1, 9), TEXT, st.integers(0, 9), TEXT)
ENTRY = st.builds(KeyEntry, ADDRESS, st.dictionaries(TEXT, TEXT, max_size=4))
HERE = Address("t", 1, "c", 0, "label")


@given(st.dictionaries(TEXT, ENTRY, max_size=5))
def test_what_is_written_is_read(tmp_path_factory, entries):
    path = tmp_path_factory.mktemp("folder") / "keys.json"
    write_keys(path, entries)
    assert read_keys(path) == entries


def test_a_part_stands_once_however_many_keys_have_it(tmp_path):
    parts = {f"metric {n}": f"sha256:{n:016}" for n in range(20)}
    sizes = []
    for count in (1, 1000):
        entries = {f"{n:064}": KeyEntry(HERE, parts) for n in range(count)}
        write_keys(tmp_path / "keys.json", entries)
        sizes.append((tmp_path / "keys.json").stat().st_size)
    assert (sizes[1] - sizes[0]) / 999 < 220


@given(
    st.recursive(st.none() | st.integers() | TEXT, lambda x: st.lists(x) | st.dictionaries(TEXT, x))
)
def test_foreign_json_is_refused(tmp_path_factory, document):
    path = tmp_path_factory.mktemp("folder") / "keys.json"
    path.write_text(json.dumps(document))
    with pytest.raises(ValueError, match="it is not a list of keys"):
        read_keys(path)


def test_a_damaged_file_is_reported_and_the_store_works_on(tmp_path):
    store = Store.create(tmp_path)
    store.keep_keys({"k": KeyEntry(HERE, {"seed": "0"})})
    text = (tmp_path / "keys.json").read_text()
    (tmp_path / "keys.json").write_text(text[:-5])
    assert store.load_keys() == {}
    assert "keys.json" in store.damaged[0]
    store.keep_keys({"k": KeyEntry(HERE, {"seed": "0"})})
    assert store.load_keys()["k"].parts == {"seed": "0"}


def test_parts_are_kept_as_long_as_their_record(tmp_path):
    store = Store.create(tmp_path)
    store.save(Record("a" * 64, "f", HERE, 0, "m", {}, Status.OK))
    one, other, third = (KeyEntry(HERE, {"seed": str(n)}) for n in range(3))
    store.keep_keys({"a" * 64: one, "b" * 64: other})
    store.keep_keys({"c" * 64: third})
    assert store.load_keys() == {"a" * 64: one, "c" * 64: third}
