"""A command is a model like any other: what goes in and out of it is checked."""

import pickle
import re
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines import Imputer, Prediction
from mocapbench.benchmark.programs.running import ProgramError
from mocapbench.benchmark.testing import check_model
from mocapbench.benchmark.testing.subject import COMPLETE, GAP, SCATTERED, problem

GIVEN = problem(GAP)
NEW = 'provides = ["fills entries", "fills new recordings"]'
FILL = """\
for path in "$2"/given/*; do
    out="$2/filled/$(basename "$path")"
    mkdir "$out"
    {} "$path/values.csv" > "$out/mean.csv"
done
echo at the end >&2
"""
REVERSE = """awk '{gsub("NaN", 1); lines[NR] = $0} END {for (n = NR; n; n--) print lines[n]}'"""
COUNTS = """\
echo "$1 $(ls "$2/train" 2>/dev/null | wc -l)" >> calls
[ "$1" = fill ] || { echo 2.5 > "$2/model/a"; mkdir "$2/model/b"; echo x > "$2/model/b/c"; exit; }
cat "$2/model/b/c" >> calls
for path in "$2"/given/*; do
    out="$2/filled/$(basename "$path")"
    mkdir "$out"
    sed "s/NaN/$(cat "$2/model/a")/g" "$path/values.csv" > "$out/mean.csv"
done
"""
LEARNS = f"{NEW}\nlearns_in_fit = true"


def fill(model, recordings=GIVEN):
    return model.fit(recordings).impute([recordings[-1]])


def test_it_keeps_what_its_abilities_promise(build):
    check_model(type(build(lines=NEW)))


def test_the_mean_stands_where_entries_are_hidden(build):
    (prediction,) = fill(build())
    np.testing.assert_array_equal(prediction.mean, np.where(GAP, 1.0, COMPLETE[-1].values))
    assert prediction.variance is None


def test_visible_values_of_the_recording_stay_to_the_last_digit(build):
    rounded = FILL.format(r"sed -E 's/NaN/1/g; s/(\.[0-9]{6})[0-9]*/\1/g'")
    (prediction,) = fill(build(rounded))
    np.testing.assert_array_equal(prediction.mean[~GAP], COMPLETE[-1].values[~GAP])


FAULTS = {
    "no file": ("echo at the end >&2", "expected the program to write filled/0001, got no such"),
    "other rows": (FILL.format("head -n 3"), "expected mean of shape (20, 2) (frames, channels), "),
    "a header": (FILL.format("sed '1i 0,1'"), "expected mean of shape (20, 2) (frames, channels)"),
    "no numbers": (FILL.format("sed s/NaN/none/"), "expected named arrays of numbers, got: Value"),
    "no mean": (FILL.replace("mean", "Mean").format("cat"), "called mean or samples, got Mean"),
    "empty": (FILL.format("true"), "expected named arrays of numbers, got: EmptyDataError"),
    "NaN": (FILL.format("cat"), "expected a number at all 8 entries, got others at 8, first nan"),
    "infinity": (FILL.format("sed s/NaN/inf/"), "expected a number at all 8 entries, got others"),
    "other values": (FILL.format("sed 's/NaN/0/g; s/^0/9/'"), "visible values as they were given"),
    "another order": (FILL.format(REVERSE), "visible values as they were given"),
    "no std": (
        FILL.format("sed s/NaN/1/g").replace(
            "done", '    cp "$path/values.csv" "$out/std.csv"\ndone'
        ),
        "expected a std above 0 at all 8 entries, got others at 8, first nan",
    ),
    "an exit": ("echo at the end >&2; exit 1", "to end with exit code 0, got 1"),
}


@pytest.mark.parametrize(("script", "message"), FAULTS.values(), ids=FAULTS)
def test_a_wrong_prediction_is_told_with_what_the_program_said(build, script, message):
    with pytest.raises(ProgramError, match=re.escape(message)) as raised:
        fill(build(script))
    assert str(raised.value).endswith("; it said: at the end")


def test_a_std_becomes_the_variance(build):
    script = FILL.format("sed s/NaN/1/g")
    both = script.replace("done", '    sed s/.*/3,4/ "$path/times.csv" > "$out/std.csv"\ndone')
    (prediction,) = fill(build(both))
    np.testing.assert_array_equal(prediction.variance, np.where(GAP, [9.0, 16.0], 0.0))


