"""Names of files and channels that are nobody's idea of a name, through the command line."""

import tomllib

import pandas as pd
import pytest
from format_files import markers, sample, with_gap, write_c3d, write_trc
from own_files import write_csv
from shared_files import shared

ODD = ["Tête Fuß 膝.c3d", "T\udceate.c3d", "a [1] #\"'\\${b}.c3d", "-x.c3d", "nl\n\x1b[31m.c3d"]


def fill(cli, out, *words):
    return cli("fill", "--model", "linear", "--out", out, "--", *words)


@pytest.mark.parametrize("name", ODD, ids=ascii)
def test_a_file_of_any_name_is_filled(cli, tmp_path, name):
    write_c3d(tmp_path / "plain.c3d", with_gap(markers(60)))
    (tmp_path / "plain.c3d").rename(tmp_path / name)
    assert fill(cli, tmp_path / "out", tmp_path / name) == 0, cli.printed
    names = {name, f"{name}.entries.csv", f"{name}.gaps.csv", f"{name}.html"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == names
    assert "filled</title>" in (tmp_path / "out" / f"{name}.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["acclaim", "bvh", "c3d", "csv", "parquet", "trc"])
def test_every_format_has_files_of_any_name(cli, tmp_path, name):
    made = sample(name, tmp_path)
    for file in {made, made.with_suffix(".asf")} & {*tmp_path.iterdir()}:
        file.rename(file.with_stem("T\udceate"))
    path = made.with_stem("T\udceate")
    words = ("--model", "linear", "--out", tmp_path / "out", "--frames", "20:30", path)
    assert cli("fill", *words) == 0, cli.printed
    assert len(list((tmp_path / "out").iterdir())) == 4


def test_a_name_too_long_to_write_is_refused_before_anything_is_filled(cli, tmp_path):
    write_c3d(tmp_path / "plain.c3d", with_gap(markers(60)))
    for length, code in ((227, 0), (228, 2)):  # the table is called NAME.entries.csv
        path = (tmp_path / "plain.c3d").rename(tmp_path / f"{'x' * (length - 4)}.c3d")
        assert fill(cli, tmp_path / f"out {length}", path) == code
        (tmp_path / "plain.c3d").symlink_to(path)
    assert "names have at most 239 bytes, got 240" in cli.printed
    assert not (tmp_path / "out 228").exists()


def test_channels_are_named_in_the_encoding_of_the_terminal(cli, tmp_path):
    path = tmp_path / "walk.trc"
    write_trc(path, with_gap(markers(60)))
    path.write_bytes(path.read_bytes().replace(b"root", b"Fu\xdf_"))
    words = ("--model", "linear", "--out", tmp_path / "out", "--channels", "Fuß*", path)
    assert cli("fill", *words) == 0, cli.printed
    table = pd.read_csv(tmp_path / "out" / "walk.trc.entries.csv")
    assert {*table["channel"]} == {"Fuß_.x", "Fuß_.y", "Fuß_.z"}
    assert "Fuß_.x" in (tmp_path / "out" / "walk.trc.html").read_text(encoding="utf-8")
    assert b"Fu\xdf_" in (tmp_path / "out" / "walk.trc").read_bytes()


def test_a_run_on_names_of_windows(cli, records, tmp_path):
    folder, task_file = tmp_path / "Fuß [1]", tmp_path / "first.toml"
    for name in ("Tête 1", "Tête #2"):
        path = write_csv(folder / f"{name}.csv", channels=("Fuß.x", "Fuß.y", "Knie.x"))
        path.write_bytes(path.read_text(encoding="utf-8").encode("cp1252"))
    assert cli("init", task_file, "--recordings", folder) == 0, cli.printed
    words = ("--recordings", folder, "--task-file", task_file, "--models", "linear")
    assert cli("run", *words, "--folds", "1", "--out", tmp_path / "run") == 0, cli.printed
    found = records(tmp_path / "run")
    assert {record["status"] for record in found.values()} == {"ok"}
    assert {case.rpartition(" 0")[0] for _, case, *_ in found} == {"Tête 1", "Tête #2"}
    assert cli("export", tmp_path / "run") == 0, cli.printed


def test_the_first_task_file_of_markers_runs(cli, tmp_path):
    """The list of models breaks over lines nowhere in a name."""
    folder = shared("wild", "cases", "00-init-invalid-toml", "recordings")
    assert cli("init", tmp_path / "first.toml", "--recordings", folder) == 0
    assert "pca-regression" in tomllib.loads((tmp_path / "first.toml").read_text())["models"]
    words = ("--recordings", folder, "--task-file", tmp_path / "first.toml")
    assert cli("run", *words, "--dry-run", "--out", tmp_path / "run") == 0, cli.printed


@pytest.mark.parametrize(
    "file",
    [
        *(f"gap_{place}.c3d" for place in ("elsewhere", "in_accented")),
        *(f"gap_{place}_cp1252.csv" for place in ("elsewhere", "in_accented")),
        *("gap_in_accented_latin1.trc", "utf8.csv"),
    ],
)
def test_names_with_accents_in_latin1_files(cli, tmp_path, file):
    path = shared("wild", "cases", "04-latin1-names") / file
    assert fill(cli, tmp_path, path) == 0, cli.printed
    table = pd.read_csv(tmp_path / f"{file}.entries.csv")
    hidden = "LKNE" if "elsewhere" in file else "Fuß_L"
    assert f"{hidden}.x" in {*table["channel"]}
    assert f"{hidden}.x" in (tmp_path / f"{file}.html").read_text(encoding="utf-8")
    name = b"T\xeate" if "elsewhere" in file else b"Fu\xdf_L"
    name = "Fuß_L".encode() if file == "utf8.csv" else name
    assert (tmp_path / file).read_bytes().count(name) == path.read_bytes().count(name) > 0
