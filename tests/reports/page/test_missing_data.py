from mocapbench.reports.analysis.troubles import Trouble
from mocapbench.reports.page.missing_data import missing_data


def job(message, case="row", task="missing-frames"):
    return Trouble("job-1", task, case, 0, "knn", "data-missing", message, "")


def lacks(*names, options=""):
    listed = " ".join(names)
    return f"{listed} cannot be had: get it with `mocapbench data fetch {listed}{options}`"


def test_a_missing_recording_is_said_once_whatever_the_jobs():
    jobs = [job(lacks("12_02"), "a"), job(lacks("12_02", "12_03"), "b"), job(lacks("12_03"), "c")]
    (found,) = missing_data([*jobs, *jobs])
    assert found.recordings == ("12_02", "12_03")
    assert found.message == "mocapbench data fetch 12_02 12_03"
    assert (found.jobs, found.tasks) == (6, ("missing-frames",))


def test_commands_with_other_options_stay_apart():
    plugin = lacks("own:a", options=" --plugin own.py")
    first, second = missing_data([job(lacks("12_02")), job(plugin, task="own")])
    assert first.message == "mocapbench data fetch 12_02"
    assert second.message == "mocapbench data fetch own:a --plugin own.py"


def test_another_message_is_shown_as_it_is():
    (found,) = missing_data([job("ask the owner"), job("ask the owner")])
    assert (found.recordings, found.message, found.jobs) == ((), "ask the owner", 2)
