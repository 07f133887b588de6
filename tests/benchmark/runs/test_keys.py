import dataclasses
import functools
import importlib

import pytest

from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.runs import keys
from mocapbench.benchmark.runs.keys import fit_key, score_key, source_digest
from mocapbench.benchmark.tasks.seeds import Seeds

TASK = TASKS.get("toy-interpolation-1")
SEEDS = Seeds(0, TASK.name, TASK.version, "test 1", 0)


def _key(case=TASK.cases[0], seeds=SEEDS, **changes):
    entrant = {"label": "trivial", "model": MODELS.get("trivial"), "parameters": {}, "digests": {}}
    return fit_key(TASK, case, seeds, **{**entrant, **changes})


@pytest.mark.parametrize(
    "changes",
    [
        {"seeds": dataclasses.replace(SEEDS, root=1)},
        {"seeds": dataclasses.replace(SEEDS, fold=1)},
        {"case": TASK.cases[1]},
        {"label": "other"},
        {"model": MODELS.get("cubic-spline")},
        {"parameters": {"a": 1}},
        {"digests": {"cmu:02_01": "abc"}},
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_everything_that_can_change_the_result_changes_the_key(changes):
    assert _key(**changes) != _key()


def test_order_of_parameters_does_not():
    assert _key(parameters={"a": 1, "b": 2}) == _key(parameters={"b": 2, "a": 1})


def _score_key(metrics, case="row", references=None):
    return score_key("fit", metrics, case, references or {})


def test_a_metric_changes_the_score_key_alone():
    mse, msll = METRICS.get("mse"), METRICS.get("msll")
    assert _score_key([mse]) != _score_key([mse, msll])
    assert _score_key([mse, msll]) == _score_key([msll, mse])


def test_rows_and_references_change_the_score_key_alone():
    mse, asked = METRICS.get("mse"), dataclasses.replace(TASK.cases[0], question="what is asked")
    row, other = (dataclasses.replace(asked, name=name, settings={"row": name}) for name in "ab")
    assert _key(row) == _key(other) != _key()
    keys = [_score_key([mse], "a"), _score_key([mse], "b"), _score_key([mse], "a", {"r": "0"})]
    assert len({*keys, _score_key([mse], "a", {"r": "1"})}) == 4


@pytest.mark.parametrize("name", METRICS.names())
def test_a_metric_is_named_by_its_own_source(name, monkeypatch):
    """Also where the function is bound to arguments, which count too."""
    metric = METRICS.get(name)
    before = _score_key([metric])
    statistic = functools.partial(metric.statistic, level=0.123)
    assert _score_key([dataclasses.replace(metric, statistic=statistic)]) != before
    monkeypatch.setattr(keys, "_source", lambda module: f"# {module}" * ("mocapbench" in module))
    source_digest.cache_clear()
    assert _score_key([metric]) != before
    source_digest.cache_clear()


def test_the_harness_that_poses_and_scores_is_part_of_the_key(monkeypatch):
    before, read = _key(), keys._source
    for module in ("problems.impute", "tasks.seeds", "runs.solve", "problems.masks"):
        changed = f"mocapbench.benchmark.{module}"
        monkeypatch.setattr(keys, "_source", lambda m, c=changed: read(m) + "# changed" * (m == c))
        source_digest.cache_clear()
        assert _key() != before, module
    monkeypatch.undo()
    source_digest.cache_clear()


def test_a_users_helper_module_is_part_of_the_key(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "helper_x.py").write_text("VALUE = 0\n")
    (tmp_path / "main_x.py").write_text("import helper_x\n")
    importlib.import_module("main_x")
    before = source_digest("main_x", ())
    (tmp_path / "helper_x.py").write_text("VALUE = 1\n")
    source_digest.cache_clear()
    assert source_digest("main_x", ()) != before


def test_a_source_digest_follows_imports_to_the_engine(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "engine_x.py").write_text("def solve():\n    return 1\n")
    (tmp_path / "model_x.py").write_text("from engine_x import solve\n")
    (tmp_path / "model_y.py").write_text("from engine_x import solve\n")
    before = source_digest("model_x", ("engine_x",))
    assert before == source_digest("model_x", ("engine_x",))
    (tmp_path / "engine_x.py").write_text("def solve():\n    return 2\n")
    source_digest.cache_clear()
    assert source_digest("model_x", ("engine_x",)) != before
