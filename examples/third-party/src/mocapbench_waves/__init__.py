"""A model, a task and a metric for mocapbench."""
