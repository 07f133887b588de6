"""Pictures of tasks: curves, matrices and paths through space."""
