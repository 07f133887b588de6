"""Which code a digest covers, shown on small packages and files of a user."""

import importlib
import sys
from types import ModuleType

import pytest

from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.runs.source_code.digest import source_digest

LAZY = (
    "import lazy_loader\n"
    "__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)\n"
)
ENGINE = '''\
"""What the engine does."""

from fractions import Fraction

STEPS = 3


class Engine:
    """What it is."""

    tolerance = 0.1
    """What it is for."""

    def solve(self, steps=STEPS):
        """What it returns."""
        return steps * self.tolerance  # as fast as can be


solve = Engine().solve
HALF = Fraction(1, 2)
'''


@pytest.fixture
def project(tmp_path, monkeypatch, forget):
    """Return a function from files by path to the digest of a module, in a fresh process."""
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    before = set(sys.modules)

    def digest(files, module="walks.model", within=()):
        for name in set(sys.modules) - before:
            del sys.modules[name]
        for path, text in files.items():
            (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / path).write_text(text)
        importlib.invalidate_caches()
        forget()
        importlib.import_module(module)
        return source_digest(module, within)

    yield digest
    for name in set(sys.modules) - before:
        del sys.modules[name]


def _package(model, **others):
    """Return the files of a package whose model imports its engine somehow."""
    files = {"walks/__init__.py": "", "walks/model.py": model, "walks/engine.py": ENGINE}
    return files | {"walks/other.py": "UNUSED = 1\n"} | others


EAGER = {
    "walks/__init__.py": "from .engine import HALF, solve as go\nfrom .other import UNUSED\n",
}
OFFERED = {
    "walks/__init__.py": LAZY,
    "walks/__init__.pyi": "from .engine import HALF, solve\nfrom .other import UNUSED\n",
}
MODULES = {"walks/__init__.py": "from . import engine, other\n"}
LOOKED_UP = {
    "walks/__init__.py": (
        "import importlib\n"
        "def __getattr__(name):\n"
        "    return getattr(importlib.import_module('walks.engine'), name)\n"
    )
}
DEEP = {
    "walks/deep/__init__.py": "from .inner import solve\n",
    "walks/deep/inner.py": "from ..engine import solve\n",
}
WAYS = {
    "absolute": _package("from walks.engine import solve\n"),
    "relative": _package("from .engine import solve\n"),
    "module": _package("from . import engine\n"),
    "module by its full name": _package("import walks.engine as e\n"),
    "within a function": _package(
        "def fit():\n    from .engine import solve\n    return solve()\n"
    ),
    "of a package": _package("from walks import go\n", **EAGER),
    "a value of a package": _package("from walks import HALF\n", **EAGER),
    "a value of a module": _package("from walks.engine import HALF\n"),
    "of a lazy package": _package("from walks import solve\n", **OFFERED),
    "a module of a package": _package("from walks import engine\n", **MODULES),
    "of a package that looks names up": _package("from walks import Engine\n", **LOOKED_UP),
    "a value of a lazy package": _package("from walks import HALF\n", **OFFERED),
    "through modules": _package("from .deep.inner import solve\n", **DEEP),
    "through a package": _package("from .deep import solve\n", **DEEP),
    "everything": _package("from .engine import *\n"),
}


@pytest.mark.parametrize("files", WAYS.values(), ids=WAYS)
def test_code_that_is_imported_from_the_same_package_counts(project, files):
    before = project(files)
    assert project(files) == before
    assert project(files | {"walks/engine.py": ENGINE.replace("STEPS = 3", "STEPS = 4")}) != before


@pytest.mark.parametrize("files", WAYS.values(), ids=WAYS)
def test_code_that_is_not_imported_does_not_count(project, files):
    before = project(files)
    changed = {"walks/other.py": "UNUSED = 2\n", "walks/new.py": "UNUSED = 3\n"}
    assert project(files | changed) == before


