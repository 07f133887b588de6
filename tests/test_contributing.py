"""The environments that CONTRIBUTING.md names exist."""

import configparser
import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


def test_its_environments_of_tox_exist():
    tox = configparser.ConfigParser(interpolation=None)
    tox.read(ROOT / "tox.ini")
    sections = re.findall(r"testenv:\{?([\w,]+)", " ".join(tox.sections()))
    known = {"tests", *(name for names in sections for name in names.split(","))}
    named = re.findall(r"tox run -e ([\w,]+)", PAGE)
    assert {name for names in named for name in names.split(",")} <= known
