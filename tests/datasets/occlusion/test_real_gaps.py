"""Gaps of real files: lengths and overlaps alone, as the script derives them."""

import subprocess
import sys
from pathlib import Path

from shared_files import shared

from mocapbench.datasets.occlusion.real_gaps import real_gaps

ROOT = Path(__file__).parents[3]
TABLE = ROOT / "datasets" / "occlusion" / "real_gaps.csv"


def test_gaps_are_by_file_in_seconds_and_the_longest_of_a_group_comes_first():
    files = real_gaps()
    assert {*files} == {"nexus_markers.csv", "walkingOptiTrack.c3d"}
    for seconds, groups in files.values():
        assert all(list(group) == sorted(group, reverse=True) for group in groups)
        assert all(0 < length < seconds for group in groups for length in group)
    seconds, groups = files["nexus_markers.csv"]
    assert seconds == 5.8
    assert groups[2][:3] == (0.45, 0.2, 0.14)


def test_the_table_is_what_the_script_prints_of_the_files():
    files = [str(shared("wild", "real", name)) for name in real_gaps()]
    script = ROOT / "docs" / "evidence" / "occlusion.py"
    printed = subprocess.run(
        [sys.executable, script, *files], check=True, capture_output=True, text=True
    ).stdout
    assert printed == TABLE.read_text(encoding="utf-8")
