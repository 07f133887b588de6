"""Fill by a network of PyPOTS, which learns as its authors have it: SAITS, BRITS or CSDI."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pypots.imputation import BRITS, CSDI, SAITS
from recordings import fill_recordings, hide_gaps, load_windows
from training import limit_time, seed_everything

__all__ = ["build_network"]

_LONGEST = 96
"""Frames of a window."""
_LEARNING = {"batch_size": 16, "epochs": 200, "patience": 10, "device": "cpu", "verbose": False}
_N_DRAWS = 10
"""Draws of CSDI, of which intervals are made."""


def build_network(name: str, length: int, n_channels: int) -> Any:
    """Return a network that has learnt nothing, of sizes that a processor can train."""
    match name:
        case "SAITS":
            sizes = {"n_layers": 2, "d_model": 128, "n_heads": 4, "d_k": 32, "d_v": 32}
            return SAITS(length, n_channels, **sizes, d_ffn=256, dropout=0.1, **_LEARNING)
        case "BRITS":
            return BRITS(length, n_channels, rnn_hidden_size=128, **_LEARNING)
        case _:
            sizes = {"n_layers": 2, "n_heads": 4, "n_channels": 32, "d_time_embedding": 32}
            sizes |= {"d_feature_embedding": 16, "d_diffusion_embedding": 32}
            return CSDI(length, n_channels, **sizes, n_diffusion_steps=25, **_LEARNING)


def _learn(name: str, folder: Path) -> None:
    rng = seed_everything()
    training, held_out, parts = load_windows(folder, _LONGEST, rng)
    gaps = hide_gaps(held_out.shape, parts, rng)
    network = build_network(name, *training.shape[1:])
    with limit_time():  # at which PyPOTS keeps what was best
        network.fit({"X": training}, {"X": np.where(gaps, np.nan, held_out), "X_ori": held_out})
    network.save(str(folder / "model" / "network.pypots"))


def _fill(name: str, folder: Path) -> None:
    seed_everything()
    with np.load(folder / "model" / "scale.npz") as scale:
        network = build_network(name, int(scale["length"]), len(scale["centre"]))
    network.load(str(folder / "model" / "network.pypots"))

    def fill(windows: NDArray[np.float64]) -> Mapping[str, NDArray[np.float64]]:
        if name == "CSDI":
            drawn = network.predict({"X": windows}, n_sampling_times=_N_DRAWS)
            return {"samples": drawn["imputation"]}
        return {"mean": network.predict({"X": windows})["imputation"]}

    fill_recordings(folder, fill)


STEPS: Mapping[str, Callable[[str, Path], None]] = {"fit": _learn, "fill": _fill}

if __name__ == "__main__":
    STEPS[sys.argv[2]](sys.argv[1], Path(sys.argv[3]))
