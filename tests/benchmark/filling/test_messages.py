import warnings
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.halving import Contender
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.gaps import Gap
from mocapbench.benchmark.filling.messages import describe_choice, describe_fill, list_remarks
from mocapbench.benchmark.filling.requests.request import FillRequest, NamedEntries, select
from mocapbench.datasets import Recording


def ask(given, target, **special):
    """Return the request of filling a target by the best model."""
    return FillRequest(given.hide(target), target, np.full(int(target.sum()), "best"), **special)


@pytest.mark.parametrize(
    ("chosen", "n_train", "advised"), [(True, 2, True), (True, 1, False), (False, 2, False)]
)
def test_channels_of_which_nothing_is_visible_are_named(
    filled, choice_of, waves, hidden, *, chosen, n_train, advised
):
    choice = choice_of({"one": [1, 2, 1]}) if chosen else None
    assert not any("nothing is visible" in remark for remark in list_remarks(filled(choice)))
    target = hidden((50, 60, [0, 1]), (0, 200, [2]))
    request = ask(waves(), target, train=(waves(),) * n_train)
    remarks = list_remarks(filled(choice, request, 0.0))
    (said,) = (remark for remark in remarks if "nothing is" in remark)
    assert said.startswith("Of knee.rx, nothing is visible in the file")
    assert ("--model best-of" in said) is advised


def test_the_headline_counts(filled):
    assert describe_fill(filled()) == "one filled 20 entries in 1 gap."


def test_the_headline_names_each_model_with_what_it_filled_the_one_of_most_first(filled):
    one = filled()
    models = np.where(np.arange(20) % 2, "one", "two")
    models[:2] = "six", "one"
    said = describe_fill(replace(one, models=models, n_windows=dict.fromkeys(models, 0)))
    assert said == (
        "one filled 10 entries in 1 gap, two filled 9 entries in 1 gap and "
        "six filled 1 entry in 1 gap."
    )


def test_the_headline_names_models_that_were_not_compared(filled, choice_of):
    choice = choice_of({"one": [1, 2, 1, 2, 1], "two": [2, 1, 2, 1, 2]})
    assert "Not compared" not in describe_fill(filled(choice))
    early = Contender("early", [None], ending="erred too much")
    late = Contender("late", ending="would take 40 s of work")
    contenders = (*choice.contenders, early, late)
    lacking = replace(choice, contenders=contenders, too_dear=("dear",))
    assert describe_fill(filled(lacking)).endswith(" Not compared: late and dear.")


def test_one_of_anything_is_singular(filled, waves, hidden):
    target = hidden((50, 51, [0]))
    request = ask(waves().hide(np.roll(target, 1)), target, left_open=(Gap(100, 150, (0,)),))
    one = filled(request=request)
    said = [*list_remarks(one)]
    assert describe_fill(one) == "one filled 1 entry in 1 gap."
    assert "1 longer gap was left open." in said
    assert "1 hidden entry stays hidden, since it was not to be filled." in said


def test_that_nothing_could_be_compared_is_said_if_there_are_intervals(filled):
    (said,) = describe_choice(filled())
    assert said.startswith("The model was named, so no held-out gap")
    assert [*describe_choice(filled(variance=None))] == []


@pytest.mark.parametrize(
    ("errors", "said"),
    [
        (
            {"one": [1, 2, 1, 2, 1], "two": [5, 6, 5, 6, 5.1]},
            "one leads two by more than chance, over 5 held-out gaps.",
        ),
        (
            {"one": [1, 2, 1, 2, 1], "two": [2, 1, 2, 1, 2]},
            "The lead of one over two may be chance, over 5 held-out gaps.",
        ),
        ({"one": [1], "two": [2]}, "one did best in 1 held-out gap, too few to tell"),
        ({"one": [1, 2, 1, 2], "two": [5, 6, 5, 6.1]}, "too few to tell"),
        ({"one": [1, 2]}, "one alone was compared to the end, over 2 held-out gaps."),
    ],
)
def test_the_verdict_says_whether_the_lead_is_more_than_chance(filled, choice_of, errors, said):
    (verdict,) = describe_choice(filled(choice_of(errors)))
    assert verdict.startswith("one marker or joint, up to 0.25 s, deg: ")
    assert said in verdict


