"""A user's own Python file adds plug-ins of five kinds, or nothing at all."""

import re
import sys

import pytest

from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.formats import format_for
from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.registry import FORMATS, LIBRARIES, METRICS, MODELS, REGISTRIES, TASKS
from mocapbench.datasets import FormatError

HEAD = """\
from mocapbench.baselines import FrameImputer
from mocapbench.baselines.trivial import Trivial
from mocapbench.benchmark import Case, Profile, Task
from mocapbench.datasets import CSVFormat, Format, GaitLibrary, Library
from mocapbench.metrics import Direction, Imputation, Score, metric
from mocapbench.reports import TaskPage


class Mine(Trivial):
    pass


class Gait(GaitLibrary):
    pass


class Table(CSVFormat):
    suffixes = (".table",)


def mine(name):
    @metric(name=name, title="Mine", direction=Direction.LOWER)
    def declared(outcome: Imputation):
        return Score(1.0, {})

    return declared


def task(name):
    return Task(
        name=name,
        version=1,
        requires={"fills frames"},
        cases=(Case("one", None),),
        profiles={"quick": Profile(("one",), folds=1)},
        page=TaskPage(title="Mine", reference="", description="Mine.", metrics=("mse",)),
    )


"""
DOORS = {
    "MODELS": "MODELS = {'my-model': Mine}\n",
    "TASKS": "TASKS = {'my-task': task('my-task')}\n",
    "METRICS": "METRICS = {'my-metric': mine('my-metric')}\n",
    "LIBRARIES": "LIBRARIES = {'my-library': Gait}\n",
    "FORMATS": "FORMATS = {'my-format': Table}\n",
}
NAMES = {
    "MODELS": "my-model",
    "TASKS": "my-task",
    "METRICS": "my-metric",
    "LIBRARIES": "my-library",
    "FORMATS": "my-format",
}
REGISTRY = dict(zip(DOORS, REGISTRIES, strict=True))


@pytest.fixture
def load(tmp_path):
    """Return a function that loads a file of this text, and what is added to fixed lines."""

    def load(text, head=HEAD):
        (tmp_path / "mine.py").write_text(head + text)
        return load_plugin(tmp_path / "mine.py")

    return load


def _registered():
    return [registry.names() for registry in REGISTRIES]


@pytest.mark.parametrize("door", DOORS)
def test_each_kind_can_be_added_alone(load, door):
    before = {name: registry.names() for name, registry in REGISTRY.items()}
    assert load(DOORS[door]) == (NAMES[door],)
    for name, registry in REGISTRY.items():
        added = {NAMES[door]} if name == door else set()
        assert set(registry.names()) - set(before[name]) == added
    assert REGISTRY[door].get(NAMES[door]) is not None
    assert not REGISTRY[door].is_installed(NAMES[door])


def test_all_kinds_can_be_added_together(load):
    assert load("".join(DOORS.values())) == tuple(NAMES.values())
    assert all(NAMES[door] in registry.names() for door, registry in REGISTRY.items())


def test_several_of_a_kind_can_be_added(load):
    assert load("MODELS = {'a': Mine, 'b': Trivial}\n") == ("a", "b")


def test_a_library_that_is_added_is_part_of_the_archive(load):
    load(DOORS["LIBRARIES"])
    assert archive_at().available("my-library:01_01")


def test_a_format_that_is_added_reads_its_files(load, tmp_path):
    load(DOORS["FORMATS"])
    (tmp_path / "walk.TABLE").write_text("time,hip\n0,1\n")
    assert format_for(tmp_path / "walk.TABLE").read(tmp_path / "walk.TABLE").channels == ("hip",)


def test_two_formats_for_one_suffix_are_refused_by_name(load):
    load("FORMATS = {'mine': Table, 'other': Table}\n")
    with pytest.raises(UsageError, match=r"one format for .table, got mine and other; remove the"):
        format_for("walk.table")


@pytest.mark.parametrize(("name", "got"), [("walk.doc", "'.doc'"), ("walk", "no suffix")])
def test_a_suffix_that_no_format_has(name, got):
    expected = (
        rf"{name}: expected a file of .amc, .bvh, .*, got {got}; export .*, or add yours with"
    )
    with pytest.raises(FormatError, match=expected):
        format_for(name)


def test_the_same_file_may_be_loaded_again_and_another_one_overrides_it(load):
    load(DOORS["MODELS"])
    load(DOORS["MODELS"])
    load("MODELS = {'my-model': Trivial}\n")
    assert MODELS.get("my-model").__name__ == "Trivial"


