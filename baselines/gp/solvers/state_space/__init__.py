"""Inference in a state-space model: Kalman filter and smoother, linear in frames."""
