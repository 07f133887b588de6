"""Inference by a Kalman filter and smoother over the frames."""
