"""The tasks of many people: what is hidden, who is learnt from, and that nothing leaks."""

import re

import numpy as np
import pytest

from mocapbench.benchmark import TASKS, Address, Request, Seeds, archive_at, people_tasks, plan
from mocapbench.benchmark.registry import MODELS, build_unfitted
from mocapbench.benchmark.runs.request import entrants
from mocapbench.benchmark.tasks.people import N_BESIDE, N_GAPS, RATE, SECONDS
from mocapbench.datasets import Archive, FormatError, GaitLibrary, Library, People, read_people
from mocapbench.reports import CaseLayout
from mocapbench.reports.analysis.units import unit_names

NAMES = ("lost-limb", "lost-markers", "in-betweening")
TASK_NAMES = [f"{name}{end}" for name in NAMES for end in ("", "-angles")]
REGIMES = ("alone", "own", "3 strangers", "10 strangers", "30 strangers", "100 strangers")
FAST = ("linear", "nn", "pca-regression", "low-rank", "pose-viterbi", "marker-kriging")
SHORT = "lost-limb", "synthetic 0.5 s 3 strangers"


def list_asked(problem):
    """Return which entries are hidden and scored: (N, D)."""
    return ~problem.given[0].visible & np.isfinite(problem.truth[0])


def hidden_runs(problem):
    """Return the first frame and the length of each gap, in order."""
    frames = np.flatnonzero(list_asked(problem).any(axis=1))
    ends = np.flatnonzero(np.diff(frames) > 1)
    starts = frames[np.r_[0, ends + 1]]
    return [(int(a), int(b - a + 1)) for a, b in zip(starts, frames[np.r_[ends, -1]], strict=True)]


def pose(task, case, fold=0, archive=None):
    address = Address(task.name, task.version, case, fold)
    return task.case(case).problem(Seeds(0, address), archive or archive_at())


@pytest.mark.parametrize("name", TASK_NAMES)
def test_every_task_has_all_regimes_and_lengths_on_recordings_and_on_generated_walkers(name):
    expected = {f"{seconds:g} s {regime}" for seconds in SECONDS for regime in REGIMES}
    cases = {case.name: case.synthetic for case in TASKS.get(name).cases}
    assert {case for case, synthetic in cases.items() if not synthetic} == expected
    assert {case for case, synthetic in cases.items() if synthetic} == {
        f"synthetic {case}" for case in expected
    }


@pytest.mark.parametrize("name", TASK_NAMES)
@pytest.mark.parametrize("seconds", SECONDS)
@pytest.mark.parametrize("fold", [0, 7])
def test_gaps_are_as_long_as_declared_and_leave_frames_between(posed, name, seconds, fold):
    problem = posed(name, f"synthetic {seconds:g} s alone", fold)
    runs, n_frames = hidden_runs(problem), len(problem.given[0].times)
    length = round(RATE * seconds)
    room = (n_frames - N_BESIDE) // (length + N_BESIDE)
    assert [n for _, n in runs] == [length] * min(N_GAPS, room)
    edges = [0, *(edge for start, n in runs for edge in (start, start + n)), n_frames]
    assert min(b - a for a, b in zip(edges[::2], edges[1::2], strict=True)) >= N_BESIDE
    np.testing.assert_allclose(np.diff(problem.given[0].times), 1 / RATE)


def test_what_is_hidden_depends_on_the_fold_and_neither_on_training_nor_on_values(posed):
    def joints(task, case, fold=3):
        (given,) = posed(task, case, fold).given
        columns = np.flatnonzero(~given.visible.all(axis=0))
        return {given.channels[column].partition(".")[0] for column in columns}

    one = posed("lost-limb", "synthetic 1 s alone", 3).given[0].visible
    other = posed("lost-limb", "synthetic 1 s 10 strangers", 3).given[0].visible
    np.testing.assert_array_equal(one, other)
    limbs = joints("lost-limb", "synthetic 0.25 s alone")
    assert joints("lost-limb", "synthetic 0.5 s alone") == limbs
    assert joints("lost-limb-angles", "synthetic 0.25 s alone") <= limbs
    runs = [
        hidden_runs(posed(f"lost-limb{end}", "synthetic 0.25 s alone", 3))
        for end in ("", "-angles")
    ]
    assert runs[0] == runs[1]


