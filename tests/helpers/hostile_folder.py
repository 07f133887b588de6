"""A folder whose Python files pass for every library, and tell which of them were run."""

import sys
from importlib.metadata import packages_distributions

OPTIONAL = ("bottleneck", "numexpr", "numba", "uvloop", "sitecustomize", "usercustomize")
"""What libraries import if it is there; it mostly is not."""
TELL = "import posix\nposix.close(posix.open({!r}, posix.O_CREAT | posix.O_WRONLY))\n"
"""Code that leaves a file behind, and imports what no file can pass for."""


class HostileFolder:
    """A folder that somebody sent.

    Parameters
    ----------
    path : Path
    marks : Path
        Another folder, to which each Python file adds a file of its own name when it is run.
    """

    def __init__(self, path, marks):
        self.path, self._marks = path, marks
        for folder in (path, marks):
            folder.mkdir()
        for name in {*sys.stdlib_module_names, *packages_distributions(), *OPTIONAL, "mocapbench"}:
            if name.isidentifier():
                (path / f"{name}.py").write_text(TELL.format(str(marks / name)))

    def forget(self):
        """Take no note of what was run before."""
        for path in self._marks.iterdir():
            path.unlink()

    @property
    def run_files(self):
        """Return the names of the Python files that were run."""
        return sorted(path.name for path in self._marks.iterdir())


def write_program(folder, module="mocapbench.benchmark.cli.main"):
    """Write the program of a command line as pip does: where Python finds nothing beside it."""
    folder.mkdir()
    program = folder / "program"
    program.write_text(f"from {module} import main\nif __name__ == '__main__':\n    main()\n")
    return program
