"""The common estimator of models that align recordings to one cycle."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Collection, Mapping, Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.cycle_model import Hyperparameters, State
from mocapbench.baselines.alignment.cycle_start import GROUPINGS, best_paths, default_states
from mocapbench.baselines.alignment.inference import infer_path
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.common.ascent import Ascent
from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.common.cycle_settings import check_settings
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.common.recordings import by_content, places_by_content
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.validation import check_choice
from mocapbench.baselines.protocols import Aligner, StatePath
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["CycleAligner"]

_CHOICES: Mapping[str, Collection[str]] = {"prior": PRIORS, "grouping": GROUPINGS}


class CycleAligner(Aligner):
    """An estimator of one common cycle; a subclass provides the learning and its attributes.

    The model works on channels of zero mean and unit variance, and learns from recordings in the
    an order that follows from their values.
    """

    family: ClassVar[str] = "Alignment"

    n_states: int | None
    max_jump: int
    random_state: int | np.random.Generator | None

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn the cycle and the alignment of the recordings to it.

        Raises
        ------
        ValueError
            If a parameter is of the wrong type or out of range, there is no recording, channels
            differ, a name repeats, or a channel is nowhere visible.
        """
        self._check_parameters()
        checked = check_recordings(recordings)
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        ordered, places = by_content(checked), places_by_content(checked)
        self.scaling_: Standardisation = Standardisation.of(ordered)
        self.names_: tuple[str, ...] = tuple(recording.name for recording in ordered)
        self.sequences_: Sequences = self._sequences(ordered)
        self.cycle_length_: int = self.n_states or default_states(self.sequences_, self.max_jump)
        self.hyper_: Hyperparameters = self._hyperparameters()
        run = self._learn(np.random.default_rng(self.random_state))
        self.state_: State = run.state
        self.converged_: bool = run.converged
        self.n_iterations_: int = run.n_iterations
        paths = best_paths(self.state_, self.sequences_)
        self.path_: tuple[StatePath, ...] = tuple(paths[k] for k in places)
        self.fitted_: dict[str, tuple[Recording, StatePath]] = {
            r.name: (r, path) for r, path in zip(checked, self.path_, strict=True)
        }
        self._describe(run, places)
        return self

    def align(self, recordings: Sequence[Recording]) -> list[StatePath]:
        """Return the most likely state sequence of each recording.

        That of `fit` for a recording given there. A new recording takes the style with the highest
        bound, if there are several.

        Raises
        ------
        ValueError
            If channels differ.
        """
        check_given(self, recordings)
        return [self._align_recording(recording) for recording in recordings]

    @abstractmethod
    def _hyperparameters(self) -> Hyperparameters:
        """Return the hyperparameters, which are not learnt."""

    @abstractmethod
    def _learn(self, rng: np.random.Generator) -> Ascent[State]:
        """Run EM on ``sequences_`` from random starts and return the best run."""

    @abstractmethod
    def _describe(self, run: Ascent[State], places: NDArray[np.intp]) -> None:
        """Set the attributes of the subclass from the best run.

        Values are in the channels' units, and in the order in which recordings were given, whose
        ``places`` (K,) are those in the run.
        """

    def _check_parameters(self) -> None:
        parameters = self.get_params()
        check_settings(parameters)
        for name, choices in _CHOICES.items():
            if name in parameters:
                check_choice(name, parameters[name], choices)

    def _align_recording(self, recording: Recording) -> StatePath:
        if recording.name in self.fitted_:
            fitted, path = self.fitted_[recording.name]
            if np.array_equal(fitted.values, recording.values, equal_nan=True):
                return path
        sequence = self._sequences([recording])
        return best_paths(infer_path(sequence, self.state_, self.hyper_), sequence)[0]

    def _sequences(self, recordings: Sequence[Recording]) -> Sequences:
        return Sequences.of([self.scaling_.apply(recording).values for recording in recordings])

    def _restore_units(self, values: Array) -> Array:
        return np.asarray(self.scaling_.restore(values))
