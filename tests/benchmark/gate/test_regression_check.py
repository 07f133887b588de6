"""`mocapbench check` on run directories that are written by hand."""

import html
import json
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from markdown_it import MarkdownIt
from plans import plan_of
from rich.console import Console

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.gate.documents import terminal
from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.findings import Check, Finding
from mocapbench.benchmark.gate.reference import Reference, Series
from mocapbench.benchmark.gate.rule import Tolerance, Verdict, judge
from mocapbench.benchmark.gate.updating import require_updatable
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

ABOUT = {
    **{"profile": "smoke", "seed": "0", "machine": "m", "libc": "l", "BLAS": "b"},
    **dict.fromkeys(("numpy version", "scipy version", "scikit-learn version"), "1"),
}
TASK, CASE = "toy-interpolation-1", "test 1"


def _record(label, fold, found, about, version):
    key = f"{label}-{fold}-{version}".encode().hex()
    fields = {"status": found, "message": "no | luck\x1b"}
    if isinstance(found, dict):
        fields = {"status": Status.OK, "scores": found}
    if isinstance(found, tuple):  # a metric failed, and others did not
        status, scores = found
        fields |= {"status": status, "scores": scores}
    return Record(
        *(key, key, Address(TASK, version, CASE, fold, label), 0, label, {}),
        **fields,
        provenance=about,
    )


@pytest.fixture
def run(tmp_path):
    """Return a maker of runs from {label: [scores or status per fold]}."""

    def make(name, entrants, about=ABOUT, version=1):
        store = RunDirectory.create(tmp_path / name)
        records = [
            _record(label, fold, found, about, version)
            for label, folds in entrants.items()
            for fold, found in enumerate(folds)
        ]
        for record in records:
            store.save(record)
        store.save_plan(plan_of(records, **about))
        return store.path

    return make


def _mse(*values):
    return [{"mse": value} for value in values]


@pytest.fixture
def check(cli, run, tmp_path):
    """Return a function that holds one run against another, recorded as a reference."""

    def hold(before, after, *options):
        reference = tmp_path / "reference.csv"
        assert cli("check", run("before", before), "--reference", reference, "--update") == 0
        return cli("check", run("after", after), "--reference", reference, *options)

    return hold


def test_the_same_values_are_fine(check, cli):
    assert check({"knn": _mse(1.0, 2.0)}, {"knn": _mse(1.0, 2.0)}) == 0
    assert "check: 1 same; same environment" in cli.printed


def test_worse_is_1_and_named(check, cli):
    before = {"knn": _mse(1.0, 2.0), "nn": _mse(1.0, 2.0)}
    assert check(before, {**before, "knn": _mse(1.1, 2.1)}) == 1
    assert "worse" in cli.printed
    assert "knn" in cli.printed
    assert "check: 1 worse, 1 same" in cli.printed


def test_better_is_told_and_strict_wants_it_recorded(check, cli, run, tmp_path):
    before, after = {"knn": _mse(1.0, 2.0)}, {"knn": _mse(0.9, 1.9)}
    assert check(before, after) == 0
    assert "1 better" in cli.printed
    assert check(before, after, "--strict") == 1
    arguments = ("check", tmp_path / "after", "--reference", tmp_path / "reference.csv")
    assert cli(*arguments, "--update") == 0
    assert "1 better" in cli.printed
    assert cli(*arguments, "--strict") == 0


@pytest.mark.parametrize("strict", [(), ("--strict",)])
def test_new_values_are_told_and_strict_wants_them_recorded(check, cli, strict):
    before = {"knn": _mse(1.0)}
    assert check(before, {**before, "nn": _mse(1.0)}, *strict) == len(strict)
    assert "1 new, 1 same" in cli.printed


@pytest.mark.parametrize(
    "after",
    [
        {"knn": _mse(1.0, 2.0)},
        {"knn": _mse(1.0, 2.0), "nn": _mse(1.0)},
        {"knn": _mse(1.0, 2.0), "nn": _mse(1.0, float("nan"))},
        {"knn": _mse(1.0, 2.0), "nn": [{"smse": 1.0}, {"smse": 1.0}]},
    ],
    ids=["entrant", "fold", "not a number", "metric"],
)
def test_what_is_lost_is_no_silence(check, cli, tmp_path, after):
    assert check({"knn": _mse(1.0, 2.0), "nn": _mse(1.0, 2.0)}, after) == 1
    assert "lost" in cli.printed
    assert "no finite value of task version 1" in cli.printed
    document = json.loads((tmp_path / "after" / "check.json").read_text())
    told = {(each["verdict"], each["fails"]) for each in document["findings"]}
    assert ("lost", True) in told


