"""Networks learn from training recordings alone, of which some are held out, for as long as told.

What needs PyTorch is tested where `mocapbench models install` has put it, as `tox -e networks` has.
"""

import importlib.util
import os
import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest

import mocapbench
from mocapbench.benchmark.programs.declaration import find_requirements, read_declaration
from mocapbench.benchmark.programs.entrants import find_entrants
from mocapbench.benchmark.programs.environments import find_environment, list_variables

FOLDER = Path(mocapbench.__path__[0]) / "entrants" / "networks"
NETWORKS = {name: path for name, path in find_entrants().items() if path.parent.name == "networks"}
CHANNELS = [f"{joint}.{axis}" for joint in ("hip", "knee", "toe") for axis in "xyz"]
N_FRAMES = 40


@pytest.fixture(scope="module")
def recordings():
    """Return the module that all networks read recordings with, which needs no PyTorch."""
    spec = importlib.util.spec_from_file_location("recordings", FOLDER / "recordings.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def write_recordings(folder, n, begin=0):
    """Write recordings whose values say which recording and which frame they are of."""
    folder.mkdir(parents=True)
    for number in range(begin, begin + n):
        frames = 100.0 * number + np.arange(N_FRAMES)[:, None] + np.zeros(len(CHANNELS))
        units = ["cm"] * len(CHANNELS)
        np.savez(folder / f"{number:04d}.npz", values=frames, channels=CHANNELS, units=units)


@pytest.mark.parametrize("n", [2, 5, 11])
def test_what_is_held_out_are_recordings_that_nothing_is_learnt_from(recordings, tmp_path, n):
    write_recordings(tmp_path / "train", n)
    (tmp_path / "model").mkdir()
    kinds = recordings.load_windows(tmp_path, 30, np.random.default_rng(0))[:2]
    with np.load(tmp_path / "model" / "scale.npz") as scale:
        back = [windows * scale["spread"] + scale["centre"] for windows in kinds]
    learnt, held_out = ({*np.unique(windows.round() // 100)} for windows in back)
    assert not learnt & held_out
    assert learnt | held_out == {*range(n)}
    assert len(held_out) == max(1, n // 5)


def test_of_a_single_recording_the_end_is_held_out(recordings):
    (learnt,), (held_out,) = recordings.split_recordings(
        [np.arange(20.0)[:, None]], np.random.default_rng(0)
    )
    np.testing.assert_array_equal(np.concatenate([learnt, held_out]).ravel(), np.arange(20.0))
    assert len(held_out) == 5


def test_which_are_held_out_depends_on_the_seed_alone(recordings):
    given = [np.full((4, 1), float(k)) for k in range(10)]
    splits = [
        recordings.split_recordings(given, np.random.default_rng(seed))[1] for seed in (1, 1, 2)
    ]
    first, again, other = ([part[0, 0] for part in split] for split in splits)
    assert first == again != other


@pytest.mark.parametrize("name", NETWORKS)
def test_a_network_takes_part_with_three_seeds(name):
    assert read_declaration(NETWORKS[name]).get("seeds") == 3


@pytest.fixture
def run_in():
    """Return a function that runs Python where a network has its packages, for so many seconds."""

    def run_in(name, *words, seconds):
        environment = find_environment(find_requirements(NETWORKS[name]))
        if not environment.exists():
            pytest.skip(f"needs `mocapbench models install {name}`")
        variables = {"MOCAPBENCH_SEED": "1", "MOCAPBENCH_SECONDS": seconds}
        known = {name: text for name, text in os.environ.items() if name != "MOCAPBENCH_DEADLINE"}
        ended = subprocess.run(
            [environment / "bin" / "python", *words],
            cwd=FOLDER,
            env={**known, **list_variables(environment), **variables},
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN),  # in the background
            capture_output=True,
            text=True,
            check=False,
        )
        assert ended.returncode == 0, ended.stderr
        return ended

    return run_in


@pytest.mark.slow
@pytest.mark.parametrize("name", NETWORKS)
def test_a_network_fills_with_what_it_learns_in_a_minute(name, run_in, tmp_path):
    write_recordings(tmp_path / "train", 3)
    write_recordings(tmp_path / "given", 1, begin=3)
    for folder in ("model", "filled"):
        (tmp_path / folder).mkdir()
    for step in ("fit", "fill"):
        run_in(
            name, *read_declaration(NETWORKS[name]).get("command")[1:], step, tmp_path, seconds="60"
        )
    with np.load(tmp_path / "filled" / "0003.npz") as filled:
        assert {*filled} & {"mean", "samples"}
        assert all(np.isfinite(filled[array]).all() for array in filled)


ENDLESS = """
import training
with training.limit_time():
    while True: pass
print("then it goes on")
"""
RISES = """
import os, torch, training
training.seed_everything()
network, seen = torch.nn.Linear(1, 1), []
def lose(batch):
    seen.append(network.training)
    wanted = 1.0 if network.training else network.start
    return (network.weight - wanted).abs().sum()
network.start = network.weight.detach().clone()
training.train_network(network, lose, lambda: None, [None], 0.1)
print(bool((network.weight == network.start).all()), sum(seen))
"""


@pytest.mark.slow
def test_learning_ends_with_half_of_the_time(run_in):
    ended = run_in("transformer", "-c", ENDLESS, seconds="2")
    assert "stopped after 50% of its processor time: with more it may learn more" in ended.stderr
    assert ended.stdout == "then it goes on\n"


LATE = """
import os, time
os.environ["MOCAPBENCH_DEADLINE"] = repr(time.monotonic() + 23)
import training
with training.limit_time():
    while True: pass
print("then it goes on")
"""


@pytest.mark.slow
def test_what_was_spent_before_learning_is_part_of_the_time(run_in):
    ended = run_in("transformer", "-c", LATE, seconds="100")
    assert "stopped after 80% of its time by the clock" in ended.stderr
    assert ended.stdout == "then it goes on\n"


SPENT = """
import torch, training
network = torch.nn.Linear(1, 1)
training.train_network(network, lambda batch: -network.weight.sum(), lambda: None, [None], 0.1)
"""


@pytest.mark.slow
def test_between_steps_it_is_known_whether_the_time_is_spent(run_in):
    said = run_in("transformer", "-c", SPENT, seconds="0.01").stderr
    assert "step 0: loss" in said
    assert "stopped after 50% of its processor time" in said


FAILS = """
import time, training
try:
    with training.limit_time():
        raise ValueError
except ValueError:
    time.sleep(1.0)
for _ in range(10_000_000): pass
print("nothing interrupts what follows")
"""


@pytest.mark.slow
def test_what_fails_is_not_interrupted_afterwards(run_in):
    ended = run_in("transformer", "-c", FAILS, seconds="3")
    assert ended.stdout == "nothing interrupts what follows\n"


@pytest.mark.slow
def test_learning_stops_when_held_out_recordings_get_worse_and_the_best_weights_are_kept(run_in):
    ended = run_in("transformer", "-c", RISES, seconds="1000")
    assert ended.stdout == "True 150\n"  # six times 25 steps in vain
