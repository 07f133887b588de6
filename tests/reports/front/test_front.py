"""The first screen: answers, the scoreboard and the line of trust."""

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mocapbench.reports import render
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.bundle.model_info import ModelInfo
from mocapbench.reports.front.answers import answers
from mocapbench.reports.front.scoreboard import (
    INCOMPLETE,
    SHADES,
    BoardCell,
    board_cells,
    reference_of,
    scoreboard,
)
from mocapbench.reports.front.trust import trust
from mocapbench.reports.paper.published import published_values
from mocapbench.reports.text import cell_anchor

NAN = float("nan")
laws = settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])


def results_of(bundle):
    return task_results(bundle, bundle.layouts[0])


@pytest.mark.parametrize("task", [0, 1, 2])
def test_every_cell_is_the_mean_over_cases_that_count(bundle, task):
    results = task_results(bundle, bundle.layouts[task])
    metric = results.layout.page.metrics[0]
    cases = {case.name for case in results.representative_cases(metric)}
    scores = results.scores
    own = scores[(scores["metric"] == metric) & scores["case"].isin(cases)]
    means = own.groupby(["label", "case"])["value"].mean().groupby("label").mean()
    found = {label: cell.value for label, cell in board_cells(results).items()}
    assert found == pytest.approx(means.to_dict())


@laws
@given(st.lists(st.floats(0.01, 100.0), min_size=2, max_size=8, unique=True))
def test_shades_say_how_many_times_worse_than_the_best_a_mean_is(small, means):
    labels = [f"model {place}" for place in range(len(means))]
    one = {label: [mean] for label, mean in zip(labels, means, strict=True)}
    cells = board_cells(results_of(small({"row": one})))
    most = {name: times for times, name in SHADES}
    for label, mean in zip(labels, means, strict=True):
        times = mean / min(means)
        shade = cells[label].shade
        assert times <= most.get(shade, float("inf")) * (1 + 1e-9)
        assert all(times >= limit or most.get(shade, 1e9) <= limit for limit in most.values())
    assert [cell.shade for cell in cells.values()].count("best") == 1


@pytest.mark.parametrize(("synthetic", "said"), [((True, True), True), ((True, False), False)])
def test_the_first_screen_says_where_all_that_counts_is_generated(small, synthetic, said):
    one = small(
        {"x": {"a": [1.0], "b": [2.0]}, "y": {"a": [1.0], "b": [2.0]}}, question="hidden-frames"
    )
    layout = one.layouts[0]
    cases = [replace(c, synthetic=s) for c, s in zip(layout.cases, synthetic, strict=True)]
    layout = replace(layout, cases=tuple(cases))
    results = task_results(replace(one, layouts=(layout,)), layout)
    (column,) = scoreboard([results], {"Models": ["a", "b"]})["columns"]
    assert ("synthetic" in column["basis"]) == said
    (answer,) = answers([results])
    assert [title.endswith(" (synthetic)") for _, title, _ in answer["findings"]] == [said]


def test_limits_are_not_shaded_and_cells_name_the_cases_that_they_lack(small):
    values = {"x": {"a": [1.0], "b": [2.0], "oracle": [0.1]}, "y": {"a": [1.0], "b": [NAN]}}
    cells = board_cells(results_of(small(values)))
    assert (cells["oracle"].shade, cells["oracle"].style) == ("", "reference")
    assert cells["b"].note == "incomplete (1 of 2 cases)"
    assert cells["a"].link == cell_anchor("small", "", "a")


@laws
@given(st.lists(st.floats(0.01, 100.0), min_size=12, max_size=12), st.sets(st.integers(0, 3)))
def test_what_lost_folds_is_called_incomplete_and_never_near_the_best(small, values, lost):
    """However small its mean over the folds that it has."""
    best, other, partial = values[:4], values[4:8], list(values[8:])
    for fold in lost:
        partial[fold] = NAN
    one = {"best": best, "other": other, "partial": partial, "trivial": [1e-3] * 4}
    cells = board_cells(results_of(small({"row": one})))
    assert {cells[label].shade for label in ("best", "other")}.isdisjoint({INCOMPLETE})
    if 0 < len(lost) < 4:
        cell = cells["partial"]
        assert (cell.shade, cell.style, cell.beaten) == (INCOMPLETE, "incomplete", False)
        assert cell.note == f"incomplete ({4 - len(lost)} of 4 folds)"


