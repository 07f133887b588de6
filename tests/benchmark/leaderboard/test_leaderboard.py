"""A leaderboard: archives of others are data, and scores count only if their problems are one."""

import json
import shutil
from dataclasses import replace
from zipfile import ZIP_BZIP2, ZIP_LZMA, ZIP_STORED, ZipFile

import pytest

from mocapbench import benchmark as bench
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.leaderboard import submission
from mocapbench.benchmark.leaderboard.submission import (
    read_models,
    read_submission,
    write_submission,
)
from mocapbench.benchmark.registry import TASKS

TASK, CASES = "toy-interpolation-1", ("test 1", "test 2")
ROWS = [(TASK, case, label, fold) for case in CASES for label in ("x", "y") for fold in (0, 1)]
VERSIONS = {"a": {"version of numpy": "2.0"}, "b": {"version of numpy": "2.1"}}


@pytest.fixture
def send(write_run, tmp_path):
    """Return a function that writes a run and its archive, and returns the archive."""

    def send(name, rows=ROWS, by="", models=None, **run):
        folder = write_run(tmp_path / name, rows, **run)
        path = tmp_path / f"{name}.zip"
        write_submission(bench.RunDirectory(folder), path, by or f"Lab {name}", None, models or {})
        return path

    return send


@pytest.fixture
def unite(tmp_path):
    """Return a function from archives to what they say, and their records by archive."""

    def unite(*paths):
        folder = tmp_path / "unpacked"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        submissions = {path.name: read_submission(path, folder / path.stem) for path in paths}
        return submissions, bench.unite_submissions(submissions)

    return unite


def _change(path, change):
    """Write an archive again, its contents changed: a function of a mapping from name to bytes."""
    with ZipFile(path) as archive:
        contents = {name: archive.read(name) for name in archive.namelist()}
    change(contents)
    with ZipFile(path, "w", ZIP_STORED) as archive:
        for name, content in contents.items():
            archive.writestr(name, content)
    return path


def _labels(united):
    return [sorted({r.address.label for r in records}) for records in united.values()]


def test_the_same_run_gives_the_same_bytes_and_comes_back_whole(send, unite, tmp_path):
    path = send("a")
    store, again = bench.RunDirectory(tmp_path / "a"), tmp_path / "again.zip"
    write_submission(store, again, "Lab a", None, {})
    assert path.read_bytes() == again.read_bytes()
    submissions, united = unite(path)
    assert submissions["a.zip"][0]["by"] == "Lab a"
    assert [r.to_json() for r in united["a.zip"]] == [r.to_json() for r in store.planned()]


def test_neither_predictions_nor_recordings_are_in_it(send):
    with ZipFile(send("a")) as archive:
        kinds = {name.partition("/")[0] for name in archive.namelist()}
    assert kinds == {"about.json", "plan.json", "records"}


def test_what_two_have_alike_counts_once_for_the_first(send, unite):
    _, united = unite(send("a"), send("b"))
    assert _labels(united) == [["x", "y"], []]


def test_other_results_of_one_row_are_named_after_their_sender(send, unite):
    archives = [send(name, parts=parts) for name, parts in VERSIONS.items()]
    _, united = unite(*archives)
    assert _labels(united) == [["x", "y"], ["x (Lab b)", "y (Lab b)"]]
    addresses = [r.address for records in united.values() for r in records]
    assert len({*addresses}) == len(addresses) == 2 * len(ROWS)


def test_one_sender_has_one_result_of_a_row(send, unite):
    archives = [send(name, parts=parts, by="us") for name, parts in VERSIONS.items()]
    with pytest.raises(UsageError, match=r"c\.zip: expected one result of x .* another --by"):
        unite(*archives, send("c", parts={"version of numpy": "2.2"}, by="us"))


def test_different_scores_of_one_job_are_refused(send, unite):
    with pytest.raises(UsageError, match=r"expected one score .* 6\.0 in a\.zip, 7\.0 in b\.zip"):
        unite(send("a"), send("b", scores={ROWS[0]: 7.0}))


def _in_records(document):
    def change(contents):
        for name in contents:
            if name.startswith("records/"):
                contents[name] = json.dumps({**json.loads(contents[name]), **document}).encode()

    return change


