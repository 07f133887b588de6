"""From recordings in a tree of replicates to independent block problems, exactly."""