@pytest.mark.parametrize("value", [NAN, 2.0])
def test_the_key_of_what_is_incomplete_is_there_where_something_is(small, value):
    results = results_of(small({"row": {"a": [1.0, 1.0], "b": [0.5, value]}}))
    board = scoreboard([results], {"Models": ["a", "b"]})
    assert board["has_incomplete"] == (value is NAN)


def test_a_model_that_failed_wherever_it_was_tried_has_a_row_and_no_rank(small):
    values = {"x": {"a": [1.0, 2.0], "b": [NAN, NAN]}, "y": {"a": [1.0, 2.0], "b": [NAN, NAN]}}
    first, second = small(values, task="first"), small({"x": {"b": [1.0]}}, task="second")
    board = scoreboard([results_of(first), results_of(second)], {"Models": ["a", "b"]})
    ((_, ((_, of_a), (_, of_b))),) = board["groups"]
    cell = of_b[0]
    assert (cell.text, cell.note, cell.style) == ("failed", "in 4 of 4", "failed")
    assert cell.link == results_of(first).failures["x", "b"][0].id
    assert (of_a[0].shade, of_b[1].shade) == ("best", "best")
    assert not board["has_incomplete"]
    assert 'data-v="nan"' not in render(first)


def test_a_model_without_recordings_did_not_fail(small):
    bundle = small({"x": {"a": [1.0], "b": [NAN]}})
    bundle.records.loc[bundle.records["label"] == "b", "status"] = "data-missing"
    ((_, rows),) = scoreboard([results_of(bundle)], {"Models": ["a", "b"]})["groups"]
    assert [label for label, _ in rows] == ["a"]


def test_an_incomplete_interpolation_is_not_the_best_one(small):
    values = {"row": {"a": [1.0, 1.0], "linear": [0.5, NAN], "pchip": [2.0, 2.0]}}
    results = [results_of(small(values, interpolations=("linear", "pchip")))]
    ((_, cells),) = scoreboard(results, {"Models": ["a", "linear", "pchip"]})["references"]
    assert cells[0].note == "pchip"


def test_what_is_no_better_than_the_reference_is_marked(small):
    results = results_of(small({"row": {"a": [1.0], "trivial": [2.0], "b": [2.0], "c": [3.0]}}))
    cells = board_cells(results)
    assert reference_of(results) == "trivial"
    assert {label for label, cell in cells.items() if cell.beaten} == {"b", "c"}
    assert reference_of(results_of(small({"row": {"a": [1.0]}}))) is None


def test_near_a_target_the_distances_of_cases_count_and_not_that_of_their_mean(small):
    values = {
        "x": {"a": [0.52], "b": [0.53], "trivial": [0.525]},
        "y": {"a": [0.48], "b": [0.53], "trivial": [0.525]},
    }
    cells = board_cells(results_of(small(values, metric="coverage_50")))
    assert (cells["a"].shade, cells["b"].shade) == ("best", "within 50 %")
    assert (cells["a"].beaten, cells["b"].beaten) == (False, True)


@pytest.mark.parametrize(("loser", "said"), [(3.0, True), (1.5, False)])
def test_the_key_of_the_mark_is_there_where_something_has_it(small, loser, said):
    results = results_of(small({"row": {"a": [1.0], "trivial": [2.0], "b": [loser]}}))
    assert scoreboard([results], {"Models": ["a", "b"]})["has_beaten"] == said


def test_a_style_names_the_shade_and_the_mark():
    styles = [BoardCell("", 0.0, name).style for _, name in SHADES]
    assert styles == [f"shade-{place}" for place in range(len(SHADES))]
    assert BoardCell("", 0.0, "worse", beaten=True).style == f"shade-{len(SHADES)} beaten"


FAMILIES = {"Models": ["a", "b"], "Others": ["stranger"], "References": ["oracle"]}


def test_the_scoreboard_has_a_column_a_task_and_rows_of_what_took_part(small):
    results = [
        results_of(small({"row": {"a": [1.0], "oracle": [0.5]}}, task="first")),
        results_of(small({"row": {"b": [1.0], "a": [2.0]}}, task="second")),
        results_of(small({"row": {"a": [NAN]}}, task="third")),
    ]
    board = scoreboard(results, FAMILIES)
    assert [column["id"] for column in board["columns"]] == ["task-first", "task-second"]
    assert sum(width for _, width in board["questions"]) == len(board["columns"])
    ((family, rows),) = board["groups"]
    assert (family, [label for label, _ in rows]) == ("Models", ["a", "b"])
    _, cells = rows[1]
    assert (cells[0], cells[1].shade) == (None, "best")
    assert [label for label, _ in board["references"]] == ["oracle"]


