"""A benchmark of one's own recordings, from files to the report."""

import json
import shutil
import tomllib

import numpy as np
import pytest
from format_files import GAIT, markers, write_acclaim, write_csv, write_trc
from own_files import write_csv as write_waves

from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.directory import RunDirectory

pytestmark = pytest.mark.slow

LEGS = ("lfemur.rx", "lfemur.ry", "ltibia.rx", "rfemur.rx", "rtibia.rx")
WAYS = {
    "frames": 'frames = ["30:36", "50:60"]\nchannels = ["lfemur.*"]',
    "whole-frames": 'frames = "30:36"',
    "fraction": "fraction = [0.1, 0.3]",
    "runs": 'runs = { seconds = [0.03, 0.1], count = 2, together = "joint" }',
    "pattern": 'pattern-of = "gaps/cameras.csv"',
    "channels": 'channels = "ltibia.*"',
}


def walks(folder, n_frames=80):
    """Write three walks of different people, and one with gaps in a folder below."""
    (folder / "gaps").mkdir(parents=True)
    for subject in ("01", "02", "03"):
        walk = GAIT.recording(f"{subject}_01").select(LEGS).frames(np.arange(n_frames))
        write_csv(folder / f"walk {subject}.csv", walk)
    hidden = np.zeros((n_frames, len(LEGS)), dtype=bool)
    hidden[10:25, :3] = hidden[60:65, 4] = True
    write_csv(folder / "gaps" / "cameras.csv", walk.hide(hidden))
    return folder


@pytest.fixture(scope="module")
def recordings(tmp_path_factory):
    return walks(tmp_path_factory.mktemp("own") / "recordings")


@pytest.fixture
def task_file(tmp_path):
    """Return a function that writes a task file."""

    def write(hide, name="mine", above='title = "Our walks"\n', models='["linear", "knn"]'):
        path = tmp_path / f"{name}.toml"
        text = f'files = ["*.csv"]\nmodels = {models}\n{above}\n[hide]\n{hide}\n'
        path.write_text(text)
        return path

    return write


@pytest.fixture
def own(cli, recordings, tmp_path):
    """Return a function that runs task files on the recordings and returns the exit code."""

    def run(*paths, out=tmp_path / "run", more=(), folder=recordings):
        files = [word for path in paths for word in ("--task-file", path)]
        return cli("run", "--offline", "--recordings", folder, *files, "--out", out, *more)

    return run


def test_every_way_of_hiding_runs(own, task_file, records, tmp_path):
    """With other recordings to learn from and without, in one run of several task files."""
    others = {f"{name}-others": task_file(hide, f"{name}-others") for name, hide in WAYS.items()}
    alone = {
        f"{name}-alone": task_file(hide, f"{name}-alone", 'training = "none"')
        for name, hide in WAYS.items()
        if name != "channels"  # of which nothing could be learnt
    }
    every = {**others, **alone}
    assert own(*every.values(), more=["--models", "linear", "--cases", "walk 01*,walk 02*"]) == 0
    found = records(tmp_path / "run")
    assert {task for task, *_ in found} == set(every)
    assert {case for _, case, *_ in found} >= {"walk 01", "walk 01 0.1 s", "walk 02 0.3 of entries"}
    for (task, *_), record in found.items():
        assert record["status"] == "ok", record["message"]
        digests = [name for name in record["provenance"] if name.startswith("digest of files:")]
        assert len(digests) == (3 if task in others else 1) + ("pattern" in task)
        assert record["scores"]["mse"] >= 0


