"""The tasks: one file each, found through the entry points ``mocapbench.tasks``."""