def test_the_best_interpolation_of_each_task_is_a_reference_line(small):
    values = {"row": {"a": [1.0], "linear": [2.0], "pchip": [1.5]}}
    interpolations = ("linear", "pchip")
    results = [results_of(small(values, interpolations=interpolations)), results_of(small(values))]
    board = scoreboard(results, {"Models": ["a", "linear", "pchip"]})
    ((label, (first, second)),) = board["references"]
    assert label == "best interpolation"
    assert (first.note, first.value, first.shade) == ("pchip", 1.5, "")
    assert second is None


CLEAR = {"a": [1.0, 1.1, 0.9, 1.0, 1.1, 0.9], "b": [9.0, 9.1, 9.2, 9.0, 9.1, 8.9]}


def test_an_answer_names_the_model_that_leads_its_margin_and_the_test(small):
    (answer,) = answers([results_of(small({"row": CLEAR}))])
    ((anchor, _, text),) = answer["findings"]
    assert answer["model"] == "a"
    assert text == "a 1.00; 8.05 (7.92 to 8.18) less than b, over 6 folds"
    assert answer["sure"] == "1 lead: 1 more than chance"
    assert anchor == "task-small"


FEW = {"a": [1.0], "b": [2.0]}
CHANCE = {"a": [1.0, 1.1, 0.9, 1.0, 1.1, 0.9], "b": [1.1, 1.0, 1.0, 0.9, 1.2, 0.9]}


@pytest.mark.parametrize(
    ("rows", "doubt"),
    [
        ([CLEAR], ""),
        ([CLEAR, CLEAR, FEW], ""),
        ([CLEAR, FEW], "too few to test"),
        ([FEW, CHANCE], "may be chance"),
        ([{"a": [1.0]}], "no rival"),
    ],
)
def test_the_head_names_a_model_without_a_doubt_only_where_most_leads_are_more_than_chance(
    small, rows, doubt
):
    tasks = [small({"row": row}, task=f"task {place}") for place, row in enumerate(rows)]
    (answer,) = answers([results_of(task) for task in tasks])
    assert (answer["model"], answer["doubt"]) == ("a", doubt)


def test_each_case_that_many_people_are_asked_has_a_sentence_of_its_own(small):
    rows = {"x": {"a": [1.0], "b": [2.0]}, "y": {"a": [3.0], "b": [1.0]}, "z": {"a": [0.1]}}
    (answer,) = answers([results_of(small(rows, asks={"y": "Legs", "x": "Arms"}))])
    assert [(title, text.partition(";")[0]) for _, title, text in answer["findings"]] == [
        ("Arms", "a 1.00"),
        ("Legs", "b 1.00"),
    ]
    assert (answer["model"], answer["sure"]) == ("", "2 leads: 2 too few to test")


def test_where_no_asked_case_ran_the_task_is_told_as_a_whole(small):
    (answer,) = answers([results_of(small({"x": {"a": [1.0]}}, asks={"y": "Legs"}))])
    assert [title for _, title, _ in answer["findings"]] == ["Small"]


def test_many_people_decide_who_is_best_and_tasks_with_published_values_stand_below(small):
    """Unless there is nothing else to decide by."""
    many, other = small({"row": CLEAR}, asks={"row": "Legs"}), {"a": CLEAR["b"], "b": CLEAR["a"]}
    values = published_values("walking-interpolation")
    reproduced = [
        replace(results_of(small({"row": other}, task=name)), published=values) for name in "xyz"
    ]
    (answer,) = answers([*reproduced, results_of(many)])
    assert answer["model"] == "a"
    assert (len(answer["findings"]), len(answer["reproductions"])) == (1, 3)
    (answer,) = answers(reproduced)
    assert answer["model"] == "b"
    assert answer["findings"] == []


@pytest.mark.parametrize("share", [1.0, 0.9])
def test_a_model_that_chooses_among_others_neither_leads_nor_hides_a_lead(small, share):
    several = {"both": ModelInfo("both", family="Several models")}
    both = {"both": [share * value for value in CLEAR["a"]]}
    (answer,) = answers([results_of(small({"row": both | CLEAR}, models=several))])
    assert answer["model"] == "a"
    assert answer["findings"][0][2] == "a 1.00; 8.05 (7.92 to 8.18) less than b, over 6 folds"
    (answer,) = answers([results_of(small({"row": both}, models=several))])
    assert answer["model"] == "both"