def test_a_run_resumes_and_only_what_a_change_concerns_runs_again(cli, own, task_file, tmp_path):
    hide = "fraction = 0.2"
    assert own(task_file(hide)) == 0
    page = tmp_path / "run" / "report.html"
    assert "Our walks" in page.read_text()
    assert own(task_file(hide)) == 0
    assert "nothing new; report" in cli.printed
    assert own(task_file(f"# a comment\n{hide}", above='title = "Their walks"\nfolds = 1')) == 0
    assert "6 of 6 jobs are in" in cli.printed
    assert "Their walks" in page.read_text()
    assert own(task_file(hide, above="folds = 2", models='["linear"]')) == 0
    assert "3 of 6 jobs are in" in cli.printed
    assert own(task_file("fraction = 0.3"), more=["--explain", "--dry-run"]) == 0
    assert "fit and score 6" in cli.printed
    assert "task code" in cli.printed
    assert own(task_file("fraction = 0.3")) == 0
    assert "jobs are in" not in cli.printed
    assert len(RunDirectory(tmp_path / "run").record_keys()) == 6 + 3 + 6


def test_a_changed_recording_runs_again(cli, own, task_file, recordings, tmp_path):
    copy, path = tmp_path / "copy", task_file("fraction = 0.2", above='training = "none"')
    shutil.copytree(recordings, copy)
    assert own(path) == 0
    assert own(path, folder=copy) == 0
    assert "nothing new" in cli.printed  # the same recordings elsewhere
    walk = copy / "walk 02.csv"
    walk.write_text(walk.read_text().replace(",left\n", ",right\n"))
    assert own(path, folder=copy) == 0
    assert "nothing new" in cli.printed  # the same channels
    lines = walk.read_text().splitlines()
    walk.write_text("\n".join(lines[:-1]) + "\n")
    assert own(path, folder=copy) == 0
    assert "4 of 6 jobs are in" in cli.printed


def test_other_commands_work_on_the_run_alone(cli, own, task_file, tmp_path):
    one, two = tmp_path / "one", tmp_path / "two"
    path = task_file("fraction = 0.2", above='title = "Our walks"\nfolds = 2')
    assert own(path, out=one, more=["--models", "linear"]) == 0
    assert own(path, out=two, more=["--models", "knn"]) == 0
    path.unlink()
    forget_tasks()
    assert cli("merge", one, two, "--out", tmp_path / "both") == 0
    for command in (
        ("report", "--out", tmp_path / "both"),
        ("status", tmp_path / "both"),
        ("export", tmp_path / "both"),
        ("compare", tmp_path / "both", "--models", "linear,knn"),
        ("check", tmp_path / "both", "--reference", tmp_path / "both"),
    ):
        forget_tasks()
        assert cli(*command) == 0, cli.printed
    page = (tmp_path / "both" / "report.html").read_text()
    assert "Our walks" in page
    assert "Longest gaps" in page


def forget_tasks():
    TASKS._added.pop("mine", None)


def test_a_report_needs_neither_the_recordings_nor_that_they_stayed_the_same(
    cli, own, task_file, recordings, tmp_path
):
    copy, out = tmp_path / "copy", tmp_path / "run"
    shutil.copytree(recordings, copy)
    assert own(task_file("fraction = 0.2"), folder=copy) == 0
    assert "Longest gaps" in (out / "report.html").read_text()
    shutil.copy(copy / "walk 02.csv", copy / "walk 01.csv")
    assert cli("report", "--out", out) == 0
    assert "Longest gaps" not in (out / "report.html").read_text()
    shutil.rmtree(copy)
    assert cli("report", "--out", out) == 0
    assert "Our walks" in (out / "report.html").read_text()


def test_a_damaged_task_in_a_plan_is_said_to_be_that(cli, own, task_file, tmp_path):
    assert own(task_file("fraction = 0.2"), more=["--models", "linear"]) == 0
    plan = tmp_path / "run" / "plan.json"
    document = json.loads(plan.read_text())
    plan.write_text(json.dumps({**document, "task_files": [{"file": "my.toml"}]}))
    assert cli("report", "--out", tmp_path / "run") == 2
    assert "at task_files[0], expected the entry text, got none" in cli.printed
    assert "run `mocapbench run` again" in cli.printed


