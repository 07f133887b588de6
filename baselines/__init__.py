"""The models, one module each, behind the abilities of `mocapbench.baselines.protocols`."""

from mocapbench.baselines.protocols import (
    Aligner,
    Blender,
    Clusterer,
    Coregionalised,
    FrameByStyle,
    FrameImputer,
    Imputer,
    Inductive,
    Informed,
    Layered,
    Model,
    Prediction,
    SampleByFrameByChannel,
    StatePath,
    Synthesiser,
    Trended,
)

__all__ = [
    "Aligner",
    "Blender",
    "Clusterer",
    "Coregionalised",
    "FrameByStyle",
    "FrameImputer",
    "Imputer",
    "Inductive",
    "Informed",
    "Layered",
    "Model",
    "Prediction",
    "SampleByFrameByChannel",
    "StatePath",
    "Synthesiser",
    "Trended",
]
