"""A package index on this machine, from which a new environment installs mocapbench.

`tox run -e release` runs it on the distributions that are to be published: dependencies come from
the index of pip's own settings.
"""

import subprocess
import sys
import threading
import venv
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from tempfile import TemporaryDirectory

COMMANDS = (
    "mocapbench --version",
    "mocapbench run --profile smoke --tasks toy-interpolation-1 --offline --out run",
)
KINDS = {"wheel": "--only-binary", "source distribution": "--no-binary"}


class _Silent(SimpleHTTPRequestHandler):
    """Lists the files of a folder as links, which is what pip asks of an index."""

    def log_message(self, *args):
        pass


@contextmanager
def serve_index(distributions):
    """Yield the address of an index that has these files, and nothing else."""
    with TemporaryDirectory() as folder:
        place = Path(folder) / "mocapbench"
        place.mkdir()
        for path in distributions:
            (place / path.name).write_bytes(path.read_bytes())
        handler = partial(_Silent, directory=folder)
        with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            yield f"http://127.0.0.1:{server.server_port}/"
            server.shutdown()


def try_distribution(kind, folder, *options, lent=""):
    """Install one kind of distribution into a new environment; return what the commands print.

    The commands run in an empty folder, and find no program but those of the environment: no git.

    Parameters
    ----------
    kind : str
        A key of `KINDS`.
    folder : Path
        New; the environment is made in it.
    *options : str
        Of ``pip install``, the index among them.
    lent : str
        A folder of packages that the environment has too.
    """
    venv.create(folder / "environment", with_pip=True)
    (packages,) = (folder / "environment").glob("lib/python*/site-packages")
    (packages / "lent.pth").write_text(f"import site; site.addsitedir({lent!r})\n" if lent else "")
    programs, work = folder / "environment" / "bin", folder / "work"
    work.mkdir()
    chosen = [KINDS[kind], "mocapbench", *options, "mocapbench"]
    _run([programs / "pip", "install", "--quiet", *chosen], work)
    given = {"PATH": str(programs), "HOME": str(folder), "MOCAPBENCH_CACHE": str(folder / "cache")}
    where = [programs / "python", "-c", "import mocapbench; print(mocapbench.__file__)"]
    return [_run(words, work, given) for words in (where, *map(str.split, COMMANDS))]


def _run(words, folder, environment=None):
    words = [str(words[0]), *words[1:]]
    done = subprocess.run(
        words, cwd=folder, env=environment, capture_output=True, text=True, timeout=600, check=False
    )
    assert done.returncode == 0, f"{words}\n{done.stdout}{done.stderr}"
    return done.stdout


if __name__ == "__main__":
    with serve_index([*Path(sys.argv[1]).iterdir()]) as address, TemporaryDirectory() as top:
        for name in KINDS:
            told = try_distribution(name, Path(top) / name, "--extra-index-url", address)
            print(f"{name}:", *(printed.splitlines()[-1] for printed in told), sep="\n  ")
