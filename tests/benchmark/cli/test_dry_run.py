"""``mocapbench run --dry-run``: what would run, what is missing, how long it takes."""

import pytest

TOY = ("run", "--dry-run", "--tasks", "toy-interpolation-1", "--models", "trivial,knn")
FRAMES = ("run", "--dry-run", "--tasks", "missing-frames", "--models", "trivial", "--folds", 1)


def test_cases_of_the_same_entrants_stand_together(cli, tmp_path):
    assert cli(*TOY, "--out", tmp_path / "run") == 0
    assert "toy-interpolation-1 12 jobs = 3 cases × 2 entrants × 2 folds" in cli.printed
    assert "cases test 1, test 4, test 9 entrants knn, trivial" in cli.printed


def test_it_tells_the_time_and_how_it_knows(cli, tmp_path):
    out = ("--out", tmp_path / "run")
    assert cli(*TOY, *out, "--jobs", 3) == 0
    assert "12 jobs in" in cli.printed
    assert "with 3 jobs at once" in cli.printed
    assert "estimated by the entrant's mean in a run of the developers (12 fits)" in cli.printed
    assert cli(*(word for word in TOY if word != "--dry-run"), *out, "--folds", 1) == 0
    assert cli(*TOY, *out, "--explain") == 0
    assert "6 done already, 6 to fit and score" in cli.printed
    assert "estimated by the entrant's records in the run directory (6 fits)" in cli.printed


@pytest.mark.usefixtures("nothing_here")
def test_it_says_which_recordings_are_missing_and_what_happens_then(cli, tmp_path):
    chosen = (*FRAMES, "--cases", "35_03 three,synthetic 1", "--out", tmp_path / "run")
    lacking = "data missing: 1 of 2 jobs lack 4 recordings;"
    assert cli(*chosen) == 0
    assert f"{lacking} the run downloads them first: 35_03 35_02 12_01 16_15" in cli.printed
    assert cli(*chosen, "--offline") == 0
    assert f"{lacking} `mocapbench data fetch 35_03 35_02 12_01 16_15` gets them" in cli.printed
    assert not (tmp_path / "cache" / "subjects").exists()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("--cases", ""), "'--cases': expected names, got none; leave the option out for all"),
        (("--metrics", ",, "), "'--metrics': expected names, got none"),
        (("--folds", 10**8), "'--folds'"),
        (("--cluster", "local:0"), "--cluster: expected a value such as local:4, got 'local:0'"),
        (("--jobs", 2, "--cluster", "local:2"), "got --jobs and --cluster; leave out all but one"),
    ],
)
def test_what_a_run_would_refuse_a_dry_run_refuses(cli, arguments, complaint):
    assert cli(*TOY, *arguments) == 2
    assert complaint in cli.printed
