"""Plug-ins and their helpers are on a worker as they are here."""

from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.runs.cluster.plugin_files import read_plugin_files, write_plugin_files


def travel(plugins, folder):
    return write_plugin_files(read_plugin_files(plugins), plugins, folder)


def test_a_plugin_and_the_helper_that_it_imports_travel_and_other_files_do_not(tmp_path):
    home, away = tmp_path / "home", tmp_path / "away"
    home.mkdir()
    (home / "travelling_helper.py").write_text("from mocapbench.baselines.trivial import Trivial")
    (home / "unrelated.py").write_text("")
    plugin = home / "models.py"
    plugin.write_text("from travelling_helper import Trivial\nMODELS = {'fills': Trivial}\n")
    load_plugin(plugin)
    (there,) = travel([plugin], away)
    assert there.name == "models.py"
    assert there.read_bytes() == plugin.read_bytes()
    assert {path.name for path in there.parent.iterdir()} == {"models.py", "travelling_helper.py"}


def test_files_of_one_name_in_two_folders_stay_apart(tmp_path):
    plugins = [tmp_path / name / "models.py" for name in ("one", "two")]
    for path in plugins:
        path.parent.mkdir()
        path.write_text(f"NAME = {path.parent.name!r}")
    there = travel(plugins, tmp_path / "away")
    assert [path.read_bytes() for path in there] == [path.read_bytes() for path in plugins]
    assert len({path.parent for path in there}) == 2


def test_no_plugins_are_no_files(tmp_path):
    assert travel([], tmp_path) == ()
