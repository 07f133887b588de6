from dataclasses import replace

import pytest

from mocapbench.reports import render
from mocapbench.reports.tables.check import LIMIT, check_table


def _finding(verdict, label="knn", **more):
    address = {"task": "small", "case": "row", "label": label, "metric": "mse"}
    return {**address, "verdict": verdict, "fails": verdict == "worse", "reason": "", **more}


PAIRED = {"n": 2, "reference": 1.0, "run": 1.25, "change": -0.25, "worst": 0.5, "allowance": 0.01}


def _check(*findings):
    passed = not any(finding["fails"] for finding in findings)
    summary = "1 worse; same environment"
    return {"reference": "base.csv", "summary": summary, "passed": passed, "findings": findings}


def test_failures_come_first_and_what_is_the_same_is_left_out():
    table = check_table(_check(_finding("same"), _finding("better", **PAIRED), _finding("worse")))
    assert [row[0].text for row in table.rows] == ["worse", "better"]
    numbers = [cell.text for cell in table.rows[1][5:11]]
    assert numbers == ["2", "1", "1.25", "−0.25", "0.01", "0.5"]


def test_nothing_moved_is_no_table():
    assert check_table(_check(_finding("same"), _finding("data missing"))) is None


def test_a_long_list_is_cut_and_says_so():
    findings = [_finding("new", label=str(number)) for number in range(LIMIT + 7)]
    table = check_table(_check(*findings))
    assert len(table.rows) == LIMIT
    assert table.notes[-1].startswith("7 more")


@pytest.mark.parametrize(("verdict", "outcome"), [("worse", "failed"), ("better", "passed")])
def test_the_page_shows_the_check(small, verdict, outcome):
    check = _check(_finding(verdict, label="<script>", **PAIRED))
    page = render(replace(small({"row": {"a": [1.0]}}), check=check))
    assert f"the run <strong>{outcome}</strong>" in page
    assert ("The regression check failed" in page) is (outcome == "failed")
    assert '<td class="text">&lt;script&gt;</td>' in page


def test_a_run_that_was_not_checked_has_no_such_section(page):
    assert "Regression check" not in page
