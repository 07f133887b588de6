"""Importing the values of a report loads no plotting library and no data frames."""

import subprocess
import sys

import pytest

LOADED = "import sys, {module}; print(*(name for name in {heavy} if name in sys.modules))"


@pytest.mark.parametrize(
    ("module", "heavy"),
    [
        ("mocapbench.reports", ("matplotlib", "pandas")),
        ("mocapbench.reports.bundle.task_page", ("matplotlib", "pandas", "numpy")),
        ("mocapbench.reports.bundle.pictures", ("matplotlib", "pandas")),
    ],
)
def test_an_import_loads_nothing_heavy(module, heavy):
    code = LOADED.format(module=module, heavy=heavy)
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == []
