import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.schedule import Contender
from mocapbench.benchmark.filling.filled_file import FilledFile
from mocapbench.benchmark.filling.gap_problem import PredictedEntries
from mocapbench.benchmark.filling.gaps import Gap
from mocapbench.benchmark.filling.input_files import InputFile
from mocapbench.benchmark.filling.messages import describe_choice, describe_fill, list_remarks
from mocapbench.benchmark.filling.requests.request import FillRequest, NamedEntries, select
from mocapbench.datasets import CSVFormat, Recording


@pytest.mark.parametrize(
    ("chosen", "n_train", "advised"), [(True, 2, True), (True, 1, False), (False, 2, False)]
)
def test_channels_of_which_nothing_is_visible_are_named(
    filled, choice_of, *, chosen, n_train, advised
):
    one = filled(choice_of({"one": [1, 2, 1]}) if chosen else None)
    request = one.input_file.request
    assert not any("nothing is visible" in remark for remark in list_remarks(one))
    target = request.target.copy()
    target[:, 2] = True
    request = replace(request, given=request.given.hide(target), target=target)
    input_file = replace(one.input_file, request=request, train=(request.given,) * n_train)
    prediction = PredictedEntries(np.zeros(target.sum()), None)
    (said,) = (
        r
        for r in list_remarks(replace(one, input_file=input_file, prediction=prediction))
        if "nothing is" in r
    )
    assert said.startswith(f"Of {request.given.channels[2]}, nothing is visible in the file")
    assert ("--model best-of" in said) is advised


def test_the_headline_counts(filled):
    assert describe_fill(filled()) == "one filled 20 entries in 1 gap."


def test_one_of_anything_is_singular(filled):
    one = filled(left_open=(Gap(100, 150, (0,)),))
    target = np.zeros_like(one.input_file.request.target)
    target[50, 0] = True
    given = one.input_file.request.given
    given = replace(given, values=np.where(given.visible, given.values, 0.0))
    hides_two = given.hide(target | np.roll(target, 1))
    request = replace(one.input_file.request, given=hides_two, target=target)
    input_file = replace(one.input_file, request=request)
    one = replace(one, input_file=input_file, prediction=PredictedEntries(np.zeros(1), np.ones(1)))
    said = [*list_remarks(one)]
    assert describe_fill(one) == "one filled 1 entry in 1 gap."
    assert "1 longer gap was left open." in said
    assert "1 hidden entry stays hidden, since it was not to be filled." in said


def test_that_nothing_could_be_compared_is_said_with_what_to_do(filled):
    assert describe_choice(filled()).startswith("The model was named, so no held-out gap")
    bare = filled()
    assert describe_choice(replace(bare, prediction=replace(bare.prediction, variance=None))) == ""
    said = describe_choice(replace(filled(), uncompared=True))
    assert said.startswith("Nothing could be compared, since no model filled a held-out gap")
    assert "raise --budget" in said


@pytest.mark.parametrize(
    ("errors", "said"),
    [
        ({"one": [1, 2, 1, 2, 1], "two": [5, 6, 5, 6, 5.1]}, "over two is more than chance"),
        ({"one": [1, 2, 1, 2, 1], "two": [2, 1, 2, 1, 2]}, "over two may be chance"),
        ({"one": [1], "two": [2]}, "too few to tell"),
        ({"one": [1, 2, 1, 2], "two": [5, 6, 5, 6.1]}, "too few to tell"),
        ({"one": [1, 2]}, "No other model could be compared with it"),
    ],
)
def test_the_verdict_says_whether_the_lead_is_more_than_chance(filled, choice_of, errors, said):
    assert said in describe_choice(filled(choice_of(errors)))


def test_what_was_done_is_said(filled, choice_of):
    kind = {"left_open": (Gap(100, 150, (0,)),), "n_windows": 3, "failed": (("two", "it broke"),)}
    said = " ".join(list_remarks(filled(choice_of({"one": [1, 2]}, share=0.25), **kind)))
    for words in ("1 longer gap was left open", "3 windows", "25 % as long", "two did better"):
        assert words in said


def test_models_that_err_much_more_are_not_named_beside_the_choice(filled, choice_of):
    """One gap decides, so that no test separates even a model that errs ten times as much."""
    errors = {"one": [1, 1, 1, 1, 1], "two": [1, 2, 1, 2, 1], "three": [1, 1, 1, 1, 99]}
    said = describe_choice(filled(choice_of(errors)))
    assert "Its lead over two may be chance" in said
    said = describe_choice(filled(choice_of({name: errors[name] for name in ("one", "three")})))
    assert said.startswith("It leads by far, but gaps differ too much for a test")


