"""A model, or a metric, that misbehaves costs its own record and nothing else."""

import psutil
import pytest

from mocapbench.benchmark.runs.execution import job_pool

LITTERS = ["sleep", "601"], ["sleep", "602"]
ENDINGS = {
    "raises": ("failed", "RuntimeError: the model <b>raised</b>"),
    "wordy": ("failed", "ValueError: xxx"),
    "silent": ("failed", "_SilentError, whose message cannot be read"),
    "singular": ("failed", "LinAlgError"),
    "not-a-number": ("failed", "expected a finite mean"),
    "diverges": ("failed", "mse is inf: numbers overflowed; expected a finite score"),
    "wrong-shape": ("failed", "expected a mean of shape (50, 3), got (2, 2)"),
    "wrong-count": ("failed", "expected a list of 1 Prediction, got []"),
    "no-variance": ("failed", "expected a positive variance"),
    "hangs": ("timeout", "killed after 5 s"),
    "exits": ("failed", "SystemExit: 5"),
    "interrupts": ("failed", "KeyboardInterrupt"),
    "arrays": ("failed", "expected a list of 1 Prediction"),
    "unlocks": ("failed", "cannot set WRITEABLE flag"),
    "counts": ("ok", ""),
    "dies": ("failed", "exit code 7"),
    "hungry": ("out-of-memory", "raise --memory"),
    "litters": ("ok", ""),
    "meddles": ("failed", "RuntimeError: meddled"),
    "rigs": ("ok", ""),
    "well-behaved": ("ok", ""),
}
BY_METRIC = {
    "sleeps": ("timeout", "killed after 2 s"),
    "hangs": ("timeout", "killed after 2 s"),
    "dies": ("failed", "exit code 7"),
    "leaves": ("failed", "the worker died with exit code 0"),
    "exits": ("failed", "the metric 'exits' raised SystemExit: 5"),
    "raises": ("failed", "the metric 'raises' raised RuntimeError: the metric raised"),
    "hoards": ("out-of-memory", "raise --memory"),
    "litters": ("ok", ""),
}


BACKENDS = {"this machine": ("--jobs", 2), "a cluster": ("--cluster", "local:2")}


@pytest.fixture
def arguments(tmp_path, broken_models):
    return [
        *("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--folds", 1),
        *("--plugin", broken_models, "--out", tmp_path / "run", "--offline"),
    ]


@pytest.fixture
def short_grace(monkeypatch):
    """Kill jobs from outside soon after their time."""
    monkeypatch.setattr(job_pool, "_GRACE", 5.0)


def _litter():
    return [p for p in psutil.process_iter(["cmdline"]) if p.info["cmdline"] in LITTERS]


@pytest.mark.slow
@pytest.mark.parametrize("backend", BACKENDS.values(), ids=BACKENDS)
def test_each_ending_is_recorded_and_the_others_run(cli, records, arguments, tmp_path, backend):
    assert cli(*arguments, *backend, "--models", ",".join(ENDINGS), "--timeout", 5) == 3
    found = {label: record for (_, _, label, _), record in records(tmp_path / "run").items()}
    assert {label: record["status"] for label, record in found.items()} == {
        label: status for label, (status, _) in ENDINGS.items()
    }
    for label, (_, message) in ENDINGS.items():
        assert message in found[label]["message"]
    assert _litter() == []
    assert "RuntimeError" in found["raises"]["traceback"]
    assert found["well-behaved"]["scores"]["mse"] > 0
    page = (tmp_path / "run" / "report.html").read_text()
    assert "the model &lt;b&gt;raised" in page
    assert "<b>raised" not in page


