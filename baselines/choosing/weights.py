"""From errors in held-out gaps to the weights of models."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.linalg import solve_triangular
from scipy.optimize import nnls

from mocapbench.baselines.choosing.candidates import LAST_RESORT
from mocapbench.baselines.choosing.held_out_errors import HeldOutErrors, Products
from mocapbench.baselines.choosing.parts import EVERYTHING, Part

__all__ = ["among", "evidence", "expected_errors", "weights_of"]

_LEAST = 1e-12
"""Least squared error, in units of the channels' scales."""
_PRIOR_ENTRIES = 10
"""Entries that count in the recording itself as erring as in training, beside those it hides."""
_RIDGE = 1e-9
"""Added to correlations, so that models that agree share their weight."""


def evidence(errors: HeldOutErrors, part: Part = EVERYTHING) -> Sequence[Products]:
    """Return the products of errors to expect in a part of the gaps, by each source there is.

    The sources are copies of the gaps in the recording itself, which knows the person, and training
    recordings that take its place, which know such gaps in such motions. Where copies had to be
    shorter than the gaps, the first is multiplied by how much larger the models' errors are in
    training with the gaps than with such copies; where that is not known, training counts alone.
    Where copies hide a few entries only, what they say is moved towards what training says. Without
    a gap there is no source.
    """
    if errors.given.visible.all():
        return []
    own, elsewhere = _mean(errors.in_recording(part)), errors.elsewhere(part)
    gaps = _mean(with_gaps for with_gaps, _ in elsewhere)
    short = errors.are_short(part)
    copies = _mean(with_copies for _, with_copies in elsewhere) if short else gaps
    both = [name for name in own if name in gaps and name in copies]
    if not both:
        return [alone for alone in [own if gaps.empty else gaps] if not alone.empty]
    own, gaps, copies = (each.loc[both, both] for each in (own, gaps, copies))
    growth = np.sqrt(np.diag(gaps) / np.diag(copies))
    grown = own * np.outer(growth, growth)
    return [_steady_products(grown, gaps, errors.n_entries(part)), gaps]


def _steady_products(own: Products, gaps: Products, n_entries: float) -> Products:
    """Return products in the recording itself, moved towards those in training if of few entries.

    Among many models, some err little by chance in a few entries. `_PRIOR_ENTRIES` more are
    supposed, in which models err as in training but for one factor, the geometric mean of theirs.
    """
    factor = np.exp(np.log(np.diag(own) / np.diag(gaps)).mean())
    steadied: Products = n_entries * own + _PRIOR_ENTRIES * factor * gaps
    return steadied / (n_entries + _PRIOR_ENTRIES)


def _mean(held_out: Iterable[Products]) -> Products:
    """Return the mean products of the models that have errors in everything held out."""
    every = [products for products in held_out if not products.empty]
    if not every:
        return pd.DataFrame()
    names = [name for name in every[0] if all(name in products for products in every)]
    total = np.sum([products.loc[names, names].to_numpy() for products in every], axis=0)
    return pd.DataFrame(total / len(every) + _LEAST * np.eye(len(names)), names, names)


def among(sources: Sequence[Products], names: Container[str]) -> Sequence[Products]:
    """Return what the sources say of these models, where they say anything."""
    kept = [name for name in sources[0] if name in names] if sources else []
    return [products.loc[kept, kept] for products in sources if kept]


def expected_errors(sources: Sequence[Products]) -> Mapping[str, float]:
    """Return the geometric mean over the sources of the squared error of each model."""
    if not sources:
        return {}
    logarithms = [np.log(np.diag(products)) for products in sources]
    errors = np.exp(np.mean(logarithms, axis=0)).tolist()
    return dict(zip(map(str, sources[0]), errors, strict=True))


def weights_of(sources: Sequence[Products], shrinkage: float) -> Mapping[str, float]:
    """Return the weights of models, which sum to one: the mean that errs least in what is held out.

    Each source counts in units of the least squared error in it. Correlations between errors are
    moved towards one by the ``shrinkage``, since in few held-out gaps models seem to make up for
    each other's errors more than they will. Without any source the last resort has all the weight.
    """
    if not sources:
        return {LAST_RESORT: 1.0}
    products = np.sum([source / np.diag(source).min() for source in sources], axis=0)
    roots = np.sqrt(np.diag(products))
    correlations = (1.0 - shrinkage) * products / np.outer(roots, roots) + shrinkage
    return dict(zip(map(str, sources[0]), _least_error(correlations, roots), strict=True))


def _least_error(correlations: NDArray[np.float64], roots: NDArray[np.float64]) -> list[float]:
    """Return the shares w that minimise wᵀ R C R w, with R the diagonal of the roots.

    They are those of the y ≥ 0 that minimises ½ yᵀ R C R y − 1ᵀ y, which is a problem of
    non-negative least squares in R y.
    """
    factor = np.linalg.cholesky(correlations + _RIDGE * np.eye(len(roots)))
    scaled, _ = nnls(factor.T, solve_triangular(factor, roots.min() / roots, lower=True))
    shares = scaled / roots
    normalised: list[float] = (shares / shares.sum()).tolist()
    return normalised
