"""Several models, averaged with the weights that err least in copies of the gaps at hand."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from typing import ClassVar, Self

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.choosing.candidates import LAST_RESORT, FittedCandidates
from mocapbench.baselines.choosing.held_out_errors import HeldOutErrors, Products
from mocapbench.baselines.choosing.parts import parts_of
from mocapbench.baselines.choosing.weights import among, evidence, expected_errors, weights_of
from mocapbench.baselines.common.checks import check_channels, check_recordings, check_spread
from mocapbench.baselines.common.recordings import by_content
from mocapbench.baselines.common.validation import check_share
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["BestOf"]


class BestOf(Imputer, Inductive):
    r"""The mean of several models, weighted by how well each fills copies of the gaps.

    A model that is best on walks may be bad for someone who stands still. For every recording to
    fill, copies of its gaps are therefore hidden where its entries are visible, and every candidate
    fills them. Where the visible stretches are shorter than the gaps, the copies are shorter, which
    flatters models that only interpolate. Up to three training recordings then take the place of
    the one to fill, in turn and left out of training: by what a candidate's error grows there from
    the copies to the gaps, its error is multiplied.

    Results do not depend on whether angles are in degrees or radians, and lengths in mm, cm or m.
    Channels of one unit share their weights, and have others for gaps in all channels, and for
    channels that are hidden throughout, if there are gaps of other kinds besides. In place of
    channels that are hidden throughout, copies hide other channels of their unit.

    Weights are those of stacked regression: :math:`w = \arg\min w^\top G w` over :math:`w \ge 0,
    \sum_i w_i = 1`. :math:`G = \sum_s G_s / \min_i G_{s,ii}` adds up the sources s of evidence,
    each with the mean products :math:`G_{s,ij}` to expect of the errors of candidates i and j,
    whose correlations :math:`\rho_{ij}` become :math:`(1 - \lambda) \rho_{ij} + \lambda` with the
    ``shrinkage`` :math:`\lambda`. The prediction is the mixture of the candidates' distributions:
    its variance includes how far they lie apart. The variance of a candidate that has none is the
    geometric mean of its squared errors :math:`G_{s,ii}`. Where copies of the gaps hide a few
    entries only, what they say is moved towards what training says: ten more entries are supposed,
    in which candidates err as there.

    Candidates are the interpolations, ``lds``, ``fam``, ``low-rank``, ``pca-regression``, ``nn``,
    ``aligned-window``, ``pose-kriging``, ``channel-kriging``, and ``mohgp`` with three components
    and with one and five that registers recordings; where channels are coordinates of markers,
    ``rigid-body`` and ``marker-kriging`` besides. Those that cannot fill a mask, or not learn
    from the recordings, are left out (``left_out_`` has why). ``mohgp`` takes
    part where a recording given to `fit` has hidden entries, as where those to fill are among them,
    and all are few and small: three walks of 90 frames and 39 channels, which take a minute. It
    keeps its parameters where gaps are held out. The seed of ``fam`` is fixed: nothing is random.

    Parameters
    ----------
    shrinkage : float, default=0.5
        How far the correlations between candidates' errors are moved from those held out, at 0,
        towards one, at 1, where the best candidate has all the weight.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    recordings_ : tuple of Recording
        The recordings given to `fit`, of which some are held out.
    candidates_ : FittedCandidates
        The candidates, fitted to them.
    left_out_ : mapping of str to str
        Why other candidates cannot learn from them, by name.

    References
    ----------
    L. Breiman (1996), Stacked regressions, *Machine Learning* 24:49–64, for the weights. The
    evidence and the shrinkage are not from a publication.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import BestOf
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(60) / 30
    >>> values = np.column_stack([times, -times])
    >>> line = Recording("line", times, values, ("x", "y"), ("cm", "cm"))
    >>> gap = np.repeat(((times > 0.9) & (times < 1.2))[:, None], 2, axis=1)
    >>> model = BestOf().fit([line.hide(gap)])
    >>> (weights,) = model.weights([line.hide(gap)])
    >>> weights.sum().round(9).to_dict()
    {'cm': 1.0}
    >>> (prediction,) = model.impute([line.hide(gap)])
    >>> bool(np.abs(prediction.mean - values).max() < 1e-3)
    True
    """

    family: ClassVar[str] = "Several models"
    provides: ClassVar[frozenset[str]] = Imputer.provides | Inductive.provides | {"scales along"}

    max_frames: ClassVar[int | None] = 1000

    def __init__(self, shrinkage: float = 0.5) -> None:
        self.shrinkage = shrinkage

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Fit the candidates.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, or a channel has a single visible entry.
        """
        check_share("shrinkage", self.shrinkage)
        checked = check_recordings(recordings)
        check_spread(checked)
        self.recordings_: tuple[Recording, ...] = by_content(checked)
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.candidates_: FittedCandidates = FittedCandidates.of(self.recordings_)
        self.left_out_: Mapping[str, str] | dict[str, str] = self.candidates_.left_out
        return self

    def weights(self, recordings: Sequence[Recording]) -> list[pd.DataFrame]:
        """Return the weights of the candidates that can fill a recording: (C, U).

        There is a row for each candidate and a column for each unit of the channels; columns sum to
        one. Where a recording has gaps of several kinds, there are other columns for each unit:
        ``"deg, whole frames"`` is that of gaps in all channels, ``"deg, whole channels"`` that of
        channels that are hidden throughout.

        Raises
        ------
        ValueError
            If channels differ.
        """
        return [
            self._weights(
                self._sources(self._hold_out(recording), self.candidates_.means(recording))
            )
            for recording in self._check_recordings(recordings)
        ]

    def _sources(
        self, errors: HeldOutErrors, names: Container[str]
    ) -> Mapping[str, Sequence[Products]]:
        """Return the sources of evidence on each part of the gaps."""
        return {
            name: among(evidence(errors, part) or evidence(errors, part.widely), names)
            for name, part in parts_of(errors.given).items()
        }

    def _weights(self, sources: Mapping[str, Sequence[Products]]) -> pd.DataFrame:
        by_part = {part: weights_of(each, self.shrinkage) for part, each in sources.items()}
        return pd.DataFrame(by_part).fillna(0.0)

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the weighted mean of the candidates, and the variance of their mixture.

        Raises
        ------
        ValueError
            If channels differ, or a channel is visible neither in a recording nor in those given to
            `fit`.
        """
        return [self._mixture(recording) for recording in self._check_recordings(recordings)]

    def _check_recordings(self, recordings: Sequence[Recording]) -> Sequence[Recording]:
        check_is_fitted(self)
        check_channels(recordings, self.channels_, self.units_)
        return recordings

    def _hold_out(self, recording: Recording) -> HeldOutErrors:
        return HeldOutErrors(self.recordings_, self.candidates_, recording)

    def _mixture(self, recording: Recording) -> Prediction:
        filled = self.candidates_.means(recording)
        if LAST_RESORT not in filled:  # it says what nothing can fill
            return self.candidates_.models[LAST_RESORT].impute([recording])[0]
        held_out = self._hold_out(recording)
        sources = self._sources(held_out, filled)
        weights = self._weights(sources)
        weights = weights[(weights > 0.0).any(axis=1)]
        errors = pd.DataFrame({part: expected_errors(each) for part, each in sources.items()})
        errors = errors.reindex(weights.index).fillna(1.0)
        filled_by = self.candidates_.impute(recording, weights.index)
        predictions = [filled_by[name] for name in weights.index]
        shares, expected = (_spread_over_entries(table, recording) for table in (weights, errors))
        means = np.stack([prediction.mean for prediction in predictions])
        expected = expected * held_out.scale**2
        variances = np.stack(list(map(_variance_or_expected, predictions, expected)))
        mean = (shares * means).sum(axis=0)
        variance = (shares * (variances + (means - mean) ** 2)).sum(axis=0)
        return Prediction.around(recording, mean, variance)


def _spread_over_entries(by_part: pd.DataFrame, recording: Recording) -> NDArray[np.float64]:
    """Return a table of candidates and parts for every entry: (C, N, D)."""
    spread = np.empty((len(by_part), *recording.values.shape))
    for name, part in parts_of(recording).items():
        spread[:, part.entries(~recording.visible)] = by_part[[name]].to_numpy()
    return spread


def _variance_or_expected(prediction: Prediction, expected: FrameByChannel) -> FrameByChannel:
    """Return the variance of a candidate (N, D), or the expected one if it predicts none."""
    return expected if prediction.variance is None else prediction.variance
