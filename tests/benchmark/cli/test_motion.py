"""`mocapbench motion`, from a run directory to files."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mocapbench.benchmark import JointAngles, RunDirectory, archive_at
from mocapbench.benchmark.cli.main import main
from mocapbench.datasets import AcclaimFormat, CSVFormat

pytestmark = pytest.mark.slow

FILL, WALKS = "upper-body-missing", "synthetic walks"
CELL = f"{FILL}/{WALKS}/nn"
SAMPLE = "walking-synthesis/synthetic/hgp"
RUNS = (
    (f"{FILL},style-clustering", "nn,trivial,k-means"),
    ("walking-synthesis,marker-gaps", "hgp,linear"),
)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Return run directories of models that fill, cluster and invent motion."""
    folders = []
    for tasks, models in RUNS:
        out = tmp_path_factory.mktemp("run") / "run"
        options = ("--profile", "smoke", "--tasks", tasks, "--models", models, "--offline")
        with pytest.raises(SystemExit) as ended:
            main(["run", *options, "--out", str(out)])
        assert ended.value.code == 0
        folders.append(out)
    return folders


@pytest.fixture
def fills(finished):
    return finished[0]


@pytest.fixture
def samples(finished):
    return finished[1]


@pytest.fixture
def stored(fills):
    """Return what the store has of the cell's recording."""
    store = RunDirectory(fills)
    (record,) = (r for r in store.records() if (r.address.task, r.address.label) == (FILL, "nn"))
    return store.load_fit(record.fit_key).arrays["mean-0"]


def hidden(recording):
    """Return the mask of what the task hides: all joint angles but the lower legs', late."""
    kept = ("root", "tibia", "foot", "toes")
    columns = [not name.partition(".")[0].endswith(kept) for name in recording.channels]
    return np.outer(np.arange(len(recording.times)) >= len(recording.times) // 2, columns)


def test_a_csv_file_has_the_stored_prediction(cli, fills, stored, tmp_path):
    path = tmp_path / "walk.csv"
    assert cli("motion", fills, CELL, "--csv", path) == 0
    read = CSVFormat().load(path, None)
    mask = hidden(read)
    np.testing.assert_array_equal(read.values[mask], stored[mask])


def test_an_amc_file_has_the_stored_prediction(cli, fills, stored, tmp_path):
    assert cli("motion", fills, CELL, "--amc", tmp_path / "w.amc", "--csv", tmp_path / "w.csv") == 0
    assert "30 frames per second" in cli.printed
    table = CSVFormat().load(tmp_path / "w.csv", None)
    angles = [name for name in table.channels if not name.startswith("root.d")]
    read = AcclaimFormat().load(tmp_path / "w.amc", 30.0).select(angles)
    mask = hidden(read)
    columns = [table.channels.index(name) for name in angles]
    np.testing.assert_array_equal(read.values[mask], stored[:, columns][mask])
    skeleton = AcclaimFormat().skeleton(tmp_path / "w.amc")
    assert skeleton.parents == archive_at().skeleton("gait:01_01").parents
    assert JointAngles(skeleton).positions(read).shape[1] == len(skeleton.segments)


def test_a_gif_moves_and_shows_the_gap(cli, fills, tmp_path):
    path = tmp_path / "walk.gif"
    assert cli("motion", fills, CELL, "--gif", path) == 0
    with Image.open(path) as gif:
        colours = []
        for frame in (0, gif.n_frames - 1):
            gif.seek(frame)
            colours.append(gif.convert("RGB").getpixel((100, 100)))
        assert gif.n_frames == len(CSVFormat().load(_csv(cli, fills, tmp_path), None).times)
    assert colours[0] != colours[1]  # the background of hidden frames is tinted


def _csv(cli, run, folder):
    assert cli("motion", run, CELL, "--csv", folder / "again.csv") == 0
    return folder / "again.csv"


def test_a_sample_is_written_in_every_format(cli, samples, tmp_path):
    files = [tmp_path / f"walk.{kind}" for kind in ("gif", "amc", "bvh", "csv")]
    options = [word for path in files for word in (f"--{path.suffix[1:]}", path)]
    assert cli("motion", samples, SAMPLE, *options) == 0
    assert all(path.stat().st_size > 1000 for path in (*files, tmp_path / "walk.asf"))


def test_markers_have_no_joint_angles(cli, samples, tmp_path):
    cell = "marker-gaps/synthetic a limb 0.5 s, others of the subject/linear"
    assert (
        cli("motion", samples, cell, "--bvh", tmp_path / "a.bvh", "--csv", tmp_path / "a.csv") == 2
    )
    assert "joint angles of a skeleton" in cli.printed
    assert "possible: --csv, --gif" in cli.printed
    assert [*tmp_path.iterdir()] == []
    assert cli("motion", samples, cell, "--gif", tmp_path / "a.gif") == 0


@pytest.mark.parametrize(
    ("cell", "told"),
    [
        (f"{FILL}/synthetic walk/nn", f"such as '{CELL}'"),
        (f"{CELL}/2", "unknown cell"),
        ("", "expected TASK/CASE/MODEL"),
        ("style-clustering/synthetic C = 2/k-means", "fills or invents motion"),
    ],
)
def test_a_cell_that_has_no_motion_is_named(cli, fills, tmp_path, cell, told):
    assert cli("motion", fills, cell, "--csv", tmp_path / "walk.csv") == 2
    assert told in cli.printed
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ((), "--gif, --amc, --bvh or --csv"),
        (("--csv", "walk.txt"), "*.csv"),
        (("--csv", "nowhere/walk.csv"), "folder that exists"),
        (("--csv", "there.csv"), "would be overwritten"),
        (("--amc", "there.amc"), "there.asf"),
    ],
)
def test_a_file_that_cannot_be_written_is_refused(cli, fills, tmp_path, options, told):
    for name in ("there.csv", "there.asf"):
        (tmp_path / name).write_text("mine")
    paths = [tmp_path / word if "." in word else word for word in options]
    assert cli("motion", fills, CELL, *paths) == 2
    assert told in cli.printed
    assert sorted(path.read_text() for path in tmp_path.iterdir()) == ["mine", "mine"]