def test_another_version_of_a_task_is_another_problem(check, cli, run, tmp_path):
    assert check({"knn": _mse(1.0)}, {"knn": _mse(1.0)}) == 0
    newer = run("newer", {"knn": _mse(1.0)}, version=2)
    assert cli("check", newer, "--reference", tmp_path / "reference.csv") == 1
    assert "1 lost, 1 new" in cli.printed


@pytest.mark.parametrize("status", [Status.FAILED, Status.TIMEOUT, Status.OUT_OF_MEMORY])
@pytest.mark.parametrize("known", [True, False])
def test_a_failed_job_is_3(check, cli, status, known):
    before = {"knn": _mse(1.0), **({"nn": _mse(1.0)} if known else {})}
    assert check(before, {"knn": _mse(1.0), "nn": [status]}) == 3
    assert f"{status}: no | luck" in cli.printed


@pytest.mark.parametrize("known", [["mse"], ["mse", "smse"]])
def test_a_job_that_one_metric_failed_is_3_and_its_other_scores_are_compared(check, cli, known):
    before = {"knn": [dict.fromkeys(known, 1.0)]}
    assert check(before, {"knn": [(Status.FAILED, {"mse": 1.0})]}) == 3
    assert "check: 1 job failed, 1 same" in cli.printed
    assert check(before, {"knn": [(Status.FAILED, {"mse": 1.1})]}) == 1
    assert "check: 1 worse, 1 job failed" in cli.printed


def test_a_failed_fold_that_the_reference_lacks_is_3_too(check):
    assert check({"knn": _mse(1.0)}, {"knn": [{"mse": 1.0}, Status.FAILED]}) == 3


def test_failed_jobs_without_reference_values_are_told_by_name(check, tmp_path):
    after = {name: [Status.FAILED] for name in ("nn", "knn", "moa")}
    assert check({"trivial": _mse(1.0)}, {"trivial": _mse(1.0), **after}) == 3
    found = json.loads((tmp_path / "after" / "check.json").read_text())["findings"]
    assert [each["label"] for each in found] == ["trivial", "knn", "moa", "nn"]


def test_worse_comes_before_broken(check):
    before = {"knn": _mse(1.0), "nn": _mse(1.0)}
    assert check(before, {"knn": _mse(1.1), "nn": [Status.FAILED]}) == 1


def test_missing_data_are_skipped_and_stay_in_the_reference(check, cli, tmp_path):
    before = {"knn": _mse(1.0), "nn": _mse(1.0)}
    assert check(before, {"knn": _mse(1.0), "nn": [Status.DATA_MISSING]}) == 0
    assert "1 data missing, 1 same" in cli.printed
    reference = tmp_path / "reference.csv"
    kept = reference.read_text()
    assert cli("check", tmp_path / "after", "--reference", reference, "--update") == 0
    assert reference.read_text() == kept


def test_a_run_that_was_compared_to_nothing_is_4(check, cli):
    assert check({"knn": _mse(1.0)}, {"knn": [Status.DATA_MISSING]}) == 4
    assert "nothing was compared: expected values that both" in cli.printed


def test_a_reference_that_is_not_there_is_4(cli, run, tmp_path):
    path = run("run", {"knn": _mse(1.0)})
    assert cli("check", path, "--reference", tmp_path / "absent") == 4
    assert "write some with --update" in cli.printed


def test_another_environment_is_seen_and_held_less_tightly(check, cli, run, tmp_path):
    assert check({"knn": _mse(1.0)}, {"knn": _mse(1.0)}) == 0
    arguments = ("--reference", tmp_path / "reference.csv")
    other = ABOUT | {"BLAS": "another"}
    assert cli("check", run("near", {"knn": _mse(1.01)}, other), *arguments) == 0
    assert "cross environment (BLAS differ)" in cli.printed
    assert cli("check", run("far", {"knn": _mse(1.03)}, other), *arguments) == 1
    assert cli("check", tmp_path / "near", *arguments, "--environment", "same") == 1


def test_a_file_of_tolerances_decides(check, tmp_path):
    before, after = {"knn": _mse(1.0)}, {"knn": _mse(1.05)}
    (tmp_path / "t.toml").write_text("[same.metrics.mse]\nrelative = 0.1\n")
    assert check(before, after) == 1
    assert check(before, after, "--tolerances", tmp_path / "t.toml") == 0


def test_a_run_directory_is_a_reference_but_not_one_to_write(cli, run):
    before, after = run("before", {"knn": _mse(1.0)}), run("after", {"knn": _mse(1.1)})
    assert cli("check", after, "--reference", before) == 1
    assert cli("check", after, "--reference", before, "--update") == 2
    assert "is a run directory" in cli.printed


