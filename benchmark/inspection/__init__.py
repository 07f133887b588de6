"""Inspection: what state a run is in, and why a job runs or does not."""
