import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
FOLDERS = ("datasets", "metrics", "baselines", "reports", "benchmark")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


def test_the_lowest_versions_tested_are_the_lowest_declared():
    declared = [line.replace(">=", "==") for line in PROJECT["project"]["dependencies"]]
    assert (ROOT / "tests" / "lowest.txt").read_text().splitlines() == declared


def test_every_folder_with_modules_is_packaged():
    found = {
        ".".join(("mocapbench", *path.parent.relative_to(ROOT).parts))
        for top in FOLDERS
        for path in (ROOT / top).rglob("__init__.py")
    }
    assert {"mocapbench", *found} == set(PROJECT["tool"]["setuptools"]["packages"])


def test_every_public_module_says_what_is_public():
    for path in (path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")):
        source = path.read_text()
        assert re.search(r"__all__ = ", source, re.MULTILINE) or "import" not in source, path


def test_the_readme_tells_the_truth_about_names():
    readme = (ROOT / "README.md").read_text()
    points = PROJECT["project"]["entry-points"]
    for group in ("mocapbench.models", "mocapbench.tasks"):
        for name in points[group]:
            assert f"`{name}`" in readme, name
