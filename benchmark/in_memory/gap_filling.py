"""Filling a recording in memory, as the command does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from numbers import Integral
from typing import Any

from mocapbench.benchmark.filling.choosing.choice import EFFORTS
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.filled_recording import fill as fill_request
from mocapbench.benchmark.filling.input_files import compose_request
from mocapbench.benchmark.filling.requests.names import split_names
from mocapbench.benchmark.filling.requests.request import BEST, FillRequest, NamedEntries
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.benchmark.in_memory.arguments import (
    list_given,
    require_positive,
    translate_errors,
)
from mocapbench.benchmark.in_memory.filled import Filled
from mocapbench.benchmark.in_memory.own_models import ModelLike, lend_models, name_model
from mocapbench.benchmark.in_memory.progress_bar import show_progress
from mocapbench.benchmark.in_memory.recording_inputs import read
from mocapbench.benchmark.in_memory.this_process import ThisProcess
from mocapbench.benchmark.runs.machine import n_cores

__all__ = ["fill", "solve_request"]


def fill(
    recording: Any,
    model: ModelLike = BEST,
    *,
    train: Sequence[Any] = (),
    frames: tuple[int, int] | None = None,
    channels: str | Sequence[str] = (),
    leave: str | Sequence[str] = (),
    only: str | Sequence[str] = (),
    max_gap: float | None = None,
    ends: str = "open",
    effort: str = "normal",
    seed: int = 0,
    jobs: int | None = None,
    **options: Any,
) -> Filled:
    """Fill the gaps of a recording, as ``mocapbench fill`` does, to the bit.

    Parameters
    ----------
    recording : Recording, path, DataFrame, ndarray, xarray.Dataset or xarray.DataArray
        What `read` takes.
    model : str or model
        The name of a model; ``"best"``, which errs least in held-out gaps; rules such as
        ``"LKNE=linear,*=best"``; or a model of your own: an instance of
        `mocapbench.baselines.FrameImputer`, or an imputer of scikit-learn. Models that are named
        compute in this process, and those that are compared in others.
    train : sequence
        Recordings to learn from besides, of whatever `read` takes; or one of them.
    frames : tuple of int, optional
        Frames [first, stop), 0-based, which are filled whether they have values or not.
    channels, leave, only : str or sequence of str, optional
        Which markers, joints or channels are filled, which gaps stay open, and which alone do not,
        as the options of these names have it: ``"R*"``, ``"LKNE:412-455"``.
    max_gap : float, optional
        Seconds; longer gaps stay open.
    ends : str, default="open"
        ``"open"`` or ``"fill"``: what happens before a marker is first seen and after it is last
        seen.
    effort : str, default="normal"
        ``"low"``, ``"normal"`` or ``"high"``: how much work the choice among models may take.
    seed : int, default=0
        Of where gaps are held out, and of what models draw.
    jobs : int, optional
        How many models run at once; all cores by default.
    **options
        For `read`, of what is no recording yet.

    Returns
    -------
    Filled

    Raises
    ------
    ValueError
        If there is nothing to fill, or no way to do it; the message says what to do.

    Examples
    --------
    >>> import numpy as np
    >>> import mocapbench
    >>> walk = np.array([[0.0], [np.nan], [2.0]])
    >>> filled = mocapbench.fill(walk, "linear", rate=30)
    >>> filled.recording.values[:, 0]
    array([0., 1., 2.])
    """
    given = read(recording, **options)
    others = [read(one, **options) for one in list_given(train) if one is not recording]
    _require_frames(frames)
    if max_gap is not None:
        require_positive("max_gap", max_gap, "in seconds, ")
    _require_choice("ends", ends, ("open", "fill"))
    _require_choice("effort", effort, EFFORTS)
    entries = NamedEntries(
        frames,
        _split_names("channels", channels),
        max_gap,
        ends == "fill",
        name_model(model),
        _split_names("leave", leave),
        _split_names("only", only),
    )
    with translate_errors():
        request = compose_request(given, entries, others, getattr(given, "results", ()))
        own = {entries.model: model}
        return Filled(given, solve_request(request, own, effort=effort, seed=seed, jobs=jobs))


def _split_names(argument: str, names: str | Sequence[str]) -> tuple[str, ...]:
    listed = list_given(names)
    if not all(isinstance(name, str) for name in listed):
        raise ValueError(f"expected {argument}= as a name or a list of names, got {names!r}")
    return split_names(listed)


def _require_frames(frames: object) -> None:
    if frames is None:
        return
    ends = list_given(frames)
    if len(ends) != 2 or not all(isinstance(end, Integral) for end in ends):
        raise ValueError(f"expected frames= as (first, stop), such as (120, 180), got {frames!r}")


def _require_choice(name: str, value: str, known: Sequence[str] | Mapping[str, object]) -> None:
    if value not in known:
        raise ValueError(f"expected {name}= as one of {', '.join(known)}, got {value!r}")


def solve_request(
    request: FillRequest,
    models: Mapping[str, ModelLike],
    *,
    effort: str = "normal",
    seed: int = 0,
    jobs: int | None = None,
) -> FilledRecording:
    """Return what is asked for, filled: in other processes if models are compared, else here.

    Parameters
    ----------
    request : FillRequest
    models : mapping of str to model
        The user's own among those that are asked for, by their names.
    effort : str
        How much work a choice may take.
    seed : int
    jobs : int or None
        How many models run at once where they are compared.
    """
    if BEST in request.models[request.kept]:
        n_jobs = jobs or n_cores()
        with Workers(n_jobs, seed=seed) as workers, show_progress("hold-outs") as watch:
            return fill_request(request, workers, effort, watch)
    with lend_models(models) as own:
        return fill_request(request, ThisProcess(own, seed), effort, _ignore)


def _ignore(done: int, total: int) -> None:
    del done, total
