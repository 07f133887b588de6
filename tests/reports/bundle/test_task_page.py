import pytest

from mocapbench.reports import CaseLayout, RowNotes, TaskLayout, TaskPage

NOTES = RowNotes(published="test 1", remark="a remark", not_comparable={"a": "another protocol"})
PAGE = TaskPage(
    title="T", reference="thesis §1", description="D", metrics=("mse",), rows={"one": NOTES}
)
GENERATED = "Generated gait, not recordings of people."


def test_notes_are_those_of_the_case_or_empty():
    assert PAGE.notes("one") == NOTES
    assert PAGE.notes("two") == RowNotes()


def test_a_page_is_declared_by_names():
    with pytest.raises(TypeError, match="positional"):
        TaskPage("T", "thesis §1", "D", metrics=("mse",))


@pytest.mark.parametrize(
    ("synthetic", "notes", "remark"),
    [
        (False, RowNotes(), ""),
        (True, RowNotes(), GENERATED),
        (True, NOTES, "a remark"),
        (False, NOTES, "a remark"),
    ],
)
def test_a_generated_case_says_so_unless_it_has_a_remark(synthetic, notes, remark):
    assert CaseLayout("one", {}, synthetic=synthetic, notes=notes).remark == remark


@pytest.mark.parametrize(("synthetic", "heading"), [(False, "one"), (True, "one (synthetic)")])
def test_the_heading_marks_generated_motion(synthetic, heading):
    assert CaseLayout("one", {}, synthetic=synthetic).heading == heading


def test_limits_and_controls_are_not_ranked():
    layout = TaskLayout("t", PAGE, (), ("a", "oracle", "control", "replay", "b"))
    assert layout.ranked == ("a", "b")
