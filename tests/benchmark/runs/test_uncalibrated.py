"""Models without their calibration: beside the calibrated ones, where they are named."""

import pytest

from mocapbench.baselines import LDS, Calibrated
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.errors import UnregisteredNameError
from mocapbench.benchmark.registry import CALIBRATIONS, MODELS, TASKS, find_calibration
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.request import Request, entrants, nameable_entrants


def plan_jobs(*models, task="toy-interpolation-1"):
    return plan(Request("smoke", (task,), models, folds=1), archive_at())


def test_every_calibration_is_of_a_model_that_is_registered():
    assert set(CALIBRATIONS.names()) <= set(MODELS.names())


def test_a_calibrated_model_has_a_second_name_that_is_not_listed():
    assert MODELS.get("lds-uncalibrated") is LDS
    assert "lds-uncalibrated" not in MODELS.names()
    assert find_calibration("lds") is Calibrated
    assert find_calibration("lds-uncalibrated") is None


@pytest.mark.parametrize("name", ["linear-uncalibrated", "-uncalibrated", "nn-uncalibrated"])
def test_a_model_without_a_calibration_has_no_such_name(name):
    with pytest.raises(UnregisteredNameError):
        MODELS.get(name)
    with pytest.raises(UnregisteredNameError):
        plan_jobs(name)


def test_uncalibrated_entrants_take_part_only_where_they_are_named():
    assert not [job for job in plan_jobs() if "uncalibrated" in job.address.label]
    labels = {job.address.label for job in plan_jobs("lds", "lds-uncalibrated")}
    assert labels == {"lds", "lds-uncalibrated"}


def test_an_entrant_of_a_task_keeps_its_parameters_without_calibration():
    by_label = {one.label: one for one in nameable_entrants(TASKS.get("toy-interpolation-1"))}
    calibrated, plain = by_label["mohgp-3"], by_label["mohgp-3-uncalibrated"]
    assert (plain.model, plain.parameters) == ("mohgp-uncalibrated", calibrated.parameters)
    (job,) = {job.address.label: job for job in plan_jobs("mohgp-3-uncalibrated")}.values()
    assert job.parameters["n_components"] == 3


def test_a_model_s_uncalibrated_name_stands_for_all_of_its_entrants():
    task = TASKS.get("walking-interpolation")
    expected = {e.label + "-uncalibrated" for e in entrants(task) if e.model == "mohgp"}
    labels = {j.address.label for j in plan_jobs("mohgp-uncalibrated", task=task.name)}
    assert labels == expected


def test_both_have_the_same_seeds_and_keys_of_their_own():
    one, other = (plan_jobs(name)[0] for name in ("lds", "lds-uncalibrated"))
    assert one.seeds == other.seeds
    assert one.fit_key != other.fit_key
    assert one.parts.keys() == other.parts.keys()
    differing = {part for part in one.parts if one.parts[part] != other.parts[part]}
    assert differing == {"calibration code"}


def test_published_and_calibrated_stand_side_by_side_in_a_table(cli, records, tmp_path):
    toy = ("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--offline")
    models = ("--models", "mohgp-3,mohgp-3-uncalibrated", "--folds", 1)
    assert cli(*toy, *models, "--metrics", "mse,msll", "--out", tmp_path / "run") == 0, cli.printed
    by_label = {label: one for (_, _, label, _), one in records(tmp_path / "run").items()}
    mse, msll = (
        {label: one["scores"][metric] for label, one in by_label.items()}
        for metric in ("mse", "msll")
    )
    assert mse["mohgp-3"] == mse["mohgp-3-uncalibrated"]
    assert msll["mohgp-3"] != msll["mohgp-3-uncalibrated"]
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert "mohgp-3-uncalibrated" in page
