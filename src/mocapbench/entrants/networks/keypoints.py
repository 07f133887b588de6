"""Fill keypoints by the recurrent network of DISK, with its loss and its scaling of windows.

Windows are made to face one way and scaled to a cube, as DISK does. What is hidden meanwhile, and
when learning stops, is that of the other networks here. DISK's swaps of keypoints are left out: it
repairs with them what cameras mistake. Its transformer, which relates every keypoint of every frame
to all others, is beyond a processor for windows as long as these.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from DISK.utils.train_fillmissing import construct_NN_model, feed_forward
from DISK.utils.transforms import NormalizeCube, ViewInvariant
from numpy.typing import NDArray
from recordings import fill_recordings, hide_gaps, interpolate_lines, load_windows
from torch import Tensor, nn
from training import load_network, save_network, seed_everything, train_network

__all__ = ["build_network", "find_columns"]

_LONGEST, _BATCH, _RATE = 96, 8, 5e-4
"""Frames of a window, windows of a batch, and the rate of learning."""
_NETWORK = {"type": "GRU", "num_layers": 3, "size_layer": 128, "dropout": 0}
_NETWORK |= {"mu_sigma": True, "beta_mu_sigma": 0.5}
"""As DISK has it, but for 128 units in place of 512."""

Values = NDArray[np.float64]
Columns = NDArray[np.intp]
"""Of each keypoint the columns of its three coordinates, the upright one last; -1 for none."""
_Batch = tuple[Tensor, Tensor, Tensor]
"""Windows with zeros where keypoints are hidden, which are hidden, and the truth."""


def build_network(n_keypoints: int, length: int) -> nn.Module:
    """Return a network that has learnt nothing, and begins every window in the same state."""
    network: Any = construct_NN_model(_NETWORK, range(n_keypoints), 3, length, None, "cpu")
    states = 2 * network.num_layers, network.hidden_size
    # DISK draws the state, and with it another filling for every order of windows.
    network.init_hidden = lambda windows: torch.zeros(states[0], len(windows), states[1])
    return network


def find_columns(parts: Sequence[NDArray[np.intp]], frames: Values) -> Columns:
    """Return the columns of keypoints, of which a joint or marker has one.

    Parameters
    ----------
    parts : sequence of arrays of int
        The columns of each joint or marker.
    frames : array (N, D)
        Poses, which reach further upright than to any side.
    """
    threes = [part[k : k + 3] for part in parts for k in range(0, len(part), 3)]
    columns = np.array([np.pad(three, (0, 3 - len(three)), constant_values=-1) for three in threes])
    return columns[:, np.argsort(np.ptp(_place(frames, columns), axis=1).mean(axis=0))]


def _place(values: Values, columns: Columns) -> Values:
    """Return the coordinates (..., keypoints, 3) of values (..., channels)."""
    return np.where(columns >= 0, values[..., columns], 0.0)


def _scale_windows(
    windows: Values, hidden: NDArray[np.bool_], columns: Columns
) -> tuple[_Batch, Callable[[Values], Values], Values]:
    """Return windows as DISK scales them by what is visible and by lines across gaps.

    Returns
    -------
    batch : tuple of Tensor
    back : callable
        From coordinates of the network to those of the windows.
    sizes : array (windows, 1, 1, 1)
        What one unit of the network is.
    """
    facing = ViewInvariant(proba=1, divider=3, index_frame=windows.shape[1] // 2)
    cube = NormalizeCube(proba=1, divider=3)
    lines, _ = interpolate_lines(np.where(hidden, np.nan, windows))
    known, truths, said = [], [], []
    for one, true in zip(_place(lines, columns), _place(windows, columns), strict=True):
        facts: dict[str, Any] = {"verbose_sample": False, "skeleton_graph": None}
        one, true, facts = facing(one, x_supp=true, **facts)  # noqa: PLW2901
        one, true, facts = cube(one, x_supp=true, **facts)  # noqa: PLW2901
        known.append(one)
        truths.append(true)
        said.append(facts)
    holes = (hidden[..., columns] & (columns >= 0)).any(axis=-1)
    given = np.where(holes[..., None], 0.0, np.stack(known))

    def go_back(scaled: Values) -> Values:
        pairs = zip(scaled, said, strict=True)
        return np.stack([facing.untransform(cube.untransform(x, **f), **f) for x, f in pairs])

    sizes = np.array([np.max(facts["max_sample"] - facts["min_sample"]) / 2 for facts in said])
    data, truth = (torch.tensor(each, dtype=torch.float32) for each in (given, np.stack(truths)))
    return (data, torch.tensor(holes).int(), truth), go_back, sizes[:, None, None, None]


def _score_batch(network: nn.Module, batch: _Batch) -> Tensor:
    """Return DISK's loss, or where nothing is learnt the error by which it chooses an epoch."""
    given, holes, truth = batch
    quiet, distances = logging.getLogger("disk"), nn.L1Loss(reduction="none")
    options = {"data_full": truth, "criterion_seq": distances, "logger": quiet}
    *_, loss, _, errors = feed_forward(given, holes, 3, network, True, None, _NETWORK, **options)
    return loss if network.training else errors.mean()


