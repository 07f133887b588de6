from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.inspection.explanation import PartChange, changes, in_words

PARTS = st.dictionaries(st.sampled_from("abcde"), st.sampled_from(["1", "2", "sha256:3"]))


@given(PARTS, PARTS)
def test_changes_lead_from_one_to_the_other_and_back(one, other):
    there, back = changes(one, other), changes(other, one)
    kept = {name: text for name, text in one.items() if name not in {c.part for c in there}}
    assert kept | {c.part: c.after for c in there if c.after} == other
    assert sorted(there) == sorted(PartChange(c.part, c.after, c.before) for c in back)
    assert (there == ()) == (one == other)


def test_short_values_are_shown_and_digests_are_not():
    named = {
        "seed 0 → 1": PartChange("seed", "0", "1"),
        "model code": PartChange("model code", "sha256:a", "sha256:b"),
        "parameter size added 3": PartChange("parameter size", "", "3"),
        "parameter size left out 3": PartChange("parameter size", "3", ""),
        "metric mse added": PartChange("metric mse", "", "sha256:a"),
        "metric mse left out": PartChange("metric mse", "sha256:a", ""),
        "recording r": PartChange("recording r", '"missing"', "sha256:a"),
    }
    assert {in_words([change]) for change in named.values()} == set(named)
    assert in_words(named.values()).count(", ") == len(named) - 1


def test_many_changes_of_a_kind_are_counted():
    several = [PartChange(f"recording {n}", "sha256:a", "sha256:b") for n in range(5)]
    assert in_words([*several, PartChange("seed", "0", "1")]) == "5 recordings, seed 0 → 1"
    assert in_words(several[:3]) == "recording 0, recording 1, recording 2"
