"""How alike the machines and libraries of two runs are, which decides how tight the gate is."""

from __future__ import annotations

from enum import StrEnum

__all__ = ["Environment"]


class Environment(StrEnum):
    """How alike the two runs' machines and libraries are.

    In one environment a program repeats itself; across environments searches may end elsewhere.
    """

    SAME = "same"
    CROSS = "cross"
