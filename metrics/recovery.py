"""Errors of estimated covariances of a process whose true covariances are known.

After J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017 (thesis), §5.2.3.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Metric, Score, metric
from mocapbench.metrics.outcomes.recovery import Recovery

__all__ = [
    "frobenius_child",
    "frobenius_parent",
    "log_det_divergence",
    "logdet_child",
    "logdet_parent",
    "relative_frobenius",
]


def relative_frobenius(outcome: Recovery, layer: str) -> Score:
    r"""Return ‖K̂ − K‖ / ‖K‖ in the Frobenius norm, for the covariance K of ``layer``.

    The metrics ``frobenius_child`` and ``frobenius_parent``. Noise is in neither matrix. It is 0
    for the truth, 1 for K̂ = 0.

    Parameters
    ----------
    outcome : Recovery
        With the layer in both mappings.
    layer : str
        ``"parent"`` or ``"child"``.

    Returns
    -------
    Score
        Without parts.

    Raises
    ------
    ValueError
        If the layer has no estimate.

    Warnings
    --------
    Large entries decide it. A single parent was drawn, so that an estimate of the parent's
    covariance is poor however good the model is.

    Notes
    -----
    With K the true and K̂ the estimated covariance of the layer, (n, n):

    .. math:: \frac{\| \hat K - K \|_F}{\| K \|_F}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Recovery, frobenius_child
    >>> truth, estimate = np.eye(3), 2.0 * np.eye(3)
    >>> outcome = Recovery({"child": truth}, {"child": estimate}, noise=1.0)
    >>> round(frobenius_child(outcome).value, 6)
    1.0
    """
    truth, estimate = _pair(outcome, layer)
    return Score(float(np.linalg.norm(estimate - truth) / np.linalg.norm(truth)))


def log_det_divergence(outcome: Recovery, layer: str) -> Score:
    r"""Return tr(A B⁻¹) − log det(A B⁻¹) − n with A = K + σ² I and B = K̂ + σ² I, K (n, n).

    The metrics ``logdet_child`` and ``logdet_parent``: twice the Kullback–Leibler divergence
    KL(N(0, A) ‖ N(0, B)), the log loss from taking K̂ for the covariance of ``layer``. Covariances
    of smooth curves are almost singular, and without noise the divergence is infinite where K̂
    lacks a direction of K; with σ², the variance of the true noise in both matrices, directions too
    small to be observed hardly count.

    Parameters
    ----------
    outcome : Recovery
        With the layer in both mappings.
    layer : str
        ``"parent"`` or ``"child"``.

    Returns
    -------
    Score
        Without parts.

    Raises
    ------
    ValueError
        If the variance of the noise is not positive, or the layer has no estimate.

    Warnings
    --------
    It grows with the number n of values, and it is harsher on variance that the estimate lacks than
    on variance that it has too much.

    Notes
    -----
    With A = K + σ² I of the true and B = K̂ + σ² I of the estimated covariance, (n, n):

    .. math:: \operatorname{tr}(A B^{-1}) - \log \det (A B^{-1}) - n

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Recovery, logdet_child
    >>> truth, estimate = np.eye(3), 2.0 * np.eye(3)
    >>> outcome = Recovery({"child": truth}, {"child": estimate}, noise=1.0)
    >>> round(logdet_child(outcome).value, 6)
    0.216395
    """
    truth, estimate = _pair(outcome, layer)
    if not outcome.noise > 0.0:
        raise ValueError(f"expected a positive variance of the noise, got {outcome.noise:g}")
    noise = outcome.noise * np.eye(len(truth))
    a, b = (cho_factor(matrix + noise, lower=True) for matrix in (truth, estimate))
    trace = np.trace(cho_solve(b, truth + noise))
    return Score(float(trace + _log_det(b[0]) - _log_det(a[0]) - len(truth)))


def _log_det(factor: Array) -> float:
    """Return log det(L Lᵀ) of a Cholesky factor L, in the lower triangle."""
    return 2.0 * float(np.log(np.diag(factor)).sum())


def _pair(outcome: Recovery, layer: str) -> tuple[Array, Array]:
    """Return the true and the estimated covariance of ``layer``.

    Raises
    ------
    ValueError
        If it has no estimate.
    """
    if not _has(outcome, layer):
        raise ValueError(
            f"expected a covariance of layer {layer!r} among the estimated ones, "
            f"got those of {sorted(outcome.estimate)}"
        )
    return outcome.truth[layer], outcome.estimate[layer]


def _has(outcome: Recovery, layer: str) -> bool:
    return layer in outcome.estimate


_SYMBOLS = {"child": "child K_f", "parent": "parent K_g"}
_COVARIANCES = {
    "child": "covariance of children around their parent",
    "parent": "covariance of the parent",
}


def _declare_frobenius(layer: str) -> Metric[Recovery]:
    declare = metric(
        name=f"frobenius_{layer}",
        title=f"Relative Frobenius error, {_SYMBOLS[layer]}",
        direction=Direction.LOWER,
        sentence=f"Size of the error of the {_COVARIANCES[layer]}, over the size of the true one.",
        range="0 to ∞",
        source="this project",
        defined=partial(_has, layer=layer),
    )
    return declare(partial(relative_frobenius, layer=layer))


def _declare_logdet(layer: str) -> Metric[Recovery]:
    declare = metric(
        name=f"logdet_{layer}",
        title=f"Log-determinant divergence, {_SYMBOLS[layer]}",
        direction=Direction.LOWER,
        sentence=f"Log loss from taking the estimated {_COVARIANCES[layer]} for the true one.",
        unit="nats",
        range="0 to ∞",
        source="Kullback and Leibler 1951",
        defined=partial(_has, layer=layer),
    )
    return declare(partial(log_det_divergence, layer=layer))


frobenius_child: Metric[Recovery] = _declare_frobenius("child")
frobenius_parent: Metric[Recovery] = _declare_frobenius("parent")
logdet_child: Metric[Recovery] = _declare_logdet("child")
logdet_parent: Metric[Recovery] = _declare_logdet("parent")