def test_other_recordings_of_one_name_are_refused(send, unite):
    archives = [
        _change(
            send(name, parts=parts),
            _in_records({"provenance": {"digest of cmu:35_01": f"of {name}"}}),
        )
        for name, parts in VERSIONS.items()
    ]
    with pytest.raises(UsageError, match=r"two of cmu:35_01: of a in a\.zip, of b in b\.zip"):
        unite(*archives)


def test_a_task_that_is_not_here_or_of_another_version_is_refused(send, unite, monkeypatch):
    with pytest.raises(UsageError, match=r"c\.zip: unknown case of toy-interpolation-1 'c'"):
        unite(send("c", [(TASK, "c", "x", 0)]))
    monkeypatch.setattr(submission, "_require_shared_tasks", lambda plan, records: None)
    with pytest.raises(UsageError, match=r"b\.zip: unknown task 't'.*this version"):
        unite(send("b", [("t", "c", "x", 0)]))
    path = send("a")
    monkeypatch.setitem(TASKS._added, TASK, replace(TASKS.get(TASK), version=2))
    with pytest.raises(UsageError, match="expected version 2 of"):
        unite(path)


def test_scores_of_metrics_that_are_not_here_are_left_out(send, unite):
    path = _change(send("a"), _in_records({"scores": {"mse": 1.0, "theirs": 2.0}}))
    assert all(r.scores == {"mse": 1.0} for r in unite(path)[1]["a.zip"])


def test_entrants_have_what_their_senders_say_of_them(send, unite, tmp_path):
    file = tmp_path / "models.toml"
    file.write_text('[y]\npaper = "Ours"\ncode = "https://example.org/y"\nlicence = "MIT"\n')
    failed = {ROWS[0]: bench.Status.FAILED}
    path = send("a", models=read_models(file), statuses=failed)
    x, y = bench.describe_entrants(*unite(path))
    assert (x["label"], x["jobs"], x["lacking"], x["paper"]) == ("x", 3, 1, "")
    assert (y["label"], y["jobs"], y["lacking"], y["by"]) == ("y", 4, 0, "Lab a")
    assert (y["paper"], y["code"], y["licence"]) == ("Ours", "https://example.org/y", "MIT")


def test_entrants_say_by_which_profile_they_ran_and_what_it_sets(send, unite):
    path = _change(send("a"), _in_records({"parameters": {"max_iter": 2, "kernel": "rbf"}}))
    x, y = bench.describe_entrants(*unite(path))
    assert x["profile"] == y["profile"] == "smoke, max_iter=2"


@pytest.mark.parametrize(
    "text",
    [
        '[y]\ncode = "javascript:alert(1)"',
        '[y]\ncod = "x"',
        "[y]\ncode = 3",
        "y = 1",
        "y",
        "\0",
        None,
    ],
)
def test_a_file_that_says_anything_else_of_models_is_refused(tmp_path, text):
    file = tmp_path / "models.toml"
    if text is not None:
        file.write_text(text)
    with pytest.raises(UsageError, match=r"models\.toml: expected a table"):
        read_models(file)


def test_other_seeds_are_refused(send, unite):
    other = _change(send("b", parts=VERSIONS["b"]), _in_records({"seed": 1}))
    with pytest.raises(UsageError, match=r"two of the seed: 0 in a\.zip, 1 in b\.zip"):
        unite(send("a"), other)


def test_other_problems_are_refused(send, unite):
    archives = [
        _change(send(name, parts=parts), _in_records({"problem": f"2:of {name}"}))
        for name, parts in VERSIONS.items()
    ]
    with pytest.raises(UsageError, match=r"b\.zip: expected the problem of"):
        unite(*archives)


def test_other_folds_of_one_name_are_another_entrant(send, unite):
    folds = [[row for row in ROWS if row[3] == fold] for fold in (0, 1)]
    _, united = unite(send("a", folds[0]), send("b", folds[1]))
    assert _labels(united) == [["x", "y"], ["x (Lab b)", "y (Lab b)"]]


@pytest.mark.parametrize("names", ["ab", "ba"])
def test_of_a_job_that_went_well_once_the_good_record_counts(send, unite, names):
    failed = {"a": {ROWS[0]: bench.Status.FAILED}, "b": {}}
    _, united = unite(*(send(name, statuses=failed[name]) for name in names))
    assert all(record.scores for records in united.values() for record in records)
    assert sum(map(len, united.values())) == len(ROWS)


