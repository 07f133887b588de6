"""The action for GitHub, run step by step as its runner would."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from action_runner import ACTION, MANIFEST, STEPS, Run
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mocapbench import __version__

SOURCE = ACTION.read_text(encoding="utf-8")
SCRIPTS = {name: step for name, step in STEPS.items() if "run" in step}
INSTALLING = ("Set up Python", "Make an environment", "Install mocapbench")
REFERENCE = "Require reference values"
RUN, CHECK, REPORT = "Run the benchmark", "Check the metrics", "Write the report"
UPLOAD, PUBLISHED = "Upload the report", ("report.html", "check.md", "check.xml")
SMALL = {
    **{"tasks": "toy-interpolation-1", "models": "trivial", "reference": "reference"},
    **{"run-arguments": "--folds=1\n--offline", "check-arguments": "--environment=same"},
}
PRINT = """#!/bin/sh
printf '%s\\0' "$@" >> "$RUNNER_TEMP/arguments"
"""
REAL = f"""#!/bin/sh
exec {sys.executable} -m mocapbench.benchmark.cli.main "$@"
"""
PLUGIN = """
from mocapbench.baselines import Imputer

class Fails(Imputer):
    def fit(self, recordings):
        raise ValueError("no luck")

    def impute(self, recordings):
        return []

