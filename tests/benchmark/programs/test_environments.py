"""Environments are installed whole or not at all, from what pip finds, and are found again.

The package index is a folder with a wheel in it.
"""

import os
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import pytest

from mocapbench.basics.temporaries import PREFIX
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.programs.environments import (
    find_environment,
    install_environment,
    read_versions,
)
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.testing.subject import GAP, problem

SCRIPT = "from mocapbench.benchmark.cli.main import main; main()"
PROGRAM = """\
import sys
from pathlib import Path
import halves
for path in Path(sys.argv[2], "given").iterdir():
    out = Path(sys.argv[2], "filled", path.name)
    out.mkdir()
    text = (path / "values.csv").read_text()
    (out / "mean.csv").write_text(text.replace("NaN", str(halves.HALF)))
"""
TOML = """\
name = "mine"
command = ["python", "fill.py"]
files = ["fill.py"]
format = "csv"
requirements = "packages.txt"
"""


def write_wheel(folder, version="1.0", content="HALF = 0.5\n"):
    """Write a package of one module, as the package index has them."""
    info = f"halves-{version}.dist-info"
    files = {
        "halves.py": content,
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: halves\nVersion: {version}\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        f"{info}/RECORD": "".join(f"{name},,\n" for name in ("halves.py", f"{info}/METADATA")),
    }
    folder.mkdir(exist_ok=True)
    with zipfile.ZipFile(folder / f"halves-{version}-py3-none-any.whl", "w") as wheel:
        for name, text in files.items():
            wheel.writestr(name, text)


@pytest.fixture
def index(tmp_path, monkeypatch):
    """Return the folder that stands for the package index, with a cache of its own beside it."""
    for name in [name for name in os.environ if name.startswith("PIP_")]:
        monkeypatch.delenv(name)
    monkeypatch.setenv("PIP_CONFIG_FILE", os.devnull)
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_NO_CACHE_DIR", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path / "index"))
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "cache"))
    write_wheel(tmp_path / "index")
    return tmp_path / "index"


@pytest.fixture
def packages(tmp_path):
    path = tmp_path / "packages.txt"
    path.write_text("halves==1.0\n")
    return path


@pytest.fixture
def declared(tmp_path, packages):
    """Return a TOML file of a program that needs these packages."""
    (tmp_path / "fill.py").write_text(PROGRAM)
    (tmp_path / "my.toml").write_text(TOML)
    return tmp_path / "my.toml"


def list_left(tmp_path):
    """Return what is in the folder of environments, temporary folders too."""
    folder = tmp_path / "cache" / "environments"
    return sorted(path.name for path in folder.iterdir()) if folder.exists() else []


@pytest.mark.slow
def test_a_program_finds_its_packages_once_they_are_installed(index, declared, tmp_path, cli):
    with pytest.raises(UsageError, match=r"got none; run `mocapbench models install .*my\.toml`"):
        load_plugin(declared)
    assert cli("models", "install", declared) == 0
    assert "packages: Installing collected packages: halves" in cli.printed
    assert load_plugin(declared) == ("mine",)
    recordings = problem(GAP)
    (prediction,) = MODELS.get("mine")().fit(recordings).impute([recordings[-1]])
    assert set(prediction.mean[GAP]) == {0.5}
    (name,) = list_left(tmp_path)
    assert name.startswith("packages-")
    pip = tmp_path / "cache" / "environments" / name / "bin" / "pip"
    assert subprocess.run([pip, "--version"], check=True, capture_output=True).stdout
    assert cli("models", "install", declared) == 0
    assert "packages: is installed already" in cli.printed


@pytest.mark.slow
def test_other_versions_make_predictions_new(index, declared, packages):
    packages.write_text("halves>=1\n")
    environment = install_environment(packages, str)
    assert read_versions(environment).splitlines()[0].startswith("halves==1.0")
    load_plugin(declared)
    first = MODELS.get("mine").files_digest
    (environment / "versions.txt").write_text("halves==2.0\n")
    load_plugin(declared)
    assert MODELS.get("mine").files_digest != first


def test_other_requirements_have_another_environment(index, packages):
    first = find_environment(packages)
    packages.write_text("halves==1.1\n")
    assert find_environment(packages) != first


