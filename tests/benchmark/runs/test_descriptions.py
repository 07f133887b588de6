"""Descriptions tell two functions or values apart, whatever they are made of."""

import functools
import importlib
import json
import sys

import numpy as np
import pandas as pd
import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.descriptions import describe_value
from mocapbench.metrics import Direction


def make(value):
    """Return a function that closes over a value."""

    def inner(seeds, archive):
        return value, seeds, archive

    return inner


def logged(function):
    """Decorate without telling what is decorated."""

    def inner(*arguments):
        return function(*arguments)

    return inner


class Thing:
    def __init__(self, value):
        self.value = value


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (1, 2),
        (1, True),
        (1, "1"),
        (0.1, 0.1 + 1e-16),
        ((1, 2), [1, 2]),
        ({"a": 1}, {"a": 2}),
        ({"a", "b"}, {"a", "c"}),
        (np.arange(3), np.arange(3.0)),
        (np.zeros((2, 3)), np.zeros((3, 2))),
        (np.array(["a", None], object), np.array(["b", None], object)),
        (Direction.LOWER, Direction.HIGHER),
        (make(1), make(2)),
        (make({"deep": [1]}), make({"deep": [2]})),
        (logged(make), logged(logged)),
        (functools.partial(make, 1), functools.partial(make, value=1)),
        (Thing(1), Thing(2)),
        (Thing, Direction),
        (np.sin, np.cos),
        (len, max),
    ],
)
def test_two_that_differ_have_two_descriptions(one, other):
    assert describe_value(one, ()) == describe_value(one, ())
    assert describe_value(one, ()) != describe_value(other, ())
    json.dumps([describe_value(one, ()), describe_value(other, ())])


def test_the_order_of_a_set_does_not_count():
    names = [f"joint {number}" for number in range(50)]
    backwards = dict.fromkeys(reversed(names))
    assert describe_value(set(names), ()) == describe_value(frozenset(backwards), ())


@pytest.mark.slow
@pytest.mark.parametrize("value", [object(), iter([1]), pd.DataFrame({"a": range(1000)})])
def test_what_cannot_be_told_apart_is_refused(value):
    with pytest.raises(UsageError, match=r"expected arguments .* use a dataclass"):
        describe_value((value,), ())


@pytest.mark.parametrize("bound", ["Wave(2)", "Wave(2).height", "(Wave(2),)", "Wave", "{1: Wave}"])
def test_the_source_of_the_class_of_a_value_counts(bound, tmp_path, monkeypatch, forget):
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "waves_of_mine", raising=False)
    file = tmp_path / "waves_of_mine.py"
    code = "class Wave:\n    def __init__(self, n): self.n = n\n    def height(self): return "
    file.write_text(f"{code}self.n * 1\n")
    module = importlib.import_module("waves_of_mine")
    value = eval(bound, {"Wave": module.Wave})
    before = describe_value(functools.partial(make, value), ())
    file.write_text(f"{code}self.n * 7\n")
    forget()
    assert describe_value(functools.partial(make, value), ()) != before
