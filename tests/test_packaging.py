"""What is declared to package indexes, and what the distributions hold."""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import venv
import zipfile
from pathlib import Path

import pytest
from package_index import KINDS, serve_index, try_distribution

from mocapbench import __version__

ROOT = Path(__file__).parents[1]
FOLDERS = ("datasets", "metrics", "baselines", "reports", "benchmark")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
METADATA = PROJECT["project"]
CACHES = shutil.ignore_patterns(
    *(".git", ".tox", ".venv", ".*_cache", "__pycache__", "*.egg-info", "build", "dist"),
)
BUILD = "import sys; from hatchling import build; build.build_{}(sys.argv[1])"


def test_the_lowest_versions_tested_are_the_lowest_declared():
    extras = METADATA["optional-dependencies"]
    needed = [*METADATA["dependencies"], *extras["parquet"], *extras["cluster"]]
    declared = [line.replace(">=", "==") for line in needed]
    assert (ROOT / "tests" / "lowest.txt").read_text().splitlines() == declared


def test_the_tests_have_what_every_extra_of_users_needs():
    extras = METADATA["optional-dependencies"]
    assert {f"mocapbench[{name}]" for name in extras if name not in ("test", "docs")} <= set(
        extras["test"]
    )


def test_the_versions_of_python_declared_are_those_that_tox_runs():
    lowest = METADATA["requires-python"].removeprefix(">=")
    versions = re.findall(r"Python :: (3\.\d+)", " ".join(METADATA["classifiers"]))
    (others,) = re.findall(r"\[testenv:\{(py\d+(?:,py\d+)*)\}\]", (ROOT / "tox.ini").read_text())
    assert versions[0] == lowest
    assert [f"py{version.replace('.', '')}" for version in versions[1:]] == others.split(",")


def test_every_address_of_the_project_is_below_its_source():
    urls = METADATA["urls"]
    assert {"Homepage", "Documentation", "Changelog", "Issues", "Source"} <= set(urls)
    assert all(url.startswith(urls["Source"]) for url in urls.values())


