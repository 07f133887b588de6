"""Runs: from a request to jobs, from jobs to records in a store.

In the order in which a run goes: `plan` makes the jobs and `keys` names them, `run` skips what the
`store` holds, `execution` gives every other job to a worker, here or (`cluster`) on other machines,
which poses and scores it (`evaluate`); its model fits and predicts (`fit_attempt`) in a process of
its own. Each job ends as a `record`.
"""
