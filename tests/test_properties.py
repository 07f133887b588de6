"""Property tests are tried on the same examples every time, unless a search is asked for."""

import re
from pathlib import Path

from hypothesis import settings

TOX = (Path(__file__).parents[1] / "tox.ini").read_text(encoding="utf-8")


def test_examples_are_the_same_every_time_by_default_and_random_in_the_search():
    (search,) = re.findall(r"--hypothesis-profile (\S+)", TOX)
    assert settings.default.derandomize
    assert not settings.get_profile(search).derandomize
