"""Runs on the workers of a dask cluster.

`scheduler` and `local` give the run's own process a `backend`, whose `executor` submits the jobs.
On every dask worker a `worker_state` gives each job a killable process, as on one machine. What the
workers need travels to them: `run_plugin` carries the user's own files (`plugin_files`), and the
`installation` of every worker must be that of the run.

They need the package `distributed`, and are loaded only if a cluster is asked for.
"""
