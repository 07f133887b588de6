import dataclasses

import pytest

from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.plan import plan, required_recordings
from mocapbench.benchmark.runs.request import Request
from mocapbench.benchmark.tasks.base import Entrant
from mocapbench.benchmark.tasks.people import NAMES


def test_recordings_are_wanted_only_where_a_chosen_model_can_run():
    assert (
        required_recordings(Request(tasks=("missing-frames",), models=("mohgp",)), archive_at())
        == ()
    )
    wanted = required_recordings(
        Request(tasks=("missing-frames",), models=("cubic-spline",)), archive_at()
    )
    assert "cmu:35_03" in wanted
    assert len(set(wanted)) == len(wanted)


@pytest.mark.parametrize(
    "profile", ["smoke", "quick", pytest.param("paper", marks=pytest.mark.slow)]
)
def test_every_job_of_a_profile_has_a_key_of_its_own_and_every_problem_a_fit(profile):
    jobs = plan(Request(profile), archive_at())
    assert len({job.key for job in jobs}) == len(jobs)
    assert len({job.fit_key for job in jobs}) == len(
        {(job.seeds, job.address.label) for job in jobs}
    )


def test_a_profile_leaves_out_what_runs_only_when_asked_for():
    archive = archive_at()
    quick = {job.address.label for job in plan(Request(tasks=("missing-frames",)), archive)}
    asked = Request(tasks=("missing-frames",), models=("gpdm-two-stage-window",))
    assert "gpdm-two-stage-window" not in quick
    assert {job.address.label for job in plan(asked, archive)} == {"gpdm-two-stage-window"}


@pytest.mark.parametrize("name", TASKS.names())
def test_generated_gait_stands_in_for_recordings_but_not_among_the_rows_of_the_papers(name):
    task = TASKS.get(name)
    of_paper = {case.name for case in task.cases if not case.synthetic}
    chosen = set(task.profile("paper").cases)
    # Those of many people are of no paper, and have more rows than one can wait for; the contest of
    # motion prediction has rows besides that do without its largest files.
    fewer = name.removesuffix("-angles") in NAMES or name.startswith("motion-prediction")
    assert chosen < of_paper if fewer else chosen == of_paper
    for profile in {"smoke", "quick"} & {*task.profiles}:
        chosen = [task.case(case) for case in task.profile(profile).cases]
        assert any(case.synthetic or not case.recordings for case in chosen)


TASK = TASKS.get("toy-interpolation-1")
FIRST = TASK.cases[0]
TWICE = {
    "entrant 'trivial' twice": {"entrants": (Entrant("trivial", "trivial"),) * 2},
    "case 'test 1' twice": {"cases": (*TASK.cases, FIRST)},
}


@pytest.mark.parametrize(("complaint", "changes"), TWICE.items(), ids=TWICE)
def test_two_rows_of_one_name_are_refused(complaint, changes):
    kind, name = complaint.split(" ")[0], complaint.split("'")[1]
    TASKS.add("mine", dataclasses.replace(TASK, name="mine", **changes))
    expected = f"expected every {kind} under a name of its own, got '{name}' twice"
    with pytest.raises(UsageError, match=expected):
        plan(Request("smoke", tasks=("mine",)), archive_at())


@pytest.mark.parametrize("uri", ["nowhere:01_01", "01_01", "cmu:"])
def test_an_address_that_no_library_can_have_is_refused_by_task_and_case(uri):
    case = dataclasses.replace(FIRST, given=(uri,))
    TASKS.add("mine", dataclasses.replace(TASK, name="mine", cases=(case, *TASK.cases[1:])))
    request = Request("paper", tasks=("mine",), cases=(FIRST.name,))
    for ask in (plan, required_recordings):
        with pytest.raises(UsageError, match=f"task 'mine', case '{FIRST.name}': .* got '{uri}'"):
            ask(request, archive_at())


PAGE = TASK.page
CANNOT_RUN = {
    "got 0": {"profiles": {"smoke": dataclasses.replace(TASK.profile("smoke"), folds=0)}},
    "unknown metric 'msee'": {"page": dataclasses.replace(PAGE, metrics=("mse", "msee"))},
    "metrics to show on its page, got none": {"page": dataclasses.replace(PAGE, metrics=())},
}


@pytest.mark.parametrize(("complaint", "changes"), CANNOT_RUN.items(), ids=CANNOT_RUN)
def test_what_could_not_be_run_or_shown_is_refused_before_the_run(complaint, changes):
    TASKS.add("mine", dataclasses.replace(TASK, name="mine", **changes))
    for ask in (plan, required_recordings):
        with pytest.raises(UsageError, match=f"task 'mine'.*{complaint}"):
            ask(Request("smoke", tasks=("mine",)), archive_at())


def test_a_recording_as_the_database_writes_it_finds_the_cases_on_it():
    chosen = Request(tasks=("missing-frames",), models=("trivial",), cases=("35_03",), folds=1)
    cases = {job.address.case for job in plan(chosen, archive_at())}
    assert cases == {"35-03 four-walkers", "35-03 three-walkers"}


def test_a_label_names_its_entrant_alone_though_others_have_a_model_of_that_name():
    request = Request("smoke", tasks=("missing-frames",), models=("cyclic-alignment",))
    labels = {job.address.label for job in plan(request, archive_at())}
    assert labels == {"cyclic-alignment"}
