"""Runs: from a request to jobs, from jobs to records in a store.

In the order in which a run goes: `plan` makes the jobs and `keys` names them, `run` skips what the
`store` holds, `execution` gives every other job a process of its own, here or (`cluster`) on other
machines, in which `evaluate` fits, answers (`solve`) and scores; each ends as a `record`.
"""
