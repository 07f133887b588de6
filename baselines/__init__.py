"""The models, one module each, behind the abilities of `mocapbench.baselines.protocols`."""

from mocapbench.baselines.protocols import (
    Aligner,
    Blender,
    Clusterer,
    FrameByStyle,
    FrameImputer,
    Imputer,
    Inductive,
    Informed,
    Misinformed,
    Model,
    Prediction,
    SampleByFrameByChannel,
    StatePath,
    Synthesiser,
)

__all__ = [
    "Aligner",
    "Blender",
    "Clusterer",
    "FrameByStyle",
    "FrameImputer",
    "Imputer",
    "Inductive",
    "Informed",
    "Misinformed",
    "Model",
    "Prediction",
    "SampleByFrameByChannel",
    "StatePath",
    "Synthesiser",
]