def test_other_formats_run_and_skeletons_give_centimetres(own, records, tmp_path):
    """Markers of a TRC file, and Acclaim motions with the skeletons beside them."""
    for name in ("trc", "amc"):
        (tmp_path / name).mkdir()
    write_trc(tmp_path / "trc" / "walk.trc", markers())
    walk = GAIT.recording("01_05").frames(np.arange(60))
    for name in ("one", "two"):
        write_acclaim(tmp_path / "amc" / f"{name}.amc", walk)
    for suffix, training in (("trc", "none"), ("amc", "others")):
        path = tmp_path / f"{suffix}-gaps.toml"
        path.write_text(
            f'files = "*.{suffix}"\ntraining = "{training}"\nmodels = ["linear"]\n'
            '[hide]\nruns = { seconds = 0.05, together = "joint" }\n'
        )
        assert own(path, folder=tmp_path / suffix, out=tmp_path / f"{suffix}-run") == 0
    (of_markers,) = records(tmp_path / "trc-run").values()
    assert "mpjpe" not in of_markers["scores"]
    of_angles = records(tmp_path / "amc-run").values()
    assert len(of_angles) == 2
    assert all(record["scores"]["mpjpe"] >= 0 for record in of_angles)


def test_without_models_every_one_that_can_takes_part(own, cli, tmp_path, recordings):
    path = tmp_path / "mine.toml"
    path.write_text('files = "*.csv"\n[hide]\nframes = "30:36"\n')
    assert own(path, more=["--dry-run"]) == 0
    for name in ("gpdm", "nn", "hold", "mohgp"):
        assert name in cli.printed
    for name in ("oracle", "k-means", "replay"):
        assert f"{name}," not in cli.printed


def test_a_wrong_request_ends_with_its_reason(cli, own, task_file, recordings, tmp_path):
    wrong = {
        "line 6, key hide.fractio: expected one of": task_file("fractio = 0.2"),
        "expected a TOML file": tmp_path / "none.toml",
    }
    for reason, path in wrong.items():
        assert own(path) == 2
        assert reason in cli.printed
    assert cli("run", "--recordings", recordings) == 2
    assert "`mocapbench init my.toml --recordings" in cli.printed
    assert own(task_file("fraction = 0.2"), more=["--cases", "walk 9"]) == 2
    assert own(task_file('frames = "1:9"'), more=["--folds", "2"]) == 2
    assert not (tmp_path / "run").exists()


def test_the_first_task_file_names_the_models_of_a_plug_in(cli, recordings, tmp_path):
    plugin, path = tmp_path / "mine.py", tmp_path / "mine.toml"
    plugin.write_text(
        "from mocapbench.baselines import LinearImputer\n"
        "MODELS = {'straight-lines': type('Mine', (LinearImputer,), {'__doc__': 'Lines.'})}\n"
    )
    assert cli("init", path, "--recordings", recordings, "--plugin", plugin) == 0
    models = tomllib.loads(path.read_text())["models"]
    assert {"linear", "straight-lines"} <= set(models)
    assert "best-of" not in models


def test_the_first_task_file_runs_as_it_stands(cli, own, records, recordings, tmp_path):
    path = tmp_path / "first.toml"
    (recordings / "other.csv").write_text("time,x\n0,1\n1,2\n")
    try:
        assert cli("init", path, "--recordings", recordings) == 0
    finally:
        (recordings / "other.csv").unlink()
    assert "left out: other.csv: expected the 5 channels of" in cli.printed
    assert f"next: edit it, then `mocapbench run --recordings {recordings}" in cli.printed
    assert own(path, more=["--models", "linear", "--folds", "1"]) == 0
    found = records(tmp_path / "run")
    assert {case.split(" 0")[0] for _, case, *_ in found} == {"gaps/cameras", "walk"}
    text = path.read_text()
    assert cli("init", path, "--recordings", recordings) == 2
    assert "which exists; choose another name" in cli.printed
    assert path.read_text() == text