@pytest.mark.parametrize("init", [EAGER, OFFERED], ids=["eager", "lazy"])
@pytest.mark.parametrize("module", ["engine", "other"])
def test_of_a_package_that_is_imported_whole_all_that_it_offers_counts(project, init, module):
    files = _package("import walks\n", **init)
    before = project(files)
    path = f"walks/{module}.py"
    assert project(files | {path: f"{files[path]}\nCHANGED = 1\n"}) != before


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"""What the engine does."""\n', ""),
        ('"""What the engine does."""', '"""What it did."""'),
        ('"""What it is."""', '"""What it was."""'),
        ('"""What it is for."""', '"""What it was for."""'),
        ('"""What it returns."""', '"""What it returned."""'),
        ("  # as fast as can be", ""),
        ("STEPS = 3\n", "# Enough.\n\n\n\nSTEPS = 3\n"),
        (
            "def solve(self, steps=STEPS):",
            "def solve(\n        self,\n        steps=STEPS,\n    ):",
        ),
        ("STEPS = 3", "STEPS = (3)"),
    ],
)
def test_prose_and_layout_do_not_count(project, old, new):
    files = WAYS["relative"]
    assert old in ENGINE
    changed = {"walks/engine.py": ENGINE.replace(old, new, 1)}
    assert project(files | changed) == project(files)
    assert project(changed, "walks.engine") == project({"walks/engine.py": ENGINE}, "walks.engine")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("STEPS = 3", "STEPS = 3.0"),
        ("steps=STEPS", "steps=2"),
        ("tolerance = 0.1", "tolerance = 0.2"),
        ("steps * self", "steps + self"),
        ("solve = Engine().solve", "solve = lambda: 'solve'"),
        ("    def solve", "    @staticmethod\n    def solve"),
    ],
)
def test_code_counts(project, old, new):
    assert old in ENGINE
    before = project({"walks/__init__.py": "", "walks/engine.py": ENGINE}, "walks.engine")
    after = project({"walks/engine.py": ENGINE.replace(old, new, 1)}, "walks.engine")
    assert after != before


STRIDES = {"strides/__init__.py": "", "strides/step.py": "LENGTH = 1\n"}
INSTALLED = {"strides-1.0.dist-info/RECORD": "strides/__init__.py,,\nstrides/step.py,,\n"}


def _changes(project, files, path, **options):
    """Return whether another line in one file changes the digest."""
    return project(files, **options) != project(
        files | {path: f"{files[path]}CHANGED = 1\n"}, **options
    )


def test_another_project_counts_unless_it_is_installed(project):
    files = _package("import strides.step\n") | STRIDES
    assert _changes(project, files, "strides/step.py")
    assert not _changes(project, files | INSTALLED, "strides/step.py")


def test_an_installed_project_counts_if_it_is_named(project):
    files = _package("import strides.step\n") | STRIDES | INSTALLED
    assert _changes(project, files, "strides/step.py", within=("strides",))


def test_what_lies_beside_an_installed_project_counts(project):
    """Such as a folder of one's own into which pip installed something."""
    files = _package("import strides.step\n") | STRIDES
    others = {"other-1.0.dist-info/RECORD": "stridesother/__init__.py,,\n"}
    assert _changes(project, files | others, "strides/step.py")


def test_the_init_above_a_module_counts_with_what_it_uses_itself(project):
    """Python runs it first, so that it may change what the module computes."""
    used = "from .other import UNUSED as steps\nfrom . import engine\nengine.STEPS = steps\n"
    files = _package("from walks.engine import solve\n") | {"walks/__init__.py": used}
    assert _changes(project, files, "walks/other.py")
    assert _changes(project, files, "walks/__init__.py")
    effect = files | {"walks/__init__.py": "import walks.other\n"}
    assert _changes(project, effect, "walks/other.py")
    passed_on = files | {"walks/__init__.py": "from .other import UNUSED\n"}
    assert not _changes(project, passed_on, "walks/other.py")


def test_a_name_of_a_package_counts_where_one_of_its_modules_is_imported(project):
    files = _package("import walks.engine\nX = walks.UNUSED\n", **EAGER)
    assert _changes(project, files, "walks/other.py")


