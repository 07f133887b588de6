"""Hidden markers: the masks of a paper on its recording, masks alike, and gaps as real files have.

After D. H. Kieu and others, *Locally weighted PCA regression to recover missing markers in human
motion data*, PLoS ONE 17(8), 2022, whose masks and errors its authors publish one by one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.masks import hide_runs
from mocapbench.benchmark.tasks.base import Case, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.pages.marker_masks import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import FRAME_RATE, Archive, Mask, Recording, joint_trajectories, subject_of
from mocapbench.datasets.occlusion.fixed_masks import MarkerRun, fixed_masks
from mocapbench.datasets.occlusion.real_gaps import real_gaps

__all__ = ["N_HIDDEN", "STRETCHES", "hide_alike", "hide_as_in_files", "marker_masks"]

N_HIDDEN = (3, 6, 9)
"""How many markers the masks of the paper hide."""
N_FOLDS = 50
SHARE = 370 / 400
"""Of the frames, those in which the paper's masks hide a marker."""
N_BESIDE = 5  # visible frames at either end, at the least, where gaps are as in real files

PAPERS, OTHER, SYNTHETIC = "cmu:135_02.c3d", "cmu:85_02.c3d", "gait:01_01"
STRETCHES: Mapping[str, tuple[tuple[int, int], ...]] = {
    PAPERS: ((50, 450), (450, 850), (1050, 1450), (1450, 1850)),
    OTHER: ((50, 450), (450, 810)),
    SYNTHETIC: ((50, 250), (250, 331)),
}
"""By recording, which frames are tested, counted from 0, end excluded, and which are learnt from.

Where the paper's own reference held frames 250 to 649, of which 200 are tested, there are 450 to
849 here.
"""

Hide = Callable[[Seeds, Recording], Mask]
"""From the streams of a fold to what is hidden of a recording."""


def hide_as_published(seeds: Seeds, recording: Recording, *, n_hidden: int) -> Mask:
    """Hide what the fold's mask of the paper hides."""
    return _hide_markers(fixed_masks(n_hidden)[seeds.fold], recording)


def hide_alike(seeds: Seeds, recording: Recording, *, n_hidden: int) -> Mask:
    """Hide other markers at other times, for as long as the masks of the paper do.

    Parameters
    ----------
    seeds : Seeds
    recording : Recording
        Of N frames; each marker is hidden in `SHARE` of them, from frame 2 on at the earliest.
    n_hidden : int
        How many markers.
    """
    rng, n_frames = seeds.generator("mask"), len(recording.times)
    length = round(SHARE * n_frames)
    markers = rng.choice(len(_list_markers(recording)), n_hidden, replace=False)
    starts = rng.integers(1, n_frames - length, n_hidden, endpoint=True)
    runs = zip(markers.tolist(), starts.tolist(), (starts + length).tolist(), strict=True)
    return _hide_markers([*runs], recording)


def hide_as_in_files(seeds: Seeds, recording: Recording) -> Mask:
    """Hide markers for as long, as often and as many at a time as in one of `real_gaps`.

    Folds go through the files. Of a file, groups of gaps that overlap are drawn with replacement,
    as many as it has in the time of the recording. The longest gap of a group lies anywhere, and
    the others where they overlap with it, each in a marker of its own.
    """
    rng, files = seeds.generator("mask"), [*real_gaps().values()]
    seconds, groups = files[seeds.fold % len(files)]
    n_frames, n_markers = len(recording.times), len(_list_markers(recording))
    n_groups = max(1, round(len(groups) * n_frames / FRAME_RATE / seconds))
    runs: list[MarkerRun] = []
    for group in rng.choice(len(groups), n_groups):
        lengths = [_count_frames(length, n_frames) for length in groups[group]]
        markers = np.resize(rng.permutation(n_markers), len(lengths)).tolist()
        bounds = _place_overlapping(rng, lengths, n_frames)
        runs += [(marker, *bound) for marker, bound in zip(markers, bounds, strict=True)]
    return _hide_markers(runs, recording)


def _count_frames(seconds: float, n_frames: int) -> int:
    """Return how many of the frames a gap takes: one at least, and not those at the ends."""
    return min(max(round(seconds * FRAME_RATE), 1), n_frames - 2 * N_BESIDE)


