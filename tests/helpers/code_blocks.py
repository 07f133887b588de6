"""The code blocks of a page, each tried in the way that its language says.

===========  =====================================================================================
python       runs, in one namespace for the whole page
sh           every command is tried on small files; `code_shell` says how
console      commands after `$` run as they stand, and what they print is compared; `...` stands
             for anything, such as seconds and folders
toml         is read by the reader that the command line has for such a file
yaml         is a workflow: what its steps run is tried like `sh`
text, math   are no code: trees, formulas, quotations
{name}       is a directive of the site
===========  =====================================================================================

A block whose first line is a comment that names a file, `# my_model.py`, is also written to that
file, where the commands that follow find it. Any other language fails.
"""

import doctest
import re
import tomllib
from pathlib import Path

import yaml
from code_shell import Shell
from sybil.document import Document
from sybil.evaluators.python import PythonEvaluator
from sybil.parsers.markdown.lexers import FencedCodeBlockLexer

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.tolerances import read_tolerances
from mocapbench.benchmark.task_files.checking import open_task_file

SHOWN = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
NO_CODE = ("text", "math")
DIRECTIVE = r"\{(?!code|sourcecode)[a-z-]+\}.*"
RECORDINGS = Path("walks")


class UncheckedBlockError(AssertionError):
    """A block, or a command in it, of a kind that nothing here can try."""


def code_blocks(page):
    """Return the blocks of a page; those that are no code among them."""
    return Document.parse(str(page), _blocks)


def _blocks(document):
    for region in FencedCodeBlockLexer(".*")(document):
        language, region.parsed = region.lexemes["language"].strip(), region.lexemes["source"]
        region.evaluator = WAYS.get(language, _other)
        yield region


def _python(example):
    written(example.parsed)
    example.namespace["__name__"] = "page"
    PythonEvaluator()(example)


def _sh(example):
    shell = _shell(example)
    for line in _lines(example.parsed):
        shell.attempt(line)


def _console(example):
    """Run the commands after `$`, and compare what follows each with what it prints."""
    head, *rest = re.split(r"^\$ ", _joined(example.parsed), flags=re.MULTILINE)
    assert not head, "expected a command after `$`"
    for command, shown in (part.split("\n", 1) for part in rest):
        printed = _shell(example).run(command)
        if not doctest.OutputChecker().check_output(shown, printed, SHOWN):
            return f"`{command}` was to print\n{shown}\nand printed\n{printed}"
    return None


def _toml(example):
    """Read a task file, tolerances or the entry points of a package, by the name of the file."""
    path = written(example.parsed)
    path = path or _kept(Path("block.toml"), example.parsed)
    READERS.get(path.name, _task_file)(path)


def _task_file(path):
    open_task_file(path, RECORDINGS)


def _wrong_task_file(path):
    """Be refused, since the page shows the error."""
    try:
        _task_file(path)
    except UsageError:
        return
    raise AssertionError(f"{path} is to show an error, and has none")


def _tolerances(path):
    for environment in Environment:
        read_tolerances(environment, path)


def _entry_points(path):
    """Every group is one of ours, and what is named in a file of the page is there."""
    for group, points in tomllib.loads(path.read_text())["project"]["entry-points"].items():
        assert group.removeprefix("mocapbench.") in GROUPS, group
        for target in points.values():
            module, _, name = target.partition(":")
            assert name in Path(f"{module}.py").read_text(), target


def _yaml(example):
    written(example.parsed)
    for job in yaml.safe_load(example.parsed)["jobs"].values():
        for step in job["steps"]:
            for line in _lines(step.get("run", "")):
                _shell(example).attempt(line)


def _other(example):
    language = example.region.lexemes["language"].strip()
    if language not in NO_CODE and not re.fullmatch(DIRECTIVE, language):
        raise UncheckedBlockError(
            f"line {example.line}: expected a language of {', '.join([*WAYS, *NO_CODE])}, "
            f"got {language!r}; what is no code is `text`"
        )


def _lines(text):
    return _joined(text).splitlines()


def _joined(text):
    """Return a script with lines that a backslash continues as one."""
    return text.replace("\\\n", " ")


def _shell(example):
    """Return the shell of the page, which keeps its variables from block to block."""
    return example.namespace.setdefault("__shell__", Shell(Path(example.path).parent))


def written(source):
    """Write a block that names its file in a comment, and return the path."""
    named = re.match(r"# ([\w.-]+\.\w+)\s", source)
    return _kept(Path(named[1]), source) if named else None


def _kept(path, source):
    path.write_text(source, encoding="utf-8")
    return path


GROUPS = ("models", "tasks", "metrics", "libraries", "formats")
READERS = {
    "pyproject.toml": _entry_points,
    "tolerances.toml": _tolerances,
    "wrong.toml": _wrong_task_file,
}
WAYS = {"python": _python, "sh": _sh, "console": _console, "toml": _toml, "yaml": _yaml}
