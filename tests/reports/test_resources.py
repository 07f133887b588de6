"""Templates, style sheets and scripts: found in the package, whole, and in one order."""

from importlib.resources import files

import jinja2
import pytest

from mocapbench.reports.resources import PAGE, scripts, styles, template


@pytest.mark.parametrize(("folder", "joined"), [("styles", styles), ("scripts", scripts)])
def test_every_file_of_a_folder_stands_once_in_the_order_of_names(folder, joined):
    whole = joined()
    texts = [
        (files(PAGE) / folder / name).read_text(encoding="utf-8")
        for name in sorted(file.name for file in (files(PAGE) / folder).iterdir() if file.is_file())
    ]
    places = [whole.index(text) for text in texts]
    assert places == sorted(places)
    assert all(whole.count(text) == 1 for text in texts)
    assert joined() == whole


def test_every_template_of_the_page_is_read_and_misses_nothing_silently():
    for file in (files(PAGE) / "parts").iterdir():
        assert template(f"parts/{file.name}").name == f"parts/{file.name}"
    with pytest.raises(jinja2.UndefinedError):
        template("parts/page.html.j2").render()


def test_other_packages_have_templates_of_their_own():
    assert template("page.html.j2", "mocapbench.reports.run_comparison").name == "page.html.j2"


def test_each_script_is_a_function_that_calls_itself():
    for file in (files(PAGE) / "scripts").iterdir():
        code = file.read_text(encoding="utf-8")
        assert code.startswith('"use strict";\n'), file.name
        assert "(() => {\n" in code, file.name
        assert code.rstrip().endswith("})();"), file.name
