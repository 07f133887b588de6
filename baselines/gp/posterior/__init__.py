"""Posterior of a trained model: predictions, joint covariances, draws and trends."""
