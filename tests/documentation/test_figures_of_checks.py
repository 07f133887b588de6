"""What the documentation says of how much a check compares is about what it compares."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("profile", ["smoke", "quick"])
def test_the_page_on_checks_knows_how_many_metrics_there_are(profile):
    texts = (path.read_text() for path in (ROOT / "tests/goldens/metrics" / profile).glob("*.csv"))
    lines = (line for text in texts for line in text.splitlines())
    rows = [line for line in lines if not line.startswith(("#", "task,"))]
    page = " ".join((ROOT / "docs/ci.md").read_text(encoding="utf-8").split())
    (said,) = re.findall(rf"about ([\d,]+)(?: metrics)? in {profile}\b", page)
    assert int(said.replace(",", "")) == pytest.approx(len(rows), rel=0.05)