def test_each_kind_of_gap_has_a_verdict(filled, choice_of):
    short = choice_of({"one": [1, 2, 1, 2, 1], "two": [5, 6, 5, 6, 5.1]})
    long = choice_of({"one": [5, 6, 5, 6, 5.1], "two": [1, 2, 1, 2, 1]})
    kinds = Kind("deg", "whole frames", "up to 1 s"), Kind("deg", "whole frames", "longer")
    rankings = [*short.rankings.values(), *long.rankings.values()]
    choice = replace(short, rankings=dict(zip(kinds, rankings, strict=True)))
    assert [*describe_choice(filled(choice))] == [
        "whole frames, up to 1 s, deg: one leads two by more than chance, over 5 held-out gaps.",
        "whole frames, longer, deg: two leads one by more than chance, over 5 held-out gaps.",
    ]


def test_what_was_done_is_said(filled, choice_of):
    kind = {"left_open": (Gap(100, 150, (0,)),), "n_windows": 3, "failed": {"two": "it broke"}}
    said = " ".join(list_remarks(filled(choice_of({"one": [1, 2]}, share=0.25), **kind)))
    for words in ("1 longer gap was left open", "3 windows", "25 % as long", "two did better"):
        assert words in said


def test_models_that_err_much_more_are_not_named_beside_the_choice(filled, choice_of):
    """One gap decides, so that no test separates even a model that errs ten times as much."""
    errors = {"one": [1, 1, 1, 1, 1], "two": [1, 2, 1, 2, 1], "three": [1, 1, 1, 1, 99]}
    (said,) = describe_choice(filled(choice_of(errors)))
    assert "The lead of one over two may be chance" in said
    alone = choice_of({name: errors[name] for name in ("one", "three")})
    (said,) = describe_choice(filled(alone))
    assert "one leads by far, but gaps differ too much for a test" in said
    (said,) = describe_choice(filled(replace(alone, too_dear=("dear",))))
    assert "one errs least of those compared" in said


def test_that_limits_struck_is_said_first(filled):
    said, *_ = list_remarks(filled(stopped=("slow", "hungry")))
    assert said.startswith("This cannot be repeated elsewhere: slow and hungry exceeded a limit")


def test_values_of_the_file_that_are_replaced_are_counted(filled, waves, hidden):
    request = ask(waves(), hidden((50, 60, [0, 1])), replaced=3)
    said = " ".join(list_remarks(filled(request=request)))
    assert "3 filled entries have a value in the file, which the filled one replaces." in said


@pytest.fixture
def with_intervals(choice_of):
    """Return a function from what intervals hold in held-out gaps to a choice that has some."""

    def choice(in_intervals):
        bare = choice_of({"one": [1, 2], "two": [2, 1]})
        held = {kind: in_intervals for kind in bare.rankings if in_intervals is not None}
        return replace(bare, with_intervals=frozenset({"one", "two"}), in_intervals=held)

    return choice


def test_the_verdict_says_what_intervals_hold(filled, with_intervals):
    (said,) = describe_choice(filled(with_intervals(np.arange(1204) < 1132)))
    assert said.endswith("Its 95 % intervals hold 94 % of 1204 hidden entries.")
    (said,) = describe_choice(filled(with_intervals(None)))
    assert said.endswith("Its intervals were not checked: --effort high has the work for it.")


def test_the_verdict_says_nothing_of_intervals_that_there_are_not(filled, choice_of):
    (said,) = describe_choice(filled(choice_of({"one": [1, 2], "two": [2, 1]})))
    assert "intervals" not in said


@pytest.fixture
def said_without_intervals(filled, choice_of):
    """Return a function to the remarks on a choice without intervals, beside a model with some."""

    def said(has_intervals=True, n=5):
        choice = choice_of({"one": [1, 2, 1, 2, 1][:n], "two": [2, 1, 2, 1, 2][:n]})
        choice = replace(choice, with_intervals=frozenset({"two"} if has_intervals else ()))
        return " ".join(list_remarks(filled(choice, variance=None)))

    return said


def test_a_model_with_intervals_that_hold_outs_cannot_tell_apart_is_named(said_without_intervals):
    words = said_without_intervals()
    assert "there are no intervals" in words
    assert "do not tell it apart from two, which has intervals" in words


@pytest.mark.parametrize("case", [{"has_intervals": False}, {"n": 4}], ids=str)
def test_no_model_with_intervals_is_named_where_hold_outs_do_not_speak_for_it(
    said_without_intervals, case
):
    words = said_without_intervals(**case)
    assert "there are no intervals" in words
    assert "tell it apart" not in words