def test_a_folder_that_cannot_be_written_to_is_refused(cli, fills, tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path) != tmp_path)
    assert cli("motion", fills, CELL, "--csv", tmp_path / "walk.csv") == 2
    assert "expected a folder that can be written to" in cli.printed
    assert [*tmp_path.iterdir()] == []


def test_a_job_without_a_prediction_is_named(cli, write_run, tmp_path):
    row = (FILL, WALKS, "nn", 0)
    run = write_run(tmp_path / "run", [row], statuses={row: "failed"})
    assert cli("motion", run, CELL, "--csv", tmp_path / "walk.csv") == 2
    assert "ended as failed: by run" in cli.printed


def test_a_prediction_that_is_gone_is_named(cli, write_run, tmp_path):
    run = write_run(tmp_path / "run", [(FILL, WALKS, "nn", 0)])
    for path in (run / "predictions").rglob("*.npz"):
        path.unlink()
    assert cli("motion", run, f"{CELL}/1", "--csv", tmp_path / "walk.csv") == 2
    assert "run it again" in cli.printed


def test_the_first_fold_is_taken_unless_one_is_named(cli, write_run, tmp_path):
    rows = [(FILL, WALKS, "nn", fold) for fold in (1, 2)]
    run = write_run(tmp_path / "run", rows, statuses=dict.fromkeys(rows, "failed"))
    for path in (run / "records").rglob("*.json"):
        document = json.loads(path.read_text())
        path.write_text(json.dumps({**document, "message": f"fold {document['fold'] + 1}"}))
    for cell, fold in ((CELL, 2), (f"{CELL}/2", 2), (f"{CELL}/3", 3)):
        assert cli("motion", run, cell, "--csv", tmp_path / "walk.csv") == 2
        assert f"ended as failed: fold {fold}" in cli.printed
