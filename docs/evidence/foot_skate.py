"""What recordings of people score in the metrics of feet: the table of docs/results/positions.md.

Run with the recordings at hand: ``MOCAPBENCH_DATA=… python docs/evidence/foot_skate.py``.
"""

import numpy as np

from mocapbench.baselines import Prediction
from mocapbench.benchmark import ImputeProblem, JointAngles, SynthesiseProblem
from mocapbench.datasets import Archive, open_archive
from mocapbench.metrics import foot_skate, sample_foot_skate

MOTIONS = {
    "walk": ("02_01", "07_01", "07_02", "08_01", "12_01", "16_15", "35_01", "35_03", "39_04"),
    "slow walk, stride": ("07_04", "07_05", "08_04", "08_05", "08_07"),
    "run": ("09_01", "09_02", "09_03", "09_04", "09_05", "09_06"),
    "football kick": ("10_01", "10_02", "10_03", "10_05", "10_06", "11_01"),
    "golf swing": ("64_01", "64_02", "64_03", "64_04"),
    "punches, washing": ("02_05", "02_10"),
}


def scores(archive: Archive, uri: str) -> tuple[float, float]:
    """Return both scores of a recording at 30 frames per second, as if it filled itself."""
    whole = archive.recording(uri)
    recording = whole.frames(np.arange(0, len(whole.times), 4))
    body = JointAngles(archive.skeleton(uri))
    hidden = np.full(recording.values.shape, True)
    filled = ImputeProblem.of_one(recording, hidden, body=body)
    sampled = SynthesiseProblem((recording,), recording.times, 1, (recording.values,), body=body)
    answer = (Prediction(recording.values),)
    return (
        foot_skate(filled.outcome(answer)).value,
        sample_foot_skate(sampled.outcome(recording.values[None])).value,
    )


def main() -> None:
    """Print the median and the range over the recordings of each motion."""
    archive = open_archive()
    for motion, keys in MOTIONS.items():
        columns = np.array([scores(archive, f"cmu:{key}") for key in keys]).T
        cells = (f"{np.median(c):.1f} ({c.min():.1f}–{c.max():.1f})" for c in columns)
        print(f"| {motion} | {len(keys)} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
