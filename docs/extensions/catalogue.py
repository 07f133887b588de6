"""Write a page for each task, model and metric before Sphinx reads the pages."""

from pathlib import Path

from sphinx.application import Sphinx

from mocapbench.benchmark.registry import METRICS, MODELS, TASKS

__all__ = ["setup"]

_REGISTRIES = {"tasks": TASKS, "models": MODELS, "metrics": METRICS}


def setup(app: Sphinx) -> dict[str, bool]:
    """Have Sphinx write the pages when it begins."""
    app.connect("builder-inited", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _write(app: Sphinx) -> None:
    for kind, registry in _REGISTRIES.items():
        folder = Path(app.srcdir) / "generated" / kind
        folder.mkdir(parents=True, exist_ok=True)
        names = sorted(registry.names())
        toctree = "\n".join(["```{toctree}", *names, "```"])
        (folder / "index.md").write_text(f"# {kind.title()}\n\n{toctree}\n")
        for name in names:
            (folder / f"{name}.md").write_text(f"# `{name}`\n")
