"""The tasks, one protocol a module, found through the entry points ``mocapbench.tasks``.

`base` says what a task is, `seeds` and `address` how its random numbers and jobs are known;
`pages` holds what the report shows of each. The recordings of the papers are in
`thesis_recordings` and `hlm_recordings`.
"""
