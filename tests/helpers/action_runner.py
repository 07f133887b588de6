"""What GitHub's runner does with a composite action, as far as ours needs it."""

import os
import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import yaml

ACTION = Path(__file__).parents[2] / "action.yml"
MANIFEST = yaml.safe_load(ACTION.read_text(encoding="utf-8"))
STEPS = {step["name"]: step for step in MANIFEST["runs"]["steps"]}
BASH = ("bash", "--noprofile", "--norc", "-e", "-o", "pipefail")  # what `shell: bash` stands for


@dataclass
class Run:
    """One use of the action in ``workspace``; ``steps`` has the outputs of each by its id."""

    workspace: Path
    temporary: Path
    inputs: dict
    checkout: Path = ACTION.parent
    steps: dict = field(default_factory=dict)
    taken: list = field(default_factory=list)
    failed_at: str = ""
    code: int = 0
    log: str = ""
    uploaded: str = ""

    def __post_init__(self):
        unknown = self.inputs.keys() - MANIFEST["inputs"].keys()
        assert not unknown, unknown
        defaults = {name: each.get("default", "") for name, each in MANIFEST["inputs"].items()}
        self.inputs = defaults | self.inputs
        self.temporary.mkdir(exist_ok=True)

    @property
    def outputs(self):
        """Return the outputs of the action."""
        return {name: self.text(each["value"]) for name, each in MANIFEST["outputs"].items()}

    @property
    def summary(self):
        """Return what the page of the workflow would show."""
        path = self.temporary / "summary"
        return path.read_text(encoding="utf-8") if path.exists() else ""

    def value(self, expression):
        """Return what an expression of a workflow stands for."""
        python = expression.strip()
        for theirs, ours in (("&&", "and"), ("||", "or"), ("!cancelled()", "True")):
            python = python.replace(theirs, ours)
        names = r"(inputs|steps)\.([\w-]+)(?:\.outputs\.([\w-]+))?"
        python = re.sub(names, lambda match: repr(self._lookup(*match.groups())), python)
        return eval(python, {"__builtins__": {}})

    def text(self, template):
        """Return a text with its expressions filled in."""
        return re.sub(r"\$\{\{(.*?)\}\}", lambda match: str(self.value(match[1])), template)

    def take(self, *skipped):
        """Run the steps in their order, apart from ``skipped``."""
        for name, step in STEPS.items():
            if name not in skipped and self._is_due(step):
                self.taken.append(name)
                self._use(step) if "uses" in step else self._script(name, step)
        return self

    def _lookup(self, context, name, output):
        if context == "inputs":
            return self.inputs[name]
        return self.steps.get(name, {}).get(output, "")

    def _is_due(self, step):
        condition = step.get("if", "").removeprefix("${{").removesuffix("}}")
        if self.failed_at and "cancelled()" not in condition:
            return False
        return not condition or bool(self.value(condition))

    def _use(self, step):
        given = {name: self.text(str(value)) for name, value in step["with"].items()}
        if step["uses"].startswith("actions/setup-python@"):
            self.steps[step["id"]] = {"python-path": sys.executable}
        if step["uses"].startswith("actions/upload-artifact@"):
            self.uploaded = given["path"]

    def _script(self, name, step):
        assert step["shell"] == "bash"
        script, output = self.temporary / "script.sh", self.temporary / "output"
        script.write_text(step["run"], encoding="utf-8")
        output.write_text("")
        done = subprocess.run(
            [*BASH, script],
            cwd=self.workspace,
            env={
                **os.environ,
                "RUNNER_TEMP": str(self.temporary),
                "GITHUB_ACTION_PATH": str(self.checkout),
                "GITHUB_OUTPUT": str(output),
                "GITHUB_STEP_SUMMARY": str(self.temporary / "summary"),
                **{key: self.text(value) for key, value in step["env"].items()},
            },
            capture_output=True,
            text=True,
            check=False,
        )
        self.log += done.stdout + done.stderr
        lines = output.read_text().splitlines()
        self.steps[step.get("id", name)] = dict(line.split("=", 1) for line in lines)
        if done.returncode and not self.failed_at:
            self.failed_at, self.code = name, done.returncode
