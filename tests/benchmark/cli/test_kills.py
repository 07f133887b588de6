"""Commands that are killed at random moments leave nothing, and go on; the script kills more."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

SCRIPT = Path(__file__).parents[3] / "docs" / "evidence" / "kills.py"


@pytest.mark.parametrize("case", ["run", "fill-csv", "check"])
def test_kills_leave_no_process_no_half_file_no_other_file_and_the_same_end(case):
    words = [sys.executable, SCRIPT, "--kills", "4", "--seed", "50", case]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