def test_the_first_task_file_takes_channels_in_any_order(cli, own, tmp_path):
    folder, path = tmp_path / "folder", tmp_path / "first.toml"
    for name, channels in (("a", ("hip.x", "hip.y")), ("b", ("hip.y", "hip.x"))):
        write_waves(folder / f"{name}.csv", channels=channels)
    assert cli("init", path, "--recordings", folder) == 0
    assert "a task on 2 recordings of" in cli.printed
    assert "left out" not in cli.printed
    assert tomllib.loads(path.read_text())["files"] == ["*.csv"]
    assert own(path, folder=folder, more=["--models", "linear", "--folds", "1"]) == 0


@pytest.mark.parametrize("odd", [{"channels": ("hip.x",)}, {"rate": 100.0}], ids=str)
def test_the_first_task_file_takes_the_most_files_that_are_alike(cli, tmp_path, odd):
    folder, path = tmp_path / "folder", tmp_path / "first.toml"
    write_waves(folder / "a.csv", **odd)
    for name in ("b", "c"):
        write_waves(folder / f"{name}.csv")
    assert cli("init", path, "--recordings", folder) == 0
    assert cli.printed.count("left out: ") == cli.printed.count("left out: a.csv: expected ") == 1
    assert "a task on 2 recordings of" in cli.printed
    assert tomllib.loads(path.read_text())["files"] == ["b.csv", "c.csv"]


def test_the_first_task_file_leaves_out_a_single_frame(cli, tmp_path):
    folder, path = tmp_path / "folder", tmp_path / "first.toml"
    write_waves(folder / "b.csv")
    head, frame, *_ = (folder / "b.csv").read_text().splitlines()
    (folder / "a.csv").write_text(f"{head}\n{frame}\n")
    assert cli("init", path, "--recordings", folder, "--rate", 30) == 0
    assert "left out: a.csv: expected two or more frames, got 1" in cli.printed
    assert "a task on 1 recording of" in cli.printed


def test_of_groups_of_one_size_the_first_task_file_takes_the_first(cli, tmp_path):
    folder, path = tmp_path / "folder", tmp_path / "first.toml"
    write_waves(folder / "a.csv")
    write_waves(folder / "b.csv", channels=("hip.x",))
    assert cli("init", path, "--recordings", folder) == 0
    assert "left out: b.csv: expected " in cli.printed
    assert "a task on 1 recording of" in cli.printed
    assert tomllib.loads(path.read_text())["files"] == ["a.csv"]


def test_tables_of_filled_entries_are_no_recordings(cli, own, task_file, tmp_path):
    folder = walks(tmp_path / "folder")
    (folder / "walk 01.csv.entries.csv").write_text("frame,time,channel,unit,mean,sd\n")
    (folder / "walk 01.csv.gaps.csv").write_text("marker,unit,first,last\n")
    assert cli("init", tmp_path / "first.toml", "--recordings", folder) == 0
    said = cli.printed + (tmp_path / "first.toml").read_text()
    assert "entries.csv" not in said
    assert "csv.gaps.csv" not in said
    assert own(task_file(WAYS["whole-frames"], models='["linear"]'), folder=folder) == 0


def test_a_first_task_file_of_nothing_is_refused(cli, tmp_path):
    (tmp_path / "empty").mkdir()
    (tmp_path / "timeless").mkdir()
    (tmp_path / "timeless" / "a.csv").write_text("hip\n" + "1\n2\n3\n" * 20)
    assert cli("init", tmp_path / "a.toml", "--recordings", tmp_path / "empty") == 2
    assert "got none: it has none of a known suffix; `mocapbench list formats`" in cli.printed
    assert cli("init", tmp_path / "a.toml", "--recordings", tmp_path / "timeless") == 2
    assert "expected a column 'time' in seconds, or a rate" in cli.printed
    assert cli("init", tmp_path / "a.txt", "--recordings", tmp_path / "timeless") == 2
    assert "expected the name of a new .toml file" in cli.printed
    arguments = (tmp_path / "a.toml", "--recordings", tmp_path / "timeless", "--rate", "50")
    assert cli("init", *arguments) == 0
    assert "rate = 50.0" in (tmp_path / "a.toml").read_text()