def test_samples_become_mean_and_variance(build, monkeypatch):
    model = build()
    samples = np.stack([np.where(GAP, k, COMPLETE[-1].values) for k in (1.0, 2.0, 6.0)])
    monkeypatch.setattr(type(model), "_read", lambda *_: {"samples": samples})
    (prediction,) = fill(model)
    np.testing.assert_allclose(prediction.mean[GAP], 3.0)
    np.testing.assert_allclose(prediction.variance[GAP], 7.0)
    monkeypatch.setattr(type(model), "_read", lambda *_: {"samples": samples.swapaxes(0, 1)})
    with pytest.raises(ProgramError, match=r"samples of shape \(20, 20, 2\) \(draws, frames, ch"):
        fill(model)


def test_it_learns_once_and_fills_often_from_what_it_left(build, tmp_path):
    model = build(COUNTS, LEARNS).fit(COMPLETE[:-1])
    loaded = pickle.loads(pickle.dumps(model))
    for each in (model, loaded):
        (prediction,) = each.impute([GIVEN[-1]])
        assert set(prediction.mean[GAP]) == {2.5}
    assert (tmp_path / "calls").read_text().split() == ["fit", "3", *("fill", "0", "x") * 2]


def test_one_that_does_not_learn_is_run_once_with_the_training_recordings(build, tmp_path):
    script = COUNTS.replace("$(cat", "1$(cat").replace('cat "$2/model/b/c"', "echo y")
    fill(build(script.replace('"$2/model/a"', "/dev/null")))
    assert (tmp_path / "calls").read_text().split() == ["fill", "4", "y"]


def test_the_order_of_training_recordings_means_nothing(build, tmp_path):
    model, told = build('cat "$2"/train/*/name.csv > names; exit 1'), []
    for recordings in (GIVEN, GIVEN[::-1]):
        with pytest.raises(ProgramError):
            model.fit(recordings).impute([GIVEN[-1]])
        told.append((tmp_path / "names").read_text())
    assert told[0] == told[1]
    assert sorted(told[0].split()) == [each.name for each in GIVEN]


def test_it_is_told_names_units_times_and_the_seed(build, tmp_path):
    script = 'cp -r "$2/given/0001" told; echo $MOCAPBENCH_SEED > seed; exit 1'
    with pytest.raises(ProgramError):
        fill(build(script).set_params(random_state=42))
    first, told = GIVEN[-1], tmp_path / "told"
    assert (told / "channels.csv").read_text().split() == [*first.channels]
    assert (told / "units.csv").read_text().replace('"', "").split("\n") == [*first.units, ""]
    np.testing.assert_array_equal(np.loadtxt(told / "times.csv"), first.times)
    assert (tmp_path / "seed").read_text() == "42\n"


def test_many_recordings_come_back_in_their_order(build):
    names = [f"r{number}" for number in range(12)]
    shifted = [
        replace(COMPLETE[0], name=name, values=COMPLETE[0].values + number).hide(SCATTERED)
        for number, name in enumerate(names)
    ]
    predictions = build().fit(shifted).impute(shifted)
    for recording, prediction in zip(shifted, predictions, strict=True):
        seen = recording.visible
        np.testing.assert_array_equal(prediction.mean[seen], recording.values[seen])


def test_nothing_to_fill_starts_no_program(build):
    assert build("exit 1").fit(GIVEN).impute([]) == []


def test_nothing_is_left_behind(build, tmp_path, monkeypatch):
    (tmp_path / "tmp").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "tmp"))
    fill(build())
    with pytest.raises(ProgramError):
        fill(build("exit 1"))
    assert not [*(tmp_path / "tmp").iterdir()]


class Ones(Imputer):
    """The same model in Python."""

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return [Prediction.around(each, np.ones(each.values.shape)) for each in recordings]


def test_it_is_the_model_in_python(build):
    recordings = problem(SCATTERED)
    for one, other in zip(
        build(lines=NEW).fit(COMPLETE).impute(recordings), Ones().impute(recordings), strict=True
    ):
        np.testing.assert_array_equal(one.mean, other.mean)