def test_a_module_is_known_by_its_name_too(project):
    """Two helpers that exchange their content compute something else."""
    files = _package("from . import a, b\n") | {"walks/a.py": "X = 1\n", "walks/b.py": "X = 2\n"}
    exchanged = files | {"walks/a.py": "X = 2\n", "walks/b.py": "X = 1\n"}
    assert project(files) != project(exchanged)


PAGE = """\
from mocapbench.reports import TaskPage

PAGE = TaskPage(title="Waves", reference="", description="A gap.", metrics=("mse",))
"""


def test_how_a_task_is_presented_does_not_count(project):
    files = _package("from .page import PAGE\nfrom .engine import solve\n") | {
        "walks/page.py": PAGE,
    }
    before = project(files)
    assert project(files | {"walks/page.py": PAGE.replace("A gap.", "A wide gap.")}) == before
    assert project(files | {"walks/engine.py": f"{ENGINE}\nX = 1\n"}) != before


def test_circular_imports_end(project):
    files = _package("from . import engine\n") | {"walks/engine.py": "from . import model\n"}
    assert project(files) != project(files | {"walks/engine.py": "from . import model\nX = 1\n"})


def test_an_optional_module_counts_where_it_can_be_imported(project):
    optional = "try:\n    import walks.fast\nexcept (ImportError, OSError):\n    pass\n"
    without = project(_package(optional))
    for broken in ("import no_such_library\n", "raise OSError('no such device')\n"):
        assert project(_package(optional, **{"walks/fast.py": broken})) == without
    assert project(_package(optional, **{"walks/fast.py": "SPEED = 2\n"})) != without


def test_compiled_code_counts_by_its_bytes(project, tmp_path, forget):
    def digest(content):
        project(_package("import sys\n"))
        (tmp_path / "walks" / "fast.so").write_bytes(content)
        compiled = ModuleType("walks.fast")
        compiled.__file__ = str(tmp_path / "walks" / "fast.so")
        sys.modules["walks.fast"] = compiled
        (tmp_path / "walks" / "model.py").write_text("import walks.fast\n")
        forget()
        return source_digest("walks.model", ())

    one = digest(b"\x7fELF\xff\x00")
    assert digest(b"\x7fELF\xff\x00") == one
    assert digest(b"\x7fELF\xff\x01") != one


def test_a_source_in_another_encoding_is_read(project):
    path, text = "walks/engine.py", "# coding: latin-1\nNAME = 'Schr\xf6dinger'\n"
    files = _package("from . import engine\n") | {path: ""}
    project(files)
    engine = importlib.import_module("walks.engine").__file__
    with open(engine, "wb") as file:  # noqa: PTH123
        file.write(text.encode("latin-1"))
    del files[path]
    before = project(files)
    with open(engine, "wb") as file:  # noqa: PTH123
        file.write(text.replace("\xf6", "oe").encode("latin-1"))
    assert project(files) != before


MODEL = "from mocapbench.baselines.trivial import Trivial\n"


@pytest.fixture
def plugin(tmp_path, monkeypatch, forget):
    """Return a function from files, the first being the plugin, to the digest of its model."""
    monkeypatch.setattr(sys, "dont_write_bytecode", True)

    def forget_helpers():
        for name in [name for name in sys.modules if name.startswith("stride_")]:
            del sys.modules[name]

    def digest(files):
        forget_helpers()
        for path, text in files.items():
            (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / path).write_text(text)
        importlib.invalidate_caches()
        forget()
        load_plugin(tmp_path / next(iter(files)))
        return source_digest(MODELS.get("mine").__module__, ("mocapbench.baselines",))

    yield digest
    forget_helpers()


FILE = f"{MODEL}import stride_a\nclass Mine(Trivial):\n    pass\nMODELS = {{'mine': Mine}}\n"
HELPERS = {
    "stride_a.py": "import stride_b\n",
    "stride_b.py": '"""Prose."""\nX = 1\n',
    "stride_c.py": "",
}


