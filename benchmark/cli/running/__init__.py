"""What ``mocapbench run`` does once jobs are planned: signals, the log, jobs, the last lines."""
