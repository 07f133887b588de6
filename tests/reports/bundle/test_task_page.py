import pytest

from mocapbench.reports import CaseLayout, TaskLayout, TaskPage

PAGE = TaskPage(title="T", reference="thesis §1", description="D", metrics=("mse",))
GENERATED = "Generated gait, not recordings of people."


def test_a_page_is_declared_by_names():
    with pytest.raises(TypeError, match="positional"):
        TaskPage("T", "thesis §1", "D", metrics=("mse",))


@pytest.mark.parametrize(("synthetic", "remark"), [(False, ""), (True, GENERATED)])
def test_a_generated_case_says_so(synthetic, remark):
    assert CaseLayout("one", {}, synthetic=synthetic).remark == remark


@pytest.mark.parametrize(("synthetic", "heading"), [(False, "one"), (True, "one (synthetic)")])
def test_the_heading_marks_generated_motion(synthetic, heading):
    assert CaseLayout("one", {}, synthetic=synthetic).heading == heading


def test_limits_and_controls_are_not_ranked():
    layout = TaskLayout("t", PAGE, (), ("a", "oracle", "control", "replay", "b"))
    assert layout.ranked == ("a", "b")
