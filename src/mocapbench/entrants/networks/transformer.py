"""Add to lines across gaps what a small transformer has learnt of the difference.

Its tokens are frames: values with lines where they are hidden, those that are visible alone, which
are hidden, and how far the next visible one is. It predicts a pose, how far to trust it in place of
the lines, and the standard deviation of what comes of it. The mean learns from absolute errors, the
deviation from the likelihood of the same errors.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from recordings import fill_recordings, hide_gaps, interpolate_lines, load_windows
from torch import Tensor, nn
from training import load_network, save_network, seed_everything, train_network

__all__ = ["STEPS"]

_LONGEST, _BATCH, _RATE = 96, 8, 5e-4
"""Frames of a window, windows of a batch, and the rate of learning."""
_SIZE, _HEADS, _LAYERS, _DROPOUT = 128, 8, 4, 0.2
_LEAST, _MOST = -7.0, 3.0
"""Logarithms of standard deviations, of scaled values."""


class _Transformer(nn.Module):
    """Four layers over frames.

    Parameters
    ----------
    n_channels : int
    """

    def __init__(self, n_channels: int) -> None:
        super().__init__()
        self.read = nn.Linear(4 * n_channels, _SIZE)
        layer = nn.TransformerEncoderLayer(
            _SIZE, _HEADS, 4 * _SIZE, _DROPOUT, "gelu", batch_first=True, norm_first=True
        )
        self.layers = nn.TransformerEncoder(layer, _LAYERS, enable_nested_tensor=False)
        self.write = nn.Linear(_SIZE, 3 * n_channels)
        nn.init.zeros_(self.write.weight)  # it begins between the lines and the mean
        nn.init.zeros_(self.write.bias)

    def forward(self, lines: Tensor, hidden: Tensor, away: Tensor) -> tuple[Tensor, Tensor]:
        """Return the mean, and the logarithm of the standard deviation, of every entry."""
        frames = self.read(torch.cat([lines, lines * (1 - hidden), hidden, away], dim=-1))
        frames = self.layers(frames + _encode_positions(lines.shape[1]))
        pose, trust, log_deviation = self.write(frames).chunk(3, dim=-1)
        difference = (trust + away - 1.0).sigmoid() * (pose - lines)
        return lines + difference, log_deviation.clamp(_LEAST, _MOST)


def _encode_positions(length: int) -> Tensor:
    angles = torch.arange(length)[:, None] * torch.exp(
        torch.arange(0, _SIZE, 2) * (-math.log(10_000.0) / _SIZE)
    )
    return torch.stack([angles.sin(), angles.cos()], dim=-1).reshape(length, _SIZE)


_Batch = tuple[Tensor, Tensor, Tensor, Tensor]
"""Lines, which entries are hidden, how far they are from visible ones, and the truth."""


def _make_batch(windows: NDArray[np.float64], gaps: NDArray[np.bool_]) -> _Batch:
    """Return windows with gaps; entries that nobody knows are hidden, and have no truth."""
    given = np.where(gaps, np.nan, windows)
    lines, away = interpolate_lines(given)
    arrays = (lines, ~np.isfinite(given), away, windows)
    lines, hidden, away, truth = (torch.tensor(array, dtype=torch.float32) for array in arrays)
    return lines, hidden, away, truth


def _score_batch(network: nn.Module, batch: _Batch) -> Tensor:
    *inputs, truth = batch
    mean, log_deviation = network(*inputs)
    asked = (inputs[1] > 0) & truth.isfinite()
    error, log_deviation = (truth - mean)[asked].abs(), log_deviation[asked]
    if not network.training:
        return error.sum() / max(1, asked.sum())  # the mean decides when to stop
    unlikely = 0.5 * (error.detach() / log_deviation.exp()) ** 2 + log_deviation
    return (error + 0.1 * unlikely).sum() / max(1, asked.sum())


def _learn(folder: Path) -> None:
    rng = seed_everything()
    training, held_out, parts = load_windows(folder, _LONGEST, rng)

    def draw() -> _Batch:
        windows = training[rng.integers(0, len(training), _BATCH)]
        return _make_batch(windows, hide_gaps(windows.shape, parts, rng))

    kept = [
        _make_batch(held_out[k : k + _BATCH], hide_gaps(held_out[k : k + _BATCH].shape, parts, rng))
        for _ in range(2)
        for k in range(0, len(held_out), _BATCH)
    ]
    network = _Transformer(training.shape[2])
    train_network(network, lambda batch: _score_batch(network, batch), draw, kept, _RATE)
    save_network(network, folder)


def _fill(folder: Path) -> None:
    seed_everything()
    with np.load(folder / "model" / "scale.npz") as scale:
        network = _Transformer(len(scale["centre"]))
    load_network(network, folder)

    @torch.no_grad()
    def fill(windows: NDArray[np.float64]) -> Mapping[str, NDArray[np.float64]]:
        *inputs, _ = _make_batch(windows, np.zeros(windows.shape, dtype=bool))
        mean, log_deviation = network(*inputs)
        return {"mean": mean.double().numpy(), "std": log_deviation.exp().double().numpy()}

    fill_recordings(folder, fill)


STEPS: Mapping[str, Callable[[Path], None]] = {"fit": _learn, "fill": _fill}

if __name__ == "__main__":
    STEPS[sys.argv[1]](Path(sys.argv[2]))