@pytest.mark.parametrize("door", DOORS)
def test_two_files_that_define_one_name_are_refused_by_name(cli, tmp_path, door):
    one, two = (tmp_path / name for name in ("one.py", "two.py"))
    one.write_text(HEAD + DOORS[door])
    two.write_text(f"{HEAD}X = 1\n{DOORS[door]}")
    assert cli("list", door.lower(), "--plugin", one, "--plugin", two) == 2
    expected = f"{two}: expected a {REGISTRY[door].kind} under a name that no other --plugin "
    assert expected in cli.printed
    assert f"got {NAMES[door]!r}, which {one} defines too; rename one of the two" in cli.printed


def test_one_name_of_two_kinds_and_one_file_named_twice_are_no_clash(cli, tmp_path):
    one, two = (tmp_path / name for name in ("one.py", "two.py"))
    one.write_text(f"{HEAD}MODELS = {{'mine': Mine}}\n")
    two.write_text(f"{HEAD}METRICS = {{'mine': mine('mine')}}\n")
    assert cli("list", "models", "--plugin", one, "--plugin", two, "--plugin", one) == 0
    assert "mine" in cli.printed


def test_what_other_files_define_can_be_used_by_pickle(load):
    load(DOORS["MODELS"])
    model = MODELS.get("my-model")
    assert getattr(sys.modules[model.__module__], "Mine") is model  # noqa: B009


def test_a_file_may_import_helpers_beside_it_in_the_workers_too(cli, records, tmp_path):
    """Its folder comes last, so that a helper hides no installed module."""
    (tmp_path / "helper_of_a_plugin.py").write_text("VALUE = 0.25\n")
    (tmp_path / "numpy.py").write_text("raise RuntimeError('not this one')\n")
    (tmp_path / "mine.py").write_text(
        "import numpy as np\n"
        "from helper_of_a_plugin import VALUE\n"
        "from mocapbench.baselines import Imputer, Prediction\n"
        "class Constant(Imputer):\n"
        "    def fit(self, recordings):\n"
        "        return self\n"
        "    def impute(self, recordings):\n"
        "        filled = (np.full(r.values.shape, VALUE) for r in recordings)\n"
        "        return [Prediction.around(*pair) for pair in zip(recordings, filled)]\n"
        "MODELS = {'constant': Constant}\n"
    )
    toy = ("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--offline")
    chosen = ("--models", "constant", "--folds", 1, "--plugin", tmp_path / "mine.py")
    assert cli(*toy, *chosen, "--out", tmp_path / "run") == 0
    assert [record["status"] for record in records(tmp_path / "run").values()] == ["ok"]


ABSTRACT = "from mocapbench.baselines import Imputer\n"
WRONG = {
    "MODELS = {'a': int}": "expected MODELS to map one or more names to subclasses of mocapbench.",
    "MODELS = {'a': Mine()}": "MODELS to map one or more names to subclasses",
    "MODELS = {}": "MODELS to map one or more names to subclasses of .*, got {}",
    "MODELS = [Mine]": r"MODELS to map one or more names to subclasses of .*, got \[<class",
    "TASKS = {'a': Task}": "TASKS to map one or more names to mocapbench.benchmark.Task objects",
    "TASKS = None": "TASKS to map .* names to mocapbench.benchmark.Task objects, got None",
    "METRICS = {'a': len}": "METRICS to map one or more names to mocapbench.metrics.Metric objects",
    "LIBRARIES = {'a': dict}": "expected LIBRARIES to map .* subclasses of mocapbench.datasets.",
    "LIBRARIES = {'a': Gait()}": "LIBRARIES to map one or more names to subclasses",
    "FORMATS = {'a': Gait}": "FORMATS to map .* subclasses of mocapbench.datasets.Format",
    "MODELS = {'trivial': Mine}": "expected a name that no model or entrant has, got 'trivial'",
    "MODELS = {'mohgp-3': Mine}": "expected a name that no model or entrant has, got 'mohgp-3'",
    "MODELS = {1: Mine}": "expected a name that no model or entrant has, got 1; choose another",
    "MODELS = {'': Mine}": "name of letters, digits, .* for the model, got ''; rename it",
    "MODELS = {'mi ne,x': Mine}": "name of letters, digits, .* for the model, got 'mi ne,x'; ren",
    "METRICS = {'a,b': mine('a,b')}": "name of letters, digits, .* for the metric, got 'a,b'; ",
    "TASKS = {'-a': task('-a')}": "name of letters, digits, .* for the task, got '-a'; rename it",
    "TASKS = {'missing-frames': task('missing-frames')}": "expected a name that no task .* has",
    "METRICS = {'mse': mine('mse')}": "expected a name that no metric .* has, got 'mse'; choose",
    "LIBRARIES = {'cmu': Gait}": "expected a name that no library .* has, got 'cmu'; choose",
    "FORMATS = {'csv': Table}": "expected a name that no format .* has, got 'csv'; choose",
    "TASKS = {'a': task('b')}": "expected the task under its own name 'b', got 'a'",
    "METRICS = {'a': mine('b')}": "expected the metric under its own name 'b', got 'a'",
    "LIBRARIES = {'a': Library}": "be built with several arguments, .*folder .*, got 'a': .*abstra",
    "FORMATS = {'a': Format}": "that can be built without arguments, got 'a': .*abst",
    f"{ABSTRACT}MODELS = {{'a': Imputer}}": "that can be built without arguments, got 'a': .*abst",
}


