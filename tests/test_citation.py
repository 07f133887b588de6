"""How to cite mocapbench: one answer, wherever it is asked."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

from mocapbench import __version__
from mocapbench.benchmark.cli.main import main

ROOT = Path(__file__).parents[1]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
METADATA = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]

REQUIRED = {"cff-version", "message", "title", "authors"}
REQUIRED_OF_A_REFERENCE = {"type", "title", "authors"}


def test_the_file_has_what_the_format_requires():
    assert set(CITATION) >= REQUIRED
    assert CITATION["cff-version"] == "1.2.0"
    assert CITATION["type"] == "software"
    assert all({"name", "family-names"} & set(author) for author in CITATION["authors"])
    for work in CITATION["references"]:
        assert set(work) >= REQUIRED_OF_A_REFERENCE
        assert isinstance(work["year"], int)


def test_it_is_of_this_version():
    assert CITATION["version"] == __version__


def test_it_agrees_with_the_metadata():
    assert CITATION["repository-code"] == METADATA["urls"]["Source"]
    assert CITATION["url"] == METADATA["urls"]["Homepage"]
    assert CITATION["license"] == METADATA["license"]
    assert CITATION["keywords"] == METADATA["keywords"]
    assert [each["name"] for each in CITATION["authors"]] == [
        each["name"] for each in METADATA["authors"]
    ]


def test_the_command_line_cites_the_same_work(capsys):
    with pytest.raises(SystemExit):
        main(["info"])
    shown = re.sub(r"[{}]", "", capsys.readouterr().out)
    assert CITATION["title"] in shown
    assert all(author["name"] in shown for author in CITATION["authors"])
