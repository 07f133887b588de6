import html
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from markdown_it import MarkdownIt
from plans import plan_of
from typer.main import get_command

from mocapbench.benchmark import comparison
from mocapbench.benchmark.cli.compare import app
from mocapbench.benchmark.comparison.units import with_advantages
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.results.bundle import bundle
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.metrics.statistics import ROPE
from mocapbench.reports import MetricInfo
from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.contrasts import contrasts
from mocapbench.reports.analysis.results import task_results

TOY, FRAMES = "toy-interpolation-1", "missing-frames"
GOOD = {"test 1": [1.0, 1.2, 0.9, 1.1, 1.0], "test 2": [2.0, 2.2, 1.9, 2.1, 2.0]}
BAD = {case: [1.5 * value for value in values] for case, values in GOOD.items()}


def records(label, cases, task=TOY, metric="mse", **fields):
    return [
        Record(
            key=f"{task}{case}{label}{fold}".encode().hex(),
            fit_key="fit",
            address=Address(task, 1, case, fold, label),
            seed=0,
            model=label,
            parameters={},
            status=Status.OK,
            scores={metric: value},
            provenance={"digest of cmu:07_01": "abc"},
        )
        for case, values in cases.items()
        for fold, value in enumerate(values)
    ]


@pytest.fixture
def run(tmp_path):
    """Return a writer of run directories."""

    def write(name, *groups):
        store, found = RunDirectory.create(tmp_path / name), [r for group in groups for r in group]
        for record in found:
            store.save(record)
        store.save_plan(plan_of(found))
        return store.path

    return write


def compared(cli, tmp_path, *arguments):
    assert cli("compare", *arguments, "--csv", tmp_path / "rows.csv") == 0
    return pd.read_csv(tmp_path / "rows.csv", keep_default_na=True).set_index("case")


