r"""The multiple-output hierarchical Gaussian process (MOHGP; thesis §4).

Every recording is a child of one parent: :math:`g \sim \mathcal{GP}(0, K_g)`,
:math:`f_r \sim \mathcal{GP}(g, K_f)`, :math:`y_r = f_r + \varepsilon_r`, with a linear model of
coregionalisation in both layers (thesis eq. 16 and 17). In a tree there are groups in between,
:math:`e_i \sim \mathcal{GP}(g, K_e)`, :math:`f_{ir} \sim \mathcal{GP}(e_i, K_f)` (thesis eq. 8).

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, is cited as the thesis.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_recordings
from mocapbench.baselines.common.validation import check_choice
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.parameter_docs import document_like
from mocapbench.baselines.gp.prior.parameters import CHILD
from mocapbench.baselines.gp.reduction.hierarchy import reduce_hierarchy
from mocapbench.baselines.gp.reduction.reduction import Reduction, Replicates
from mocapbench.baselines.gp.reduction.tree import Path, Tree, grow, is_path
from mocapbench.baselines.gp.registration import REGISTRATIONS, TimeMap
from mocapbench.baselines.protocols import Trended
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = ["MOHGP"]


@document_like(GaussianProcess)
@dataclass(kw_only=True, eq=False, repr=False)
class MOHGP(GaussianProcess, Trended):
    r"""A Gaussian process over all channels, in which recordings vary around a common trend.

    `impute` gives the posterior of each child. `sample` follows the thesis: new children are drawn
    from K_f around the trend's posterior mean, or around a draw of the trend with
    ``sampled_trend="posterior"``; in a tree, they are children of new groups.

    Parameters
    ----------
    tree : mapping of str to sequence of str or None, default=None
        For the name of each recording its groups, from the largest to the smallest and equally
        many for all, such as ``{"02_01": ("walk", "subject 2"), ...}``. Groups with the same name
        within different groups are different. The layers are then ``"parent"``, ``"group-1"``,
        ``"group-2"`` and so on, ``"child"``. None makes every recording a child of the trend.
    registration : {"none", "affine"}, default="none"
        Whether complete recordings are first moved in time by an affine map, to where they are most
        like the visible entries of the recording with the most hidden ones (or like the first, if
        none has any). It suits repetitions of one movement that do not begin with the same phase.
        Times of the trend and of samples are then those of that recording. The likelihood is that
        of the recordings as they were moved, without what is moved beyond that recording's first
        or last frame: it does not compare with that of another registration.

    Attributes
    ----------
    clocks_ : dict of str to TimeMap
        By the name of each recording, how ``registration`` moved it in time.

    Notes
    -----
    With the trend g, recording r, and kernels :math:`k_{\tau q}` of unit variance in each layer τ:

    .. math::

        g \sim \mathcal{GP}(0, K_g), \qquad f_r \mid g \sim \mathcal{GP}(g, K_f)

    .. math::

        y_{rd}(t) = f_{rd}(t) + \varepsilon, \qquad \varepsilon \sim N(0, \beta_d)

    .. math::

        K_\tau = \sum_q B_{\tau q} \otimes k_{\tau q}, \qquad
        B_{\tau q} = W_{\tau q} W_{\tau q}^\top + \operatorname{diag}(\kappa_{\tau q})

    ``docs/mathematics/inference.md`` has the inference.

    References
    ----------
    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira:
    the model §4, eq. (16) and (17); training eq. (25); the tree eq. (8); synthesis §5.2.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import MOHGP
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> times = np.linspace(0.0, 6.0, 20)
    >>> children = process.draw(rng, times, 3)
    >>> model = MOHGP(kernel="rbf", max_iter=20).fit(children)
    >>> mean, variance = model.trend(np.linspace(0.0, 6.0, 5))
    >>> mean.shape, variance.shape
    ((5, 2), (5, 2))
    >>> tree = {"child-1": ("slow",), "child-2": ("slow",), "child-3": ("fast",)}
    >>> model = MOHGP(tree=tree, kernel="rbf", max_iter=20).fit(children)
    >>> model.layers
    ('parent', 'group-1', 'child')
    >>> mean, variance = model.trend(np.linspace(0.0, 6.0, 5), group=("slow",))
    """

    tree: Mapping[str, Path] | None = None
    registration: str = "none"
    n_restarts: int = 5

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Register the recordings, and find the parameters of largest likelihood.

        Parameters
        ----------
        recordings : sequence of Recording
            Recordings with the same channels and different names; NaN marks a hidden entry. Times
            may differ and be irregular.

        Returns
        -------
        MOHGP
            The model itself.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, a channel is nowhere visible, or a warm start has parameters of other shapes.
        SingularCovarianceError
            If the covariance is singular at a start.
        """
        check_choice("registration", self.registration, REGISTRATIONS)
        given = check_recordings(recordings)
        registered = REGISTRATIONS[self.registration](given)
        super().fit([moved for moved, _ in registered])
        # What `impute` takes. Only complete recordings have moved, of which nothing is to fill.
        named = {recording.name: recording for recording in given}
        self.recordings_: dict[str, Recording] = {name: named[name] for name in self.recordings_}
        self.clocks_: dict[str, TimeMap] = {moved.name: clock for moved, clock in registered}
        return self

    def _process_times(self, recording: Recording, times: Frames | None) -> Frames:
        return self.clocks_[recording.name].to_reference(super()._process_times(recording, times))

    def grow(self, names: Sequence[str]) -> Tree:
        """Return for each layer the draw that each recording depends on.

        Raises
        ------
        ValueError
            If ``tree`` does not have a path for each recording and no other, or its paths are not
            equally long sequences of names.
        """
        return grow(names, self.tree)

    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""
        return reduce_hierarchy(replicates, self.tree_)

    def trend(self, times: Frames, group: Path = ()) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of g or of a group at ``times`` (N,).

        Parameters
        ----------
        times : ndarray of shape (N,)
            In seconds.
        group : sequence of str, default=()
            The group as in ``tree``; () is the common trend.

        Returns
        -------
        mean, variance : ndarray of shape (N, D)
            In the outputs' own units, noise left out.

        Raises
        ------
        ValueError
            If there is no such group.
        """
        check_is_fitted(self)
        nodes = self.process_.reduction.nodes
        if not is_path(group) or tuple(group) not in nodes:
            known = sorted(set().union(*self.tree_.values()) - set(self.tree_[CHILD]))
            raise ValueError(f"expected a group of the tree, one of {known}, got {group!r}")
        return self._infer_curve(nodes[tuple(group)], times)
