"""How the site is built: `tox run -e docs` writes it to docs/_build/html."""

import sys
import tomllib
from pathlib import Path

from numpydoc.xref import DEFAULT_LINKS

from mocapbench import __version__

HERE = Path(__file__).parent
METADATA = tomllib.loads((HERE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
sys.path.insert(0, str(HERE / "extensions"))
import front_doors  # noqa: E402

project = "mocapbench"
author = copyright = METADATA["authors"][0]["name"]  # noqa: A001
release = version = __version__
source_repository = METADATA["urls"]["Source"]

extensions = [
    "catalogue",
    "citation",
    "commands",
    "folders",
    "front_doors",
    "notebooks",
    "source_links",
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "sphinx-mathjax-offline",  # formulas without a network
]
templates_path = ["templates"]
exclude_patterns = [
    *("_build", "checks", "evidence", "extensions", "static", "templates"),
    *("generated/citation.md", "generated/commands.md", "generated/folders.md"),
    "tutorials/*.rst",
]

myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_fence_as_directive = ["math"]
myst_heading_anchors = 4

default_role = "py:obj"
nitpicky = True
# No inventory of others' names without a network: they occur in what a type stands for.
nitpick_ignore_regex = [("py:class", r"numpy\..*")]
autosummary_generate = True
autosummary_filename_map = {"mocapbench.benchmark.Run": "mocapbench.benchmark.Run-class"}  # not run
autodoc_typehints = "none"  # the sections name the types, with shapes
autodoc_member_order = "bysource"
autodoc_default_options = {
    "members": True,
    "inherited-members": "ABC,AbstractContextManager,Enum,Exception,int,str,tuple",
}
numpydoc_show_class_members = False
# Faults of fact: what is described and is not there, in another order, or without a type.
numpydoc_validation_checks = {
    *("GL05", "GL06", "GL07", "GL09", "GL10", "RT04", "RT05"),
    *("PR02", "PR03", "PR04", "PR05", "PR06", "PR08", "PR09", "PR10"),
}
# These bind a parameter of the function whose text they show.
numpydoc_validation_exclude = {r"^mocapbench\.metrics\.(coverage_|frobenius_|logdet_|mcc|mlc)"}
numpydoc_xref_param_type = True
numpydoc_xref_ignore = "all"
numpydoc_xref_aliases = {word: word for word in DEFAULT_LINKS} | {  # others' sites: no network
    name: f"{package}.{name}" for package, names in front_doors.offered().items() for name in names
}

sphinx_gallery_conf = {
    "examples_dirs": "tutorials",
    "gallery_dirs": "generated/tutorials",
    "filename_pattern": r"\.py$",
    "within_subsection_order": "FileNameSortKey",
    "image_srcset": ["2x"],
    "abort_on_example_error": True,
    "write_computation_times": False,
    "parallel": 2,
}

html_theme = "pydata_sphinx_theme"
html_theme_options = {
    "header_links_before_dropdown": 6,
    "logo": {"image_light": "static/mark.svg", "image_dark": "static/mark.svg", "text": project},
    "icon_links": [{"name": "Source", "url": source_repository, "icon": "fa-brands fa-github"}],
    "navigation_with_keys": False,
    "show_prev_next": False,
    "footer_start": ["copyright"],
    "footer_end": [],
    "back_to_top_button": False,
}
html_context = {"default_mode": "auto"}
html_title = project
html_favicon = "static/mark.svg"
html_sidebars = {
    name: [] for name in ("index", "start", "glossary", "architecture", "changelog", "cite")
}
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
copybutton_prompt_text = r">>> |\.\.\. |\$ "  # examples are copied as they are typed
copybutton_prompt_is_regexp = True
copybutton_exclude = ".linenos, .gp, .go"


def setup(app):
    """Say that an extension which only copies files keeps no build from being parallel."""
    app.extensions["sphinx-mathjax-offline"].parallel_read_safe = True
