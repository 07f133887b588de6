"""Each line of the log is one strict JSON object, whole as soon as it is told."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.events import EventLog, event_log
from mocapbench.benchmark.tasks.address import Address

TEXT = st.text() | st.sampled_from(["\x1b[31m\x00", "a\nb\r\u2028", '"\\', "\ud800"])
HERE = Address("t", 1, "c", 0, "label")


def _strict(line):
    def refuse(constant):
        raise AssertionError(constant)

    return json.loads(line, parse_constant=refuse)


@given(st.builds(Address, TEXT, st.integers(1, 9), TEXT, st.integers(0, 9), TEXT), TEXT)
def test_whatever_happens_is_one_line_of_printable_json(address, message):
    lines = []
    log = EventLog(lines.append)
    log.tell_job_start(address)
    log.tell_job_end(address, "failed", 1.23456, message)
    started, ended = map(_strict, lines)
    assert {"event": "job-started", **address._asdict()}.items() <= started.items()
    assert (ended["message"], ended["seconds"], ended["status"]) == (message, 1.235, "failed")
    assert all(line.isascii() and line[:-1].isprintable() and line[-1] == "\n" for line in lines)


def test_a_line_is_in_the_file_as_soon_as_it_is_told(tmp_path):
    path = tmp_path / "log.jsonl"
    with event_log(path) as log:
        log.tell_run_start(tmp_path, 4, 1)
        assert _strict(path.read_text())["in_store"] == 1
        log.tell_job_end(HERE, "ok", 0.5, "")
        assert len(path.read_text().splitlines()) == 2
        log.tell_job_end(HERE, "failed", 0.5, "no")
        log.tell_run_end(ExitCode.JOBS_FAILED)
    last = _strict(path.read_text().splitlines()[-1])
    assert (last["counts"], last["exit_code"]) == ({"ok": 1, "failed": 1}, 3)


def test_a_log_is_added_to(tmp_path):
    for _ in range(2):
        with event_log(tmp_path / "log.jsonl") as log:
            log.tell_run_end(ExitCode.OK)
    assert len((tmp_path / "log.jsonl").read_text().splitlines()) == 2


def test_without_a_file_nothing_is_written(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    with event_log(None) as log:
        log.tell_job_start(HERE)
    assert not [*tmp_path.iterdir()]
    assert capfd.readouterr() == ("", "")


def test_what_json_does_not_have_is_refused():
    with pytest.raises(ValueError, match="JSON"):
        EventLog().tell_job_end(HERE, "ok", math.nan, "")
