"""Normalised power spectrum similarity (NPSS): whether motions have the same frequencies.

Papers state it with the squared magnitude of the Fourier transform, and that is `npss`. The code
that they publish squares its real part alone, and that is `npss_real_part`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.fft import fft

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Score, has_poses, metric
from mocapbench.metrics.outcomes.imputation import Imputation
from mocapbench.metrics.outcomes.synthesis import Synthesis

__all__ = ["npss", "npss_real_part", "sample_npss"]


Square = Callable[[NDArray[np.complex128]], Array]
"""From a Fourier transform to the power at each frequency."""

SHORTEST = 4
"""Frames of the shortest run whose spectrum is compared."""


@metric(
    title="Normalised power spectrum similarity (NPSS)",
    direction=Direction.LOWER,
    sentence=(
        "Distance of the power spectra of filled and true gaps, strong channels weighing more; "
        "phases do not matter."
    ),
    unit="steps of frequency",
    range="0 to ∞",
    source="Gopalakrishnan et al. 2019",
    defined=has_poses,
)
def npss(outcome: Imputation) -> Score:
    r"""Return the distance of the power spectra of prediction and truth, within gaps.

    A sequence is a run of hidden entries of one output, four frames or longer. Its power spectrum
    is divided by its sum, and ``Σ_f |F̂(f) − F(f)|`` compares the cumulative spectra (the earth
    mover's distance). The mean over sequences is weighted by the true power, in which a constant
    level counts too. Phases do not matter.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames.

    Returns
    -------
    Score
        NaN if no run is long enough, or none has any power. Without parts.

    Warnings
    --------
    Phases do not count: a fill in step and one out of step score the same. The level of a sequence
    is its power at frequency 0, so that channels far from zero weigh much, and their level hides
    their movement. Runs shorter than four frames are left out. It is the published formula, and
    not what published code computes: no number that such code printed stands beside it.

    See Also
    --------
    npss_real_part : What published code computes.

    Notes
    -----
    With F and F̂ the cumulative normalised power spectra of sequence i, and :math:`P_i` the power
    of its truth:

    .. math::

        \mathrm{NPSS} = \frac{\sum_i P_i \sum_f | \hat F_i(f) - F_i(f) |}{\sum_i P_i}

    References
    ----------
    Gopalakrishnan, Mali, Kifer, Giles and Ororbia (2019), A neural temporal model for human motion
    prediction. The paper compares joint angles of a second or more; its sequences are all of
    one length.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, npss
    >>> truth, mean = np.zeros((2, 12, 2, 3))
    >>> truth[:, 1, 0] = np.sin(2 * np.pi * 2 * np.arange(12) / 12)
    >>> mean[:, 1, 0] = np.sin(2 * np.pi * 4 * np.arange(12) / 12)
    >>> hidden = np.tile([False, True], (12, 1))
    >>> times = np.arange(12) / 30
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, ("root", "knee"), (-1, 0), times)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.full((12, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> round(npss(outcome).value, 6)
    2.0
    """
    return _compare_runs(outcome, _square_magnitude)


@metric(
    title="NPSS by the real part of spectra, as public code computes it",
    direction=Direction.LOWER,
    sentence=(
        "Distance of the squared real parts of the spectra of filled and true gaps, which phases "
        "change; what papers on in-betweening print."
    ),
    unit="steps of frequency",
    range="0 to ∞",
    source="Harvey et al. 2020 (code)",
    defined=has_poses,
)
def npss_real_part(outcome: Imputation) -> Score:
    r"""Return what public code computes as NPSS: `npss` of the squared real part of spectra.

    The sequences, the weights and the distance are those of `npss`, with ``(Re X(f))²`` as the
    power at frequency f in place of ``|X(f)|²``.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames.

    Returns
    -------
    Score
        NaN if no run is long enough, or none has any such power. Without parts.

    Warnings
    --------
    The real part depends on where in a cycle a gap begins: a sine, which is 0 at the first frame,
    has none, and a cosine has all of its power. Numbers that the public code of Gopalakrishnan
    (2019) and of LaFAN1 (Harvey 2020) gave, as papers on in-betweening print them, stand beside
    this metric if outputs are the same, and beside `npss` never; it was .07 to 1.2 times the latter
    where both were computed.

    See Also
    --------
    npss : The formula of the paper.

    Notes
    -----
    With :math:`X_i(f)` the Fourier transform of sequence i, F and F̂ the cumulative sums of its
    squared real part, which end at 1, and :math:`P_i` the sum of that of the truth:

    .. math::

        \frac{\sum_i P_i \sum_f | \hat F_i(f) - F_i(f) |}{\sum_i P_i},
        \quad P_i = \sum_f (\mathrm{Re}\, X_i(f))^2

    References
    ----------
    Gopalakrishnan, Mali, Kifer, Giles and Ororbia (2019), A neural temporal model for human motion
    prediction: its code. Harvey, Yurick, Nowrouzezahrai and Pal (2020), Robust motion
    in-betweening: the code of its data set.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, npss_real_part
    >>> truth, mean = np.zeros((2, 12, 2, 3))
    >>> truth[:, 1, 0] = np.cos(2 * np.pi * 2 * np.arange(12) / 12)
    >>> mean[:, 1, 0] = np.cos(2 * np.pi * 4 * np.arange(12) / 12)
    >>> hidden = np.tile([False, True], (12, 1))
    >>> times = np.arange(12) / 30
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, ("root", "knee"), (-1, 0), times)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.full((12, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> round(npss_real_part(outcome).value, 6)
    2.0
    """
    return _compare_runs(outcome, _square_real_part)


@metric(
    title="Normalised power spectrum similarity of samples (NPSS)",
    direction=Direction.LOWER,
    sentence=(
        "Distance of the power spectra of samples and references, strong channels weighing more; "
        "a sample need not be in step."
    ),
    unit="steps of frequency",
    range="0 to ∞",
    source="Gopalakrishnan et al. 2019",
    defined=has_poses,
)
def sample_npss(outcome: Synthesis) -> Score:
    r"""Return the distance of the power spectra of samples and references.

    It is that of `npss`, of every output of every sample with the same output of every reference,
    weighted by the power of the reference. A sample need not be in step with a reference.

    Parameters
    ----------
    outcome : Synthesis
        With S samples and M references of D outputs over N frames.

    Returns
    -------
    Score
        NaN if no reference has any power. With part ``"sample"`` (S,).

    Warnings
    --------
    Channels are compared one by one: samples whose channels do not belong together score as well.
    The level of a channel is its power at frequency 0, so that channels far from zero weigh much.

    Notes
    -----
    With F the cumulative normalised power spectra of output d of sample s and reference m, and
    :math:`P_{md}` the power of the reference; the value is the mean over samples:

    .. math::

        \frac{\sum_{m, d} P_{md} \sum_f | F_{sd}(f) - F_{md}(f) |}{\sum_{m, d} P_{md}}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import SampledPoses, Synthesis, sample_npss
    >>> times = np.arange(12.0)
    >>> samples, references = np.zeros((2, 1, 12, 2, 3))
    >>> references[0, :, 1, 0] = np.sin(2 * np.pi * 2 * times / 12)
    >>> samples[0, :, 1, 0] = np.sin(2 * np.pi * 4 * times / 12)
    >>> poses = SampledPoses(samples, references, ("root", "knee"), times)
    >>> outcome = Synthesis(samples[:, :, 1], references[:, :, 1], lambda: poses)
    >>> round(sample_npss(outcome).value, 6)
    2.0
    """
    powers, references = _spectra(outcome.references, _square_magnitude)
    _, samples = _spectra(outcome.samples, _square_magnitude)
    by_sample = np.array(
        [_weighted_mean(np.abs(sample - references).sum(axis=1), powers) for sample in samples]
    )
    return Score(float(by_sample.mean()), {"sample": by_sample})


def _square_magnitude(transform: NDArray[np.complex128]) -> Array:
    return np.asarray(np.abs(transform) ** 2)


def _square_real_part(transform: NDArray[np.complex128]) -> Array:
    return np.asarray(transform.real**2)


def _compare_runs(outcome: Imputation, square: Square) -> Score:
    """Return the distance of the spectra of prediction and truth, by the true power of runs."""
    distances, powers = [], []
    for run in _runs(outcome.hidden, outcome.poses.starts):
        values = np.stack([outcome.truth[run], outcome.mean[run]])
        power, (truth, mean) = _spectra(values, square)
        distances.append(np.abs(mean - truth).sum(axis=0))
        powers.append(power[0])
    return Score(_weighted_mean(np.concatenate([[], *distances]), np.concatenate([[], *powers])))


def _runs(
    hidden: NDArray[np.bool_], starts: tuple[int, ...]
) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Yield the frames (N, n) and outputs (n,) of all runs of hidden entries of one length N."""
    found = []
    for start, stop in zip(starts, (*starts[1:], len(hidden)), strict=True):
        padded = np.pad(hidden[start:stop].astype(np.int8), ((1, 1), (0, 0)))
        steps = np.diff(padded, axis=0).T
        (outputs, begins), (_, ends) = np.nonzero(steps == 1), np.nonzero(steps == -1)
        found.append((start + begins, outputs, ends - begins))
    firsts, outputs, lengths = np.concatenate(found, axis=1)
    for length in np.unique(lengths[lengths >= SHORTEST]):
        of_length = lengths == length
        yield firsts[of_length] + np.arange(length)[:, None], outputs[of_length]


def _spectra(values: Array, square: Square) -> tuple[Array, Array]:
    """Return the total power (…, D) of the outputs of ``values`` (…, N, D), and their spectra.

    The spectra (…, N, D) are cumulative: 1 at the end; 0 where there is no power.
    """
    spectrum = square(fft(values, axis=-2))
    power = spectrum.sum(axis=-2, keepdims=True)
    cumulative = (spectrum / np.where(power > 0.0, power, 1.0)).cumsum(axis=-2)
    return power[..., 0, :], cumulative


def _weighted_mean(values: Array, weights: Array) -> float:
    total = float(weights.sum())
    return float((values * weights).sum() / total) if total > 0.0 else float("nan")
