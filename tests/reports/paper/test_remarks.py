from importlib.resources import files

import pytest

from mocapbench.reports.paper.published import every_value, published_values
from mocapbench.reports.paper.remarks import footnotes, marks, parse_remarks, remark_on

HEADER = "source,case,metric,model,note\n"


@pytest.fixture(scope="module", params=["errata.csv", "not_comparable.csv"])
def shipped(request):
    return parse_remarks((files("mocapbench.reports.paper") / request.param).read_text("utf-8"))


def test_every_remark_concerns_a_printed_number(shipped):
    for remark in shipped.items():
        assert any(remark_on(value.address, dict([remark])) for value in every_value()), remark


def test_the_first_remark_that_matches_counts():
    remarks = parse_remarks(HEADER + "t*,test [47],*,MOHGP,one\n*,*,MSE,*,two\n")
    assert remark_on(("t1", "test 4", "MSE", "MOHGP"), remarks) == "one"
    assert remark_on(("t1", "test 5", "MSE", "MOHGP"), remarks) == "two"
    assert remark_on(("t1", "test 5", "MSLL", "MOHGP"), remarks) == ""


@pytest.mark.parametrize(
    ("address", "words"),
    [
        (("toy-interpolation-1", "test 2", "SMSE", "MOA"), "cannot both be right"),
        (("toy-interpolation-1", "test 4", "MSE", "MOHGP"), "tests 4 and 7"),
        (("toy-interpolation-1", "test 7", "MSLL", "MOHGP"), "tests 4 and 7"),
        (("toy-interpolation-3", "test 3", "MSE", "MOHGP"), "noise variance"),
        (("toy-synthesis", "test 1", "MCC", "Control"), "tests 1 and 3"),
        (("toy-synthesis", "test 8", "MLC", "Control"), "tests 5 and 8"),
        (("exaggerated-synthesis", "35(1)", "MLC", "MOHGP"), "Table 15"),
        (("control-similarity", "12(1) vs 12(1)", "MCC", "real"), "26.249"),
    ],
)
def test_errata_stand_on_the_numbers_that_they_are_about(address, words):
    task, *row = address
    assert words in published_values(task)[tuple(row)].erratum


def test_errata_are_true():
    """Values that are said to repeat others do."""
    walking, exaggerated = map(published_values, ("walking-synthesis", "exaggerated-synthesis"))
    repeated = [value for value in exaggerated.values() if value.erratum]
    assert len(repeated) == 5
    for value in repeated:
        first = walking[value.case, value.metric, value.model]
        assert (value.value, value.two_sd) == (first.value, first.two_sd)
    toy = published_values("toy-interpolation-1")
    for metric in ("MSE", "SMSE", "MSLL"):
        assert toy["test 4", metric, "MOHGP"].value == toy["test 7", metric, "MOHGP"].value
    mohgp, moa = (
        toy["test 2", "MSE", model].value / toy["test 2", "SMSE", model].value
        for model in ("MOHGP", "MOA")
    )
    assert (round(mohgp, 1), round(moa, 1)) == (1.9, 0.7)
    control = published_values("toy-synthesis")
    for metric in ("MCC", "MLC"):
        for pair in ((1, 3), (5, 8)):
            one, other = (control[f"test {n}", metric, "Control"] for n in pair)
            assert (one.value, one.two_sd) == (other.value, other.two_sd)


def test_equal_notes_share_a_letter_and_nothing_has_none():
    lettered = marks(["", "first", "second", "first"])
    assert lettered == {"": "", "first": "a", "second": "b"}
    assert footnotes(lettered) == ["a: first", "b: second"]


@pytest.mark.parametrize(
    ("text", "message"),
    [("a,b\n1,2\n", "expected the columns"), (HEADER + "t,,*,*,note\n", "every field")],
)
def test_a_malformed_table_is_refused(text, message):
    with pytest.raises(ValueError, match=message):
        parse_remarks(text)
