"""The papers in full, by the short names that titles and remarks use."""

from __future__ import annotations

import re
from collections.abc import Iterable

__all__ = ["CITATIONS", "citations_of"]

CITATIONS = {
    "thesis": (
        "J. D. Gil López, Hierarchical Multiple Output Gaussian Processes for Human Motion Data, "
        "MSc thesis, Universidad Tecnológica de Pereira, 2017"
    ),
    "GPDM": (
        "J. M. Wang, D. J. Fleet and A. Hertzmann, Gaussian Process Dynamical Models for Human "
        "Motion, IEEE Transactions on Pattern Analysis and Machine Intelligence, 2008"
    ),
    "HLM": (
        "W. Pan and L. Torresani, Unsupervised Hierarchical Modeling of Locomotion Styles, "
        "International Conference on Machine Learning, 2009"
    ),
    "Taylor": (
        "G. W. Taylor, G. E. Hinton and S. T. Roweis, Modeling Human Motion Using Binary Latent "
        "Variables, Advances in Neural Information Processing Systems 19, 2006"
    ),
    "Lawrence": (
        "N. D. Lawrence, Learning for Larger Datasets with the Gaussian Process Latent Variable "
        "Model, International Conference on Artificial Intelligence and Statistics, 2007"
    ),
    "Mao": (
        "W. Mao, M. Liu, M. Salzmann and H. Li, Learning Trajectory Dependencies for Human Motion "
        "Prediction, International Conference on Computer Vision, 2019"
    ),
    "Dang": (
        "L. Dang, Y. Nie, C. Long, Q. Zhang and G. Li, MSR-GCN: Multi-Scale Residual Graph "
        "Convolution Networks for Human Motion Prediction, International Conference on Computer "
        "Vision, 2021"
    ),
    "Ma": (
        "T. Ma, Y. Nie, C. Long, Q. Zhang and G. Li, Progressively Generating Better Initial "
        "Guesses Towards Next Stages for High-Quality Human Motion Prediction, Conference on "
        "Computer Vision and Pattern Recognition, 2022"
    ),
    "Harvey": (
        "F. G. Harvey, M. Yurick, D. Nowrouzezahrai and C. Pal, Robust Motion In-betweening, ACM "
        "Transactions on Graphics 39(4), 2020, by the code of the data set LaFAN1"
    ),
    "Oreshkin": (
        "B. N. Oreshkin and others, Motion Inbetweening via Deep Delta-Interpolator, 2022, values "
        "printed in the repository of its code"
    ),
    "Qin": (
        "J. Qin and others, Motion In-betweening via Two-stage Transformers, ACM Transactions on "
        "Graphics 41(6), 2022, values printed in the repository of its code"
    ),
    "Kieu": (
        "D. H. Kieu and others, Locally weighted PCA regression to recover missing markers in "
        "human motion data, PLoS ONE 17(8), 2022, and the repository dangkh/LWPCA"
    ),
    "Wan": "GGMotion, values printed in the repository of its code, 2025",
}
"""Short name to full citation."""


def citations_of(references: Iterable[str]) -> dict[str, str]:
    """Return the citations of the papers that ``references`` name, in order of appearance.

    Parameters
    ----------
    references : iterable of str
        Places in papers, such as ``"thesis §5.1.1, Tables 1–3"``.
    """
    words = (word for reference in references for word in re.findall(r"\w+", reference))
    return {word: CITATIONS[word] for word in dict.fromkeys(words) if word in CITATIONS}
