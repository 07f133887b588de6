"""Hooks of pre-commit: ours are the checks of tox, and the one for other repositories works."""

import configparser
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from own_files import write_csv

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[1]
CONFIG, MANIFEST = ROOT / ".pre-commit-config.yaml", ROOT / ".pre-commit-hooks.yaml"
SCRIPTS = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["scripts"]
TASK = 'files = "*.csv"\ntraining = "none"\nmodels = ["linear"]\n[hide]\nframes = "20:30"\n'


@pytest.mark.parametrize(
    ("command", "path"), [("validate-config", CONFIG), ("validate-manifest", MANIFEST)]
)
def test_pre_commit_takes_them(command, path):
    words = [sys.executable, "-m", "pre_commit", command, path]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout + done.stderr) == (0, "")


def test_ours_are_the_checks_of_the_lint_environment():
    tox = configparser.ConfigParser()
    tox.read(ROOT / "tox.ini")
    checks = re.findall(r"lint: ([A-Za-z -]+[a-z])", tox["testenv:{lint,types}"]["commands"])
    (local,) = yaml.safe_load(CONFIG.read_text())["repos"]
    assert [hook["name"] for hook in local["hooks"]] == [
        check.removesuffix(" --check") for check in checks
    ]
    for hook in local["hooks"]:
        assert hook["entry"].removesuffix(" --force-exclude") == hook["name"]


def test_ours_need_no_network():
    (local,) = yaml.safe_load(CONFIG.read_text())["repos"]
    assert local["repo"] == "local"
    assert {hook["language"] for hook in local["hooks"]} == {"system"}


@pytest.fixture
def hook(tmp_path):
    """Return how to run the offered hook as its file shows, beside a task file and a recording."""
    (offered,) = yaml.safe_load(MANIFEST.read_text())
    shown = re.findall(r"^#(  .*)$", MANIFEST.read_text(), re.MULTILINE)
    ((used,),) = (each["hooks"] for each in yaml.safe_load("\n".join(shown)))
    assert used["id"] == offered["id"]
    script, *options = shlex.split(offered["entry"])
    module, _, _ = SCRIPTS[script].partition(":")
    words = [sys.executable, "-m", module, *options, *used["args"]]
    write_csv(tmp_path / "walks" / "walk.csv")
    return lambda: subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)


def test_the_hook_passes_a_sound_task_file_and_writes_nothing(hook, tmp_path):
    (tmp_path / "my.toml").write_text(TASK)
    done = hook()
    assert done.returncode == 0, done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"walks", "my.toml"}


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("files", "filez", "key filez"),
        ("20:30", "50:70", "expected for walk.csv frames"),
    ],
)
def test_the_hook_refuses_a_wrong_one(hook, tmp_path, old, new, complaint):
    (tmp_path / "my.toml").write_text(TASK.replace(old, new))
    done = hook()
    assert done.returncode == 2
    assert complaint in done.stderr
    assert "my.toml" in done.stderr
