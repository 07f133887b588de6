import pytest

from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.registry import MODELS

ONES = """\
for path in "$2"/given/*; do
    out="$2/filled/$(basename "$path")"
    mkdir "$out"
    sed s/NaN/1.0/g "$path/values.csv" > "$out/mean.csv"
done
"""
"""A model of a shell, which starts at once: 1 stands wherever an entry is hidden."""


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