@pytest.fixture
def index_fails(index, tmp_path, monkeypatch):
    """Return a function after which pip says something and fails."""

    def fail(said):
        python = tmp_path / "python"
        python.write_text(
            '#!/bin/sh\nmkdir -p "$3/bin"\nprintf "%s" "$FAKE" > "$3/bin/python"\n'
            'chmod +x "$3/bin/python"\n'
        )
        python.chmod(0o755)
        monkeypatch.setenv("FAKE", f"#!/bin/sh\necho '{said}' >&2\nexit 1\n")
        monkeypatch.setattr(sys, "executable", str(python))

    return fail


FAILURES = {
    "no network": (
        "WARNING: Retrying after connection broken by NewConnectionError: Network is unreachable",
        "check that this machine reaches the package index, and try again",
    ),
    "no room": (
        "ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device",
        "make room there, or name another folder in the variable MOCAPBENCH_CACHE",
    ),
    "no package": (
        "ERROR: No matching distribution found for halves==1.0",
        "check the packages that it lists",
    ),
}


@pytest.mark.parametrize(("said", "advice"), FAILURES.values(), ids=FAILURES)
def test_a_failure_says_what_to_do_and_leaves_nothing(
    packages, tmp_path, index_fails, said, advice
):
    index_fails(said)
    with pytest.raises(UsageError) as raised:
        install_environment(packages, str)
    assert said in str(raised.value)
    assert advice in str(raised.value)
    assert "nothing was installed" in str(raised.value)
    assert list_left(tmp_path) == []


@pytest.mark.slow
def test_a_package_that_is_not_there_is_named_as_pip_names_it(index, declared, packages, cli):
    packages.write_text("quarters==1.0\n")
    assert cli("models", "install", declared) == 2
    assert "No matching distribution found for quarters==1.0" in cli.printed


def test_a_cache_that_cannot_be_written_is_named(packages, tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "file"))
    with pytest.raises(UsageError, match=r"got: .*file.*Not a directory"):
        install_environment(packages, str)


@pytest.mark.forks  # elsewhere pip goes on without the process that started it
def test_an_installation_that_is_killed_looks_installed_to_nobody(index, declared, tmp_path, cli):
    waiting = tmp_path / "waiting"
    waiting.write_text(f"#!/bin/sh\necho $$ > {tmp_path}/pid\nexec sleep 600\n")
    waiting.chmod(0o755)
    before = f"import sys; sys.executable = {str(waiting)!r}; "
    words = [sys.executable, "-c", before + SCRIPT, "models", "install", str(declared)]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL) as process:
        while not (tmp_path / "pid").exists() or not (tmp_path / "pid").read_text():
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(signal.SIGKILL)
    (left,) = list_left(tmp_path)
    assert left.startswith(PREFIX)
    assert not find_environment(tmp_path / "packages.txt").exists()
    wait_for_end(int((tmp_path / "pid").read_text()))
    assert cli("models", "list") == 0
    assert list_left(tmp_path) == []


def wait_for_end(number):
    """Wait until a process is gone, which goes with the one that started it."""
    state = Path(f"/proc/{number}/stat")
    for _ in range(500):
        if not state.exists() or state.read_text().split()[2] == "Z":
            return
        time.sleep(0.02)
    raise AssertionError(f"{number} lives on")


def test_a_name_that_nothing_has_is_told_with_the_nearest(cli):
    assert cli("models", "install", "skikit-learn") == 2
    assert "did you mean scikit-learn" in cli.printed


def test_a_file_without_requirements_needs_nothing(declared, cli):
    declared.write_text('name = "mine"\ncommand = ["sh"]\n')
    assert cli("models", "install", declared) == 2
    assert 'expected requirements = "FILE"' in cli.printed


@pytest.mark.parametrize("line", ["-r other.txt", "--constraint x", "  -e ."])
def test_options_of_pip_are_refused_whose_changes_nothing_tells(index, packages, line):
    packages.write_text(f"halves==1.0\n{line}\n")
    with pytest.raises(UsageError, match="expected packages, one a line, got"):
        install_environment(packages, str)


def test_a_cache_that_is_a_file_is_named(index, packages, tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "file"))
    with pytest.raises(UsageError, match="name a folder that can be written to in the variable"):
        install_environment(packages, str)
