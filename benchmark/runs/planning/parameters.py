"""The full parameters of an entrant's model in one case of one profile."""

from __future__ import annotations

import json
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile

__all__ = ["full_parameters"]


def full_parameters(entrant: Entrant, case: Case, profile: Profile) -> dict[str, Any]:
    """Return the model's full parameters, its seed apart, which the label decides.

    Raises
    ------
    UsageError
        If one has no stable text, and so could be in no key or record.
    """
    model = MODELS.get(entrant.model)(**entrant.parameters)
    names = model.get_params()
    prescribed = {**profile.budget, **case.parameters}
    model.set_params(**{name: v for name, v in prescribed.items() if name in names})
    parameters = {name: v for name, v in model.get_params().items() if name != "random_state"}
    for name, value in parameters.items():
        _check_plain(entrant, name, value)
    return parameters


def _check_plain(entrant: Entrant, name: str, value: object) -> None:
    try:
        json.dumps(value)
    except (TypeError, ValueError) as error:
        raise UsageError(
            f"model {entrant.model!r}: expected parameters that JSON can hold (numbers, text, "
            f"lists of them), got {name}={value!r}; build objects from them in fit"
        ) from error
