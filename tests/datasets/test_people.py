"""Lists of people: what they say of folds and strangers, and what is refused with its line."""

import numpy as np
import pytest

from mocapbench.datasets import (
    FormatError,
    GaitLibrary,
    People,
    generated_people,
    read_people,
    registered_digests,
)
from mocapbench.datasets.keys import split_key

HEADS = "subject\ttrial\tperson\trate\trole\tshows"
PEOPLE = read_people()
LISTS = {"recordings": PEOPLE, "generated": generated_people()}


def people_of(*rows):
    return People("\n".join([HEADS, *("\t".join(row.split()) for row in rows)]), "list.tsv")


@pytest.mark.parametrize("people", LISTS.values(), ids=LISTS)
def test_there_are_thirty_people_with_one_to_three_test_recordings_each(people):
    assert len(people.subjects) == 30
    assert all(1 <= len(people.tests(subject)) <= 3 for subject in people.subjects)
    assert people.most_strangers >= 100


def test_digests_of_all_recordings_and_skeletons_are_registered():
    known = registered_digests()
    for uri in PEOPLE.recordings:
        key = uri.removeprefix("cmu:")
        subject, _ = split_key(key)
        assert {f"subjects/{subject}/{subject}.asf", f"subjects/{subject}/{key}.amc"} <= set(known)


@pytest.mark.parametrize("people", LISTS.values(), ids=LISTS)
def test_no_tested_person_and_no_test_recording_is_among_the_strangers(people):
    tests = {uri for subject in people.subjects for uri in people.tests(subject)}
    persons = {s: people.person(s) for s in people.subjects}
    for subject in people.subjects:
        strangers = people.strangers(subject, 100)
        assert len(set(strangers)) == 100
        assert not tests & set(strangers)
        of_fold = {persons[s] for s in people.subjects if people.fold(s) == people.fold(subject)}
        assert persons[subject] in of_fold
        found = {people.person(split_key(uri.partition(":")[2])[0]) for uri in strangers}
        assert not found & of_fold


@pytest.mark.parametrize("people", LISTS.values(), ids=LISTS)
def test_fewer_strangers_are_the_first_of_more_and_of_as_many_people_as_can_be(people):
    for subject in people.subjects:
        hundred = people.strangers(subject, 100)
        assert people.strangers(subject, 10) == hundred[:10]
        assert len({uri.partition("_")[0] for uri in hundred[:10]}) == 10


def test_own_recordings_are_up_to_three_others_of_the_subject():
    for subject in PEOPLE.subjects:
        own = PEOPLE.own(subject)
        assert len(own) <= 3
        assert not set(own) & set(PEOPLE.tests(subject))
        assert all(uri.startswith(f"cmu:{subject}_") for uri in own)
    assert [subject for subject in PEOPLE.subjects if not PEOPLE.own(subject)] == ["11", "12"]


def test_partners_of_a_dance_are_one_person_and_never_strangers():
    assert PEOPLE.person("60") == PEOPLE.person("61") == "60"
    assert PEOPLE.fold("60") == PEOPLE.fold("61")
    assert PEOPLE.rate("cmu:61_05") == 60