def test_a_model_with_intervals_that_is_behind_a_worse_one_is_not_named(filled, choice_of):
    """It errs so much more in some gaps than in others that no test separates it."""
    erratic = {"one": [1, 2, 1, 2, 1], "two": [3, 4, 3, 4, 3.1], "three": [1, 2, 99, 2, 1]}
    choice = replace(choice_of(erratic), with_intervals=frozenset({"three"}))
    (ranking,) = choice.rankings.values()
    assert ranking.sharing == ("one", "three")
    assert "tell it apart" not in " ".join(list_remarks(filled(choice, variance=None)))


@pytest.mark.parametrize(
    ("visible", "train", "said"), [(9, False, True), (10, False, False), (9, True, False)]
)
def test_a_channel_of_which_little_is_visible_is_named(
    filled, waves, hidden, *, visible, train, said
):
    others = (waves(name="other"),) if train else ()
    request = ask(waves(), hidden((visible, 200, [1])), train=others)
    words = " ".join(list_remarks(filled(request=request)))
    assert (f"only {visible} frames are visible" in words) == said


def test_unlabelled_markers_that_stay_as_they_are_are_counted_once(filled, waves, hidden):
    given = waves().hide(hidden((5, 200, [1, 2, 3])))
    given = replace(given, channels=("hip.rx", "*12.x", "*12.y", "*12.z"))
    request = ask(given, hidden((50, 60, [0])), unlabelled=given.channels[1:])
    (said,) = list_remarks(filled(request=request))
    assert said.startswith("1 unlabelled marker (*12) stays as it is: name it with --channels")


@pytest.mark.parametrize(("fill_ends", "count"), [(False, 36), (True, 20)])
def test_what_is_open_at_the_ends_is_counted_beside_the_gaps(
    filled, waves, hidden, fill_ends, count
):
    mask = hidden((0, 5, [0, 1, 2, 3]), (5, 13, [0, 1]), (50, 60, [3]))
    request = select(waves().hide(mask), NamedEntries(fill_ends=fill_ends))
    one = filled(request=request, variance=None)
    assert describe_fill(one).endswith(f", and left {count} open at the ends.")
    remarks = " ".join(list_remarks(one))
    assert "Nothing is visible in 5 frames at the beginning or the end, which stay" in remarks
    stay = "Of hip.rx and hip.ry, 16 entries before the first visible one or after the last stay"
    assert (stay in remarks) != fill_ends
    assert ("1 gap is at the beginning or the end of the recording" in remarks) == fill_ends
    assert "not to be filled" not in remarks


@pytest.mark.parametrize(
    ("gaps", "said"),
    [
        ([(0, 10, [0, 1])], "1 gap is at the beginning or the end"),
        ([(190, 200, [3]), (0, 5, [1])], "2 gaps are at the beginning or the end"),
        ([(1, 10, [0]), (100, 199, [1])], ""),
        ([(0, 200, [2])], ""),  # visible nowhere, which another caution says
    ],
)
def test_gaps_with_frames_on_one_side_only_are_counted(filled, waves, hidden, gaps, said):
    request = ask(waves(), hidden(*gaps))
    remarks = list_remarks(filled(request=request))
    found = [remark for remark in remarks if "on one side only" in remark]
    assert [remark.startswith(said) for remark in found] == [True] * bool(said)
    for _, _, channels in gaps if said else ():
        assert all(request.given.channels[channel] in found[0] for channel in channels)


def test_a_jump_at_an_edge_is_said(filled):
    (said,) = list_remarks(filled(mean=99.0))
    assert said.startswith("At 4 edges of gaps, a channel jumps further than between any two")
    assert "deg at frame 5" in said


def test_one_frame_has_no_interval_to_remark_on(filled):
    given = Recording("one", [0.0], [[1.0, np.nan]], ("a", "b"), ("deg", "deg"))
    request = ask(given, np.array([[False, True]]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        (said,) = list_remarks(filled(request=request, mean=0.0))
    assert "only 0 frames are visible" in said


def test_nothing_special_is_passed_over_in_silence(filled):
    assert list(list_remarks(filled())) == []


@pytest.mark.parametrize(
    ("apart", "slow"), [(0.02, False), (0.49, False), (0.5, False), (0.51, True), (0.6, True)]
)
@pytest.mark.parametrize("start", [0.0, 1000.0])
def test_times_that_seem_to_be_milliseconds_are_doubted_wherever_they_begin(
    filled, waves, hidden, *, apart, slow, start
):
    late = replace(waves(), times=start + apart * np.arange(200))
    said = [*list_remarks(filled(request=ask(late, hidden((50, 60, [0, 1])))))]
    assert len([remark for remark in said if remark.startswith(f"Frames are {apart} s")]) == slow
    assert any("in milliseconds" in remark for remark in said) is slow
