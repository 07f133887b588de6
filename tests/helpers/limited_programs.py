"""What tests have a process do that is given limits, and runs a program.

They are here since a process that the portable backend starts imports them anew.
"""

from mocapbench.basics.deadline import set_deadline
from mocapbench.basics.system.choice import find_system
from mocapbench.benchmark.programs.running import run_program


def run_script(folder, script, **variables):
    """Run a script of a shell in a folder."""
    return run_program(["sh", "-c", script, "sh", "fill"], folder / "f", folder, variables)


def report(function, *arguments):
    """Return the kind and the message of what a function raises."""
    try:
        function(*arguments)
    except Exception as error:
        return type(error).__name__, str(error)
    return "", ""


def run_with_deadline(shell, script):
    """Run a script for which there are 3 seconds."""
    set_deadline(3.0)
    return report(shell, script)


def take_memory(shell, script):
    """Run a script that takes more than 100 MiB, and return also the limit as messages name it."""
    find_system().limit_growth(100 * 2**20)
    most = find_system().find_memory_limit()
    return *report(shell, script), f"at most {most / 2**30:.1f} GiB"


def reserve_addresses(shell, script):
    """Run a script in a process that may take 100 MiB."""
    find_system().limit_growth(100 * 2**20)
    return report(shell, script)


def work_in_vain(shell, script):
    """Run a script in a process that may work for a second."""
    find_system().limit_work(1.0)
    return report(shell, script)
