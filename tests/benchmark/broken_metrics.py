"""Metrics with one fault each, for the tests of the harness."""

import ctypes
import os
import subprocess
import time

import numpy as np

from mocapbench.metrics import Direction, Imputation, Metric, Score


def _sleeps(outcome):
    time.sleep(600)


def _hangs(outcome):
    """Hang where Python takes no note of signals."""
    ctypes.PyDLL(None).sleep(600)


def _dies(outcome):
    os._exit(7)


def _leaves(outcome):
    """End the process as if all were well."""
    os._exit(0)


def _exits(outcome):
    raise SystemExit(5)


def _raises(outcome):
    raise RuntimeError("the metric raised")


def _hoards(outcome):
    return Score(float(np.ones(2**40).sum()))


def _litters(outcome):
    subprocess.Popen(["sleep", "602"])
    return Score(1.0)


def _metric(name, statistic):
    return Metric(name, name, Direction.LOWER, Imputation, statistic)


METRICS = {
    statistic.__name__[1:]: _metric(statistic.__name__[1:], statistic)
    for statistic in (_sleeps, _hangs, _dies, _leaves, _exits, _raises, _hoards, _litters)
}
