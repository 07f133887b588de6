"""The models, one module each, behind the abilities of `mocapbench.baselines.protocols`."""

from mocapbench.baselines.protocols import (
    FrameImputer,
    Imputer,
    Inductive,
    Informed,
    Model,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)

__all__ = [
    "FrameImputer",
    "Imputer",
    "Inductive",
    "Informed",
    "Model",
    "Prediction",
    "SampleByFrameByChannel",
    "Synthesiser",
]