@pytest.mark.parametrize(
    ("document", "said"),
    [
        ({"scores": {"mse": -1.0}}, "expected mse of"),
        ({"scores": {"coverage_95": 7.0}}, "from -1e-09 to 1, got 7"),
        ({"scores": {"mse": 1e308}}, "got 1e"),
        ({"status": "failed"}, "expected no score of"),
    ],
)
def test_scores_that_cannot_be_are_refused(send, unite, document, said):
    with pytest.raises(UsageError, match=said):
        unite(_change(send("a"), _in_records(document)))


def _rename(old, new):
    def change(contents):
        contents[new] = contents.pop(old)

    return change


def _drop(name):
    return lambda contents: contents.pop(name)


def _set(name, content):
    return lambda contents: contents.update({name: content})


def _first_record(contents):
    return next(name for name in contents if name.startswith("records/"))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (_set("../evil.json", b"{}"), "got '../evil.json'"),
        (_set("/evil.json", b"{}"), "got '/evil.json'"),
        (_set("records/..%2f.json", b"{}"), "got 'records"),
        (_set("predictions/a.npz", b"pickled"), "got 'predictions/a.npz'"),
        (_drop("about.json"), "it has no about.json"),
        (_drop("plan.json"), "it has no plan.json"),
        (_rename("plan.json", "records/" + "a" * 64 + ".json"), "no plan.json"),
        (_set("about.json", b'{"format": 1, "by": ""}'), "by"),
        (_set("about.json", b'{"format": 2, "by": "x"}'), "format"),
        (_set("about.json", b'{"format": 1, "by": "x", "link": "javascript:x"}'), "link"),
        (_set("about.json", b'{"format": 1, "by": "\\u202ex"}'), "plain text"),
        (_set("about.json", b'{"format": 1, "by": "x ", "models": {}}'), "plain text"),
        (_in_records({"fold": None}), "expected the record of"),
        (_set("about.json", b"[" * 10**6), "expected"),
        (_set("plan.json", b"null"), "plan"),
        (lambda contents: contents.update({_first_record(contents): b"{}"}), "record"),
        (lambda c: c.update({"records/" + "b" * 64 + ".json": c[_first_record(c)]}), "holds"),
    ],
)
def test_an_archive_of_anything_else_is_refused(send, unite, tmp_path, change, said):
    path, before = _change(send("a"), change), {*tmp_path.iterdir()}
    with pytest.raises(UsageError, match=f"{path.name}: expected an archive") as refused:
        unite(path)
    assert said in str(refused.value)
    assert {*tmp_path.iterdir()} - before <= {tmp_path / "unpacked"}


@pytest.mark.parametrize("content", [b"", b"PK", b"<html>", None])
def test_what_is_no_archive_is_refused(send, unite, content):
    path = send("a")
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2] if content is None else content)
    with pytest.raises(UsageError, match=f"{path.name}: expected an archive"):
        unite(path)
    path.unlink()
    with pytest.raises(UsageError, match="got no file"):
        unite(path)


@pytest.mark.parametrize("method", [ZIP_BZIP2, ZIP_LZMA])
def test_another_method_is_refused(send, unite, method):
    path = send("a")
    with ZipFile(path) as archive:
        contents = {name: archive.read(name) for name in archive.namelist()}
    with ZipFile(path, "w", method) as archive:
        for name, content in contents.items():
            archive.writestr(name, content)
    with pytest.raises(UsageError, match="another method"):
        unite(path)


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_file_twice_is_refused(send, unite):
    path = send("a")
    with ZipFile(path, "a") as archive:
        archive.writestr("about.json", archive.read("about.json"))
    with pytest.raises(UsageError, match=r"two files called about\.json"):
        unite(path)


@pytest.mark.parametrize("name", ["_MOST_FILES", "_MOST_BYTES", "_LARGEST"])
def test_an_archive_that_unpacks_to_too_much_is_refused_before_it_is(
    send, unite, monkeypatch, name
):
    monkeypatch.setattr(submission, name, 5)
    with pytest.raises(UsageError, match="expected at most"):
        unite(send("a"))


