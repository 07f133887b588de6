"""The TOML file of a command says what the model is, and what makes its predictions new."""

import pickle
import shutil

import pytest

from mocapbench.benchmark.catalogue.entries import model_entry
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.plugins import load_plugin, load_plugins
from mocapbench.benchmark.registry import MODELS, TASKS
from mocapbench.benchmark.runs.cluster.plugin_files import read_plugin_files, write_plugin_files
from mocapbench.benchmark.runs.keys import fit_contents, key_of
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.seeds import Seeds

ABOUT = """\
summary = "Fill with ones."
environment = "dash 0.5"
licence = "MIT"
source = "A. Author and B. Writer (2020), Ones, J. Ones 1"
provides = ["interpolates"]
needs = ["coordinates"]
max_frames = 500
"""


FRAMES = {"fills frames", "fills entries", "continues recordings"}


def find_key(name="mine"):
    task = TASKS.get("toy-interpolation-1")
    seeds = Seeds(0, Address(task.name, task.version, "test 1", 0, name))
    return key_of(
        fit_contents(task.cases[0], seeds, model=MODELS.get(name), parameters={}, digests={})
    )


def test_it_says_what_the_model_is(declare):
    assert load_plugin(declare(lines=ABOUT)) == ("mine",)
    entry = model_entry("mine")
    assert entry["summary"] == "Fill with ones (dash 0.5; MIT)."
    assert entry["source"] == "Author and Writer 2020"
    assert entry["family"] == "Interpolation"
    model = MODELS.get("mine")()
    assert model.provides == {*FRAMES, "interpolates"}
    assert model.needs == {"coordinates"}
    assert model.max_frames == 500


def test_what_it_leaves_out_has_a_default(tmp_path):
    (tmp_path / "my.toml").write_text('name = "mine"\ncommand = ["sh", "-c", "exit 1", "sh"]')
    load_plugin(tmp_path / "my.toml")
    model = MODELS.get("mine")()
    assert model.provides == FRAMES
    assert (model.exchange, model.learns_in_fit, model.needs) == ("npz", False, frozenset())
    assert model_entry("mine")["summary"] == "The command sh -c 'exit 1' sh."


FAULTS = {
    "unknown key": ('licences = "MIT"', "line 5, key licences: .*did you mean licence"),
    "unknown ability": ('provides = ["fills gaps"]', "key provides: .*got 'fills gaps'; remove it"),
    "ability of Python": (
        'provides = ["clusters"]',
        "'clusters'; remove it: .*only of models in P",
    ),
    "need of Python": ('needs = ["true process"]', "expected some of coordinates, got 'true proc"),
    "no truth value": ("learns_in_fit = 1", "expected true or false, got 1"),
    "no frames": ("max_frames = 0", "expected a number of frames, got 0"),
    "no seeds": ("seeds = 0", "expected a number of seeds, got 0"),
    "empty text": ('source = ""', "key source: expected a text, got ''"),
    "no TOML": ("provides = [", "expected TOML, got"),
}


@pytest.mark.parametrize(("lines", "message"), FAULTS.values(), ids=FAULTS)
def test_what_is_wrong_is_named_with_its_key(declare, lines, message):
    with pytest.raises(UsageError, match=message):
        load_plugin(declare(lines=lines))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('command = ["sh"]', "key name: expected a value, got none"),
        ('name = "mine"', "key command: expected a value, got none"),
        ('name = "mine"\ncommand = "sh model.sh"', "expected a list of texts, got 'sh model.sh'"),
        ('name = "mine"\ncommand = ["sh"]\nformat = "hdf5"', "expected one of npz, mat, csv, got"),
        ('name = "mine"\ncommand = ["sh"]\nfiles = ["no.sh"]', "beside the TOML file.*got 'no.sh'"),
        ('name = "mine"\ncommand = ["sh"]\nfiles = ["../my.toml"]', "got '../my.toml'; correct"),
        ('name = "linear"\ncommand = ["sh"]', "expected a name that no model or entrant has"),
        ('name = "a b"\ncommand = ["sh"]', "expected a name of letters, digits"),
    ],
)
def test_a_file_that_declares_no_model_is_refused(tmp_path, text, message):
    (tmp_path / "my.toml").write_text(text)
    with pytest.raises(UsageError, match=message):
        load_plugin(tmp_path / "my.toml")


def test_a_file_that_is_no_text_is_refused(tmp_path):
    (tmp_path / "my.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(UsageError, match="expected a TOML file of a command, got"):
        load_plugin(tmp_path / "my.toml")


def test_two_files_may_not_declare_one_name(declare, tmp_path):
    shutil.copy(declare(), tmp_path / "other.toml")
    with pytest.raises(UsageError, match="expected a model under a name that no other --plugin"):
        load_plugins([tmp_path / "my.toml", tmp_path / "other.toml"])


def test_predictions_are_new_if_the_file_or_a_file_that_it_lists_changes(declare, tmp_path):
    load_plugin(declare())
    first = find_key()
    shutil.copytree(tmp_path, tmp_path / "copy")
    (tmp_path / "copy" / "unlisted.txt").write_text("more")
    load_plugin(tmp_path / "copy" / "my.toml")
    assert find_key() == first
    load_plugin(declare(script="exit 1"))
    second = find_key()
    load_plugin(declare(lines='environment = "dash 0.6"'))
    assert len({first, second, find_key()}) == 3


def test_with_several_seeds_it_has_a_name_for_each(declare):
    names = load_plugin(declare(lines="seeds = 3"))
    assert names == ("mine", "mine-2", "mine-3")
    assert len({find_key(name) for name in names}) == 3
    for name in names:
        model = MODELS.get(name)()
        assert pickle.loads(pickle.dumps(model)).files_digest == MODELS.get("mine").files_digest


def test_a_name_with_dots_can_be_pickled(declare):
    path = declare()
    path.write_text(path.read_text().replace('"mine"', '"my.own-1.2"'))
    load_plugin(path)
    model = MODELS.get("my.own-1.2")(random_state=3)
    assert pickle.loads(pickle.dumps(model)).random_state == 3


def test_a_worker_elsewhere_gets_the_files_that_it_lists(declare, tmp_path):
    path = declare()
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "part.sh").write_text("true")
    (tmp_path / "unrelated.sh").write_text("true")
    path.write_text(path.read_text().replace('["model.sh"]\nf', '["model.sh", "deep/part.sh"]\nf'))
    away = tmp_path / "away"
    (there,) = write_plugin_files(read_plugin_files([path]), [path], away)
    files = {each.relative_to(there.parent).as_posix() for each in there.parent.rglob("*.*")}
    assert files == {"my.toml", "model.sh", "deep/part.sh"}
    load_plugin(path)
    here = find_key()
    load_plugin(there)
    assert find_key() == here
    assert MODELS.get("mine").folder == there.parent
