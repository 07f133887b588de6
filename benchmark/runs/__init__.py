"""Runs: from a request to jobs, from jobs to records in a store.

In the order in which a run goes: `plan` makes the jobs and `keys` names them, `run` skips what the
`store` holds, `pool` gives every other job a process of its own, in which `evaluate` fits, answers
(`solve`) and scores; each ends as a `record`.
"""
