"""Two installations are alike when results are."""

import pytest

from mocapbench.benchmark.runs.cluster import installation as module
from mocapbench.benchmark.runs.cluster.installation import difference, installation


def test_an_installation_does_not_differ_from_itself():
    assert difference(installation(), installation()) == ""


@pytest.mark.parametrize("name", ["mocapbench", "numpy", "scipy", "scikit-learn"])
def test_another_version_is_named_with_both(name):
    found = {**installation(), name: "0.0"}
    assert difference(installation(), found) == f"expected {name} {installation()[name]}, got 0.0"


def test_a_package_with_plugins_that_only_one_has_is_named():
    more = {**installation(), "waves": "1.0"}
    assert difference(more, installation()) == "expected waves 1.0, got none"
    assert difference(installation(), more) == "expected waves not to be installed, got 1.0"


def test_changed_code_of_one_version_differs(monkeypatch):
    monkeypatch.setattr(module, "_PARTS", module._PARTS[:-1])
    changed = installation.__wrapped__()
    assert difference(installation(), changed).startswith("expected source code of mocapbench ")
