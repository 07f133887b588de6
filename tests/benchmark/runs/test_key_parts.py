"""The parts of keys differ where keys do, and nowhere else."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.foreign_files import ForeignFileError, encode_json
from mocapbench.benchmark.runs.key_parts import encode_keys, key_parts, read_keys
from mocapbench.benchmark.runs.keys import key_of
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.request import Request
from mocapbench.benchmark.tasks.address import Address

TEXT = st.text("ab:é", max_size=3)
LONG = st.sampled_from(["a" * 64, "b" * 64, "a"])
DIGESTS = st.dictionaries(TEXT, LONG, max_size=2)
FITTED = st.fixed_dictionaries(
    {
        "problem": st.tuples(
            st.just("task"),
            st.integers(1, 2),
            TEXT,
            st.just(0),
            st.just("label"),
            st.integers(0, 2),
            DIGESTS,
        ),
        "posed by": st.lists(LONG, max_size=2),
        "training": TEXT,
        "entrant": st.tuples(TEXT, st.dictionaries(TEXT, st.integers(0, 2) | TEXT, max_size=2)),
        "source": st.tuples(LONG, LONG, LONG),
        "libraries": st.dictionaries(st.sampled_from(["numpy", "scipy"]), TEXT),
    }
)
SCORED = st.fixed_dictionaries(
    {
        "metrics": st.dictionaries(TEXT, st.lists(LONG), max_size=2),
        "scored against": st.tuples(st.just("case"), DIGESTS),
    }
)


def _key(fitted, scored):
    return key_of({**scored, "fit": key_of(fitted)})


@given(FITTED, FITTED, SCORED, SCORED)
def test_parts_are_equal_just_where_keys_are(fitted, other_fitted, scored, other_scored):
    one, other = (fitted, scored), (other_fitted, other_scored)
    assert (key_parts(*one) == key_parts(*other)) == (_key(*one) == _key(*other))


@given(FITTED, SCORED, st.data())
def test_one_change_is_one_part(fitted, scored, data):
    name, value = data.draw(
        st.sampled_from(
            [("posed by", ["new"]), ("source", ("new", *fitted["source"][1:])), ("libraries", None)]
        )
    )
    changed = value or {**fitted["libraries"], "numpy": "of tomorrow"}
    before, after = key_parts(fitted, scored), key_parts({**fitted, name: changed}, scored)
    differing = [n for n in {**before, **after} if before.get(n) != after.get(n)]
    expected = {"posed by": "task code", "source": "model code", "libraries": "version of numpy"}
    assert differing == [expected[name]]


@pytest.mark.slow
@pytest.mark.parametrize("profile", ["smoke", "quick"])
def test_within_a_row_each_key_has_its_own_parts(profile):
    archive = archive_at()
    jobs = [j for seed in (0, 1) for j in plan(Request(profile, seed=seed), archive)]
    assert len({(job.address, *job.parts.items()) for job in jobs}) == len(
        {(job.address, job.key) for job in jobs}
    )
    assert all(len(text) <= 40 for job in jobs for text in job.parts.values())


ADDRESS = st.builds(Address, TEXT, st.integers(1, 9), TEXT, st.integers(0, 9), TEXT)
ENTRY = st.tuples(ADDRESS, st.dictionaries(TEXT, TEXT, max_size=4))


@given(entries=st.dictionaries(st.text("0123abc", min_size=1), ENTRY, max_size=5))
def test_the_parts_of_keys_survive_a_file(tmp_path_factory, entries):
    path = tmp_path_factory.getbasetemp() / "keys.json"
    path.write_bytes(encode_json(encode_keys(entries)))
    assert read_keys(path) == entries


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"parts": []}, "expected numbers below 0, got one beyond"),
        ({"parts": [["a"]]}, r"at parts\[0\], expected a list of length 2"),
        ({"keys": {"k": ["t", 1, "c", 0, "l"]}}, r"at keys\[...\], expected a list of length 6"),
        ({"keys": {"k": ["t", 1, "c", 0, "l", [-1]]}}, "expected a whole number >= 0"),
        ({"keys": {"../k": ["t", 1, "c", 0, "l", []]}}, "at key in keys, expected text that names"),
        ({"format": 2}, "at format"),
    ],
    ids=str,
)
def test_what_is_no_list_of_keys_is_told_with_its_place(tmp_path, change, said):
    path = tmp_path / "keys.json"
    here = Address("t", 1, "c", 0, "label")
    path.write_bytes(encode_json({**encode_keys({"k": (here, {"seed": "0"})}), **change}))
    with pytest.raises(ForeignFileError, match=f"keys.json: expected a list of keys; .*{said}"):
        read_keys(path)


def test_a_part_stands_once_however_many_keys_have_it():
    parts = {f"metric {n}": f"sha256:{n:016}" for n in range(20)}
    here, sizes = Address("t", 1, "c", 0, "label"), []
    for count in (1, 1000):
        entries = {f"{n:064}": (here, parts) for n in range(count)}
        sizes.append(len(json.dumps(encode_keys(entries))))
    assert (sizes[1] - sizes[0]) / 999 < 220


def test_entries_make_one_file_in_whatever_order_they_come():
    address = Address("t", 1, "c", 0, "label")
    entries = [(f"{n}", (address, {"seed": f"{n % 2}", "metric": f"{n % 3}"})) for n in range(6)]
    (first,) = {str(encode_keys(dict(e))) for e in (entries, entries[::-1], entries[3:] + entries)}
    assert first


def test_the_folds_of_a_row_share_what_their_keys_cover():
    request = Request("smoke", ("toy-interpolation-1",), ("trivial", "knn"), folds=20)
    jobs = plan(request, archive_at())
    rows = {job.address._replace(fold=None) for job in jobs}
    assert len({id(job.parts) for job in jobs}) == len(rows) < len(jobs)
