"""What ``mocapbench run`` does once jobs are planned: the log, jobs, the last lines."""
