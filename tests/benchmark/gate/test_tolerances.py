import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.rule import Tolerance
from mocapbench.benchmark.gate.tolerances import read_tolerances


@pytest.fixture
def written(tmp_path):
    def write(text):
        (tmp_path / "t.toml").write_text(text)
        return tmp_path / "t.toml"

    return write


def test_defaults_are_tight_in_one_environment_and_two_percent_across():
    same, cross = (read_tolerances(each, None)["mse"] for each in Environment)
    assert same == Tolerance(k=3.0, relative=1e-9, absolute=0.0)
    assert cross == Tolerance(k=3.0, relative=0.02, absolute=0.0)


def test_a_metrics_own_table_goes_over_the_environments(written):
    path = written("[cross]\nk = 2\n[cross.metrics.msll]\nabsolute = 0.01\n")
    cross, same = (read_tolerances(each, path) for each in ("cross", "same"))
    assert cross["mse"] == Tolerance(2, 0.02, 0.0)
    assert cross["msll"] == Tolerance(2, 0.02, 0.01)
    assert same["msll"] == Tolerance()


def test_a_tolerance_may_be_zero(written):
    path = written("[same]\nk = 0\nrelative = 0\nabsolute = 0.0\n")
    assert read_tolerances(Environment.SAME, path)["mse"] == Tolerance(0, 0, 0)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("[crosss]", "unknown entry of --tolerances 'crosss': did you mean cross"),
        ("[cross]\nrelativ = 1", "did you mean relative"),
        ("[cross]\nk = -1", "at cross.k, expected a number >= 0.0"),
        ("[cross]\nk = nan", "at cross.k, expected a number >= 0.0"),
        ("[cross]\nk = true", "at cross.k, expected a number, got true or false"),
        ("[same]\nk = 'three'", "at same.k, expected a number, got text"),
        ("cross = 3", "at cross, expected a table, got a whole number"),
        ("[cross.metrics.msl]\nk = 1", "did you mean msll"),
        (
            "[cross.metrics]\nmsll = 1",
            "at cross.metrics.msll, expected a table, got a whole number",
        ),
        ("[cross]\nk = 1e400", "at cross.k, expected a number <= 1e\\+300"),
        ("[cross", "t.toml: expected tolerances; expected ']' at the end"),
        ("a = " + "[" * 10_000, "too many lists in one another"),
        ("a = " + "9" * 10_000, "a number of too many digits"),
    ],
)
def test_a_file_that_is_no_good_says_why(written, text, complaint):
    with pytest.raises(UsageError, match=complaint):
        read_tolerances(Environment.SAME, written(text))


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(UsageError, match="cannot be read"):
        read_tolerances(Environment.SAME, tmp_path / "absent.toml")
