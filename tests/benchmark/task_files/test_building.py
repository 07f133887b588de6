"""What the task of a file is, and the problems that it poses."""

from dataclasses import replace

import numpy as np
import pytest
from own_files import write_csv

from mocapbench.baselines.interpolation import LinearImputer
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.runs.keys import fit_contents
from mocapbench.benchmark.runs.request import entrants
from mocapbench.benchmark.task_files.building import build_task
from mocapbench.benchmark.task_files.uniting import united_task_files
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import PROFILES
from mocapbench.benchmark.tasks.seeds import Seeds

TEXT = 'files = "*.csv"\ntraining = "{}"\n[hide]\nframes = "20:30"\n'


@pytest.fixture
def pose(check, folder):
    """Return a function that poses the problem of a task file's case."""

    def pose_problem(text, case="a", fold=0):
        task = build_task(check(text))
        seeds = Seeds(0, Address(task.name, 1, case, fold))
        return task.case(case).problem(seeds, archive_at(folder))

    return pose_problem


def named(recordings):
    return [recording.name for recording in recordings]


def test_models_learn_from_the_recordings_that_the_file_names(pose, folder):
    write_csv(folder / "more" / "c.csv", channels=("knee.x", "hip.y", "hip.x"))
    assert named(pose(TEXT.format("none")).train) == ["files:a.csv"]
    assert named(pose(TEXT.format("others")).train) == ["files:b.csv", "files:a.csv"]
    problem = pose(TEXT.format("more/*.csv"))
    assert named(problem.train) == ["files:more/c.csv", "files:a.csv"]
    assert len({recording.channels for recording in problem.train}) == 1  # in one order


def test_no_model_sees_what_is_hidden(pose):
    problem = pose(TEXT.format("others"))
    for recording in (*problem.given, problem.train[-1]):
        assert np.isnan(recording.values[20:30]).all()
        assert recording.visible.sum() == recording.values.size - 30


def test_the_part_that_counts_is_cut_from_every_recording(pose):
    problem = pose('frames = "10:50"\nchannels = "hip.*"\n' + TEXT.format("others"))
    assert {recording.values.shape for recording in problem.train} == {(40, 2)}
    assert problem.given[0].times[0] == pytest.approx(0.2)


def test_gaps_of_a_file_itself_are_filled_and_not_scored(pose, folder):
    """The score is that of the file without the gaps, of what does not look across them."""
    whole = pose(TEXT.format("none"))
    write_csv(folder / "a.csv", gaps=[(40, 45, 1)])
    gappy = pose(TEXT.format("none"))
    outcomes = []
    for problem in (whole, gappy):
        model = problem.fit(LinearImputer())
        outcomes.append(problem.outcome(problem.solve(model, 0)))
    one, other = outcomes
    assert (one.hidden == other.hidden).all()
    assert np.isfinite(other.truth).all()
    assert one.mean[one.hidden] == pytest.approx(other.mean[other.hidden])
    assert np.isnan(gappy.given[0].values[40:45, 1]).all()


@pytest.mark.parametrize(
    ("hidden", "question"),
    [
        ('frames = "20:30"', "hidden-frames"),
        ("runs = { seconds = [0.1, 0.2] }", "hidden-frames"),
        ("fraction = 0.2", "scattered-samples"),
        ('runs = { seconds = 0.1, together = "channel" }', "other-channels"),
        ('frames = "20:30"\nchannels = "knee.*"', "other-channels"),
        ('channels = "knee.*"', "other-channels"),
    ],
)
def test_the_question_follows_from_what_is_hidden(check, hidden, question):
    task = build_task(check(f'files = "*.csv"\ntraining = "others"\n[hide]\n{hidden}\n'))
    assert task.page.question == question


def test_a_task_is_alike_in_all_profiles_and_names_its_models(check):
    task = build_task(check('models = ["linear", "knn"]\nfolds = 1\n' + TEXT.format("others")))
    assert set(task.profiles) == set(PROFILES)
    profile = task.profiles["paper"]
    assert all(other == profile for other in task.profiles.values())
    assert profile.cases == ("a", "b")
    assert {"linear", "knn"}.isdisjoint(profile.opt_in)
    assert {"hold", "gpdm"} <= set(profile.opt_in)


def test_a_model_takes_part_without_its_calibration_where_the_file_names_it(check):
    text = TEXT.format("others")
    task = build_task(check('models = ["lds", "lds-uncalibrated"]\n' + text))
    (entrant,) = task.entrants
    assert (entrant.label, entrant.model) == ("lds-uncalibrated",) * 2
    assert {"lds", "lds-uncalibrated"}.isdisjoint(task.profiles["paper"].opt_in)
    assert {e.label for e in entrants(task)} > {"lds", "lds-uncalibrated"}
    assert build_task(check('models = ["lds"]\n' + text)).entrants == ()


def test_each_length_of_gaps_is_a_case(check):
    task = build_task(check('files = "*.csv"\n[hide]\nruns = { seconds = [0.1, 0.2] }\n'))
    assert [case.name for case in task.cases] == ["a 0.1 s", "a 0.2 s", "b 0.1 s", "b 0.2 s"]
    assert task.page.along == ("seconds",)
    assert task.cases[1].columns == {"recording": "a", "seconds": 0.2}


def test_recordings_of_one_name_keep_their_suffixes(folder, check):
    path = write_csv(folder / "a.csv")
    path.rename(folder / "b.trc.csv")
    (folder / "b.trc.csv").rename(folder / "b.CSV")
    task = build_task(check(TEXT.format("none").replace('"*.csv"', '["*.csv", "*.CSV"]')))
    assert [case.name for case in task.cases] == ["b.csv", "b.CSV"]


def test_files_named_like_cmus_tell_their_subject_and_others_count_for_themselves(folder, check):
    for name in ("35_01", "35_02"):
        write_csv(folder / f"{name}.csv")
    task = build_task(check(TEXT.format("none")))
    assert {case.name: case.subjects for case in task.cases} == {
        **{"35_01": ("35",), "35_02": ("35",)},
        **{"a": ("a.csv",), "b": ("b.csv",)},
    }


def test_draws_on_one_recording_have_no_subject(check):
    (case,) = build_task(check(TEXT.format("none").replace("*.csv", "a.csv"))).cases
    assert case.subjects == ()


def keys(check, text):
    task = build_task(check(text))
    case = task.cases[0]
    seeds = Seeds(0, Address(task.name, 1, case.problem_name, 0, "linear"))
    digests = dict.fromkeys(case.given, "the same")
    return fit_contents(case, seeds, model=LinearImputer, parameters={}, digests=digests)


def test_keys_cover_the_protocol_and_no_prose(check):
    text = TEXT.format("others")
    first = keys(check, text)
    prose = '# why\ntitle = "Gaps"\ndescription = "of ours"\nmetrics = ["smse"]\nmodels = ["knn"]\n'
    assert keys(check, prose + text.replace("[hide]", "\n\n[hide]  # what")) == first
    changes = (
        text.replace("20:30", "20:31"),
        text.replace("others", "none"),
        text + 'channels = "hip.*"\n',
        'frames = "0:50"\n' + text,
        "rate = 50\n" + text,
        text.replace('frames = "20:30"', "fraction = 0.2"),
    )
    others = [keys(check, changed) for changed in changes]
    assert all(other != first for other in others)


def test_task_files_of_merged_runs_have_the_recordings_of_all(check):
    file = check(TEXT.format("none"))
    one, two = (replace(file, tests=(name,)) for name in file.tests)
    (united,) = united_task_files([one, two, one])
    assert united.tests == file.tests