def test_a_narrow_terminal_cuts_no_word(cli, run, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    path = run("run", records("lmc-independent-1", GOOD), records("gp-independent", BAD))
    models = "lmc-independent-1,gp-independent"
    assert cli("compare", path, "--models", models, "--metrics", "mse") == 0
    assert "test 1" in cli.printed
    assert "…" not in cli.printed


def test_two_runs_are_contrasted_case_by_case_and_over_all(cli, run, tmp_path):
    one, other = run("good", records("knn", GOOD)), run("bad", records("knn", BAD))
    rows = compared(cli, tmp_path, one, other, "--metrics", "mse")
    assert list(rows.index) == ["test 1", "test 2", "all cases"]
    assert list(rows["n"]) == [5, 5, 10]
    assert rows.loc["test 1", "advantage"] == pytest.approx(0.52)
    assert rows.loc["all cases", "advantage"] == pytest.approx(0.77)
    assert (rows["t_p_holm"] >= rows["t_p"]).all()
    assert rows.loc["test 1", "signed_rank_p"] == 0.0625
    assert "good better" in cli.printed
    assert "cannot go below p = 0.0625" in cli.printed


def test_exchanging_the_runs_turns_every_row_round(cli, run, tmp_path):
    one, other = run("good", records("knn", GOOD)), run("bad", records("knn", BAD))
    there = compared(cli, tmp_path, one, other)
    back = compared(cli, tmp_path, other, one)
    pd.testing.assert_series_equal(back["advantage"], -there["advantage"])
    pd.testing.assert_series_equal(back["better"], there["worse"], check_names=False)
    pd.testing.assert_series_equal(back["t_p_holm"], there["t_p_holm"])


def test_two_models_of_one_run_are_contrasted(cli, run, tmp_path):
    both = run("run", records("nn", BAD), records("knn", GOOD))
    rows = compared(cli, tmp_path, both, "--models", "knn,nn")
    assert rows.loc["test 1", "advantage"] == pytest.approx(0.52)
    assert "knn better" in cli.printed


def test_two_runs_are_contrasted_for_the_entrants_asked_for(cli, run, tmp_path):
    one = run("good", records("knn", GOOD), records("nn", GOOD), records("trivial", GOOD))
    other = run("bad", records("knn", BAD), records("nn", BAD))
    rows = compared(cli, tmp_path, one, other, "--models", "nn,trivial")
    assert set(rows["entrant"]) == {"nn"}
    assert set(compared(cli, tmp_path, one, other)["entrant"]) == {"knn", "nn"}


def test_a_run_against_itself_is_identical(cli, run):
    path = run("run", records("knn", GOOD))
    assert cli("compare", path, path) == 0
    assert "3 of 3 comparisons are identical" in cli.printed


def test_models_that_nobody_changed_do_not_hide_one_that_was(cli, run, tmp_path):
    others = [records(name, GOOD) for name in ("nn", "trivial", "linear")]
    before, after = (
        run(name, records("knn", scores)) for name, scores in (("a", GOOD), ("b", BAD))
    )
    alone = compared(cli, tmp_path, before, after)
    before, after = (
        run(name, records("knn", scores), *others) for name, scores in (("c", GOOD), ("d", BAD))
    )
    beside = compared(cli, tmp_path, before, after)
    assert beside["identical"].sum() == 3 * len(alone)
    changed = beside[~beside["identical"]]
    np.testing.assert_array_equal(changed["t_p_holm"], alone["t_p_holm"])
    np.testing.assert_array_equal(changed["signed_rank_p_holm"], alone["signed_rank_p_holm"])


def test_overlapping_windows_of_one_person_count_as_one(cli, run, tmp_path):
    windows = {"35-03 three-walkers": [1.0, 2.0, 3.0], "07-01 three-walkers": [2.0, 3.0, 5.0]}
    groups = [
        records(label, cases, task=FRAMES, metric="rms_per_frame")
        for label, cases in (("knn", windows), ("nn", {c: [9.0] * 3 for c in windows}))
    ]
    rows = compared(cli, tmp_path, run("run", *groups), "--models", "knn,nn")
    assert list(rows["n"]) == [1, 1, 2]
    assert rows["t_p"].isna().all()
    assert cli.printed.count("too few to test") == 4  # three rows, and the note on n
    assert "give `mocapbench run` more --folds" in cli.printed


@pytest.mark.parametrize(
    ("task", "metric", "n_folds", "n_units"),
    [
        (TOY, "mse", 2, 18),
        (FRAMES, "rms_per_frame", 3, 5),
        (FRAMES, "coverage_95", 3, 5),
        ("marker-gaps", "mpjpe", 6, 4),
        ("toy-synthesis", "variance_ratio", 4, 36),
    ],
)
def test_the_units_and_tests_are_those_of_the_report(task, metric, n_folds, n_units):
    rng, cases = np.random.default_rng(0), TASKS.get(task).cases
    found = [
        records(label, {c.name: list(rng.lognormal(size=n_folds)) for c in cases}, task, metric)
        for label in ("knn", "nn")
    ]
    whole = bundle([record for side in found for record in side], {})
    scored = cells(task_results(whole, whole.layouts[0]), metric)
    sides = comparison.between_models([r for side in found for r in side], ("knn", "nn"))
    rows = comparison.compare(*sides, metrics=[metric], rope=ROPE)
    (pooled,) = (row.contrast for row in rows if row.case == "all cases")
    expected = contrasts(scored)["knn", "nn"]
    assert pooled.n == expected.n == n_units
    for name in ("first", "second", "advantage"):
        assert getattr(pooled, name) == pytest.approx(getattr(expected, name))
    assert pooled.t_p == pytest.approx(expected.t_p, nan_ok=True)


@pytest.mark.parametrize(
    ("direction", "target", "advantages"),
    [
        ("lower", None, [2.0, 3.0, -1.0]),
        ("higher", None, [-2.0, -3.0, 1.0]),
        ("target", 5.0, [-2.0, -3.0, 1.0]),  # both means are below it
    ],
)
def test_an_advantage_follows_the_direction(direction, target, advantages):
    addresses = pd.MultiIndex.from_tuples([("a", 0), ("a", 1), ("b", 0)], names=["case", "fold"])
    pairs = pd.DataFrame({"first": [1.0, 2.0, 3.0], "second": [3.0, 5.0, 2.0]}, addresses)
    found = with_advantages(pairs, MetricInfo("m", "m", direction, target))
    assert found["advantage"].to_list() == advantages


def test_equal_means_of_units_are_not_identical_values(cli, run, tmp_path):
    swings = {"64-01": [1.0], "64-02": [3.0]}
    turned = dict(zip(swings, reversed(swings.values()), strict=True))
    both = run(
        "run", *(records(*of, task="golf-swings") for of in (("knn", swings), ("nn", turned)))
    )
    rows = compared(cli, tmp_path, both, "--models", "knn,nn", "--metrics", "mse")
    assert not rows["identical"].any()
    assert rows.loc["all cases", ["n", "advantage"]].to_list() == [1, 0.0]
    assert cli.printed.count("too few to test") == 4  # three rows, and the note on n
    assert "give `mocapbench run` more --folds" in cli.printed


def test_nothing_is_said_of_few_units_where_all_is_identical(cli, run):
    path = run("run", records("knn", {"test 1": [1.0]}))
    assert cli("compare", path, path) == 0
    assert "give `mocapbench run` more --folds" not in cli.printed


def test_rows_that_are_means_of_others_do_not_count_beside_them(cli, run, tmp_path):
    cases = {"12(1)": [20.0], "35(1)": [22.0], "without 38(2)": [21.0]}
    given = {"task": "walking-synthesis", "metric": "mcc"}
    one = run("one", records("moa-3", cases, **given))
    other = run("other", records("moa-3", {case: [19.0] for case in cases}, **given))
    rows = compared(cli, tmp_path, one, other, "--metrics", "mcc")
    assert rows.loc["all cases", "n"] == 2


def test_generated_motion_is_not_pooled_with_recordings(cli, run, tmp_path):
    cases = {"observed 40": [1.0, 1.0], "observed 10": [2.0, 2.1], "synthetic observed 40": [9.0]}
    doubled = {case: [2.0 * value for value in values] for case, values in cases.items()}
    groups = [
        records(label, values, task="walking-interpolation")
        for label, values in (("knn", cases), ("nn", doubled))
    ]
    rows = compared(cli, tmp_path, run("run", *groups), "--models", "knn,nn", "--metrics", "mse")
    assert rows.loc["all cases", "n"] == 4
    assert rows.loc["all cases", "first"] == pytest.approx(1.525)


def test_folds_that_only_one_side_was_asked_for_are_left_out(cli, run, tmp_path):
    fewer = records("nn", {"test 1": [2.0, 2.2]})
    rows = compared(cli, tmp_path, run("run", records("knn", GOOD), fewer), "--models", "knn,nn")
    assert rows["n"].to_dict() == {"test 1": 2}
    assert not rows[["first_lost", "second_lost"]].to_numpy().any()


def test_markdown_holds_every_row_and_the_notes(cli, run, tmp_path):
    one, other = run("a|b", records("knn", GOOD)), run("bad", records("knn", BAD))
    assert cli("compare", one, other, "--markdown", tmp_path / "out.md") == 0
    text = (tmp_path / "out.md").read_text()
    assert text.count("| knn: ") == 3
    assert "a\\|b better" in text
    assert "cannot go below p = 0.0625" in text


def test_markdown_shows_names_as_they_are():
    name, sides = "<script>`x`|[here](http://elsewhere)\n# *y*", ("a<b>|c", "d")
    first, second = (records(name, {name: values}) for values in ([1.0, 1.2], [1.5, 1.9]))
    rows = [replace(row, task=name) for row in comparison.compare(first, second, rope=0.02)]
    page = MarkdownIt("commonmark").enable("table").render(comparison.markdown(rows, sides))
    shown = html.escape(" ".join(name.split()))
    assert "<h1>a&lt;b&gt;|c against d</h1>" in page
    assert f"<h2>{shown}: Mean squared error (MSE) (lower is better)</h2>" in page
    assert f"<td>{shown}: {shown}</td>" in page
    assert "<th>a&lt;b&gt;|c</th>" in page


def test_no_name_in_the_csv_begins_a_formula(cli, run, tmp_path):
    good, bad = (run(f"{value}", records("knn", {"=1+1": [value]})) for value in (1.0, 2.0))
    rows = compared(cli, tmp_path, bad, good)
    assert set(rows.index) == {"'=1+1"}
    assert rows["advantage"].to_list() == [-1.0]


def test_a_metric_that_both_sides_lack_is_named(cli, run):
    both = run("run", records("knn", GOOD), records("nn", BAD))
    assert cli("compare", both, "--models", "knn,nn", "--metrics", "mse,coverage_95") == 0
    assert "The two have no value of coverage_95 in common." in cli.printed
    assert "no value of mse" not in cli.printed


def test_near_a_target_the_distances_of_cases_are_averaged():
    """One side is as far below the target as above it; the other is nearer in every case."""
    first = records("knn", {"test 1": [0.45] * 5, "test 2": [1.45] * 5}, metric="coverage_95")
    second = records("nn", {"test 1": [0.90] * 5, "test 2": [0.85] * 5}, metric="coverage_95")
    *_, pooled = comparison.compare(
        [replace(r, address=r.address._replace(label="a"), model="a") for r in first],
        [replace(r, address=r.address._replace(label="a"), model="a") for r in second],
        metrics=["coverage_95"],
        rope=0.02,
    )
    assert (pooled.contrast.first, pooled.contrast.second) == pytest.approx((0.95, 0.875))
    assert pooled.contrast.advantage == pytest.approx(0.075 - 0.5)
    assert any(
        "mean distance over cases" in note for note in comparison.notes([pooled], ("a", "b"))
    )


def test_equivalence_begins_where_the_statistics_say_unless_told_otherwise(cli, run, tmp_path):
    (rope,) = (p for p in get_command(app).params if p.name == "rope")
    assert rope.default == ROPE
    one, other = run("good", records("knn", GOOD)), run("bad", records("knn", BAD))
    default, given, wide = (
        compared(cli, tmp_path, one, other, *options)
        for options in ((), ("--rope", ROPE), ("--rope", 0.5))
    )
    pd.testing.assert_frame_equal(default, given)
    assert (wide["equivalent"] > default["equivalent"]).any()


def _changed(record, version=1, **fields):
    return replace(record, address=record.address._replace(version=version), **fields)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"seed": 7}, "seed 0 against 7 (10 jobs)"),
        ({"version": 2}, "version of toy-interpolation-1 1 against 2"),
        ({"provenance": {"digest of cmu:07_01": "other"}}, "digest of cmu:07_01 abc against other"),
        ({"provenance": {}}, "digest of cmu:07_01 abc against absent"),
    ],
)
def test_what_is_not_paired_is_refused_with_the_reason(cli, run, change, reason):
    changed = [_changed(record, **change) for record in records("knn", GOOD)]
    assert cli("compare", run("one", records("knn", GOOD)), run("other", changed)) == 2
    assert "do not solve the same problems" in cli.printed
    assert reason in cli.printed


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["{run}"], "expected a second run, or --models with two labels"),
        (["{run}", "--models", "knn"], "expected a second run"),
        (["{run}", "--models", "knn,kn"], "did you mean knn"),
        (["{run}", "{run}", "--models", "kn"], "did you mean knn"),
        (["{run}", "{empty}"], "nothing|no scored (task, case, fold, entrant) in common"),
        (["{run}", "{tmp}"], "is not a mocapbench run"),
        (["{run}", "{run}", "{run}"], "expected one or two run directories, got 3"),
        (["{run}", "{run}", "--tasks", "toy"], "unknown task 'toy'"),
        (["{run}", "{run}", "--metrics", "mlc"], "no value of mlc in common"),
        (["{run}", "{run}", "--rope", "-1"], "rope"),
        (["{run}", "{run}", "--csv", "{tmp}/no/rows.csv"], "a folder that exists"),
    ],
)
def test_wrong_requests_end_in_one_clear_line(cli, run, tmp_path, arguments, message):
    names = {"run": run("run", records("knn", GOOD)), "empty": run("empty"), "tmp": tmp_path}
    assert cli("compare", *(argument.format(**names) for argument in arguments)) == 2
    assert message.split("|")[-1] in cli.printed