def test_values_of_the_file_that_are_repositiond_are_counted(filled):
    one = filled()
    request = replace(one.input_file.request, replaced=3)
    said = " ".join(list_remarks(replace(one, input_file=replace(one.input_file, request=request))))
    assert "3 filled entries have a value in the file, which the filled one replaces." in said


@pytest.fixture
def with_intervals(choice_of):
    """Return a function from what intervals hold in held-out gaps to a choice that has some."""

    def choice(in_intervals):
        bare = choice_of({"one": [1, 2], "two": [2, 1]})
        return replace(bare, with_intervals=frozenset({"one", "two"}), in_intervals=in_intervals)

    return choice


def test_the_verdict_says_what_intervals_hold_unless_another_model_filled(filled, with_intervals):
    choice = with_intervals(
        (np.ones(1000, dtype=bool), np.arange(204) < 127, np.ones(0, dtype=bool))
    )
    said = describe_choice(filled(choice))
    assert said.endswith("Its 95 % intervals hold 94 % of 1204 hidden entries in 3 held-out gaps.")
    assert "intervals" not in describe_choice(filled(choice, failed=(("two", "it broke"),)))
    assert "no time to check its intervals" in describe_choice(filled(with_intervals(())))


def test_the_verdict_says_nothing_of_intervals_that_there_are_not(filled, choice_of):
    assert "intervals" not in describe_choice(filled(choice_of({"one": [1, 2], "two": [2, 1]})))


def test_a_remark_says_that_the_choice_had_fewer_hold_outs(filled, choice_of):
    choice = replace(choice_of({"one": [1, 2], "two": [2, 1]}), unused=7)
    said = " ".join(list_remarks(filled(choice)))
    assert "one had no time for 7 more hold-outs that others filled" in said


@pytest.fixture
def said_without_intervals(filled, choice_of):
    """Return a function to the remarks on a choice without intervals, beside a model with some."""

    def said(has_intervals=True, n=5, failed=()):
        choice = choice_of({"one": [1, 2, 1, 2, 1][:n], "two": [2, 1, 2, 1, 2][:n]})
        choice = replace(choice, with_intervals=frozenset({"two"} if has_intervals else ()))
        bare = filled(choice, failed=failed)
        return " ".join(
            list_remarks(replace(bare, prediction=replace(bare.prediction, variance=None)))
        )

    return said


def test_a_model_with_intervals_that_hold_outs_cannot_tell_apart_is_named(said_without_intervals):
    words = said_without_intervals()
    assert "there are no intervals" in words
    assert "do not tell it apart from two, which has intervals" in words


@pytest.mark.parametrize(
    "case",
    [
        {"has_intervals": False},
        {"n": 4},  # too few to tell anything
        {"failed": (("two", "it broke"),)},
    ],
    ids=str,
)
def test_no_model_with_intervals_is_named_where_hold_outs_do_not_speak_for_it(
    said_without_intervals, case
):
    words = said_without_intervals(**case)
    assert "there are no intervals" in words
    assert "tell it apart" not in words


def test_a_model_with_intervals_that_is_behind_a_worse_one_is_not_named(filled, choice_of):
    """It errs so much more in some gaps than in others that no test separates it."""
    erratic = {"one": [1, 2, 1, 2, 1], "two": [3, 4, 3, 4, 3.1], "three": [1, 2, 99, 2, 1]}
    choice = choice_of(erratic)
    assert choice.ranking.sharing == ("one", "three")
    bare = filled(replace(choice, with_intervals=frozenset({"three"})))
    bare = replace(bare, prediction=replace(bare.prediction, variance=None))
    assert "tell it apart" not in " ".join(list_remarks(bare))


@pytest.mark.parametrize(
    ("visible", "train", "said"), [(9, False, True), (10, False, False), (9, True, False)]
)
def test_a_channel_of_which_little_is_visible_is_named(filled, waves, visible, train, said):
    target = np.zeros((200, 4), dtype=bool)
    target[visible:, 1] = True
    request = FillRequest(waves().hide(target), target, ())
    prediction = PredictedEntries(waves().values[target], np.ones(int(target.sum())))
    others = (waves(name="other"),) if train else ()
    input_file = replace(filled().input_file, request=request, train=others)
    words = " ".join(list_remarks(replace(filled(), input_file=input_file, prediction=prediction)))
    assert (f"only {visible} frames are visible" in words) == said


