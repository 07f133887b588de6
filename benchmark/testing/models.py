"""Whether a model keeps what its abilities promise."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from functools import partial, update_wrapper
from typing import Any

from sklearn.base import clone

from mocapbench.baselines import ABILITIES, IMPLIED, NEEDS, Model
from mocapbench.benchmark.testing import abilities, facing, imputers, layers, units_and_rates
from mocapbench.benchmark.testing.errors import (
    global_randomness_untouched,
    raised_by,
    require,
    require_equal,
)
from mocapbench.benchmark.testing.subject import GAP, Subject, problem

__all__ = ["check_model", "model_checks"]

ModelCheck = Callable[[Subject], None]

_UNNAMED = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)


def check_model(model: type[Model], **parameters: Any) -> None:
    """Check a model class against what its abilities promise.

    The model runs in this process: if it calls ``os._exit`` or crashes, that ends the tests without
    a message, where a run would only fail its job.

    Parameters
    ----------
    model : type
        A subclass of `mocapbench.baselines.Model`.
    **parameters
        Set on every instance, for example a smaller budget.

    Raises
    ------
    ConformanceError
        At the first promise that it does not keep.
    """
    for check in model_checks(model, **parameters):
        check(model, **parameters)


def model_checks(model: type[Model], **parameters: Any) -> tuple[Callable[..., None], ...]:
    """Return the checks that apply to ``model``, each to be called as `check_model` is.

    Raises
    ------
    ConformanceError
        If it is not a class of models, or has no ability: there would be nothing to check.
    """
    advice = "pass the class itself, which inherits the abilities that it has"
    kind = isinstance(model, type) and issubclass(model, Model)
    require(kind, "a subclass of mocapbench.baselines.Model", repr(model), advice)
    try:
        provides = model().set_params(**parameters).provides
    except Exception:  # what every model must do says why
        return tuple(map(_name_check, _OF_EVERY_MODEL))
    names = ", ".join(_OF_ABILITY)
    able = not provides.isdisjoint(_OF_ABILITY)
    require(able, f"a model with an ability of {names}", model.__name__, advice)
    groups = [_OF_EVERY_MODEL, *(_OF_ABILITY[name] for name in _OF_ABILITY if name in provides)]
    if "continues recordings" in provides:
        new = {True: imputers.fills_new_recordings, False: imputers.refuses_new_recordings}
        groups.append((new["fills new recordings" in provides],))
    return tuple(_name_check(check) for group in groups for check in group)


def _name_check(check: ModelCheck) -> Callable[..., None]:
    """Return a check of a class of models, which another process can be handed."""
    named = partial(_require_promise, check)
    return update_wrapper(named, check, assigned=("__name__",))


def _require_promise(check: ModelCheck, model: type[Model], **parameters: Any) -> None:
    promise = (inspect.getdoc(check) or "").removeprefix("Check that ").rstrip(".")
    with raised_by(model.__name__, promise), global_randomness_untouched():
        check(Subject(model, parameters))


def is_documented(subject: Subject) -> None:
    """Check that the class says what it is."""
    own = subject.model.__dict__.get("__doc__")
    require(own, "a docstring of the class", repr(own), "say what the model is")


def names_its_family(subject: Subject) -> None:
    """Check that the class says among which models a report shows it."""
    family: object = subject.model().family
    named = isinstance(family, str) and family.strip() != ""
    require(named, "a family, such as 'Your models'", repr(family), "name it or leave it out")


def names_known_abilities_and_needs(subject: Subject) -> None:
    """Check that what the model provides and needs has names that others know."""
    model = subject.build()
    implied = {other for name, other in IMPLIED.items() if name in model.provides}
    lacking = sorted(implied - model.provides)
    require(not lacking, "abilities with those that they imply", lacking, "add these to provides")
    for what, names, known in (
        ("abilities", model.provides, ABILITIES),
        ("needs", model.needs, NEEDS),
    ):
        unknown = sorted(names - {*known})
        require(not unknown, f"{what} among {', '.join(known)}", unknown, "correct their names")


def constructor_only_stores(subject: Subject) -> None:
    """Check that the constructor works without arguments and only stores them."""
    unnamed = [
        str(p) for p in inspect.signature(subject.model).parameters.values() if p.kind in _UNNAMED
    ]
    expected = "arguments of __init__ that have names and defaults"
    require(not unnamed, expected, ", ".join(unnamed), "name each: others cannot be set or kept")
    model = subject.model()
    learned = sorted(name for name in vars(model) if name.endswith("_"))
    require(not learned, "no learned state before fit", learned, "set it in fit")
    before, after = model.get_params(), clone(model).get_params()
    require(
        repr(before) == repr(after),
        f"a clone with the parameters {before}",
        after,
        "store each argument of __init__ unchanged under its own name",
    )


def fit_returns_the_model(subject: Subject) -> None:
    """Check that fit returns the model, and changes no parameter and no recording."""
    recordings, model = problem(GAP), subject.build(3)
    values = [recording.values.copy() for recording in recordings]
    before = repr(model.get_params())
    returned = subject.fit_built(model, recordings)
    require(returned is model, "fit to return self", repr(returned)[:80], "end it in return self")
    after = repr(model.get_params())
    require(before == after, f"the parameters {before}", after, "keep what is learned apart")
    for recording, value in zip(recordings, values, strict=True):
        require_equal(recording.values, value, "recordings as they were", "copy before you change")


_OF_EVERY_MODEL: tuple[ModelCheck, ...] = (
    is_documented,
    names_its_family,
    names_known_abilities_and_needs,
    constructor_only_stores,
    fit_returns_the_model,
)

_OF_ABILITY: Mapping[str, tuple[ModelCheck, ...]] = {
    "continues recordings": (imputers.continues_recordings,),
    "fills frames": (
        imputers.fills_whole_frames,
        imputers.repeats_itself,
        imputers.keeps_means_in_calibration,
        imputers.ignores_the_order_of_recordings,
        imputers.ignores_the_names_of_recordings,
    ),
    "fills entries": (imputers.fills_any_mask,),
    "interpolates": (imputers.fills_channels_apart,),
    "turns along": (facing.fills_alike_however_it_faces,),
    "moves along": (facing.fills_markers_alike_wherever_they_stand,),
    "mirrors along": (facing.fills_markers_alike_if_mirrored,),
    "scales along": (units_and_rates.fills_alike_in_any_unit,),
    "resamples along": (units_and_rates.fills_markers_alike_at_any_frame_rate,),
    "draws samples": (abilities.draws_samples,),
    "clusters": (abilities.clusters_every_recording, abilities.makes_one_cluster_of_one_style),
    "aligns": (abilities.aligns_every_frame,),
    "blends": (abilities.blends_frame_by_frame,),
    "has a trend": (layers.infers_a_trend_at_any_time,),
    "has layers": (layers.shows_the_covariance_of_every_layer,),
    "has coregionalisation": (layers.shows_matrices_that_add_up_to_the_covariance,),
}
