"""How similar real recordings are to each other (thesis §A.4.2, Tables 18–21)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.tasks.base import Case, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.pages.control_similarity import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.benchmark.tasks.thesis_recordings import EVALUATION, KICKS, WALKS, read_excerpt
from mocapbench.datasets import Archive

__all__ = ["control_similarity", "similarity_problem"]

SYNTHETIC = {"synthetic 1": "gait:01_01", "synthetic 2": "gait:02_01"}


def similarity_problem(
    source: str, seeds: Seeds, archive: Archive, *, references: tuple[str, ...]
) -> SynthesiseProblem:
    """Let one recording stand for the samples, and another for the references."""
    del seeds  # nothing is drawn
    recording = read_excerpt(archive, source, EVALUATION)
    return SynthesiseProblem(
        train=(recording,),
        times=recording.times,
        n_samples=1,
        references=tuple(read_excerpt(archive, uri, EVALUATION).values for uri in references),
    )


def _pairs(
    rows: Mapping[str, str], columns: Mapping[str, str], *, synthetic: bool = False
) -> tuple[Case, ...]:
    return tuple(
        Case(
            f"{row} vs {column}",
            partial(similarity_problem, rows[row], references=(columns[column],)),
            {"recording": row, "reference": column},
            (rows[row],),
            (columns[column],),
            problem_name=row,
            synthetic=synthetic,
        )
        for row in rows
        for column in columns
    )


_CASES = (
    *_pairs(WALKS, WALKS),
    *_pairs(WALKS, KICKS),
    *_pairs(SYNTHETIC, SYNTHETIC, synthetic=True),
)

control_similarity: Task = Task(
    name="control-similarity",
    version=1,
    page=PAGE,
    requires={"replays"},
    cases=_CASES,
    max_folds=1,
    profiles={
        "smoke": Profile(("synthetic 1 vs synthetic 2",), folds=1),
        "quick": Profile(("16(15) vs 35(1)", "synthetic 1 vs synthetic 2"), folds=1),
        "paper": Profile(on_recordings(_CASES), folds=1),
    },
)
"""MCC and MLC between recordings of people; no model takes part but `replay`."""