def test_every_public_module_says_what_is_public():
    for path in (path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")):
        source = path.read_text()
        assert re.search(r"__all__ = ", source, re.MULTILINE) or "import" not in source, path


def files_below(root, *folders):
    """Return the paths of all files below folders of ``root``, caches aside."""
    paths = (path for folder in folders for path in (root / folder).rglob("*") if path.is_file())
    return {path.relative_to(root).as_posix() for path in paths if path.suffix != ".pyc"}


def left_out(folder, names):
    """Return what a copy of the source tree lacks: caches, runs of the example, and the site."""
    made = {"third-party": {"results"}, "docs": {"_build", "generated"}, "api": {"generated"}}
    return {*CACHES(folder, names), *made.get(Path(folder).name, set()).intersection(names)}


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """Return a copy of the source tree, which has a package more than ours."""
    copy = tmp_path_factory.mktemp("distributions") / "tree"
    shutil.copytree(ROOT, copy, symlinks=True, ignore=left_out)
    (copy / "metrics" / "gaits").mkdir()
    (copy / "metrics" / "gaits" / "__init__.py").touch()
    return copy


def build(kind, tree):
    """Return the one file that the build backend writes, without a network."""
    target = tree.parent / kind
    target.mkdir()
    command = [sys.executable, "-c", BUILD.format(kind), target]
    done = subprocess.run(
        command, cwd=tree, capture_output=True, text=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    (path,) = target.iterdir()
    return path


@pytest.fixture(scope="module")
def sdist(tree):
    """Return the source distribution."""
    return build("sdist", tree)


def files_of(wheel):
    """Return the paths of a wheel's files, its metadata aside."""
    with zipfile.ZipFile(wheel) as archive:
        return {name for name in archive.namelist() if ".dist-info/" not in name}


@pytest.fixture(scope="module")
def wheel(tree):
    """Return the wheel that is built from a clone."""
    return build("wheel", tree)


@pytest.mark.slow
def test_the_source_distribution_holds_what_its_tests_need(tree, sdist):
    with tarfile.open(sdist) as archive:
        held = {member.name.partition("/")[2] for member in archive if member.isfile()}
    top = {"CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "LICENSE", "README.md", "tox.ini"}
    top |= {"Dockerfile", "action.yml", ".pre-commit-config.yaml", ".pre-commit-hooks.yaml"}
    needed = files_below(tree, *FOLDERS, "src", "tests", "docs", "examples", "conda", ".ci")
    assert {*top, "pyproject.toml", *needed} - held == set()
    assert {"tests/goldens/metrics/tolerances.toml", "tests/lowest.txt", ".ci/run"} <= held
    assert held - needed - top == {"PKG-INFO", ".gitignore", "pyproject.toml"}


@pytest.mark.slow
def test_an_archive_without_a_history_of_git_makes_the_same_wheel(sdist, wheel, tmp_path):
    shutil.unpack_archive(sdist, tmp_path)
    (unpacked,) = tmp_path.iterdir()
    assert unpacked.name == f"mocapbench-{__version__}"
    rebuilt = build("wheel", unpacked)
    assert files_of(rebuilt) == files_of(wheel)
    with zipfile.ZipFile(rebuilt) as archive:
        metadata = archive.read(f"mocapbench-{__version__}.dist-info/METADATA").decode()
    assert f"\nVersion: {__version__}\n" in metadata


@pytest.mark.slow
def test_the_wheel_holds_the_packages_and_their_data_alone(tree, wheel):
    held = files_of(wheel)
    packages = {f"mocapbench/{name}" for name in files_below(tree, *FOLDERS)}
    assert held == packages | files_below(tree / "src", "mocapbench")
    assert {"mocapbench/py.typed", "mocapbench/metrics/gaits/__init__.py"} <= held
    assert {"mocapbench/reports/page/parts/page.html.j2", "mocapbench/metrics/__init__.pyi"} <= held
    parts = ("parts/player.html.j2", "scripts/player.js", "styles/player.css")
    assert {f"mocapbench/reports/page/{part}" for part in parts} <= held
    assert "mocapbench/benchmark/filling/costs.csv" in held
    assert not any("/test_" in name for name in held)


@pytest.mark.slow
def test_what_a_container_is_built_from_makes_the_same_wheel(tree, wheel, tmp_path):
    copies = re.findall(r"^COPY (?!--)(.+) (\S+)$", (tree / "Dockerfile").read_text(), re.MULTILINE)
    for names, target in copies:
        for path in map(tree.joinpath, names.split()):
            if path.is_dir():
                shutil.copytree(path, tmp_path / "clone" / target, symlinks=True)
            else:
                (tmp_path / "clone" / target).mkdir(parents=True, exist_ok=True)
                shutil.copy(path, tmp_path / "clone" / target)
    assert files_of(build("wheel", tmp_path / "clone")) == files_of(wheel)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_both_distributions_install_from_an_index_and_run_without_the_repository(
    sdist, wheel, tmp_path, kind
):
    """Dependencies are lent by this environment; `tox run -e release` takes them from an index."""
    alone = ("--no-deps", "--ignore-installed", "--no-build-isolation")
    with serve_index([wheel, sdist]) as address:
        found = try_distribution(
            kind, tmp_path, *alone, "--index-url", address, lent=sysconfig.get_path("purelib")
        )
    where, version, report = (printed.splitlines()[-1] for printed in found)
    assert Path(where).is_relative_to(tmp_path / "environment")
    assert version == f"mocapbench {__version__}"
    assert Path(report.removeprefix("report: ")).is_file()


@pytest.fixture(scope="module")
def editable(tree):
    """Return the wheel that leads to a clone."""
    return build("editable", tree)


@pytest.mark.slow
def test_an_editable_install_is_a_path_that_type_checkers_follow(tree, editable):
    """They cannot follow an import hook, nor can lint-imports."""
    (path_file,) = files_of(editable)
    assert path_file.endswith(".pth")
    with zipfile.ZipFile(editable) as archive:
        (line,) = archive.read(path_file).decode().splitlines()
    package = Path(line) / "mocapbench"
    assert (package / "__init__.py").is_file()
    assert all((package / folder).samefile(tree / folder) for folder in FOLDERS)


ASKED = """\
from mocapbench import fill
from mocapbench.benchmark import archive_at
from mocapbench.metrics import mse

reveal_type((archive_at(), mse))
reveal_type(fill)
"""


@pytest.fixture(scope="module")
def ask_editor(editable, tmp_path_factory):
    """Return what asks an editor about a fresh clone, whose dependencies this environment lends."""
    checker = shutil.which("basedpyright", path=Path(sys.executable).parent)
    if not checker:
        pytest.skip("basedpyright, which bundles what editors ask, is not here")
    environment = tmp_path_factory.mktemp("editor") / "environment"
    venv.create(environment)
    (packages,) = environment.glob("lib/python*/site-packages")
    shutil.unpack_archive(editable, packages, "zip")
    lent = [path for path in sys.path if Path(path).name == "site-packages"]
    (packages / "lent.pth").write_text("\n".join(lent))
    path = os.pathsep.join([str(environment / "bin"), os.environ["PATH"]])
    settings = {"env": os.environ | {"PATH": path}, "text": True, "timeout": 300}

    def ask(folder, *questions):
        command = [checker, "--outputjson", *questions]
        done = subprocess.run(command, cwd=folder, capture_output=True, check=False, **settings)
        return json.loads(done.stdout)

    return ask


@pytest.mark.slow
def test_an_editor_knows_the_types_in_a_fresh_clone(ask_editor, tmp_path):
    (tmp_path / "asked.py").write_text(ASKED)
    found = ask_editor(tmp_path, "asked.py")["generalDiagnostics"]
    told = [line["message"] for line in found if line["message"].startswith("Type of")]
    assert told[0] == 'Type of "(archive_at(), mse)" is "tuple[Archive, Metric[Imputation]]"'
    assert told[1].startswith('Type of "fill" is "(recording') and told[1].endswith('-> Filled"')
    assert not [line for line in found if line["severity"] == "error"]


OF_UNTYPED_BASES = {"mocapbench.GapFiller", "mocapbench.benchmark.in_memory.gap_filler.GapFiller"}
"""What is of classes of scikit-learn, which has no types."""


@pytest.mark.slow
def test_the_type_of_all_that_is_public_is_declared(ask_editor, tree, tmp_path):
    """Where it is not, type checkers infer it, each in a way of its own."""
    found = ask_editor(tmp_path, "--verifytypes", "mocapbench", "--ignoreexternal")
    declared = found["typeCompleteness"]
    assert Path(declared["packageRootDirectory"]).is_relative_to(tree)
    symbols = declared["symbols"]
    assert not [each["name"] for each in symbols if each["isTypeAmbiguous"]]
    assert {each["name"] for each in symbols if not each["isTypeKnown"]} == OF_UNTYPED_BASES