def _place_overlapping(
    rng: np.random.Generator, lengths: Sequence[int], n_frames: int
) -> Iterator[tuple[int, int]]:
    """Yield first frames and ends of gaps, each of which overlaps with the first, the longest."""
    longest = lengths[0]
    begin = int(rng.integers(N_BESIDE, n_frames - N_BESIDE - longest, endpoint=True))
    yield begin, begin + longest
    for length in lengths[1:]:
        earliest = max(begin - length + 1, N_BESIDE)
        latest = min(begin + longest - 1, n_frames - N_BESIDE - length)
        start = int(rng.integers(earliest, latest, endpoint=True))
        yield start, start + length


def _list_markers(recording: Recording) -> list[str]:
    return [*dict.fromkeys(channel.rpartition(".")[0] for channel in recording.channels)]


def _hide_markers(runs: Sequence[MarkerRun], recording: Recording) -> Mask:
    names = _list_markers(recording)
    channels = [tuple(f"{names[marker]}.{axis}" for axis in "xyz") for marker, *_ in runs]
    lengths = [(start, stop - start) for _, start, stop in runs]
    return hide_runs(zip(channels, *zip(*lengths, strict=True), strict=True), recording)


def marker_masks_problem(
    seeds: Seeds, archive: Archive, *, recording: str, hide: Hide
) -> ImputeProblem:
    """Hide markers in a stretch of a recording, of which other stretches are learnt from.

    Parameters
    ----------
    seeds, archive
        See `mocapbench.benchmark.tasks.base.Case`.
    recording : str
        A key of `STRETCHES`.
    hide : callable
        From the seeds and the stretch to what is hidden.
    """
    whole = _read_markers(archive, recording)
    tested, *others = (_cut_stretch(whole, *bounds) for bounds in STRETCHES[recording])
    return ImputeProblem.of_one(tested, hide(seeds, tested), others)


def _read_markers(archive: Archive, uri: str) -> Recording:
    """Return the coordinates of markers; of generated gait, those of its joints."""
    recording = archive.recording(uri)
    if uri != SYNTHETIC:
        return recording
    return joint_trajectories(archive.skeleton(uri), recording)


def _cut_stretch(recording: Recording, start: int, stop: int) -> Recording:
    stretch = recording.frames(np.arange(start, stop))
    return replace(stretch, name=f"{recording.name} from {start + 1}")


def _build_case(name: str, recording: str, hidden: str, hide: Hide) -> Case:
    return Case(
        name,
        partial(marker_masks_problem, recording=recording, hide=hide),
        {"recording": recording, "hidden": hidden},
        (recording,),
        synthetic=recording == SYNTHETIC,
        # All masks of a case are on one recording: together they are one person, not fifty.
        subjects=() if recording == SYNTHETIC else (subject_of(recording),),
    )


def _build_cases() -> Iterator[Case]:
    for n in N_HIDDEN:
        markers = f"{n} markers"
        yield _build_case(markers, PAPERS, markers, partial(hide_as_published, n_hidden=n))
    for n in N_HIDDEN:
        markers = f"{n} markers"
        yield _build_case(f"85_02 {markers}", OTHER, markers, partial(hide_alike, n_hidden=n))
    for number, recording in (("135_02", PAPERS), ("85_02", OTHER), ("synthetic", SYNTHETIC)):
        yield _build_case(f"{number} real gaps", recording, "as in real files", hide_as_in_files)
    hide = partial(hide_alike, n_hidden=3)
    yield _build_case("synthetic 3 markers", SYNTHETIC, "3 markers", hide)


_CASES = tuple(_build_cases())

_SLOW = (
    *("best-of", "cyclic-alignment", "fam", "gp-independent", "hgp", "lds"),
    *("lmc-independent", "moa", "mohgp"),
)
"""Models that take minutes for 123 outputs and 400 frames or more."""

marker_masks: Task = Task(
    name="marker-masks",
    version=1,
    page=PAGE,
    requires={"fills entries"},
    cases=_CASES,
    meets={"coordinates"},
    max_folds=N_FOLDS,
    profiles={
        "smoke": Profile(("synthetic 3 markers",), 1, {"max_iter": 2, "n_restarts": 1}, _SLOW),
        "paper": Profile(on_recordings(_CASES), N_FOLDS, {}, _SLOW),
    },
)
"""Markers are hidden for three seconds, or as in real files, and other stretches learnt from."""
