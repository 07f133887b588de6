"""A model with intervals that hold as much as they say."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from typing import Any, Self

from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.calibration.ways import calibrate
from mocapbench.baselines.protocols import FrameImputer, Prediction
from mocapbench.datasets import Recording

__all__ = ["Calibrated"]


class Calibrated(FrameImputer):
    """A model whose variances are multiplied by what its errors in held-out gaps show.

    Means are those of the model to the last bit. When it fills a recording, copies of the gaps are
    held out where the recording is visible; the mean ratio of squared errors to predicted variances
    there, channel by channel, is what the variances are multiplied by. The model learns anew for
    gaps held out of a recording that it has learnt from. ``docs/calibration.md`` has the rules.

    A model may help by methods of its own, none of which it needs:

    * ``leave_one_out(recordings)`` returns for each recording its prediction, and the squared
      errors over variances of its visible entries (N, D), each predicted from all others, with NaN
      where it knows none;
    * ``impute_held_out(recordings)`` predicts recordings of which more is hidden than in ``fit``,
      with parameters that tell little of it: the model then never learns anew;
    * ``least_variances(recordings)`` returns for each recording the least variances (N, D) that
      what is visible supports;
    * ``learns_in_fit = False`` says that it learns when it fills, so that training recordings may
      be held out at no cost.

    All that the model offers besides `impute` is offered by the wrapper, too: ``sample``,
    ``trend``, ``labels_`` and so on are the model's own.

    Parameters
    ----------
    model : FrameImputer
        Its parameters are set as those of a part: ``set_params(model__max_iter=20)``.

    Attributes
    ----------
    model_ : FrameImputer
        The fitted model, whose `impute` gives the uncalibrated variances.
    recordings_ : tuple of Recording
        The recordings given to `fit`.

    References
    ----------
    J. Lei, M. G'Sell, A. Rinaldo, R. J. Tibshirani and L. Wasserman (2018), Distribution-Free
    Predictive Inference for Regression, *Journal of the American Statistical Association*
    113(523):1094–1111, §5.2: errors on data held out, over predicted spreads, scale the intervals.
    The wrapper follows the pattern of scikit-learn's ``CalibratedClassifierCV``.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import LDS, Calibrated
    >>> from mocapbench.datasets import Recording
    >>> def swing(name, phase):
    ...     angle = 2 * np.pi * np.arange(60) / 10 + phase
    ...     values = np.column_stack([np.sin(angle), np.cos(angle)])
    ...     return Recording(name, np.arange(60) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> model = Calibrated(LDS(n_states=2)).fit([swing("a", 0.0), swing("b", 1.0)])
    >>> hidden = np.zeros((60, 2), dtype=bool)
    >>> hidden[20:26] = True
    >>> given = swing("new", 2.0).hide(hidden)
    >>> (calibrated,), (nominal,) = model.impute([given]), model.model_.impute([given])
    >>> bool((calibrated.mean == nominal.mean).all())
    True
    """

    def __init__(self, model: FrameImputer) -> None:
        self.model = model

    @property
    def provides(self) -> frozenset[str]:  # type: ignore[override]  # of the class elsewhere
        """The abilities of the model."""
        return self.model.provides

    @property
    def needs(self) -> frozenset[str]:  # type: ignore[override]
        """The needs of the model."""
        return self.model.needs

    @property
    def family(self) -> str:  # type: ignore[override]
        """The family of the model."""
        return self.model.family

    @property
    def max_frames(self) -> int | None:  # type: ignore[override]
        """The most frames that the model fills in some seconds."""
        return self.model.max_frames

    def fit(self, recordings: Sequence[Recording], **needed: Any) -> Self:
        """Fit the model.

        Parameters
        ----------
        recordings : sequence of Recording
        **needed
            What the model needs besides. It then does not learn anew.

        Raises
        ------
        ValueError
            If the model refuses the recordings, or one of its parameters.
        """
        self.model_: FrameImputer = copy(self.model).fit(recordings, **needed)
        self.recordings_: tuple[Recording, ...] = tuple(recordings)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of the model, with calibrated variances.

        Raises
        ------
        ValueError
            If the model refuses the recordings.
        """
        check_is_fitted(self)
        return calibrate(self.model_, self.recordings_, recordings)

    def impute_uncalibrated(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of the model, as it gives them."""
        check_is_fitted(self)
        return self.model_.impute(recordings)

    def __getattr__(self, name: str) -> Any:
        """Return what the model offers and the wrapper has not."""
        inner = vars(self).get("model_", vars(self).get("model"))
        if inner is None or name.startswith("__"):
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        return getattr(inner, name)
