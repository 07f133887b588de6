"""The small files on which the commands of the documentation are tried.

Recordings are generated gait. `walk` and `jump` have gaps (as C3D, one of two in upperback),
`other` has none, and the folder `walks` holds three people's, for the task file `my.toml`. `cmu` is
a database of one walk. The plug-ins are those of docs/compare.md and examples/commands. `results`
is a finished run, `reference` has its metrics, and other runs are copies of it.
"""

import shutil

import numpy as np
from code_attempts import ROOT
from code_blocks import code_blocks, written
from code_shell import Shell
from format_files import markers, sample, walk, with_gap, write_acclaim, write_c3d, write_csv
from own_files import write_csv as write_waves

RUN = "mocapbench run --profile smoke --offline --no-report --jobs 2 --out results"
COPIES = ("before", "after", "here", "there", "thesis", "run")


def lay_out(folder, monkeypatch):
    """Write the files into a new folder."""
    folder.mkdir()
    monkeypatch.chdir(folder)
    for name in ("acclaim", "csv"):
        sample(name, folder)
    write_csv(folder / "other.csv", walk())
    for name in ("walk.c3d", "jump.c3d"):
        write_c3d(folder / name, _with_two_gaps())
    for number, name in enumerate(("anna", "ben", "cleo")):
        write_waves(folder / "walks" / f"{name}.csv", n_frames=400 + number, channels=CHANNELS)
    _write_database(folder / "cmu" / "subjects" / "01")
    shutil.copytree(ROOT / "examples" / "commands", folder, dirs_exist_ok=True)
    for example in code_blocks(ROOT / "docs" / "compare.md"):
        written(example.parsed)
    shell = Shell(folder)
    shell.run("mocapbench init my.toml --recordings walks")
    shell.run(f"{RUN} --tasks golf-swings,toy-interpolation-1,toy-synthesis --models {MODELS}")
    assert shell.code == 0
    shell.run("mocapbench check results --reference reference --update")
    for copy in COPIES:
        shutil.copytree("results", copy)


def _with_two_gaps():
    """Return markers with a gap in the root, and one in frames 40 to 49 of the upper back."""
    recording = with_gap(markers(300))
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[40:50, 6:9] = True
    return recording.hide(hidden)


def _write_database(folder):
    """Write one walk in the layout of the CMU database."""
    folder.mkdir(parents=True)
    write_acclaim(folder / "01_01.amc", walk())
    (folder / "01_01.asf").rename(folder / "01.asf")


CHANNELS = ("lknee.x", "lknee.y", "lhip.x", "rhip.x")
MODELS = "linear,knn,hgp,gp-independent,control"
