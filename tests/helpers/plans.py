"""Plans of run directories that tests write record by record."""

from mocapbench.benchmark.runs.plan_document import PlannedJob, plan_document


def plan_of(records, **provenance):
    """Return the plan of a run that left these records."""
    jobs = [PlannedJob(r.key, r.fit_key, r.address, training_key="") for r in records]
    return plan_document(jobs, provenance=provenance)
