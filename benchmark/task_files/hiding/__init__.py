"""What a task file hides: frames, entries, gaps, or the gaps of another file; one way a module."""