@pytest.mark.parametrize(("text", "complaint"), WRONG.items(), ids=WRONG)
def test_a_wrong_entry_says_what_was_expected_and_got(load, text, complaint):
    with pytest.raises(UsageError, match=f"mine.py: .*{complaint}") as raised:
        load(text)
    message = str(raised.value)
    advice = (
        "choose another",
        '= {"name": …}',
        "rename one of the two",
        "rename it, for example",
        "give every other parameter",
    )
    assert [part in message for part in ("expected", ", got ")] == [True, True]
    assert sum(part in message.rpartition("; ")[2] for part in advice) == 1


@pytest.mark.parametrize("text", WRONG)
@pytest.mark.parametrize("door", DOORS)
def test_nothing_is_registered_if_something_is_wrong(load, text, door):
    before = _registered()
    right = "" if f"{door} =" in text else DOORS[door]
    for order in ((right, text), (text, right)):
        with pytest.raises(UsageError):
            load("\n".join(order))
        assert _registered() == before


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("def", "mine.py cannot be run: SyntaxError.*; `python .*mine.py` shows where"),
        ("raise RuntimeError('no')", "cannot be run: RuntimeError: no"),
        ("import sys; sys.exit(3)", "cannot be run: SystemExit: 3"),
        ("raise ImportError('x' * 50_000)", "cannot be run: ImportError: x{,1000} … x{,1000}; `"),
        (
            "class Odd(Exception):\n    def __str__(self): return 1 / 0\nraise Odd",
            "cannot be run: Odd, whose message cannot be read; `python",
        ),
        ("import no_such_module", "cannot be run: ModuleNotFoundError: .*no_such_module"),
        (
            "x = 1",
            "expected one or more of MODELS, TASKS, METRICS, LIBRARIES, FORMATS, each a mapping",
        ),
        ("", r"such as MODELS = {\"name\": ModelClass}, got none"),
        ("models = {}", "got none"),
    ],
)
def test_a_file_that_adds_nothing_says_why(load, text, complaint):
    before, modules, path = _registered(), set(sys.modules), [*sys.path]
    with pytest.raises(UsageError, match=complaint):
        load(text, head="")
    assert _registered() == before
    if "cannot be run" in complaint:
        left = {name for name in set(sys.modules) - modules if name.startswith("mocapbench_")}
        assert (left, sys.path) == (set(), path)


@pytest.mark.parametrize(("name", "why"), [("absent.py", "does not exist"), (".", "is a folder")])
def test_a_file_that_is_not_there(tmp_path, name, why):
    path = re.escape(repr(str(tmp_path / name)))
    expected = "expected a Python file, or the TOML file of a command"
    complaint = f"--plugin: {expected}, got {path}, which {why}; check the path"
    with pytest.raises(UsageError, match=complaint):
        load_plugin(tmp_path / name)


@pytest.mark.parametrize("option", ["--plugin", "--model-file"])
@pytest.mark.parametrize(
    ("kind", "door"),
    [(door.lower(), door) for door in DOORS],
)
def test_what_a_file_adds_is_listed(cli, tmp_path, option, kind, door):
    (tmp_path / "mine.py").write_text(HEAD + "".join(DOORS.values()))
    assert cli("list", kind, option, tmp_path / "mine.py") == 0
    assert NAMES[door] in cli.printed
    others = {METRICS: "mse", MODELS: "knn", TASKS: "toy-synthesis", LIBRARIES: "gait"}
    others |= {FORMATS: "parquet"}
    assert others[REGISTRY[door]] in cli.printed
