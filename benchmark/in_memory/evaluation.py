"""Scores of models in gaps whose values are known, in memory."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from mocapbench.baselines import Prediction
from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.filling.choosing.ranking import tell_positions
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gaps import Gap, mask_ends, mask_gaps
from mocapbench.benchmark.filling.input_files import compose_request
from mocapbench.benchmark.filling.requests.names import name_owners
from mocapbench.benchmark.filling.requests.request import BEST, NamedEntries
from mocapbench.benchmark.in_memory.arguments import translate_errors
from mocapbench.benchmark.in_memory.gap_filling import solve_request
from mocapbench.benchmark.in_memory.hidden_gaps import Gaps
from mocapbench.benchmark.in_memory.own_models import ModelLike, name_model
from mocapbench.benchmark.in_memory.recording_inputs import read
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.evaluate import score_by
from mocapbench.datasets import Recording
from mocapbench.datasets.formats.strays import list_measured
from mocapbench.metrics import Imputation

__all__ = ["evaluate"]

_HALF_A_SECOND = Gaps(seconds=0.5)


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
    named = dict(models) if isinstance(models, Mapping) else _name_models(models)
    given = [read(one, **options) for one in _list_recordings(recordings)]
    others = [read(one, **options) for one in train]
    rows: list[Mapping[str, Any]] = []
    for name, recording in zip(_name_recordings(given), given, strict=True):
        measured = _keep_measured(recording)
        gaps = hide.place(measured)
        learn = [one for one in others if one is not recording]
        for label, model in named.items():
            arguments = {"effort": effort, "seed": seed, "jobs": jobs}
            filled = _fill_hidden(measured, gaps, learn, model, arguments)
            scored = _score_gaps(measured, gaps, filled, names)
            rows.extend({"recording": name, "model": label, **row} for row in scored)
    scores = pd.DataFrame(rows)
    defined = scores["value"].notna().groupby(scores["metric"]).transform("any")
    return scores[defined | bool(metrics)].reset_index(drop=True)


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
    listed = recordings if isinstance(recordings, list | tuple) else [recordings]
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
    recording: Recording, gaps: Sequence[Gap], filled: FilledRecording, metrics: Sequence[str]
) -> Iterator[dict[str, Any]]:
    """Yield the scores of each gap."""
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
        for metric in metrics:
            yield {**about, "metric": metric, "value": _score(metric, in_gap)}


def _score(metric: str, outcome: Imputation) -> float:
    """Return a score, NaN where the metric is not defined or fails."""
    try:
        scores = score_by(METRICS.get(metric), outcome)
    except (RuntimeError, ValueError) as error:
        warnings.warn(str(error), RuntimeWarning, stacklevel=2)
        return np.nan
    return float(scores[metric].value) if scores else np.nan