@pytest.mark.slow
@pytest.mark.parametrize("metric", BY_METRIC)
@pytest.mark.usefixtures("short_grace")
def test_a_metric_fails_its_jobs_and_ends_no_run(cli, records, arguments, broken_metrics, metric):
    status, message = BY_METRIC[metric]
    seconds = 2 if status == "timeout" else 60
    chosen = ("--models", "well-behaved,trivial", "--metrics", metric, "--timeout", seconds)
    chosen = (*chosen, "--jobs", 1, "--no-report")
    assert cli(*arguments, "--plugin", broken_metrics, *chosen) == (0 if status == "ok" else 3)
    out = arguments[arguments.index("--out") + 1]
    found = list(records(out).values())
    assert [record["status"] for record in found] == [status] * 2
    assert all(message in record["message"] for record in found)
    assert _litter() == []


@pytest.mark.slow
def test_one_bad_metric_leaves_the_other_scores_and_is_tried_again(
    cli, records, arguments, broken_metrics, tmp_path
):
    chosen = ("--models", "trivial", "--metrics", "mse,raises", "--plugin", broken_metrics)
    for _ in range(2):
        assert cli(*arguments, *chosen, "--jobs", 1) == 3
        assert "1 failed" in cli.printed
        (record,) = records(tmp_path / "run").values()
        assert record["status"] == "failed"
        assert record["scores"].keys() == {"mse"}
    page = (tmp_path / "run" / "report.html").read_text()
    assert "the metric &#39;raises&#39; raised RuntimeError" in page


@pytest.mark.slow
def test_what_a_model_does_to_metrics_changes_no_score_of_its_own(cli, records, arguments):
    assert cli(*arguments, "--models", "rigs,well-behaved", "--jobs", 1, "--no-report") == 0
    out = arguments[arguments.index("--out") + 1]
    rigged, honest = records(out).values()
    assert rigged["scores"] == honest["scores"]
    assert honest["scores"]["mse"] > 0


@pytest.mark.slow
def test_no_reference_is_made_of_a_run_with_scores_that_are_not_finite(cli, arguments, tmp_path):
    assert cli(*arguments, "--models", "diverges,well-behaved", "--no-report") == 3
    reference = ("--reference", tmp_path / "reference.csv", "--update")
    assert cli("check", tmp_path / "run", *reference) == 2
    assert "1 job failed (diverges" in cli.printed
    assert not (tmp_path / "reference.csv").exists()


def test_a_parameter_that_is_no_plain_value_is_refused(cli, tmp_path, arguments):
    source = (
        "from mocapbench.baselines.trivial import Trivial\n"
        "class M(Trivial):\n"
        "    def __init__(self, kernel=object()):\n"
        "        self.kernel = kernel\n"
        "MODELS = {'with-object': M}\n"
    )
    (tmp_path / "models.py").write_text(source)
    chosen = ("--models", "with-object", "--plugin", tmp_path / "models.py")
    assert cli(*arguments, *chosen) == 2
    assert "expected parameters that JSON can hold" in cli.printed


@pytest.mark.slow
def test_what_a_model_does_to_its_process_changes_no_other_score(cli, records, arguments, tmp_path):
    """One worker, so that every job after the first is forked from where the others were."""
    chosen = "meddles,litters,hungry,well-behaved,trivial,knn"
    assert cli(*arguments, "--models", chosen, "--jobs", 1) == 3
    assert cli(*arguments, "--models", "well-behaved,trivial,knn", "--out", tmp_path / "alone") == 0
    beside, alone = (records(tmp_path / name) for name in ("run", "alone"))
    assert len(alone) == 3
    for address, record in alone.items():
        assert beside[address]["scores"] == record["scores"]


@pytest.mark.slow
def test_a_broken_job_is_tried_again_and_a_finished_one_is_not(cli, records, arguments, tmp_path):
    assert cli(*arguments, "--models", "raises,well-behaved") == 3
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "run/records").glob("*/*")}
    assert cli(*arguments, "--models", "raises,well-behaved") == 3
    changed = [p for p, when in before.items() if p.stat().st_mtime_ns != when]
    assert "1 of 2 jobs are in" in cli.printed
    assert len(changed) == 1
