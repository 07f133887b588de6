"""Metrics with one fault each, for the tests of the harness."""

import ctypes
import os
import subprocess
import time

import numpy as np

from mocapbench.metrics import Direction, Imputation, Score, metric


def _declare(statistic):
    return metric(title=statistic.__name__, direction=Direction.LOWER)(statistic)


@_declare
def sleeps(outcome: Imputation):
    time.sleep(600)


@_declare
def hangs(outcome: Imputation):
    """Hang where Python takes no note of signals."""
    ctypes.PyDLL(None).sleep(600)


@_declare
def dies(outcome: Imputation):
    os._exit(7)


@_declare
def leaves(outcome: Imputation):
    """End the process as if all were well."""
    os._exit(0)


@_declare
def exits(outcome: Imputation):
    raise SystemExit(5)


@_declare
def raises(outcome: Imputation):
    raise RuntimeError("the metric raised")


@_declare
def hoards(outcome: Imputation):
    return Score(float(np.ones(2**40).sum()))


@_declare
def litters(outcome: Imputation):
    subprocess.Popen(["sleep", "602"])
    return Score(1.0)


METRICS = {
    declared.name: declared
    for declared in (sleeps, hangs, dies, leaves, exits, raises, hoards, litters)
}