def test_helpers_beside_a_users_file_count(plugin):
    files = {"mine.py": FILE, **HELPERS}
    before = plugin(files)
    assert plugin(files | {"stride_b.py": '"""Prose."""\nX = 2\n'}) != before
    assert plugin(files | {"stride_a.py": "import stride_b\nX = 2\n"}) != before
    assert plugin(files | {"stride_b.py": "X = 1  # remark\n"}) == before
    assert plugin(files | {"stride_c.py": "X = 2\n"}) == before


def test_a_users_file_counts_by_its_code_and_not_by_its_name_or_prose(plugin):
    before = plugin({"mine.py": FILE, **HELPERS})
    assert plugin({"yours.py": FILE, **HELPERS}) == before
    assert plugin({"mine.py": f'"""Mine."""\n\n{FILE}# That is all.\n', **HELPERS}) == before
    assert plugin({"mine.py": f"{FILE}X = 1\n", **HELPERS}) != before


def test_single_files_elsewhere_count(plugin, tmp_path, monkeypatch):
    elsewhere = tmp_path / "elsewhere"
    monkeypatch.syspath_prepend(elsewhere)
    files = {"mine.py": f"import stride_d\n{FILE}", **HELPERS, "elsewhere/stride_d.py": "X = 1\n"}
    assert plugin(files) != plugin(files | {"elsewhere/stride_d.py": "X = 2\n"})


PACKAGE = {
    "stride_lab/__init__.py": "",
    "stride_lab/core.py": "from .deep.inner import B\n",
    "stride_lab/deep/inner.py": "import stride_tools\nB = 1\n",
    "stride_lab/other.py": "",
    "stride_tools/__init__.py": "from .hammer import HEAD\n",
    "stride_tools/hammer.py": "HEAD = 1\n",
}
IMPORTS = (
    "from stride_lab.core import B\n",
    "import stride_lab.core\n",
    "from stride_lab import core\n",
    "def late():\n    from stride_lab.core import B\n",
)


@pytest.mark.parametrize("line", IMPORTS)
@pytest.mark.parametrize("path", [path for path in PACKAGE if "other" not in path])
def test_packages_beside_a_users_file_count(plugin, line, path):
    files = {"mine.py": f"{line}{FILE}", **HELPERS, **PACKAGE}
    changed = files | {path: f"{files[path]}CHANGED = 1\n"}
    assert plugin(files) != plugin(changed)
    other = files | {"stride_lab/other.py": "CHANGED = 1\n"}
    assert plugin(files) == plugin(other)


def test_a_package_installed_as_editable_counts(plugin, tmp_path, monkeypatch):
    """Its files are elsewhere than what says that it is installed."""
    site, source = tmp_path / "site-packages", tmp_path / "source"
    for folder in (site, source):
        monkeypatch.syspath_prepend(folder)
    editable = {
        "site-packages/stride_lab-1.0.dist-info/RECORD": "stride_lab.pth,,\n",
        "site-packages/stride_fixed.py": "X = 1\n",
        "source/stride_lab/__init__.py": "X = 1\n",
    }
    files = {"mine.py": f"import stride_lab, stride_fixed\n{FILE}", **HELPERS, **editable}
    assert plugin(files) != plugin(files | {"source/stride_lab/__init__.py": "X = 2\n"})
    assert plugin(files) == plugin(files | {"site-packages/stride_fixed.py": "X = 2\n"})


def test_no_module_is_imported_to_find_out_whose_code_it_is(plugin):
    """Nor what a function imports, which may take seconds."""
    line = "def late():\n    import antigravity\n"
    plugin({"mine.py": f"{line}{FILE}", **HELPERS})
    assert "antigravity" not in sys.modules


def test_what_a_users_file_takes_from_the_package_counts(plugin, append):
    files = {"mine.py": FILE, **HELPERS}
    before = plugin(files)
    append("mocapbench.baselines.trivial")
    assert plugin(files) != before
    append("mocapbench.baselines.knn")
    assert plugin(files) == before
