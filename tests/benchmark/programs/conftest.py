import pytest
from shell_models import ONES

from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.registry import MODELS


@pytest.fixture
def declare(tmp_path):
    """Return a function that writes a script of a shell and its TOML file, with further lines."""

    def declare(script=ONES, lines="", command='["sh", "model.sh"]'):
        (tmp_path / "model.sh").write_text(script)
        path = tmp_path / "my.toml"
        path.write_text(
            f'name = "mine"\ncommand = {command}\nfiles = ["model.sh"]\nformat = "csv"\n{lines}\n'
        )
        return path

    return declare


@pytest.fixture
def build(declare):
    """Return a function that does so, and returns the model."""

    def build(*arguments, **keywords):
        (name,) = load_plugin(declare(*arguments, **keywords))
        return MODELS.get(name)()

    return build
