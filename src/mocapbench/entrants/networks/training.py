"""How networks learn: from a seed, on one core, until held-out windows get no better."""

from __future__ import annotations

import _thread
import copy
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TypeVar

import numpy as np
import torch
from torch import nn

__all__ = [
    "limit_time",
    "load_network",
    "save_network",
    "seed_everything",
    "train_network",
    "watch_time",
]

Batch = TypeVar("Batch")

_SHARE, _OF_CLOCK = 0.5, 0.8
"""Of the seconds that the command has, for how many it learns: those of its work, and of the clock.

On a machine that has a core for it the first are spent first, or neither.
"""
_LOOK, _AGAIN = 0.1, 10.0
"""Seconds after which its time is looked at again, and after which it is interrupted again."""
_MOST_STEPS, _EVERY, _PATIENCE = 4_000, 25, 6
"""Steps at the most; after how many held-out windows are looked at; and how often in vain."""
_WARM_UP = 50
"""Steps in which the rate of learning grows."""


def seed_everything() -> np.random.Generator:
    """Take all randomness from the seed of the request, and compute the same way every time."""
    seed = int(os.environ["MOCAPBENCH_SEED"])
    torch.manual_seed(seed)
    torch.use_deterministic_algorithms(True)
    torch.set_num_threads(1)
    np.random.seed(seed)  # noqa: NPY002  # libraries draw from it
    return np.random.default_rng(seed)


def watch_time() -> Callable[[], str]:
    """Return a function that says what time this process has taken its share of, if of any."""
    seconds = min(1e7, float(os.environ["MOCAPBENCH_SECONDS"]))
    deadline = float(os.environ.get("MOCAPBENCH_DEADLINE", "inf"))

    def tell_spent() -> str:
        if time.process_time() > _SHARE * seconds:
            return f"{_SHARE:.0%} of its processor time"
        late = deadline - time.monotonic() < (1.0 - _OF_CLOCK) * seconds
        return f"{_OF_CLOCK:.0%} of its time by the clock" if late else ""

    return tell_spent


@contextmanager
def limit_time() -> Iterator[None]:
    """Interrupt what is done in the context once this process has taken its share of the time.

    It is for libraries that learn in one call.
    """
    ended = threading.Event()
    watcher = threading.Thread(target=_interrupt, args=(watch_time(), ended), daemon=True)
    former = signal.signal(signal.SIGINT, signal.default_int_handler)  # it may be ignored
    watcher.start()
    try:
        with suppress(KeyboardInterrupt):
            yield
            ended.set()
            watcher.join()
    finally:
        ended.set()
        signal.signal(signal.SIGINT, former)


def _interrupt(tell_spent: Callable[[], str], ended: threading.Event) -> None:
    """Interrupt the process when its time is spent, and again while it goes on all the same."""
    while not ended.wait(_LOOK):
        if spent := tell_spent():
            _tell_end(spent)
            _thread.interrupt_main()
            while not ended.wait(_AGAIN):  # an interrupt in a finaliser is lost
                _thread.interrupt_main()


def _tell_end(spent: str) -> None:
    print(f"stopped after {spent}: with more it may learn more", file=sys.stderr)


def train_network(
    network: nn.Module,
    loss: Callable[[Batch], torch.Tensor],
    draw: Callable[[], Batch],
    held_out: Sequence[Batch],
    rate: float,
) -> None:
    """Have a network learn, and give it the weights of which held-out batches have the least loss.

    Parameters
    ----------
    network : torch.nn.Module
    loss : callable
        The loss of the network on a batch.
    draw : callable
        Gives a batch to learn from.
    held_out : sequence
        Batches that say when to stop.
    rate : float
        Of learning.
    """
    optimizer = torch.optim.AdamW(network.parameters(), lr=rate, weight_decay=0.1)
    warm_up = torch.optim.lr_scheduler.LambdaLR(optimizer, lambda k: min(1.0, (k + 1) / _WARM_UP))
    best, least, in_vain = copy.deepcopy(network.state_dict()), np.inf, 0
    tell_spent = watch_time()
    for step in range(_MOST_STEPS):
        if step % _EVERY == 0:
            lost = _measure_loss(network, loss, held_out)
            print(f"step {step}: loss {lost:.4f} of held-out windows", file=sys.stderr)
            in_vain = 0 if lost < least else in_vain + 1
            if lost < least:
                best, least = copy.deepcopy(network.state_dict()), lost
            if in_vain == _PATIENCE:
                break
        if spent := tell_spent():
            _tell_end(spent)
            break
        optimizer.zero_grad()
        loss(draw()).backward()
        nn.utils.clip_grad_norm_(network.parameters(), 1.0)
        optimizer.step()
        warm_up.step()
    network.load_state_dict(best)


@torch.no_grad()
def _measure_loss(
    network: nn.Module, loss: Callable[[Batch], torch.Tensor], batches: Sequence[Batch]
) -> float:
    network.eval()
    lost = float(np.mean([loss(batch).item() for batch in batches]))
    network.train()
    return lost


def save_network(network: nn.Module, folder: Path) -> None:
    """Leave the weights of a network in the model's folder."""
    torch.save(network.state_dict(), folder / "model" / "weights.pt")


def load_network(network: nn.Module, folder: Path) -> None:
    """Give a network the weights of the model's folder; it is to be used, not to learn."""
    network.load_state_dict(torch.load(folder / "model" / "weights.pt", weights_only=True))
    network.eval()