def test_the_frame_before_a_gap_whose_root_steps_into_it_is_neither_shown_nor_asked(posed):
    problem = posed("in-betweening-angles", "synthetic 0.5 s own", 2)
    unknown = np.isnan(problem.truth[0])
    before = [start - 1 for start, _ in hidden_runs(problem)]
    assert unknown[before].all()
    assert unknown.sum() == unknown[before].size
    outcome = problem.outcome(problem.solve(MODELS.get("linear")().fit(problem.train), 0))
    np.testing.assert_array_equal(outcome.hidden, list_asked(problem))
    assert np.isfinite(outcome.place_joints().truth).all()


def test_what_is_hidden_of_somebody_does_not_depend_on_whether_others_have_recordings():
    rows = [
        "02\t01\t02\t120\ttest\twalk",  # learns from nothing of its own
        *(f"03\t0{t}\t03\t120\t{'train' if t > 1 else 'test'}\twalk" for t in (1, 2)),
    ]
    alone = pose_own_list(rows, GaitLibrary(), "0.25 s alone", fold=1)
    own = pose_own_list(rows, GaitLibrary(), "0.25 s own", fold=0)
    assert alone.given[0].name == own.given[0].name == "cmu:03_01"
    np.testing.assert_array_equal(alone.given[0].visible, own.given[0].visible)
    assert hidden_runs(pose_own_list(rows, GaitLibrary(), "0.25 s own", 1)) != hidden_runs(own)


def test_what_is_hidden_is_a_limb_five_joints_or_all(posed):
    def hidden_joints(name):
        (given,) = posed(name, "synthetic 2 s alone", 1).given
        columns = np.flatnonzero(~given.visible.all(axis=0))
        return {given.channels[column].partition(".")[0] for column in columns}

    assert len({joint[0] for joint in hidden_joints("lost-limb")}) == 1
    assert len(hidden_joints("lost-markers")) == 5
    assert len(hidden_joints("in-betweening")) == 31
    assert "root" not in hidden_joints("lost-limb") | hidden_joints("lost-markers")


def test_units_of_positions_are_cm_and_of_joint_angles_degrees(posed):
    assert set(posed("lost-limb", "synthetic 1 s alone").given[0].units) == {"cm"}
    angles = posed("lost-limb-angles", "synthetic 1 s alone").given[0]
    assert angles.units.count("deg") == 47
    assert len(angles.channels) == 50


@pytest.mark.parametrize("name", TASK_NAMES)
def test_the_folds_of_a_case_go_through_people_and_each_is_one_unit(name):
    for case in TASKS.get(name).cases:
        if case.synthetic:
            continue
        n = 28 if "own" in case.name else 30
        layout = CaseLayout(case.name, {}, subjects=case.subjects)
        units = unit_names(layout, range(90), independent=True)
        assert len(case.subjects) == n
        assert len(set(units)) == n - 1  # those who dance together are one
        for fold in range(90):
            tested = case.given_in(fold)[0].removeprefix("cmu:").partition("_")[0]
            assert units[fold] == f"subject {'60' if tested == '61' else tested}"


def test_a_fold_of_quick_is_of_another_person():
    case = TASKS.get("lost-limb").case("1 s 10 strangers")
    assert len({case.subjects[fold] for fold in range(12)}) == 12


@pytest.mark.parametrize("name", TASK_NAMES)
def test_no_test_recording_and_no_tested_person_is_in_a_shared_fit(name):
    people = read_people()
    tests = {uri for subject in people.subjects for uri in people.tests(subject)}
    for case in TASKS.get(name).cases:
        for fold in range(0 if case.synthetic else 90):
            tested, *training = case.given_in(fold)
            assert tested in tests
            assert not tests & set(training)
            assert bool(case.training_in(fold)) == bool(training)
            if "strangers" in case.name:
                assert f"{tested.partition('_')[0]}_" not in " ".join(training)


def test_models_learn_from_the_recording_itself_alone_or_not_at_all(posed):
    alone = posed("lost-limb", "synthetic 1 s alone")
    (seen,) = alone.train
    assert seen is alone.given[0]
    for regime in ("own", "3 strangers"):
        problem = posed("lost-limb", f"synthetic 1 s {regime}")
        assert len(problem.train) == 3
        assert problem.given[0].name not in {recording.name for recording in problem.train}