def test_a_file_that_is_read_whatever_its_name_is_not_written(cli, run, tmp_path):
    path, csv, text = (tmp_path / name for name in ("run", "b.csv", "b.txt"))
    assert cli("check", run("run", {"knn": _mse(1.0)}), "--reference", csv, "--update") == 0
    csv.rename(text)
    assert cli("check", path, "--reference", text) == 0
    assert cli("check", path, "--reference", text, "--update") == 2
    assert "expected a .csv file or a folder" in cli.printed


def test_half_a_run_is_no_reference(cli, run, tmp_path):
    whole, cut = (run(name, {"knn": _mse(1.0), "nn": _mse(1.0)}) for name in ("whole", "cut"))
    record = next(cut.glob(f"records/*/{b'nn-0-1'.hex()}.json"))
    record.write_text(record.read_text()[:50])
    assert cli("check", whole, "--reference", cut) == 2
    assert "cut holds a damaged record" in cli.printed
    record.unlink()
    assert cli("check", cut, "--reference", tmp_path / "b.csv", "--update") == 2
    assert "1 job of the run has no whole record" in cli.printed
    assert not (tmp_path / "b.csv").exists()


def test_failed_jobs_are_no_reference_unless_asked(cli, run, tmp_path):
    reference = tmp_path / "reference"
    good = run("good", {"knn": _mse(1.0), "nn": _mse(1.0)})
    assert cli("check", good, "--reference", reference, "--update") == 0
    bad = run("bad", {"knn": _mse(2.0), "nn": [Status.FAILED]})
    kept = (reference / f"{TASK}.csv").read_text()
    assert cli("check", bad, "--reference", reference, "--update") == 2
    assert "--allow-failures" in cli.printed
    assert (reference / f"{TASK}.csv").read_text() == kept
    assert cli("check", bad, "--reference", reference, "--update", "--allow-failures") == 0
    text = (reference / f"{TASK}.csv").read_text()
    assert "knn,mse,2.0" in text
    assert "nn,mse,1.0" in text


def test_the_failure_that_a_refusal_tells_is_of_the_job_that_it_names(tmp_path):
    records = [
        replace(_record(label, 0, Status.FAILED, ABOUT, 1), message=f"{label} broke")
        for label in ("knn", "nn")
    ]
    with pytest.raises(UsageError, match=r"2 jobs failed \((\w+): \1 broke\)"):
        require_updatable(tmp_path / "b.csv", Reference({}), records, 2, allow_failures=False)


@pytest.mark.parametrize("name", ["profile", "seed"])
def test_runs_that_cannot_be_paired_are_refused(check, cli, run, tmp_path, name):
    assert check({"knn": _mse(1.0)}, {"knn": _mse(1.0)}) == 0
    other = run("other", {"knn": _mse(1.0)}, ABOUT | {name: "7"})
    for options in ((), ("--update",)):
        assert cli("check", other, "--reference", tmp_path / "reference.csv", *options) == 2
        assert f"expected a run of the {name}" in cli.printed


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ((), "choose --reference"),
        (("--reference", "b.csv", "--junit", "no/such/folder.xml"), "in a folder that exists"),
        (("--reference", "b.csv", "--markdown", "/"), "in a folder that exists"),
        (("--reference", "b.csv", "--environment", "near"), "near"),
        (("--controls", "--junit", "j.xml"), "--controls: expected no other option"),
        (("--controls", "--strict"), "--controls: expected no other option"),
    ],
)
def test_bad_requests_are_2(cli, run, arguments, complaint):
    assert cli("check", run("run", {"knn": _mse(1.0)}), *arguments) == 2
    assert complaint in cli.printed


def test_a_folder_that_is_no_run_is_2(cli, tmp_path):
    assert cli("check", tmp_path, "--reference", tmp_path / "b.csv") == 2
    assert "is not a mocapbench run" in cli.printed


