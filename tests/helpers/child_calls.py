"""What tests have a child do; a new interpreter must be able to import it."""

import os
import subprocess
import sys
import time

import numpy as np

from mocapbench.basics.system.choice import find_system

REGISTERED = []
MEBIBYTE = 2**20


def register():
    if not REGISTERED:
        REGISTERED.append("registered")


def read_registered():
    return os.getpid(), REGISTERED


def take(mebibytes):
    find_system().limit_growth(100 * MEBIBYTE)
    try:
        hoard = np.ones(mebibytes * MEBIBYTE // 8)
        time.sleep(0.5)
    except MemoryError:
        return "too much"
    return f"{hoard[0]:.0f}"


def measure_peak(mebibytes):
    hoard = np.ones(mebibytes * MEBIBYTE // 8)
    return find_system().measure_peak() + 0 * hoard[0]


def work(seconds):
    find_system().limit_work(seconds)
    while True:
        pass


def wait_in_vain(seconds):
    find_system().start_timer(seconds)
    time.sleep(600)


def start_another(file):
    started = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    file.write_text(str(started.pid))