def test_commands_write_an_archive_and_a_site(cli, write_run, tmp_path):
    out, hostile = tmp_path / "site", "<script>alert(1)</script>"
    for name, parts in VERSIONS.items():
        run = write_run(tmp_path / name, ROWS, parts=parts)
        to = ("--by", hostile, "--to", tmp_path / f"{name}.zip")
        assert cli("submit", run, *to) == 0
        assert cli("submit", run, *to) == 2  # it is there
    assert cli("leaderboard", tmp_path / "a.zip", "--out", out) == 0
    page = (out / "index.html").read_text()
    assert {path.name for path in out.iterdir()} == {"index.html", "report.html", "scores.csv"}
    assert "<script" not in page
    assert "&lt;script&gt;" in page
    assert "default-src 'none'" in page
    assert cli("leaderboard", tmp_path / "a.zip", tmp_path / "b.zip", "--out", out) == 0
    assert "x (" in (out / "index.html").read_text()


def test_nothing_is_written_of_archives_that_contradict_each_other(cli, send, tmp_path):
    one, other = send("a"), send("b", scores={ROWS[0]: 7.0})
    assert cli("leaderboard", one, other, "--out", tmp_path / "site") == 2
    assert "expected one score" in cli.printed
    assert not (tmp_path / "site").exists()


@pytest.fixture
def names(write_run, tmp_path, monkeypatch):
    """What arguments may name, of the current folder."""
    monkeypatch.chdir(tmp_path)
    return {"run": write_run(tmp_path / "a", ROWS), "nothing": tmp_path / "nothing"}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("submit", "{run}"), "expected who ran it"),
        (("submit", "{run}", "--by", "  "), "expected who ran it"),
        (("submit", "{run}", "--by", "us", "--link", "example.org"), "as link an address"),
        (("submit", "{run}", "--by", "x" * 101), "at most 100"),
        (("submit", "{nothing}", "--by", "us"), "is not a mocapbench run"),
        (("leaderboard", "{nothing}"), "got no file"),
        (("leaderboard", "{run}"), "got no file"),
        (("leaderboard", "{nothing}", "{nothing}"), "each archive once"),
        (("leaderboard", "{nothing}", "--out", "{run}"), "or a site"),
        (("leaderboard", "{nothing}", "--out", "{run}/plan.json"), "got the file"),
    ],
)
def test_wrong_arguments_are_refused(cli, names, tmp_path, arguments, said):
    assert cli(*(word.format(**names) for word in arguments)) == 2
    assert said in cli.printed
    assert {*tmp_path.iterdir()} == {tmp_path / "a"}


def test_a_label_that_the_run_lacks_is_refused(cli, names, tmp_path):
    (tmp_path / "models.toml").write_text('[z]\npaper = "Ours"\n')
    assert cli("submit", names["run"], "--by", "us", "--models", tmp_path / "models.toml") == 2
    assert "unknown model 'z'" in cli.printed


def test_jobs_without_a_record_are_told(cli, write_run, tmp_path):
    run = write_run(tmp_path / "a", ROWS, left=ROWS[:3])
    assert cli("submit", run, "--by", "us", "--to", tmp_path / "a.zip") == 0
    assert "without a record: 3 jobs; `mocapbench run` computes them" in cli.printed


def test_tasks_that_nobody_else_has_cannot_be_sent(cli, write_run, tmp_path):
    run = write_run(tmp_path / "a", [("t", "c", "x", 0)])
    assert cli("submit", run, "--by", "us", "--to", tmp_path / "a.zip") == 2
    assert "expected tasks that mocapbench brings along, got t" in cli.printed


def test_a_run_on_recordings_of_ones_own_cannot_be_sent(cli, write_run, tmp_path):
    run = write_run(tmp_path / "a", ROWS)
    store = bench.RunDirectory(run)
    file = {"name": "a.toml", "text": "", "folder": "/data", "files": ["a.csv"], "plugins": []}
    plan = {**store.load_plan(), "task_files": [file]}
    (run / "plan.json").write_text(json.dumps(plan))
    assert cli("submit", run, "--by", "us", "--to", tmp_path / "a.zip") == 2
    assert not (tmp_path / "a.zip").exists()
