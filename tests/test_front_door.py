"""What ``import mocapbench`` offers is there, and costs nothing until it is used."""

import subprocess
import sys

import pytest

import mocapbench

OFFERED = ("FileRecording", "Filled", "GapFiller", "Gaps", "compare", "evaluate", "fill", "read")
HEAVY = ("matplotlib", "numpy", "pandas", "rich", "scipy", "sklearn", "xarray")


def run(code):
    """Return what a fresh process prints."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return done.stdout.split()


@pytest.mark.parametrize("name", OFFERED)
def test_every_name_is_offered_and_described(name):
    assert name in mocapbench.__all__
    assert name in dir(mocapbench)
    assert getattr(mocapbench, name).__doc__


def test_the_parts_are_at_hand():
    assert run("import mocapbench; print(mocapbench.metrics.mse.name)") == ["mse"]


def test_the_import_loads_nothing():
    code = f"import sys, mocapbench; print(*[name for name in {HEAVY!r} if name in sys.modules])"
    assert run(code) == []


def test_the_import_loads_none_of_our_modules():
    code = "import sys, mocapbench; print(*[n for n in sys.modules if n.startswith('mocapbench.')])"
    assert run(code) == []


def test_what_others_use_loads_nothing_of_it():
    """Those who run benchmarks do not pay for notebooks."""
    code = "import sys; from mocapbench.benchmark import plan, compare; print(*sys.modules)"
    assert "mocapbench.benchmark.in_memory" not in run(code)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("use", "said"),
    [
        ("filled.plot('channel 0')", "plot needs matplotlib"),
        ("filled.to_xarray()", "to_xarray needs xarray"),
    ],
)
def test_what_an_extra_brings_is_named_where_it_is_lacking(use, said):
    code = f"""
import sys
sys.modules["matplotlib"] = sys.modules["matplotlib.pyplot"] = sys.modules["xarray"] = None
import numpy as np, mocapbench
filled = mocapbench.fill(np.array([[0.0], [np.nan], [1.0]]), "linear", rate=1)
try:
    {use}
except ImportError as error:
    print(error)
"""
    advice = "which cannot be imported: pip install 'mocapbench[notebook]'"
    assert " ".join(run(code)) == f"{said}, {advice}"