MODELS = {"fails": Fails}
"""
CHARACTERS = st.characters(exclude_categories=["Cs"], exclude_characters="\0\n")
TEXT = st.text(CHARACTERS, min_size=1)
FOLDER = st.text(CHARACTERS, min_size=1, max_size=63)
"""Its name has at most 255 bytes, four a character."""
LINES = st.lists(TEXT)
CACHES = shutil.ignore_patterns(
    ".git", ".tox", ".venv", ".*_cache", "__pycache__", "*.egg-info", "build", "dist", "_build"
)


def temporary(folder, **programs):
    """Return a folder of temporary files with programs in the place of those that are installed."""
    for name, program in programs.items():
        path = folder / "mocapbench" / "bin" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(program)
        path.chmod(0o755)
    return folder


def arguments(folder):
    """Return the arguments of all calls of a program that notes them."""
    return (folder / "arguments").read_bytes().decode().split("\0")[:-1]


def test_inputs_are_those_that_are_used():
    assert set(re.findall(r"inputs\.([\w-]+)", SOURCE)) == set(MANIFEST["inputs"])


def test_only_the_reference_is_required():
    required = {name for name, each in MANIFEST["inputs"].items() if each.get("required")}
    assert required == {"reference"}
    assert all(each["description"] for each in MANIFEST["inputs"].values())


@pytest.mark.parametrize("name", SCRIPTS)
def test_no_input_is_pasted_into_a_script(name):
    step = SCRIPTS[name]
    assert "${{" not in step["run"]
    used = set(re.findall(r"\$\{?(INPUT_\w+|RUN\b|PYTHON\b)", step["run"]))
    assert used == set(step["env"])


def test_outputs_that_are_read_are_written():
    read = set(re.findall(r"steps\.(\w+)\.outputs\.([\w-]+)", SOURCE)) - {("python", "python-path")}
    written = {
        (step.get("id"), output)
        for step in SCRIPTS.values()
        for output in re.findall(r'echo "([\w-]+)=.*GITHUB_OUTPUT', step["run"])
    }
    assert read == written


@given(st.tuples(TEXT, TEXT, FOLDER, TEXT), LINES, LINES)
@settings(max_examples=10)
@example(["$(touch owned)", "`touch owned`", "'; touch owned #", '";touch owned #'], ["*"], ["&&"])
def test_whatever_inputs_say_arrives_as_it_is(texts, plugins, more):
    profile, tasks, out, reference = texts
    with TemporaryDirectory() as name:
        folder = temporary(Path(name), mocapbench=PRINT)
        inputs = {
            **{"profile": profile, "tasks": tasks, "out": out, "reference": reference},
            **{"models": tasks, "data-dir": profile, "tolerances": reference},
            **{"plugin": "\n".join(plugins), "run-arguments": "\n".join(more)},
            "check-arguments": "\n".join(more),
        }
        used = Run(folder, folder, inputs).take(*INSTALLING)
        assert used.taken == [REFERENCE, RUN, CHECK, REPORT, UPLOAD]
        options, data = [f"--plugin={line}" for line in plugins], f"--data-dir={profile}"
        assert arguments(folder) == [
            *("run", "--no-report", f"--profile={profile}", f"--out={out}"),
            *(f"--tasks={tasks}", f"--models={tasks}", data, *options, *more),
            *("check", f"--reference={reference}", f"--markdown={out}/check.md"),
            *(f"--junit={out}/check.xml", f"--tolerances={reference}", *options, *more, "--", out),
            *("report", f"--out={out}", data, *options),
        ]
        assert not list(folder.rglob("owned"))


def test_inputs_that_are_left_out_are_no_arguments(tmp_path):
    folder = temporary(tmp_path, mocapbench=PRINT)
    used = Run(tmp_path, folder, {"reference": "values"}).take(*INSTALLING)
    default = "mocapbench-results"
    assert arguments(folder) == [
        *("run", "--no-report", "--profile=smoke", f"--out={default}"),
        *("check", "--reference=values", f"--markdown={default}/check.md"),
        *(f"--junit={default}/check.xml", "--", default, "report", f"--out={default}"),
    ]
    assert used.outputs["exit-code"] == "0"


@pytest.mark.parametrize(
    ("inputs", "packages"),
    [
        ({}, [str(ACTION.parent)]),
        ({"version": "1.2"}, ["mocapbench==1.2"]),
        ({"install": ".\n\nezc3d >= 1.6"}, [str(ACTION.parent), ".", "ezc3d >= 1.6"]),
    ],
)
def test_pip_installs_what_inputs_name(tmp_path, inputs, packages):
    folder = temporary(tmp_path, pip=PRINT)
    Run(tmp_path, folder, {"reference": "values", "run": "old", **inputs}).take(
        *INSTALLING[:2], CHECK, REPORT
    )
    assert arguments(folder) == ["install", "--quiet", *packages]


def test_without_reference_values_nothing_happens(tmp_path):
    used = Run(tmp_path, tmp_path, {}).take()
    assert (used.failed_at, used.code) == (REFERENCE, 2)
    assert used.taken == [REFERENCE, UPLOAD]
    assert "expected the input reference" in used.log


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """Return a workspace in which the action has run the benchmark and recorded its values."""
    workspace = tmp_path_factory.mktemp("workspace")
    folder = temporary(tmp_path_factory.mktemp("runner"), mocapbench=REAL)
    used = Run(workspace, folder, {**SMALL, "check-arguments": "--update"}).take(*INSTALLING)
    assert used.code == 0, used.log
    return workspace


@pytest.fixture
def action(recorded, tmp_path):
    """Return how to use the action in a copy of that workspace, and the copy."""
    workspace = shutil.copytree(recorded, tmp_path / "workspace")
    folder = temporary(tmp_path / "runner", mocapbench=REAL)

    def use(**inputs):
        named = {name.replace("_", "-"): value for name, value in inputs.items()}
        return Run(workspace, folder, {**SMALL, **named}).take(*INSTALLING)

    return use, workspace


@pytest.mark.slow
def test_the_same_values_pass_and_are_uploaded(action):
    use, workspace = action
    used = use()
    assert (used.failed_at, used.outputs["exit-code"]) == ("", "0")
    assert used.summary.startswith("### Metrics: passed")
    assert used.summary == (workspace / used.outputs["summary"]).read_text()
    kept = {used.outputs[name] for name in ("report", "summary", "junit")}
    assert set(used.uploaded.split()) == kept
    assert all((workspace / path).is_file() for path in kept)


@pytest.mark.slow
def test_worse_values_of_an_existing_run_fail_with_1_and_a_report(action):
    use, workspace = action
    (path,) = (workspace / "reference").iterdir()
    path.write_text(path.read_text().replace("trivial,mse,", "trivial,mse,-"))
    used = use(run="mocapbench-results")
    assert RUN not in used.taken
    assert (used.failed_at, used.code, used.outputs["exit-code"]) == (CHECK, 1, "1")
    assert "failed, exit code 1" in used.summary
    assert "mse" in used.summary
    assert "worse" in (workspace / used.outputs["report"]).read_text(encoding="utf-8")
    assert set(used.uploaded.split()) == {f"mocapbench-results/{n}" for n in PUBLISHED}


@pytest.mark.slow
def test_failed_jobs_fail_with_3_and_a_report(action):
    use, workspace = action
    (workspace / "fails.py").write_text(PLUGIN)
    used = use(plugin="fails.py", models="trivial,fails")
    assert used.steps["run"] == {"exit-code": "3"}, used.log
    assert (used.failed_at, used.code, used.outputs["exit-code"]) == (CHECK, 3, "3")
    assert "no luck" in used.summary
    assert (workspace / used.outputs["report"]).is_file()


@pytest.mark.slow
def test_a_wrong_request_fails_with_2_and_checks_nothing(action):
    use, _ = action
    used = use(tasks="tea-interpolation")
    assert (used.failed_at, used.code, used.outputs["exit-code"]) == (RUN, 2, "2")
    assert CHECK not in used.taken
    assert "unknown task" in used.log


@pytest.mark.slow
def test_a_check_that_cannot_be_made_shows_no_earlier_summary(action):
    use, workspace = action
    (workspace / "mocapbench-results" / "check.md").write_text("### Metrics: passed")
    used = use(run="mocapbench-results", tolerances="nowhere.toml")
    assert (used.failed_at, used.code, used.outputs["exit-code"]) == (CHECK, 2, "2")
    assert used.summary == ""
    assert REPORT not in used.taken


@pytest.mark.slow
def test_it_installs_this_package_into_an_environment_of_its_own(tmp_path, monkeypatch):
    """Without a network: what mocapbench needs is lent from the environment of the tests."""
    checkout = shutil.copytree(ACTION.parent, tmp_path / "checkout", symlinks=True, ignore=CACHES)
    lent = [path for path in sys.path if path.endswith("-packages")]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(lent))
    for name, value in (("NO_INDEX", "1"), ("NO_BUILD_ISOLATION", "0"), ("NO_DEPS", "1")):
        monkeypatch.setenv(f"PIP_{name}", value)
    used = Run(tmp_path, tmp_path / "runner", {"reference": "values", "run": "old"}, checkout)
    used.take(RUN, CHECK, REPORT)
    assert used.failed_at == "", used.log
    packages = used.temporary / "mocapbench" / "lib"
    (installed,) = packages.glob("python3.*/site-packages/mocapbench/__init__.py")
    assert installed.read_text() == (ACTION.parent / "src/mocapbench/__init__.py").read_text()
    program = used.temporary / "mocapbench" / "bin" / "mocapbench"
    done = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"mocapbench {__version__}\n"
