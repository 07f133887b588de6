"""Commands of the documentation, tried on small files of the page's folder.

In blocks of `sh`, a command shows what can be written, and is tried as follows.

==================  ==============================================================================
mocapbench run      as a dry run of one fold, and of one task unless it names tasks or cases
mocapbench fill     by `linear`, unless it names a model
… data fetch        is parsed by the command line's own parser, since it needs a network; so
                    is `models install`
… --OPTION          is an option of the command line
other mocapbench    runs as it stands, and ends with exit code 0
pip install         names packages, and extras that we have
tox run             names environments of the nearest `tox.ini`; options of `bench` are parsed
pytest FOLDER       names a folder of the source tree, or a mark that is declared
python FILE         names a file of the page's folder or of the source tree
cat FILE >> …       names files that there are
git …, twine …      name a command of theirs; they publish, so nothing more is tried
pipx run, uvx       name our program; what follows is parsed like `data fetch`
docker …            builds from our Dockerfile, or runs what it has; that is parsed too
dask …              is parsed by dask's own parsers, since it needs a cluster
==================  ==============================================================================

In blocks of `console`, `mocapbench` runs as it stands, whatever its exit code, which `echo $?`
shows. Any other command fails, and so does an option that a parser does not know.
"""

import re
import shlex
import string
from pathlib import Path

from code_attempts import ATTEMPTS, run_mocapbench, split_words


class UntriedCommandError(AssertionError):
    """A command that nothing here can try."""


class Shell:
    """What a page's commands share: variables, the last exit code, and where the page is."""

    def __init__(self, where):
        self.where = where
        self.variables = {}
        self.code = 0

    def attempt(self, line):
        """Try the commands of a line, without having them do all that they would."""
        for words in self._commands(line):
            name, rest = re.sub(r"[\d.]+$", "", Path(words[0]).name), words[1:]
            if name not in ATTEMPTS:
                raise UntriedCommandError(f"no way to try {words[0]!r}")
            ATTEMPTS[name](self, rest)

    def run(self, line):
        """Run a line as it stands and return what it prints."""
        ((name, *rest),) = self._commands(line)
        if name == "echo":
            return " ".join(rest) + "\n"
        assert name == "mocapbench", f"no way to run {name!r}"
        self.code, printed = run_mocapbench(rest)
        return printed

    def _commands(self, line):
        """Yield the words of every command, and take up variables that are set."""
        known = {**self.variables, "?": str(self.code)}
        line = line.replace("$?", "${?}").replace("${?}", known["?"])
        words = shlex.split(string.Template(line).safe_substitute(known), comments=True)
        for command in split_words(words, "&&"):
            setting = re.fullmatch(r"([A-Z]+)=(.*)", command[0])
            if setting:
                self.variables[setting[1]] = setting[2]
            else:
                yield command

    def tox_file(self):
        """Return the text of the nearest `tox.ini`."""
        folders = (self.where, *self.where.parents)
        return next(folder for folder in folders if (folder / "tox.ini").exists()) / "tox.ini"
