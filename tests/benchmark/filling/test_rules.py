"""What the user takes in hand: gaps that stay open, models that are named, and nothing else."""

import shlex

import fill_workers
import numpy as np
import pandas as pd
import pytest

from mocapbench.benchmark import MODELS
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.filled_recording import fill, require_fillable
from mocapbench.benchmark.filling.gap_table import describe_options, tabulate_gaps
from mocapbench.benchmark.filling.messages import list_remarks
from mocapbench.benchmark.filling.requests.refusals import NothingToFillError
from mocapbench.benchmark.filling.requests.request import BEST, NamedEntries, select
from mocapbench.benchmark.filling.requests.rules import assign_models, mark_left

COMPARED = ("linear", "makima", "knn")
GAPS = ((20, 30, [0, 1]), (60, 75, [2]), (100, 104, [0, 1, 2, 3]), (150, 190, [3]))


def fill_here(recording, **entries):
    """Return a recording, filled; few models are compared."""
    workers = fill_workers.Here(failing={*MODELS.names()} - {*COMPARED})
    return fill(select(recording, NamedEntries(**entries)), workers, "low", lambda *_: None)


@pytest.fixture
def gappy(waves, hidden):
    """Return waves with gaps: of hip.rx and hip.ry, of knee.rx, of all, and of root.ty."""
    return waves().hide(hidden(*GAPS))


HAND = (
    {"leave": ("hip",)},
    {"leave": ("hip:20-30", "root.ty:150-170")},
    {"leave": ("hip:0-25",)},
    {"only": ("knee",)},
    {"only": ("*:100-103",), "leave": ("k*",)},
    {"model": "knee=linear,*=best"},
    {"model": "hip:100-103=knn,root=makima"},
    {"model": "knee=linear", "leave": ("hip.rx",)},
)


@pytest.mark.parametrize("hand", HAND, ids=str)
def test_what_the_hand_touches_is_left_or_named_and_all_else_is_the_same_to_the_bit(gappy, hand):
    before, after = fill_here(gappy), fill_here(gappy, **hand)
    written, left = after.request.target, before.request.target & ~after.request.target
    assert left.any() == ("leave" in hand or "only" in hand)
    assert np.isnan(after.recording.values[left]).all()
    rules = [one.partition("=")[::2] for one in hand.get("model", "").split(",")]
    masks = [
        mark_left(gappy, written, [rule], ()) for rule, model in rules if model not in ("", BEST)
    ]
    named = np.any(masks, axis=0) if masks else np.zeros_like(written)
    assert named.any() == ("model" in hand)
    same = written & ~named
    np.testing.assert_array_equal(after.recording.values[same], before.recording.values[same])
    for of_entries in ("models", "kinds", "std"):
        tables = [np.full(written.shape, "", object) for _ in range(2)]
        for table, filled in zip(tables, (before, after), strict=True):
            table[filled.request.target] = getattr(filled, of_entries)
        assert (tables[0][same].astype(str) == tables[1][same].astype(str)).all()
    assert {*before.choice.rankings} == {*after.choice.rankings}


def test_an_entry_whose_model_is_named_is_what_that_model_fills_everywhere(gappy):
    some = fill_here(gappy, model="knee=makima,hip:20-29=linear,*=knn")
    for model, block in (
        ("makima", np.s_[:, 2]),
        ("linear", np.s_[20:30, :2]),
        ("knn", np.s_[:, 3]),
    ):
        everywhere = fill_here(gappy, model=model)
        np.testing.assert_array_equal(
            some.recording.values[block], everywhere.recording.values[block]
        )
    assert some.choice is None


def test_where_all_that_is_written_is_named_there_is_no_choice(gappy):
    assert fill_here(gappy, model="knee=linear", only=("knee",)).choice is None
    assert fill_here(gappy, model="knee=linear", only=("k*", "root")).choice is not None


def test_a_model_that_fills_only_what_stays_open_need_not_be_able(gappy):
    entries = NamedEntries(model="hip=aligned-window,linear", leave=("hip",))
    require_fillable(select(gappy, entries), 0)
    with pytest.raises(UsageError, match="aligned-window"):
        require_fillable(select(gappy, NamedEntries(model="hip=aligned-window,linear")), 0)


def test_the_rules_of_each_row_remove_that_row_and_change_no_other(gappy):
    table = tabulate_gaps(fill_here(gappy, model="linear"))
    for number, rules in enumerate(table["leave"].str.split(",")):
        again = tabulate_gaps(fill_here(gappy, model="linear", leave=tuple(rules)))
        pd.testing.assert_frame_equal(again, table.drop(index=number).reset_index(drop=True))


@pytest.mark.parametrize("model", ["best", "linear", "makima"])
def test_the_said_option_fills_the_first_row_by_another_model(gappy, model):
    filled = fill_here(gappy, model=model)
    table = tabulate_gaps(filled)
    words = shlex.split(describe_options(filled, table))
    rules = words[words.index("--model") + 1].removesuffix(".")
    again = tabulate_gaps(fill_here(gappy, model=rules))
    assert again["model"][0] != table["model"][0]
    mixed = fill_here(gappy, model="knee=makima,linear")
    said = describe_options(mixed, tabulate_gaps(mixed))
    assert "write hip:20-29=makima first in --model. Other" in said
    pd.testing.assert_frame_equal(again[1:], table[1:])