def test_junit_and_markdown_tell_the_same(check, tmp_path):
    before = {name: _mse(1.0, 2.0) for name in ("knn", "nn", "moa", "trivial")}
    after = {
        **{"knn": _mse(1.1, 2.1), "nn": _mse(0.9, 1.9)},
        **{"moa": [Status.FAILED] * 2, "trivial": [Status.DATA_MISSING] * 2},
    }
    options = ("--junit", tmp_path / "j.xml", "--markdown", tmp_path / "m.md")
    assert check(before, after, *options) == 1
    (suite,) = ElementTree.parse(tmp_path / "j.xml").getroot()
    counts = {name: suite.get(name) for name in ("tests", "failures", "errors", "skipped")}
    assert counts == {"tests": "4", "failures": "1", "errors": "1", "skipped": "1"}
    (failed,) = suite.findall("testcase/failure/..")
    assert (failed.get("classname"), failed.get("name")) == (f"{TASK}.{CASE}", "knn: mse")
    text = (tmp_path / "m.md").read_text()
    assert text.startswith("### Metrics: failed, exit code 1")
    rows = [line for line in text.splitlines() if line.startswith("|")]
    assert [row.split(" | ")[0][2:] for row in rows[2:]] == ["worse", "job failed", "better"]
    assert "no \\| luck" in text


def test_markdown_shows_names_as_they_are(check, tmp_path):
    name = "<script>`x`|[here](there) *y*"
    before, after = {name: _mse(1.0), "knn": _mse(1.0)}, {name: _mse(2.0), "knn": [Status.FAILED]}
    assert check(before, after, "--markdown", tmp_path / "m.md") == 1
    page = MarkdownIt("commonmark").enable("table").render((tmp_path / "m.md").read_text())
    assert f"<td>{TASK}, {CASE}, {html.escape(name)}</td>" in page
    assert "<td>fold 0: failed: no | luck</td>" in page
    assert page.count("<tr>") == 3


@pytest.mark.parametrize("after", [_mse(1.0), _mse(1.1), [Status.FAILED], [Status.DATA_MISSING]])
def test_a_check_has_passed_if_its_exit_code_is_0(check, tmp_path, after):
    code = check({"knn": _mse(1.0)}, {"knn": after}, "--markdown", tmp_path / "m.md")
    state = "passed" if code == 0 else f"failed, exit code {code}"
    assert (tmp_path / "m.md").read_text().startswith(f"### Metrics: {state}\n")
    found = json.loads((tmp_path / "after" / "check.json").read_text())
    assert found["passed"] is (code == 0)


def _table(*findings, width=200):
    """Return the table of a check and what a terminal shows of it."""
    table = terminal(Check(findings, Environment.SAME))
    console = Console(width=width, markup=False)
    with console.capture() as shown:
        console.print(table)
    return table, shown.get()


@pytest.mark.parametrize("n", [1, 49, 50, 51, 60])
def test_the_terminal_shows_fifty_rows_and_counts_the_others(n):
    series = [Series(Address(TASK, 1, CASE, label=f"{number}"), "mse") for number in range(n)]
    table, shown = _table(*(Finding(each, Verdict.LOST) for each in series))
    assert table.row_count == min(n, 50)
    assert (f"{n - 50} more" in shown) is (" more" in shown) is (n > 50)


def test_names_are_broken_on_a_narrow_terminal_and_numbers_are_not():
    judgement = judge([1 / 3], [2 / 3], METRICS.get("mse").loss, Tolerance())
    long = Series(Address(TASK, 1, CASE, label="x" * 60), "mse")
    _, shown = _table(Finding(long, Verdict.WORSE, judgement), width=70)
    assert shown.count("x") == 60
    assert {"worse", "0.333333", "0.666667", "+0.333"} <= set(shown.split())


def test_metrics_share_a_row_only_where_they_have_no_number(check, tmp_path):
    before = {name: [{"mse": 1.0, "rms_per_frame": 1.0}] for name in ("knn", "nn")}
    after = {"knn": [{"mse": 2.0, "rms_per_frame": 3.0}], "nn": [Status.FAILED]}
    assert check(before, after, "--markdown", tmp_path / "m.md") == 1
    rows = [line.split(" | ") for line in (tmp_path / "m.md").read_text().splitlines()]
    metrics = [(row[1].split(", ")[-1], row[2]) for row in rows if row[0].startswith("| ")]
    assert metrics[2:] == [
        ("knn", "mse"),
        ("knn", "rms\\_per\\_frame"),
        ("nn", "mse, rms\\_per\\_frame"),
    ]


def test_the_report_tells_the_check_of_the_last_run_only(check, cli, tmp_path):
    assert check({"knn": _mse(1.0)}, {"knn": _mse(1.1)}) == 1
    found = json.loads((tmp_path / "after" / "check.json").read_text())
    assert not found["passed"]
    assert cli("report", "--out", tmp_path / "after") == 0
    assert "Regression check" in (tmp_path / "after" / "report.html").read_text()
    store = RunDirectory(tmp_path / "after")
    store.save_plan(store.load_plan())
    assert cli("report", "--out", tmp_path / "after") == 0
    assert "Regression check" not in (tmp_path / "after" / "report.html").read_text()
