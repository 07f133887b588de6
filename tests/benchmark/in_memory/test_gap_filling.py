"""Filling in memory gives what the command writes, to the bit, and says what cannot be done."""

import re
import subprocess
import sys
import time

import numpy as np
import pandas as pd
import pytest
from scipy.interpolate import interp1d
from sklearn.impute import KNNImputer, SimpleImputer

import mocapbench
from mocapbench.baselines import KNN, Imputer, LinearImputer, Prediction


class Constant(Imputer):
    """A model of a user's own."""

    def __init__(self, value=0.0):
        self.value = value

    def fit(self, recordings):
        self.fitted_ = len(recordings)
        return self

    def impute(self, recordings):
        return [Prediction.around(one, self.value, 4.0) for one in recordings]


class Broken(Constant):
    def fit(self, recordings):
        raise KeyError("no such thing")


@pytest.fixture
def file(gappy, tmp_path):
    """Return the recording with gaps as a file."""
    path = tmp_path / "walk.csv"
    labels = [f"{channel} [mm]" for channel in gappy.channels]
    table = pd.DataFrame(gappy.values, columns=labels)
    table.insert(0, "time", gappy.times)
    table.to_csv(path, index=False)
    return path


def fill_by_command(file, *options):
    command = [sys.executable, "-m", "mocapbench.benchmark.cli.main", "fill", str(file), *options]
    done = subprocess.run(
        [*command, "--out", str(file.parent / "out")], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    table = file.parent / "out" / f"{file.name}.entries.csv"
    return pd.read_csv(table, float_precision="round_trip")


@pytest.mark.slow
@pytest.mark.parametrize("model", ["cubic-spline", "marker-kriging", "lds"])
def test_a_named_model_gives_what_the_command_writes_to_the_bit(file, model):
    entries = fill_by_command(file, "--model", model)
    filled = mocapbench.fill(mocapbench.read(file), model)
    np.testing.assert_array_equal(filled.recording.values[filled.mask], entries["mean"])
    np.testing.assert_array_equal(filled.std[filled.mask], entries["sd"])


@pytest.mark.slow
def test_the_choice_is_that_of_the_command_to_the_bit(file):
    entries = fill_by_command(file, "--effort", "low")
    filled = mocapbench.fill(file, effort="low")
    assert filled.result.models.tolist() == entries["model"].tolist()
    np.testing.assert_array_equal(filled.recording.values[filled.mask], entries["mean"])
    assert {*filled.ranking.loc[filled.ranking.chosen, "model"]} == {*entries["model"]}


def test_a_named_model_starts_no_process(gappy, monkeypatch):
    def refuse(*_, **__):
        raise AssertionError("a process was to be started")

    monkeypatch.setattr("mocapbench.benchmark.in_memory.gap_filling.Workers", refuse)
    monkeypatch.setattr("os.fork", refuse)
    monkeypatch.setattr("subprocess.Popen", refuse)
    assert mocapbench.fill(gappy, "linear").recording.visible.all()


def test_it_is_the_model_that_fills(gappy):
    filled = mocapbench.fill(gappy, "linear")
    (prediction,) = LinearImputer().fit([gappy]).impute([gappy])
    np.testing.assert_array_equal(filled.recording.values, prediction.mean)


def test_all_that_can_be_read_is_filled_alike(gappy):
    table = pd.DataFrame(gappy.values, gappy.times, gappy.channels)
    by_table = mocapbench.fill(table, "linear")
    by_array = mocapbench.fill(gappy.values, "linear", rate=60, names=gappy.channels)
    np.testing.assert_array_equal(by_table.recording.values, by_array.recording.values)


def test_a_model_of_ones_own_fills_with_its_parameters(gappy):
    filled = mocapbench.fill(gappy, Constant(7.0))
    assert (filled.recording.values[filled.mask] == 7.0).all()
    assert (filled.std[filled.mask] == 2.0).all()
    assert filled.result.used == ("Constant",)


def test_a_model_of_ones_own_is_registered_while_it_fills_alone(gappy):
    mocapbench.fill(gappy, Constant(7.0))
    with pytest.raises(ValueError, match="unknown model 'Constant'"):
        mocapbench.fill(gappy, "Constant")
    model = Constant(7.0)
    mocapbench.fill(gappy, model)
    assert not hasattr(model, "fitted_")


def test_an_imputer_of_scikit_learn_fills_frames(gappy):
    filled = mocapbench.fill(gappy, KNNImputer(n_neighbors=3))
    expected = KNNImputer(n_neighbors=3).fit_transform(gappy.values)
    np.testing.assert_allclose(filled.recording.values, expected)
    assert np.isnan(filled.std[filled.mask]).all()


def test_what_a_model_of_ones_own_raises_is_shown(gappy):
    with pytest.raises(ValueError, match="Broken did not fill it: KeyError") as caught:
        mocapbench.fill(gappy, Broken())
    assert isinstance(caught.value.__cause__, KeyError)


@pytest.mark.parametrize(
    ("model", "said"),
    [
        (KNN, "got the class KNN; write KNN()"),
        (3, "expected the name of a model"),
        ("liner", "did you mean linear"),
        ("k-means", "expected a model that fills"),
    ],
)
def test_what_is_no_model_is_refused(gappy, model, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        mocapbench.fill(gappy, model)


def test_recordings_to_learn_from_count(walk):
    lost = np.zeros((240, 12), dtype=bool)
    lost[:, :3] = True
    recording = walk().hide(lost)
    with pytest.raises(ValueError, match="name files that have these with train="):
        mocapbench.fill(recording, "linear")
    others = [walk(name="other", seed=1), recording]
    filled = mocapbench.fill(recording, SimpleImputer(), train=others)
    assert filled.recording.visible.all()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"ends": "shut"}, "expected ends= as one of open, fill, got 'shut'"),
        ({"effort": "most"}, "expected effort= as one of low, normal, high, got 'most'"),
        ({"frames": (3, 2)}, "expected frames= within 0:240"),
        ({"max_gap": 0.01}, "raise max_gap="),
        ({"max_gap": "x"}, "expected max_gap= in seconds, above 0, got 'x'"),
        ({"frames": "40:50"}, "expected frames= as (first, stop), such as (120, 180), got '40:50'"),
        ({"frames": [(40, 50)]}, "expected frames= as (first, stop)"),
        ({"frames": (1.5, 20)}, "expected frames= as (first, stop)"),
        ({"channels": 0}, "expected channels= as a name or a list of names, got 0"),
        ({"rate": 3}, "expected options none for what is read here, got rate"),
    ],
)
def test_options_that_cannot_be_met_are_refused_by_their_names_as_arguments(gappy, options, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        mocapbench.fill(gappy, "linear", **options)


def test_without_a_gap_there_is_nothing_to_fill(walk):
    said = r"expected a gap, got all entries visible.* frames=, such as \(120, 180\)"
    with pytest.raises(ValueError, match=said):
        mocapbench.fill(walk(), "linear")


def test_a_single_recording_to_learn_from_need_not_be_in_a_list(gappy, walk):
    one, other = (mocapbench.fill(gappy, "nn", train=t) for t in (walk(1), [walk(1)]))
    np.testing.assert_array_equal(one.recording.values, other.recording.values)


def test_of_nothing_nothing_is_filled(walk):
    nothing = walk().with_values(np.full((240, 12), np.nan))
    with pytest.raises(ValueError, match="expected visible entries to fill the others from"):
        mocapbench.fill(nothing, "linear")


def test_rules_say_which_model_fills_what(gappy):
    filled = mocapbench.fill(gappy, "LKNE=linear,*=makima", channels=["LKNE", "R*"])
    assert filled.gaps["model"].tolist() == ["linear", "makima"]
    only = mocapbench.fill(gappy, "linear", only="RKNE")
    assert only.gaps["marker"].tolist() == ["RKNE"]


SCRIPT = """
import numpy as np
import mocapbench
values = np.sin(np.arange(120.0)[:, None] / 9 + np.arange(3))
values[50:56, 0] = np.nan
print(mocapbench.fill(values, rate=60, effort="low", jobs=1).result.used)
"""


@pytest.mark.slow
@pytest.mark.parametrize("way", ["file", "standard input"])
def test_a_script_need_not_guard_what_it_does(tmp_path, way):
    (tmp_path / "script.py").write_text(SCRIPT)
    words, text = (["script.py"], None) if way == "file" else (["-"], SCRIPT)
    done = subprocess.run(
        [sys.executable, *words],
        input=text,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert len(done.stdout.splitlines()) == 1, done.stdout


def count_seconds(function):
    """Return the least processor time of some calls, which other processes do not lengthen."""
    times = []
    for _ in range(5):
        started = time.process_time()
        function()
        times.append(time.process_time() - started)
    return min(times)


def test_a_named_interpolation_takes_little_more_than_that_of_scipy():
    frames, hidden = np.arange(600.0), np.zeros((600, 120), dtype=bool)
    for marker in range(10):
        hidden[50 * marker + 20 : 50 * marker + 35, 3 * marker : 3 * marker + 3] = True
    values = np.where(hidden, np.nan, np.cumsum(np.sin(frames))[:, None] + np.arange(120))
    recording = mocapbench.read(values, rate=120)

    def interpolate():
        for channel in np.flatnonzero(hidden.any(axis=0)):
            seen = ~hidden[:, channel]
            interp1d(frames[seen], values[seen, channel])(frames[~seen])

    mocapbench.fill(recording, "linear")  # loads what the first call needs
    ours = count_seconds(lambda: mocapbench.fill(recording, "linear"))
    assert ours - count_seconds(interpolate) <= 0.030
