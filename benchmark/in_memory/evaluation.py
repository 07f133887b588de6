"""Scores of models in gaps whose values are known, in memory."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.baselines import Prediction
from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.filling.choosing.ranking import tell_positions
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gaps import Gap, mask_ends, mask_gaps
from mocapbench.benchmark.filling.input_files import compose_request
from mocapbench.benchmark.filling.requests.names import name_owners
from mocapbench.benchmark.filling.requests.request import BEST, NamedEntries
from mocapbench.benchmark.in_memory.arguments import list_given, translate_errors
from mocapbench.benchmark.in_memory.gap_filling import solve_request
from mocapbench.benchmark.in_memory.hidden_gaps import Gaps
from mocapbench.benchmark.in_memory.own_models import ModelLike, name_model
from mocapbench.benchmark.in_memory.recording_inputs import read
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.evaluate import score_by
from mocapbench.datasets import Recording
from mocapbench.datasets.formats.strays import list_measured
from mocapbench.metrics import Imputation, Score

__all__ = ["evaluate", "evaluate_frames"]

_HALF_A_SECOND = Gaps(seconds=0.5)
_UNDEFINED = Score(np.nan)


def evaluate(
    recordings: Any,
    models: Sequence[ModelLike] | Mapping[str, ModelLike] = (BEST,),
    hide: Gaps = _HALF_A_SECOND,
    *,
    metrics: Sequence[str] = (),
    train: Sequence[Any] = (),
    effort: str = "normal",
    seed: int = 0,
    jobs: int | None = None,
    **options: Any,
) -> pd.DataFrame:
    """Score models in gaps that are hidden from them.

    Every model fills all gaps of a recording at once, its own too, and is scored in each of those
    that were hidden.

    Parameters
    ----------
    recordings : sequence
        What `read` takes, or one of it.
    models : sequence of model, or mapping of str to model
        What `fill` takes as a model, perhaps with a name of yours for each.
    hide : Gaps
        What is hidden.
    metrics : sequence of str, optional
        Names of metrics; by default all that are defined.
    train : sequence
        Recordings to learn from besides.
    effort : str
        See `fill`.
    seed : int
        See `fill`.
    jobs : int or None
        See `fill`.
    **options
        For `read`.

    Returns
    -------
    DataFrame
        A row for each ``recording``, ``gap``, ``model`` and ``metric``, with its ``value``, NaN
        where it is not defined; with the ``position`` of the gap, which is that of others that
        share frames with it, its ``start`` in seconds, and what it has ``hidden``.

    Raises
    ------
    ValueError
        If a recording has no room for the gaps, or a model does not fill them.

    See Also
    --------
    evaluate_frames : The same, frame by frame.
    compare : Says which differences of scores are more than chance.

    Examples
    --------
    >>> import mocapbench
    >>> from mocapbench.datasets import GaitLibrary
    >>> walk = GaitLibrary().recording("01_01")
    >>> scores = mocapbench.evaluate(walk, ["linear", "pchip"], metrics=["mse"])
    >>> scores.groupby("model")["value"].mean().idxmin()
    'pchip'
    """
    names = _check_metrics(metrics)
    arguments = {"effort": effort, "seed": seed, "jobs": jobs}
    scores = _fill_and_score(
        partial(_score_gap, metrics=names), (recordings, train, options), models, hide, arguments
    )
    defined = scores["value"].notna().groupby(scores["metric"]).transform("any")
    return scores[defined | bool(metrics)].reset_index(drop=True)


def evaluate_frames(
    recordings: Any,
    models: Sequence[ModelLike] | Mapping[str, ModelLike] = (BEST,),
    hide: Gaps = _HALF_A_SECOND,
    *,
    metric: str = "rms_per_frame",
    train: Sequence[Any] = (),
    effort: str = "normal",
    seed: int = 0,
    jobs: int | None = None,
    **options: Any,
) -> pd.DataFrame:
    """Score models frame by frame in gaps that are hidden from them, as `evaluate` does by gap.

    Parameters
    ----------
    recordings : sequence
        What `read` takes, or one of it.
    models : sequence of model, or mapping of str to model
        What `fill` takes as a model, perhaps with a name of yours for each.
    hide : Gaps
        What is hidden.
    metric : str
        Name of a metric that is defined for frames.
    train : sequence
        Recordings to learn from besides.
    effort : str
        See `fill`.
    seed : int
        See `fill`.
    jobs : int or None
        See `fill`.
    **options
        For `read`.

    Returns
    -------
    DataFrame
        The columns of `evaluate`, a row for each hidden frame, with its ``time`` in seconds.

    Raises
    ------
    ValueError
        If a recording has no room for the gaps, a model does not fill them, or the metric is not
        defined for frames.

    Examples
    --------
    >>> import mocapbench
    >>> from mocapbench.datasets import GaitLibrary
    >>> walk = GaitLibrary().recording("01_01")
    >>> errors = mocapbench.evaluate_frames(walk, ["linear"], mocapbench.Gaps(0.5, count=1))
    >>> len(errors)
    60
    """
    _check_metrics([metric])
    arguments = {"effort": effort, "seed": seed, "jobs": jobs}
    score = partial(_score_frames, metric=metric)
    errors = _fill_and_score(score, (recordings, train, options), models, hide, arguments)
    if errors.empty:
        raise ValueError(f"{metric} is not defined for the frames of these gaps")
    return errors


def _fill_and_score(
    score: Callable[[Imputation, NDArray[np.float64]], Iterator[Mapping[str, Any]]],
    inputs: tuple[Any, Sequence[Any], Mapping[str, Any]],
    models: Sequence[ModelLike] | Mapping[str, ModelLike],
    hide: Gaps,
    arguments: Mapping[str, Any],
) -> pd.DataFrame:
    """Return the rows that ``score`` makes of each gap as each model fills it.

    ``inputs`` are recordings, others to learn from, and how to read both.
    """
    named = dict(models) if isinstance(models, Mapping) else _name_models(models)
    recordings, train, options = inputs
    given = [read(one, **options) for one in _list_recordings(recordings)]
    others = [read(one, **options) for one in list_given(train)]
    rows: list[Mapping[str, Any]] = []
    for name, recording in zip(_name_recordings(given), given, strict=True):
        measured = _keep_measured(recording)
        gaps = hide.place(measured)
        learn = [one for one in others if one is not recording]
        for label, model in named.items():
            filled = _fill_hidden(measured, gaps, learn, model, arguments)
            scored = _score_gaps(measured, gaps, filled, score)
            rows.extend({"recording": name, "model": label, **row} for row in scored)
    return pd.DataFrame(rows)


def _check_metrics(metrics: Sequence[str]) -> Sequence[str]:
    """Return the names of metrics, or of all that take predictions of hidden entries."""
    wanted = [metrics] if isinstance(metrics, str) else list(metrics)
    known = [name for name in METRICS.names() if METRICS.get(name).outcome is Imputation]
    for name in wanted:
        if name not in known:
            raise UnknownNameError("metric of filled gaps", name, known)
    return wanted or known


def _name_models(models: ModelLike | Sequence[ModelLike]) -> dict[str, ModelLike]:
    """Return models by their names, which differ."""
    listed = models if isinstance(models, list | tuple) else [models]
    names = [name_model(model) for model in listed]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated or not names:
        raise ValueError(
            f"expected models of different names, got {', '.join(repeated) or 'none'}"
            f"{' several times; name them: {...: model}' if repeated else ''}"
        )
    return dict(zip(names, listed, strict=True))


def _list_recordings(recordings: Any) -> Sequence[Any]:
    listed = list_given(recordings)
    if not listed:
        raise ValueError("expected one recording or more, got none")
    return listed


def _name_recordings(recordings: Sequence[Recording]) -> list[str]:
    """Return names of recordings, with a number where several have one name."""
    names = [recording.name for recording in recordings]
    counts = [names[: k + 1].count(name) for k, name in enumerate(names)]
    return [name if n == 1 else f"{name} {n}" for name, n in zip(names, counts, strict=True)]


def _keep_measured(recording: Recording) -> Recording:
    """Return what models are judged by: what was measured, and is seen in some frame."""
    measured = list_measured(recording.channels, getattr(recording, "results", ()))
    seen = {*np.array(recording.channels)[recording.visible.any(axis=0)].tolist()}
    kept = recording.select([name for name in measured if name in seen])
    if not kept.channels:
        raise ValueError(f"{recording.name}: expected a visible channel, got none")
    blank = mask_ends(np.asarray(kept.visible.any(axis=1))[:, np.newaxis])[:, 0]
    return kept.frames(~blank)


def _fill_hidden(
    recording: Recording,
    gaps: Sequence[Gap],
    train: Sequence[Recording],
    model: ModelLike,
    arguments: Mapping[str, Any],
) -> FilledRecording:
    """Return the recording, with all that is hidden in it filled by a model."""
    given = recording.hide(mask_gaps(gaps, recording.values.shape))
    name = name_model(model)
    with translate_errors():
        request = compose_request(given, NamedEntries(fill_ends=True, model=name), train, ())
        # Not unwrapped again, as the truth beside a gap is not either.
        return solve_request(replace(request, given=given), {name: model}, **arguments)


def _score_gaps(
    recording: Recording,
    gaps: Sequence[Gap],
    filled: FilledRecording,
    score: Callable[[Imputation, NDArray[np.float64]], Iterator[Mapping[str, Any]]],
) -> Iterator[dict[str, Any]]:
    """Yield the rows of each gap."""
    shape = recording.values.shape
    problem = ImputeProblem.of_one(recording, mask_gaps(gaps, shape), filled.request.train)
    variance = np.full(shape, np.nan)
    variance[filled.request.target] = filled.std**2
    known = None if np.isnan(filled.std).any() else variance
    prediction = Prediction.around(problem.given[0], filled.recording.values, known)
    outcome = problem.outcome((prediction,))
    owners, positions = name_owners(recording.channels), tell_positions(gaps)
    for number, gap in enumerate(gaps):
        in_gap = replace(outcome, hidden=outcome.hidden & mask_gaps([gap], shape))
        about = {
            "gap": number + 1,
            "position": int(positions[number]) + 1,
            "start": float(recording.times[gap.start]),
            "hidden": ", ".join(dict.fromkeys(owners[channel] for channel in gap.channels)),
        }
        yield from ({**about, **row} for row in score(in_gap, recording.times))


def _score_gap(
    outcome: Imputation, times: NDArray[np.float64], metrics: Sequence[str]
) -> Iterator[dict[str, Any]]:
    """Yield the score by each metric."""
    del times
    for metric in metrics:
        yield {"metric": metric, "value": float(_score(metric, outcome).value)}


def _score_frames(
    outcome: Imputation, times: NDArray[np.float64], metric: str
) -> Iterator[dict[str, Any]]:
    """Yield the score of each hidden frame; none where the metric has none."""
    by_frame = _score(metric, outcome).parts.get("frame", np.empty(0))
    for time, value in zip(times, by_frame, strict=bool(len(by_frame))):
        if np.isfinite(value):
            yield {"metric": metric, "time": float(time), "value": float(value)}


def _score(metric: str, outcome: Imputation) -> Score:
    """Return a score, NaN where the metric is not defined or fails."""
    try:
        return score_by(METRICS.get(metric), outcome).get(metric, _UNDEFINED)
    except (RuntimeError, ValueError) as error:
        warnings.warn(str(error), RuntimeWarning, stacklevel=2)
        return _UNDEFINED