def _take_complete(windows: Values) -> Values:
    """Return the windows in which all is known, or if there is none, all with lines."""
    complete = windows[np.isfinite(windows).all(axis=(1, 2))]
    return complete if len(complete) else interpolate_lines(windows)[0]


def _learn(folder: Path) -> None:
    rng = seed_everything()
    *windows, parts = load_windows(folder, _LONGEST, rng)
    with np.load(folder / "model" / "scale.npz") as scale:
        home = scale["centre"] / scale["spread"]
    training, held_out = (_take_complete(some) + home for some in windows)
    columns = find_columns(parts, training.reshape(-1, training.shape[2]))
    np.save(folder / "model" / "columns.npy", columns)

    def make_batch(windows: Values) -> _Batch:
        count, length, n_channels = windows.shape
        after_first = hide_gaps((count, length - 1, n_channels), parts, rng)  # DISK sees the first
        hidden = np.pad(after_first, ((0, 0), (1, 0), (0, 0)))
        return _scale_windows(windows, hidden, columns)[0]

    kept = [
        make_batch(held_out[k : k + _BATCH])
        for _ in range(2)
        for k in range(0, len(held_out), _BATCH)
    ]
    network = build_network(len(columns), training.shape[1])
    train_network(
        network,
        lambda batch: _score_batch(network, batch),
        lambda: make_batch(training[rng.integers(0, len(training), _BATCH)]),
        kept,
        _RATE,
    )
    save_network(network, folder)


def _fill(folder: Path) -> None:
    seed_everything()
    columns = np.load(folder / "model" / "columns.npy")
    with np.load(folder / "model" / "scale.npz") as scale:
        network = build_network(len(columns), int(scale["length"]))
        home = scale["centre"] / scale["spread"]
    load_network(network, folder)
    there = columns >= 0

    def return_channels(placed: Values) -> Values:
        values = np.empty((*placed.shape[:2], len(home)))
        values[..., columns[there]] = placed[..., there]
        return values

    @torch.no_grad()
    def fill(windows: Values) -> Mapping[str, Values]:
        hidden = ~np.isfinite(windows)
        (given, holes, _), go_back, sizes = _scale_windows(windows + home, hidden, columns)
        mean, deviation = feed_forward(given, holes, 3, network, True, None, _NETWORK)
        # One of a keypoint in all directions, as they are not those of the recording.
        round_ = (deviation.double() ** 2).mean(dim=-1, keepdim=True).sqrt().expand(mean.shape)
        return {
            "mean": return_channels(go_back(mean.double().numpy())) - home,
            "std": return_channels(round_.numpy() * sizes),
        }

    fill_recordings(folder, fill)


STEPS: Mapping[str, Callable[[Path], None]] = {"fit": _learn, "fill": _fill}

if __name__ == "__main__":
    STEPS[sys.argv[1]](Path(sys.argv[2]))
