"""Processes of a command that tests start in a session of its own."""

import os
from contextlib import suppress

import psutil


def list_session(process):
    """Return what runs in the session of a process that was started with one of its own."""
    found = []
    for each in psutil.process_iter():
        with suppress(OSError, psutil.Error):
            if os.getsid(each.pid) == process.pid and each.status() != psutil.STATUS_ZOMBIE:
                found.append(each)
    return found