def test_a_lead_below_the_digits_of_the_scoreboard_is_told_with_more(small):
    results = results_of(small({"row": {"a": [17.304], "b": [17.3046], "c": [20.0]}}))
    (answer,) = answers([results])
    assert answer["findings"][0][2] == "a 17.304; 0.001 less than b, over 1 fold: too few to test"
    assert {board_cells(results)[label].text for label in "ab"} == {"17.30"}


def test_where_as_many_tasks_have_other_leaders_it_depends(small):
    tasks = [
        results_of(small({"row": {"a": [1.0], "b": [2.0]}}, task="first")),
        results_of(small({"row": {"a": [2.0], "b": [1.0]}}, task="second")),
    ]
    (answer,) = answers(tasks)
    assert answer["model"] == ""
    third = results_of(small({"row": {"a": [2.0], "b": [1.0]}}, task="third"))
    (answer,) = answers([*tasks, third])
    assert answer["model"] == "b"
    assert answer["findings"][-1][0] == "task-first"


def test_a_leader_that_is_no_better_than_the_reference_is_told(small):
    (answer,) = answers([results_of(small({"row": {"a": [3.0], "replay": [2.0]}}))])
    assert answer["findings"][0][2] == "a 3.00; no better than replay, 2.00"
    assert answers([results_of(small({"row": {"a": [NAN]}}))]) == []


def test_the_reference_is_compared_in_the_case_that_a_sentence_is_about(small):
    rows = {"x": {"a": [1.0], "replay": [2.0]}, "y": {"a": [3.0], "replay": [2.5]}}
    (answer,) = answers([results_of(small(rows, asks={"x": "Arms", "y": "Legs"}))])
    assert [text for _, _, text in answer["findings"]] == [
        "a 1.00",
        "a 3.00; no better than replay, 2.50",
    ]


def test_a_model_that_failed_on_recordings_leads_on_generated_motion(small):
    values = {
        "rec": {"a": [NAN], "both": [1.0], "replay": [2.0]},
        "syn": {"a": [1.0], "both": [2.0], "replay": [1.0]},
    }
    several = {"both": ModelInfo("both", family="Several models")}
    bundle = small(values, models=several)
    (layout,) = bundle.layouts
    cases = tuple(replace(case, synthetic=case.name == "syn") for case in layout.cases)
    bundle = replace(bundle, layouts=(replace(layout, cases=cases),))
    (answer,) = answers([task_results(bundle, bundle.layouts[0])])
    assert answer["findings"][0][2] == "a 1.00; no better than replay, 1.00"


def test_the_line_of_trust_counts_what_ran_and_what_is_missing(small):
    bundle = small({"x": {"a": [1.0, NAN], "b": [1.0, 1.0]}, "y": {"a": [NAN], "b": [NAN]}})
    bundle = replace(bundle, provenance={"profile": "quick", "wall time": "3 s", "seed": "0"})
    assert trust(bundle, [results_of(bundle)]) == [
        "profile quick",
        "1 task, 1 of 2 cases scored, 2 folds",
        "3 jobs ok, 3 failed",
        "3 s",
    ]


def test_one_of_each_is_singular_and_an_empty_run_says_so(small):
    bundle = small({"row": {"a": [1.0]}})
    assert trust(bundle, [results_of(bundle)]) == ["1 task, 1 case, 1 fold", "1 job ok"]
    empty = replace(bundle, records=bundle.records.head(0), scores=bundle.scores.head(0))
    assert trust(empty, [results_of(empty)])[-1] == "no job ran"


def test_generated_cases_beside_recordings_enter_no_mean(small):
    cases = (CaseLayout("x", {}), CaseLayout("y", {}, synthetic=True))
    bundle = small({"x": {"a": [1.0]}, "y": {"a": [9.0]}}, cases=cases)
    assert board_cells(results_of(bundle))["a"].value == 1.0


@pytest.mark.parametrize(
    ("scores", "said"),
    [
        (
            {"a": [1.0], "b": [1.0], "c": [2.0]},
            "a and b, alike: 1.00; 1.00 less than c, over 1 fold: too few to test",
        ),
        ({name: [1.0] for name in "abcde"}, "a, b, c and 2 more, alike: 1.00"),
    ],
)
def test_models_with_the_same_mean_are_told_apart_by_nothing(small, scores, said):
    (answer,) = answers([results_of(small({"row": scores}))])
    assert answer["model"] == ""
    assert answer["sure"] == "no lead"
    assert answer["findings"][0][2] == said
