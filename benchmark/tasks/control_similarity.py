"""How similar real recordings are: what the scores of samples mean (thesis §A.4.2)."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.baselines.replay import Replay
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.tasks.base import Case, Selection, Task, without_stand_ins
from mocapbench.benchmark.tasks.mocap_synthesis import KICKS, WALKS
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.benchmark.tasks.thesis_recordings import EVALUATION, read_excerpt
from mocapbench.datasets import Archive

__all__ = ["ControlSimilarity", "control_similarity"]

SYNTHETIC = {"synthetic 1": "gait:01_01", "synthetic 2": "gait:02_01"}


def _pairs(
    rows: Mapping[str, str], columns: Mapping[str, str], *, synthetic: bool = False
) -> tuple[Case, ...]:
    return tuple(
        Case(
            f"{row} vs {column}",
            {"recording": row, "reference": column},
            (rows[row],),
            references=(columns[column],),
            question=row,
            published=None if synthetic else f"{row} vs {column}",
            synthetic=synthetic,
            remark="Generated gait, not recordings of people." if synthetic else "",
        )
        for row in rows
        for column in columns
    )


class ControlSimilarity(Task):
    """Tables 18–21: MCC and MLC between recordings of people, where no model has a part."""

    name = "control-similarity"
    version = 1
    title = "Similarity of real recordings"
    reference = "thesis §A.4.2, Tables 18–21"
    description = (
        "Each walk that samples are compared with is itself compared with every such walk and "
        "with every soccer kick: as much similarity as real motions have. The recording is "
        "replayed as it is; MCC of a recording with itself is what a sample could reach."
    )
    kind = "synthesise"
    requires = (Replay,)
    cases = (
        *_pairs(WALKS, WALKS),
        *_pairs(WALKS, KICKS),
        *_pairs(SYNTHETIC, SYNTHETIC, synthetic=True),
    )
    max_folds = 1
    metrics = ("mcc", "mlc")
    profiles = {
        "smoke": Selection(("synthetic 1 vs synthetic 2",), folds=1),
        "quick": Selection(("16(15) vs 35(1)", "synthetic 1 vs synthetic 2"), folds=1),
        "paper": Selection(without_stand_ins(cases), folds=1),
    }
    crossed = ("recording", "reference")
    published_models = {"replay": "real"}
    published_metrics = {"mcc": "MCC", "mlc": "MLC"}

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> SynthesiseProblem:
        """Let one recording stand for the samples."""
        del seeds  # nothing is drawn
        recording, reference = (
            read_excerpt(archive, uri, EVALUATION) for uri in (*case.sources, *case.references)
        )
        return SynthesiseProblem(
            train=(recording,),
            process=None,
            times=recording.times,
            n_samples=1,
            references=(reference.values,),
        )


control_similarity = ControlSimilarity()
