"""The harness: tasks, seeds, jobs, store, execution and the command line."""
