"""From recordings in a tree of replicates to the blocks that solvers solve, exactly."""