class Perturbed(Archive):
    """An archive in which values of one recording are others, where a mask says so."""

    def __init__(self, uri, hidden):
        super().__init__(archive_at().libraries)
        self.uri, self.hidden = uri, hidden

    def recording(self, uri):
        recording = super().recording(uri)
        if uri != self.uri:
            return recording
        values = recording.values.copy()
        rng = np.random.default_rng(0)
        owners = [channel.partition(".")[0] for channel in recording.channels]
        for joint, rows in self.hidden.items():
            columns = [i for i, owner in enumerate(owners) if owner == joint]
            values[np.ix_(rows * 4, columns)] += rng.normal(0, 20, (len(rows), len(columns)))
        return recording.with_values(values)


def perturb_hidden(task, case, fold):
    """Return the problem of a fold, and the same where hidden values are others."""
    one = pose(task, case, fold)
    (given,) = one.given
    hidden, asked = {}, list_asked(one)
    for column, channel in enumerate(given.channels):
        rows = np.flatnonzero(asked[:, column])
        if len(rows):
            hidden[channel.partition(".")[0]] = rows
    return one, pose(task, case, fold, Perturbed(given.name, hidden))


# Of five joints in space, the positions of others follow from the same angles.
CLOSED = [name for name in TASK_NAMES if name != "lost-markers"]


@pytest.mark.parametrize("name", CLOSED)
@pytest.mark.parametrize("regime", ["alone", "own", "3 strangers", "10 strangers"])
def test_what_models_see_does_not_change_when_hidden_values_do(name, regime):
    one, other = perturb_hidden(TASKS.get(name), f"synthetic 0.5 s {regime}", 2)
    assert np.nanmax(np.abs(one.truth[0] - other.truth[0])) > 1
    for a, b in zip((*one.train, *one.given), (*other.train, *other.given), strict=True):
        np.testing.assert_array_equal(a.values, b.values)


def predict(problem, label, task):
    (entrant,) = [entrant for entrant in entrants(task) if entrant.label == label]
    model = MODELS.get(entrant.model)(**entrant.parameters)
    small = {"max_iter": 3, "n_restarts": 1, "random_state": 0}
    model.set_params(**{k: v for k, v in small.items() if k in model.get_params()})
    return problem.solve(problem.fit(model), 0)[0].mean


def check_predictions(name, regime, label):
    task = TASKS.get(name)
    one, other = perturb_hidden(task, f"synthetic 0.5 s {regime}", 4)
    try:
        predicted = predict(one, label, task)
    except ValueError as error:  # it needs longer stretches than are visible
        with pytest.raises(ValueError, match=re.escape(str(error))):
            predict(other, label, task)
    else:
        np.testing.assert_array_equal(predicted, predict(other, label, task))


@pytest.mark.parametrize("label", FAST)
@pytest.mark.parametrize("name", ["lost-limb", "in-betweening-angles"])
def test_predictions_do_not_change_when_hidden_values_do(name, label):
    if TASKS.get(name).accepts(build_unfitted(label)):
        for regime in ("alone", "3 strangers"):
            check_predictions(name, regime, label)


@pytest.mark.slow
@pytest.mark.parametrize("regime", ["own", "3 strangers"])
@pytest.mark.parametrize("name", CLOSED)
def test_predictions_of_all_models_do_not_change_when_hidden_values_do(name, regime):
    left_out = set(TASKS.get(name).profile("paper").opt_in)
    for entrant in entrants(TASKS.get(name)):
        if entrant.label not in left_out:
            check_predictions(name, regime, entrant.label)


def planned(case, folds, model="nn", archive=None):
    request = Request("paper", ("lost-limb",), (model,), (case,), ("mpjpe",), folds)
    return plan(request, archive or archive_at())


def test_models_of_strangers_are_fitted_once_a_group_and_number_for_all_lengths():
    jobs = planned("synthetic * strangers", 30)
    of_number = {}
    for job in jobs:
        number = job.address.case.split(" s ")[1]
        of_number.setdefault(number, set()).add(job.training_key)
    assert {number: len(keys) for number, keys in of_number.items()} == {
        f"{n} strangers": 3 for n in (3, 10, 30, 100)
    }
    assert "" not in set().union(*of_number.values())
    own = {job.training_key for job in planned("synthetic * own", 60)}
    assert len(own) == 30


