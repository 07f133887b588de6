"""What a trained model says: predictions, joint covariances, draws and trends."""