@pytest.mark.parametrize("people", LISTS.values(), ids=LISTS)
def test_every_group_leaves_about_two_thirds(people):
    sizes = [sum(people.fold(s) == fold for s in people.subjects) for fold in range(3)]
    assert min(sizes) >= 8


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (
            ["02 01 02 120 test walk", "02 01 02 120 test walk"],
            "list.tsv, line 3: expected every recording once, got cmu:02_01 twice, first on line 2",
        ),
        (
            ["02 01 02 120 test walk", "02 01 02 120 train walk"],
            "list.tsv, line 3: expected every recording once, got cmu:02_01 as test and as train",
        ),
        (
            ["02 01 02 120 test walk", "03 01 03 120 train walk", "02 02 02 120 train walk"],
            "list.tsv, line 4: expected every subject once, got 02 again, after line 2",
        ),
        (
            ["02 01 02 120 test walk", "02 02 03 120 train walk"],
            "list.tsv, line 3: expected one person for subject 02, got 02 before and 03 here",
        ),
        (["02 01 02 100 test walk"], "line 2: expected a rate that is a multiple of 30, got 100"),
        (["02 01 02 0 test walk"], "line 2: expected a rate that is a multiple of 30, got 0"),
        (["02 01 02 120 both walk"], "line 2: expected the role test or train, got both"),
        (["2 1 02 120 test walk"], "line 2: expected a subject and a trial, got 2_1"),
        (["02 01 02 120 test"], "line 2: expected 6 cells, got 5"),
        (["02 01 02 120 train walk"], "list.tsv: expected recordings in the role test, got none"),
        (
            ["60 01 60 120 test walk", "61 01 060 120 test walk"],
            "list.tsv, line 3: expected a subject of this list as the person, got 060; write 61, "
            "or another subject who is the same person",
        ),
    ],
)
def test_a_bad_row_is_refused_with_its_line(rows, said):
    with pytest.raises(FormatError) as error:
        people_of(*rows)
    assert said in str(error.value)


@pytest.mark.parametrize("text", ["", "subject,trial\n02,01"])
def test_a_list_without_its_heads_is_refused(text):
    with pytest.raises(FormatError, match=r"heads subject, trial, .*, got (nothing|subject,trial)"):
        People(text, "list.tsv")


@pytest.mark.parametrize("person", ["", "02 "])
def test_a_person_that_is_empty_or_has_a_blank_is_refused(person):
    row = f"02\t01\t{person}\t120\ttest\twalk"
    with pytest.raises(FormatError, match=r"line 2: expected a subject of this list"):
        People(f"{HEADS}\n{row}", "list.tsv")


def test_empty_lines_do_not_count():
    people = People(f"{HEADS}\n\n02\t01\t02\t120\ttest\twalk\n\n", "list.tsv")
    assert people.subjects == ("02",)


def test_a_list_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(FormatError, match=r"none.tsv: expected a list of people, got No such file"):
        read_people(tmp_path / "none.tsv")


def test_a_list_that_is_no_text_is_refused(tmp_path):
    (tmp_path / "list.tsv").write_bytes(b"subject\xff")
    with pytest.raises(FormatError, match=r"list.tsv: expected text in UTF-8, got the byte 0xff"):
        read_people(tmp_path / "list.tsv")


def test_a_list_of_ones_own_is_read(tmp_path):
    (tmp_path / "list.tsv").write_text(f"{HEADS}\n02\t01\t02\t120\ttest\twalk\n")
    people = read_people(tmp_path / "list.tsv")
    assert (people.subjects, people.recordings) == (("02",), ("cmu:02_01",))


def test_generated_people_have_bodies_of_their_own_and_others_share_one():
    def lengths(key):
        return np.array([s.length for s in GaitLibrary().skeleton(key).segments])

    walkers = np.array([lengths(f"{walker}_01") for walker in range(101, 131)])
    assert len(np.unique(walkers, axis=0)) == 30
    statures = walkers.sum(axis=1) / lengths("01_01").sum()
    assert 0.8 < statures.min() < 0.95
    assert 1.05 < statures.max() < 1.25
    np.testing.assert_array_equal(lengths("01_01"), lengths("99_01"))
    np.testing.assert_array_equal(lengths("101_01"), lengths("101_02"))


def test_a_generated_walker_is_the_same_on_both_sides():
    segments = {s.name: s.length for s in GaitLibrary().skeleton("105_01").segments}
    of_gait = {s.name: s.length for s in GaitLibrary().skeleton("01_01").segments}
    grown = {name: segments[name] / of_gait[name] for name in segments if of_gait[name]}
    for name, factor in grown.items():
        if name[0] == "l" and f"r{name[1:]}" in grown:
            assert factor == pytest.approx(grown[f"r{name[1:]}"])
