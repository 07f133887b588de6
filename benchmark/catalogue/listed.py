"""What tables say of each registered model and task, without importing those of mocapbench.

They take seconds to import, so that what they say stands in a file besides, which
``python -m mocapbench.benchmark.catalogue.listed`` writes anew. Those of plug-ins are imported.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from mocapbench.benchmark.registry import MODELS, TASKS, Registry

__all__ = ["TABLE", "compose_table", "list_model", "list_task"]

TABLE = Path(__file__).with_name("listed.json")


def list_model(name: str) -> Mapping[str, Any]:
    """Return what a table says of a model."""
    return _find_listed(MODELS, name) or _describe("model_summary")(name)


def list_task(name: str) -> Mapping[str, Any]:
    """Return what a table says of a task."""
    return _find_listed(TASKS, name) or _describe("task_summary")(name)


def compose_table() -> bytes:
    """Return what the file is to have, as models and tasks say it themselves."""
    table = {
        registry.kind: {n: describe(n) for n in registry.names() if registry.is_ours(n)}
        for registry, describe in (
            (MODELS, _describe("model_summary")),
            (TASKS, _describe("task_summary")),
        )
    }
    return (json.dumps(table, ensure_ascii=False, indent=2) + "\n").encode()


def _find_listed(registry: Registry[Any], name: str) -> Mapping[str, Any] | None:
    """Return what the file says; None of what is of others, or was registered in its place."""
    is_listed = registry.is_ours(name) and not registry.is_loaded(name)
    return _read_table()[registry.kind].get(name) if is_listed else None


@cache
def _read_table() -> Mapping[str, Mapping[str, Mapping[str, Any]]]:
    table: Mapping[str, Mapping[str, Mapping[str, Any]]] = json.loads(TABLE.read_bytes())
    return table


def _describe(how: str) -> Callable[[str], Mapping[str, Any]]:
    """Return a function of the catalogue, which is imported where it is needed alone."""
    describe: Callable[[str], Mapping[str, Any]] = getattr(
        import_module("mocapbench.benchmark.catalogue.entries"), how
    )
    return describe


if __name__ == "__main__":
    TABLE.write_bytes(compose_table())
