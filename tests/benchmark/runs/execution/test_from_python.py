"""A run that a script starts, as the example shows it."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[4] / "examples" / "run_from_python.py"
SCRIPT = EXAMPLE.read_text(encoding="utf-8")
GUARD = 'if __name__ == "__main__":\n    main()'


def run(script, folder):
    (folder / "my_run.py").write_text(script)
    words = [sys.executable, "my_run.py"]
    return subprocess.run(words, check=False, cwd=folder, capture_output=True, text=True)


@pytest.mark.slow
def test_the_example_runs_and_its_folder_is_a_run(tmp_path, cli):
    ended = run(SCRIPT, tmp_path)
    assert ended.returncode == 0, ended.stderr
    assert re.search(r"knn +0 +mse", ended.stdout)
    assert cli("status", tmp_path / "from-python") == 0


@pytest.mark.slow
def test_a_script_without_a_guard_says_what_to_do_and_leaves_no_failed_records(tmp_path):
    assert GUARD in SCRIPT
    ended = run(SCRIPT.replace(GUARD, "main()"), tmp_path)
    assert ended.returncode != 0
    assert ended.stderr.rstrip().endswith('put what it does below `if __name__ == "__main__":`')
    assert not [*(tmp_path / "from-python" / "records").rglob("*.json")]
