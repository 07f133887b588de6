import pandas as pd

from mocapbench.reports.page.notes import missing_data

FETCH = "mocapbench data fetch"


def job(*names, fetch=FETCH, message="not on this machine", case="row", task="missing-frames"):
    return {"task": task, "case": case, "message": message, "missing": list(names), "fetch": fetch}


def grouped(jobs):
    return missing_data(pd.DataFrame(jobs))


def test_a_missing_recording_is_said_once_whatever_the_jobs():
    jobs = [job("12_02", case="a"), job("12_02", "12_03", case="b"), job("12_03", case="c")]
    (found,) = grouped([*jobs, *jobs])
    assert found["recordings"] == ["12_02", "12_03"]
    assert found["message"] == "mocapbench data fetch 12_02 12_03"
    assert (found["jobs"], found["tasks"]) == (6, ["missing-frames"])


def test_commands_with_other_options_stay_apart():
    plugin = job("own:a walk", fetch=f"{FETCH} --plugin own.py", task="own")
    first, second = grouped([job("12_02"), plugin])
    assert first["message"] == "mocapbench data fetch 12_02"
    assert second["message"] == "mocapbench data fetch --plugin own.py 'own:a walk'"


def test_a_message_without_names_is_shown_as_it_is():
    (found,) = grouped([job(fetch="", message="ask the owner")] * 2)
    assert found == {
        "recordings": [],
        "message": "ask the owner",
        "tasks": ["missing-frames"],
        "jobs": 2,
    }