def test_a_person_whose_files_are_absent_is_missing_and_the_others_are_not():
    class WithoutTwo(GaitLibrary):
        def where(self, key):
            return "" if key.startswith("102_") else super().where(key)

    archive = Archive({**archive_at().libraries, "gait": WithoutTwo()})
    alone = planned("synthetic 1 s alone", 30, archive=archive)
    assert [job.address.fold for job in alone if job.missing] == [1]
    own = planned("synthetic 1 s own", 30, archive=archive)
    assert [job.address.fold for job in own if job.missing] == [1]


HEADS = "subject\ttrial\tperson\trate\trole\tshows"


def pose_own_list(rows, library, case="0.25 s alone", fold=0):
    people = People("\n".join([HEADS, *rows]), "list.tsv")
    archive = Archive({"cmu": library})
    return pose(people_tasks(people)["lost-limb"], case, fold, archive)


class Short(GaitLibrary):
    """Walks of two thirds of a second."""

    def recording(self, key):
        return super().recording(key).frames(np.arange(70))


class WithoutSkeleton(GaitLibrary):
    def skeleton(self, key):
        return Library.skeleton(self, key)


def test_a_recording_shorter_than_its_gap_is_named_with_its_line():
    rows = ["02\t01\t02\t120\ttrain\twalk", "02\t02\t02\t120\ttest\twalk"]
    expected = (
        r"list.tsv, line 3: expected 25 frames or more at 30 per second, for a gap of 15, got 18 "
        r"in cmu:02_02; test the person on a longer"
    )
    assert len(hidden_runs(pose_own_list(rows, Short()))) == 1
    with pytest.raises(FormatError, match=expected):
        pose_own_list(rows, Short(), "0.5 s alone")


def test_a_missing_skeleton_is_named_with_its_line():
    rows = ["02\t01\t02\t120\ttest\twalk"]
    expected = r"list.tsv, line 2: expected a recording with a skeleton, got none in cmu:02_01"
    with pytest.raises(FormatError, match=expected):
        pose_own_list(rows, WithoutSkeleton())


def test_a_list_of_ones_own_stands_beside_the_tasks_that_are_installed(tmp_path, cli):
    plugin = tmp_path / "plugin.py"
    plugin.write_text(
        "from mocapbench.benchmark import people_tasks\n"
        "from mocapbench.datasets import read_people\n"
        "TASKS = people_tasks(read_people(), prefix='our-')\n"
    )
    assert cli("list", "tasks", "--plugin", plugin) == 0
    assert set(re.findall(r"our-[a-z-]+", cli.printed)) == {f"our-{name}" for name in TASK_NAMES}


def test_a_list_of_few_recordings_has_no_cases_of_more_strangers_than_there_are():
    rows = [
        f"{s:02}\t{t:02}\t{s:02}\t60\t{'train' if t > 1 else 'test'}\twalk"
        for s in range(2, 8)
        for t in (1, 2)
    ]
    tasks = people_tasks(People("\n".join([HEADS, *rows]), "list.tsv"))
    regimes = {case.name.split(" s ")[1] for case in tasks["lost-limb"].cases}
    assert regimes == {"alone", "own", "3 strangers"}


def test_recordings_at_half_the_rate_take_twice_the_share_of_frames():
    def given(rate):
        rows = [f"02\t01\t02\t{rate}\ttest\twalk"]
        return pose_own_list(rows, GaitLibrary()).given[0]

    slow, fast = given(60), given(120)
    assert len(slow.times) in (2 * len(fast.times), 2 * len(fast.times) - 1)
    np.testing.assert_allclose(np.diff(slow.times), 1 / RATE)


def test_paper_runs_both_curves_on_recordings_of_thirty_people():
    for name in TASK_NAMES:
        profile = TASKS.get(name).profile("paper")
        assert profile.folds == 30
        assert set(profile.cases) == {
            *(f"1 s {regime}" for regime in REGIMES),
            *(f"{s:g} s {regime}" for s in SECONDS for regime in ("alone", "own", "30 strangers")),
        }


def test_columns_of_scores_say_from_how_many_recordings_of_whom_models_learn():
    columns = {case.name: case.columns for case in TASKS.get("lost-limb").cases}
    assert columns["1 s own"] == {"learnt from": "the person", "recordings": 3, "seconds": 1.0}
    assert columns["1 s alone"] == {"learnt from": "others", "recordings": 0, "seconds": 1.0}
    assert columns["2 s 30 strangers"]["recordings"] == 30
