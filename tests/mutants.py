"""Change the code of a folder, one operator or number at a time, and print what no test notices.

    python tests/mutants.py baselines/kriging tests/baselines/kriging --sample 30 --seed 1

Each change is made in memory, as Python imports the module, in the tests' process and in all that
it starts. No file is touched. The tests run without those marked ``slow``. A change is noticed if
they fail, or take more than four times as long and 10 s. Some survivors are no gap in the tests:
``max(n, 1)`` is ``max(n, 2)`` where n is never 1.

Why neither library serves. mutmut 3.8 names a mutant after its file (``baselines.kriging.paths``);
tests import ``mocapbench.baselines.kriging.paths``, so that it finds no test for any mutant.
cosmic-ray 8.7 finds 3,486 mutants in ``baselines/kriging`` and takes no sample of them. It changes
the files of the checkout, and drops no call of ``clip`` or ``minimum``.
"""

from __future__ import annotations

import argparse
import ast
import copy
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

OPERATORS = {
    **{ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt},
    **{ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.And: ast.Or, ast.Or: ast.And},
    **{ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult},
    **{ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd},
}
LIMITS = {"clip", "minimum", "maximum", "min", "max"}  # a call becomes its first argument
# Python runs this as it starts, wherever PYTHONPATH names its folder.
IMPORT_HOOK = """
import os
from importlib.machinery import SourceFileLoader
get_code = SourceFileLoader.get_code

def get_changed_code(self, name):
    if os.path.realpath(self.path) != os.environ["MUTANT_OF"]:
        return get_code(self, name)
    with open(os.environ["MUTANT"], encoding="utf-8") as file:
        return compile(file.read(), self.path, "exec")

SourceFileLoader.get_code = get_changed_code
"""


def change_operators(node: ast.AST) -> Iterator[ast.AST]:
    """Yield copies of an operation with one operator changed."""
    match node:
        case ast.Compare(ops=operators):
            for place, operator in enumerate(operators):
                if type(operator) in OPERATORS:
                    changed = copy.deepcopy(node)
                    changed.ops[place] = OPERATORS[type(operator)]()
                    yield changed
        case ast.BinOp(op=op) | ast.BoolOp(op=op) | ast.AugAssign(op=op) if type(op) in OPERATORS:
            changed = copy.deepcopy(node)
            changed.op = OPERATORS[type(op)]()
            yield changed


def change_node(node: ast.AST) -> Iterator[ast.AST]:
    """Yield what may stand in place of a node."""
    yield from change_operators(node)
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            yield from (ast.Constant(value + step) for step in (1, -1))
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield operand
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), args=[first, *_]):
            if name in LIMITS and not isinstance(first, ast.GeneratorExp | ast.Starred):
                yield first


def find_nodes(tree: ast.AST) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Yield each node with its statement, types of parameters and results apart."""
    waiting = [(tree, tree)]
    while waiting:
        parent, statement = waiting.pop()
        for field, value in ast.iter_fields(parent):
            for node in value if isinstance(value, list) else [value]:
                if isinstance(node, ast.AST) and field not in ("annotation", "returns"):
                    waiting.append((node, node if isinstance(node, ast.stmt) else statement))
                    yield waiting[-1]


def find_mutants(path: Path) -> Iterator[tuple[Path, str, str]]:
    """Yield a module's path, what is changed, and the source of the whole module after it."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node, statement in find_nodes(tree):
        before, kind, fields = ast.unparse(statement).splitlines(), node.__class__, vars(node)
        for changed in change_node(node):
            node.__class__, node.__dict__ = changed.__class__, {**fields, **vars(changed)}
            pairs = zip(before, ast.unparse(statement).splitlines(), strict=False)
            old, new = next((pair for pair in pairs if pair[0] != pair[1]), ("", ""))
            where = f"{path}:{getattr(node, 'lineno', 0)}"
            yield path, f"{where}: {old.strip()}  →  {new.strip()}", ast.unparse(tree)
            node.__class__, node.__dict__ = kind, fields


def run_tests(tests: list[str], path: Path, source: str, limit: float | None) -> bool:
    """Return whether the tests pass with this source of the module; not if they take too long."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "sitecustomize.py").write_text(IMPORT_HOOK, encoding="utf-8")
        Path(folder, "mutant").write_text(source, encoding="utf-8")
        env = {**os.environ, "PYTHONPATH": folder, "OPENBLAS_NUM_THREADS": "1"}
        env |= {"MUTANT_OF": str(path.resolve()), "MUTANT": str(Path(folder, "mutant"))}
        options = ["-x", "-q", "-m", "not slow", "-p", "no:cacheprovider"]
        command = [sys.executable, "-m", "pytest", *options, *tests]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.STDOUT}
        with subprocess.Popen(command, env=env, start_new_session=True, **quiet) as process:
            try:
                return process.wait(limit) == 0
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                return False


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="the folder, or the module, to change")
    parser.add_argument("tests", nargs="+", help="the tests that should notice, as for pytest")
    parser.add_argument("--sample", type=int, help="how many changes to try; by default all")
    parser.add_argument("--seed", type=int, default=0, help="of the sample")
    chosen = parser.parse_args()
    paths = sorted(chosen.folder.rglob("*.py")) if chosen.folder.is_dir() else [chosen.folder]
    mutants = [mutant for path in paths for mutant in find_mutants(path)]
    size = min(chosen.sample or len(mutants), len(mutants))
    started = time.monotonic()
    if not run_tests(chosen.tests, paths[0], paths[0].read_text(encoding="utf-8"), None):
        sys.exit("expected tests that pass before anything is changed; run them with pytest")
    limit, survivors = 10.0 + 4.0 * (time.monotonic() - started), 0
    sample = random.Random(chosen.seed).sample(mutants, size)
    for number, (path, change, source) in enumerate(sample, start=1):
        if run_tests(chosen.tests, path, source, limit):
            survivors += 1
            print(f"[{number}] {change}", flush=True)
    print(f"{survivors} of {size} changes survive, of {len(mutants)} in {chosen.folder}")


if __name__ == "__main__":
    main()
