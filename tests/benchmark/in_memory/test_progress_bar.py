import warnings
from importlib.machinery import ModuleSpec

import pytest
from rich import console

from mocapbench.benchmark.in_memory import progress_bar


@pytest.fixture
def jupyter(monkeypatch):
    """Return a function that says whether Jupyter has widgets."""
    monkeypatch.setattr(console, "_is_jupyter", lambda: True)
    monkeypatch.setattr(console.Console, "is_terminal", property(lambda _: False))

    def set_up(*, widgets):
        found = ModuleSpec("ipywidgets", None) if widgets else None
        monkeypatch.setattr(progress_bar, "find_spec", lambda name: found)

    return set_up


def test_jupyter_without_widgets_shows_neither_a_bar_nor_a_warning(jupyter):
    jupyter(widgets=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with progress_bar.show_progress("trying models") as watch:
            watch(1, 2)


def test_jupyter_with_widgets_has_a_bar(jupyter, monkeypatch):
    made = []
    monkeypatch.setattr(
        progress_bar.Progress, "start", lambda self: made.append(self.disable), raising=False
    )
    jupyter(widgets=True)
    with progress_bar.show_progress("trying models"):
        pass
    assert made == [False]