@pytest.mark.parametrize(
    ("rule", "blocks"),
    [
        ("hip", [(20, 30, [0, 1]), (100, 104, [0, 1])]),
        ("hip.ry", [(20, 30, [1]), (100, 104, [1])]),
        ("*.r?", [(20, 30, [0, 1]), (60, 75, [2]), (100, 104, [0, 1, 2])]),
        ("[hk]*:0-62", [(20, 30, [0, 1]), (60, 63, [2])]),
        ("root:100-150", [(100, 104, [3]), (150, 151, [3])]),
        ("root:103-103", [(103, 104, [3])]),
        ("*:0-99999", GAPS),
    ],
)
def test_a_rule_names_a_joint_or_channel_or_a_pattern_and_frames_with_both_ends(
    gappy, hidden, rule, blocks
):
    target, named = hidden(*GAPS), hidden(*blocks)
    np.testing.assert_array_equal(mark_left(gappy, target, [rule], ()), named)
    np.testing.assert_array_equal(mark_left(gappy, target, (), [rule]), target & ~named)
    models = assign_models(gappy, target, f"{rule}=knn")
    np.testing.assert_array_equal(models == "knn", named[target])
    assert {*models[models != "knn"]} <= {BEST}


def test_names_with_colons_equals_signs_and_stars_can_be_named(waves, hidden):
    names = ("Ann:L=K.x", "Ann:L=K.y", "*12.x", "a,b:3-4.x")
    recording = waves().hide(hidden(*GAPS))
    recording = type(recording)("r", recording.times, recording.values, names, recording.units)
    for rule, channels in (("Ann:L=K", [0, 1]), ("[*]12", [2]), ("a?b:3-4:0-199", [3])):
        models = assign_models(recording, hidden(*GAPS), f"{rule}=linear,*=knn")
        wanted = np.nonzero(hidden(*GAPS))[1]
        np.testing.assert_array_equal(models == "linear", np.isin(wanted, channels))


def test_the_first_rule_that_names_an_entry_counts_and_one_that_comes_too_late_is_refused(
    gappy, hidden
):
    target = hidden(*GAPS)
    models = assign_models(gappy, target, "hip.rx=linear,hip=knn,makima")
    channels = np.nonzero(target)[1]
    assert models.tolist() == [("linear", "knn", "makima", "makima")[c] for c in channels.tolist()]
    np.testing.assert_array_equal(
        assign_models(gappy, target, "hip=knn,root=knn,knee=knn,*=best"), "knn"
    )
    with pytest.raises(UsageError, match=r"got 'hip.rx' after others .* put it before them"):
        assign_models(gappy, target, "hip=linear,hip.rx=knn")


@pytest.mark.parametrize("option", ["leave", "only", "model"])
@pytest.mark.parametrize(
    ("rule", "said"),
    [
        (
            "hipp",
            "got 'hipp', which names none: did you mean hip? Gaps to fill are hip:20-29, hip:1",
        ),
        (
            "knee:0-50",
            "got 'knee:0-50', which names none. Gaps to fill are knee:60-74, knee:100-103",
        ),
        (
            "elbow",
            "names none. Gaps to fill are hip:20-29, knee:60-74, hip:100-103, knee:100-103, root",
        ),
        (
            "hip:30-20",
            "expected the first frame before the last, as in LKNE:20-30, got 'hip:30-20'",
        ),
    ],
)
def test_a_rule_that_names_nothing_is_refused_with_names_and_gaps_that_are_near(
    gappy, option, rule, said
):
    named = {option: f"{rule}=linear" if option == "model" else (rule,)}
    with pytest.raises(UsageError) as error:
        select(gappy, NamedEntries(**named))
    assert str(error.value).startswith("waves: ") or rule == "hip:30-20"
    assert f"--{option}: " in str(error.value)
    assert said in str(error.value)


@pytest.mark.parametrize("rules", ["", "hip=", "=linear", "hip=linear,", ",linear"])
def test_what_is_no_rule_of_a_model_is_refused(gappy, rules):
    with pytest.raises(
        UsageError, match=r"--model: expected a model, or rules such as 'LKNE=linear"
    ):
        select(gappy, NamedEntries(model=rules))


def test_where_all_is_left_open_nothing_is_to_be_filled(gappy):
    for hand in ({"leave": ("*",)}, {"only": ("hip",), "leave": ("hip",)}):
        with pytest.raises(NothingToFillError, match="all left open by --leave or --only"):
            select(gappy, NamedEntries(**hand))


def test_what_is_left_open_is_counted_once_and_replaces_no_value(gappy, waves):
    said = " ".join(list_remarks(fill_here(gappy, model="linear", leave=("hip",))))
    assert "2 gaps were left open by --leave or --only: hip.rx and hip.ry." in said
    assert "stay hidden" not in said
    assert select(waves(), NamedEntries(frames=(50, 60), leave=("hip",))).replaced == 20
