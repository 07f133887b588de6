from .aligned_window import AlignedWindow
from .best_of import BestOf
from .calibrated import Calibrated
from .channel_kriging import ChannelKriging
from .control import Control
from .cpm import CPM
from .cyclic_alignment import CyclicAlignment
from .declarations.abilities import ABILITIES, IMPLIED
from .declarations.needs import NEEDS, Need
from .fam import FAM
from .forecasting.neighbours import NeighbourForecast
from .forecasting.ridge import RidgeForecast
from .forecasting.velocity import ConstantVelocity
from .forecasting.window_process import ProcessForecast
from .gp_independent import GPIndependent
from .gpdm.model import GPDM
from .gplvm import GPLVM
from .hgp import HGP
from .interpolation import (
    CubicSplineImputer,
    HoldImputer,
    LinearImputer,
    MakimaImputer,
    PchipImputer,
)
from .k_cpm import KCPM
from .k_fam import KFAM
from .k_means import KMeans
from .knn import KNN
from .lds import LDS
from .lgssm import LGSSM
from .lmc_independent import LMCIndependent
from .low_rank import LowRank
from .marker_kriging import MarkerKriging
from .moa import MOA
from .mohgp import MOHGP
from .nn import NN
from .oracle import Oracle
from .pca_regression import PCARegression
from .pose_kriging import PoseKriging
from .pose_viterbi import PoseViterbi
from .protocols import (
    Aligner,
    Blender,
    Clusterer,
    Coregionalised,
    Dynamical,
    Embedded,
    Forecaster,
    FrameByStyle,
    FrameImputer,
    Imputer,
    Inductive,
    Interpolator,
    Layered,
    Model,
    Prediction,
    SampleByFrameByChannel,
    StatePath,
    Synthesiser,
    Trended,
)
from .replay import Replay
from .rigid_body import RigidBody
from .trivial import Trivial

__all__ = [
    "ABILITIES",
    "CPM",
    "FAM",
    "GPDM",
    "GPLVM",
    "HGP",
    "IMPLIED",
    "KCPM",
    "KFAM",
    "KNN",
    "LDS",
    "LGSSM",
    "MOA",
    "MOHGP",
    "NEEDS",
    "NN",
    "AlignedWindow",
    "Aligner",
    "BestOf",
    "Blender",
    "Calibrated",
    "ChannelKriging",
    "Clusterer",
    "ConstantVelocity",
    "Control",
    "Coregionalised",
    "CubicSplineImputer",
    "CyclicAlignment",
    "Dynamical",
    "Embedded",
    "Forecaster",
    "FrameByStyle",
    "FrameImputer",
    "GPIndependent",
    "HoldImputer",
    "Imputer",
    "Inductive",
    "Interpolator",
    "KMeans",
    "LMCIndependent",
    "Layered",
    "LinearImputer",
    "LowRank",
    "MakimaImputer",
    "MarkerKriging",
    "Model",
    "Need",
    "NeighbourForecast",
    "Oracle",
    "PCARegression",
    "PchipImputer",
    "PoseKriging",
    "PoseViterbi",
    "Prediction",
    "ProcessForecast",
    "Replay",
    "RidgeForecast",
    "RigidBody",
    "SampleByFrameByChannel",
    "StatePath",
    "Synthesiser",
    "Trended",
    "Trivial",
]
