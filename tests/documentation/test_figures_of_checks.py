"""What the documentation says of reference values is about what they are."""

import re
from collections import defaultdict
from pathlib import Path

import pytest

from mocapbench.benchmark.gate import read_reference

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("profile", ["smoke", "quick"])
def test_the_page_on_checks_knows_how_many_metrics_there_are(profile):
    texts = (path.read_text() for path in (ROOT / "tests/goldens/metrics" / profile).glob("*.csv"))
    lines = (line for text in texts for line in text.splitlines())
    rows = [line for line in lines if not line.startswith(("#", "task,"))]
    page = " ".join((ROOT / "docs/ci.md").read_text(encoding="utf-8").split())
    (said,) = re.findall(rf"about ([\d,]+)(?: metrics)? in {profile}\b", page)
    assert int(said.replace(",", "")) == pytest.approx(len(rows), rel=0.05)


TASKS = {
    "`missing-frames`": "missing-frames",
    "`golf-swings`": "golf-swings",
    "subject 35": "subject-35-missing",
    "upper bodies": "upper-body-missing",
    "walks": "walking-interpolation",
    "`marker-gaps`": "marker-gaps",
}
ENTRANTS = {"gpdm": "gpdm-balanced-6d-viterbi-offset"}


def read_coverage():
    """Return the mean coverage of 95 % by entrant and task, of recordings."""
    found = defaultdict(list)
    reference = read_reference(ROOT / "tests/goldens/metrics/quick")
    for (address, metric), folds in reference.values.items():
        if metric == "coverage_95" and not address.case.startswith("synthetic"):
            found[address.label, address.task] += folds.values()
    return {key: sum(values) / len(values) for key, values in found.items()}


def test_the_table_of_coverage_is_that_of_quick():
    page = (ROOT / "docs/results/calibration.md").read_text(encoding="utf-8")
    head, _, *rows = re.search(r"(?:^\|.*\n)+", page, re.MULTILINE)[0].splitlines()
    tasks = [TASKS[cell.strip()] for cell in head.split("|")[2:-1]]
    coverage = read_coverage()
    for row in rows:
        names, *cells = row.split("|")[1:-1]
        entrants = [ENTRANTS.get(name, name) for name in re.findall("`(.+?)`", names)]
        for task, cell in zip(tasks, cells, strict=True):
            numbers = re.findall(r"(\*?)(\.\d+)", cell)
            for entrant, (outside, number) in zip(entrants, numbers, strict=bool(numbers)):
                assert float(number) == pytest.approx(coverage[entrant, task], abs=6e-4), row
                assert bool(outside) == (not 0.93 <= float(number) <= 0.97), row
