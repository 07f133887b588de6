"""A Linux that looks to our modules as Windows does: what that lacks is hidden from them alone.

The libraries and Python itself go on as they do on Linux. `write_look` makes a folder for
PYTHONPATH, from which every interpreter that starts takes this look.
"""

import builtins
import os
import signal
import sys
from types import ModuleType

MODULES = {"fcntl", "resource", "termios", "pwd", "grp"}
ATTRIBUTES = {
    os: {
        "fork", "killpg", "setsid", "getuid", "geteuid", "pidfd_open", "O_NOFOLLOW", "O_NONBLOCK",
        "register_at_fork", "waitid", "getpgid", "setpgid", "sched_getaffinity", "set_blocking",
        "wait4", "mkfifo", "uname",
    },
    signal: {
        "SIGKILL", "SIGALRM", "SIGHUP", "SIGXCPU", "SIGPIPE", "SIGUSR1", "setitimer", "getitimer",
        "ITIMER_REAL", "ITIMER_PROF", "pthread_sigmask", "SIG_BLOCK", "SIG_SETMASK", "SIGPROF",
        "pthread_kill",
    },
}  # fmt: skip


def is_ours(name):
    return name.startswith("mocapbench.") or name == "mocapbench"


class Look(ModuleType):
    """A module of which our modules see only what Windows has."""

    def __getattr__(self, name):
        hidden = self.__dict__["_hidden"]
        if name in hidden and not is_ours(sys._getframe(1).f_globals.get("__name__", "")):
            return hidden[name]
        raise AttributeError(f"module {self.__name__!r} has no attribute {name!r} on Windows")


def put_on():
    """Take the look, in this interpreter, until its end."""
    for module, names in ATTRIBUTES.items():
        module._hidden = {name: getattr(module, name) for name in names}
        for name in names:
            delattr(module, name)
        module.__class__ = Look
    if hasattr(os, "process_cpu_count"):  # Python 3.13 has it, and asks on Linux what is hidden
        os.process_cpu_count = os.cpu_count
    find = builtins.__import__

    def find_as_windows(name, *rest, **named):
        scope = rest[0] if rest else named.get("globals")
        if name in MODULES and is_ours((scope or {}).get("__name__", "")):
            raise ModuleNotFoundError(f"No module named {name!r} on Windows", name=name)
        return find(name, *rest, **named)

    builtins.__import__ = find_as_windows


def write_look(folder):
    """Write what interpreters import at their start from a folder on PYTHONPATH."""
    folder.mkdir()
    (folder / "sitecustomize.py").write_text(
        f"import sys; sys.path.append({os.path.dirname(__file__)!r})\n"  # noqa: PTH120
        "import windows_look; windows_look.put_on()\n"
    )
    return folder
