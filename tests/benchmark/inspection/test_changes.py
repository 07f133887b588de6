from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.inspection.explanation import changes, in_words

PARTS = st.dictionaries(st.sampled_from("abcde"), st.sampled_from(["1", "2", "sha256:3"]))


@given(PARTS, PARTS)
def test_changes_lead_from_one_to_the_other_and_back(one, other):
    there, back = changes(one, other), changes(other, one)
    kept = {name: text for name, text in one.items() if name not in there}
    assert kept | {name: after for name, (_, after) in there.items() if after} == other
    assert there == {name: values[::-1] for name, values in back.items()}
    assert (there == {}) == (one == other)


def test_short_values_are_shown_and_digests_are_not():
    named = {
        "seed 0 → 1": {"seed": ("0", "1")},
        "model code": {"model code": ("sha256:a", "sha256:b")},
        "parameter size added 3": {"parameter size": ("", "3")},
        "parameter size left out 3": {"parameter size": ("3", "")},
        "metric mse added": {"metric mse": ("", "sha256:a")},
        "metric mse left out": {"metric mse": ("sha256:a", "")},
        "recording r": {"recording r": ('"missing"', "sha256:a")},
    }
    assert {in_words(change) for change in named.values()} == set(named)
    every = {part: values for change in named.values() for part, values in change.items()}
    assert in_words(every).count(", ") == len(every) - 1


def test_many_changes_of_a_kind_are_counted():
    five, three = (
        {f"recording {n}": ("sha256:a", "sha256:b") for n in range(size)} for size in (5, 3)
    )
    assert in_words({**five, "seed": ("0", "1")}) == "5 recordings, seed 0 → 1"
    assert in_words(three) == "recording 0, recording 1, recording 2"
