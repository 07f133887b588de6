"""A page for each task, model and metric, written before Sphinx reads the pages.

All that a page says is read from what is registered: the tasks themselves, the docstrings of models
and metrics, the published values, and the stored reference values as the report reads them.
"""

from __future__ import annotations

from pathlib import Path

from sphinx.application import Sphinx
from sphinx.config import Config

from catalogue.figures import style_sheet
from catalogue.folder import write_folder
from catalogue.site import pages

__all__ = ["setup"]

STATIC = "generated/static"
STYLES = "catalogue.css"


def setup(app: Sphinx) -> dict[str, bool]:
    """Have Sphinx write the pages when it begins."""
    app.add_config_value("catalogue_reference", "../tests/goldens/metrics", "env", str)
    app.connect("config-inited", _write_styles)
    app.connect("builder-inited", _write_pages)
    app.add_css_file(STYLES)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _write_styles(app: Sphinx, config: Config) -> None:
    write_folder(Path(app.srcdir) / STATIC, {STYLES: style_sheet()})
    config.html_static_path = [*config.html_static_path, STATIC]


def _write_pages(app: Sphinx) -> None:
    source = Path(app.srcdir)
    for kind, texts in pages(source / app.config.catalogue_reference).items():
        named = {f"{name}.rst": text for name, text in texts.items()}
        write_folder(source / "generated" / kind, named)
