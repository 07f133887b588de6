import subprocess
import sys

import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory.lock import held, is_held

HOLD = (
    "import sys\n"
    "from pathlib import Path\n"
    "from mocapbench.benchmark.runs.directory.lock import held\n"
    "with held(Path(sys.argv[1])):\n"
    "    print('held', flush=True)\n"
    "    sys.stdin.read()\n"
)


def test_others_see_that_it_is_held_and_are_kept_out(tmp_path):
    assert not is_held(tmp_path)
    assert [*tmp_path.iterdir()] == []
    with held(tmp_path):
        assert is_held(tmp_path)
        with pytest.raises(UsageError, match="another run is writing"), held(tmp_path):
            pass
    assert not is_held(tmp_path)


def test_it_is_seen_in_another_process_and_ends_with_it(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout.readline() == "held\n"
        assert is_held(tmp_path)
    finally:
        process.kill()
        process.communicate(timeout=60)
    assert not is_held(tmp_path)


def test_to_look_does_not_need_to_write(tmp_path):
    with held(tmp_path):
        pass
    (tmp_path / "mocapbench.lock").chmod(0o444)
    before = (tmp_path / "mocapbench.lock").stat().st_mtime_ns
    assert not is_held(tmp_path)
    assert (tmp_path / "mocapbench.lock").stat().st_mtime_ns == before