def test_unlabelled_markers_that_stay_as_they_are_are_counted_once(filled, waves, hidden):
    given = waves().hide(hidden((5, 200, [1, 2, 3])))
    given = replace(given, channels=("hip.rx", "*12.x", "*12.y", "*12.z"))
    target = hidden((50, 60, [0]))
    request = FillRequest(given.hide(target), target, (), given.channels[1:])
    one = filled()
    one = replace(one, input_file=replace(one.input_file, request=request))
    (said,) = list_remarks(
        replace(one, prediction=PredictedEntries(waves().values[target], np.ones(10)))
    )
    assert said.startswith("1 unlabelled marker (*12) stays as it is: name it with --channels")


@pytest.mark.parametrize(("fill_ends", "count"), [(False, 36), (True, 20)])
def test_what_is_open_at_the_ends_is_counted_beside_the_gaps(
    filled, waves, hidden, fill_ends, count
):
    mask = hidden((0, 5, [0, 1, 2, 3]), (5, 13, [0, 1]), (50, 60, [3]))
    request = select(waves().hide(mask), NamedEntries(fill_ends=fill_ends))
    prediction = PredictedEntries(waves().values[request.target], None)
    input_file = replace(filled().input_file, request=request)
    one = replace(filled(), input_file=input_file, prediction=prediction)
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
    target = hidden(*gaps)
    request = FillRequest(waves().hide(target), target, ())
    one = replace(
        filled(), prediction=PredictedEntries(waves().values[target], np.ones(int(target.sum())))
    )
    found = [
        remark
        for remark in list_remarks(
            replace(one, input_file=replace(one.input_file, request=request))
        )
        if "on one side only" in remark
    ]
    assert [remark.startswith(said) for remark in found] == [True] * bool(said)
    for _, _, channels in gaps if said else ():
        assert all(request.given.channels[channel] in found[0] for channel in channels)


def test_a_jump_at_an_edge_is_said(filled):
    raised = replace(filled(), prediction=PredictedEntries(np.full(20, 99.0), np.ones(20)))
    (said,) = list_remarks(raised)
    assert said.startswith("At 4 edges of gaps, a channel jumps further than between any two")
    assert "deg at frame 5" in said


def test_times_that_are_probably_not_in_seconds_are_said(filled):
    given = filled()
    request = given.input_file.request
    for interval, said in ((0.49, False), (0.51, True)):
        times = interval * np.arange(len(request.given.times))
        late = replace(request, given=replace(request.given, times=times))
        found = replace(given, input_file=replace(given.input_file, request=late))
        assert ("in milliseconds" in " ".join(list_remarks(found))) == said


def test_one_frame_has_no_interval_to_remark_on():
    given = Recording("one", [0.0], [[1.0, np.nan]], ("a", "b"), ("deg", "deg"))
    target = np.array([[False, True]])
    input_file = InputFile(Path("one.csv"), CSVFormat(), FillRequest(given, target, ()), ())
    filled = FilledFile(input_file, "one", PredictedEntries(np.zeros(1), np.ones(1)), 0, None, ())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        (said,) = list_remarks(filled)
    assert "only 0 frames are visible" in said


def test_nothing_special_is_passed_over_in_silence(filled):
    assert list(list_remarks(filled())) == []


def test_models_that_had_no_time_are_said(filled, choice_of):
    late = tuple(Contender(f"slow {n}", failure="too slow", timed_out=True) for n in range(6))
    broken = Contender("broken", failure="ValueError")
    choice = replace(choice_of({"one": [1, 2]}), left_out=(*late[:3], broken, *late[3:]))
    (said,) = list_remarks(filled(choice))
    assert "slow 0, slow 1, slow 2, slow 3 and 2 more" in said
    assert "--budget" in said
    assert list(list_remarks(filled(replace(choice, left_out=(broken,))))) == []


@pytest.mark.parametrize(("apart", "slow"), [(0.02, False), (0.5, False), (0.6, True)])
@pytest.mark.parametrize("start", [0.0, 1000.0])
def test_times_that_seem_to_be_milliseconds_are_doubted_wherever_they_begin(
    filled, apart, slow, start
):
    one = filled()
    request = one.input_file.request
    times = start + apart * np.arange(len(request.given.times))
    request = replace(request, given=replace(request.given, times=times))
    one = replace(one, input_file=replace(one.input_file, request=request))
    said = [
        remark for remark in list_remarks(one) if remark.startswith(f"Frames are {apart} s apart")
    ]
    assert len(said) == slow
    assert any("s apart" in remark for remark in list_remarks(one)) is slow
