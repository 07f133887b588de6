"""What the benchmarks of one run say: `python report.py speed.json [PAGE]`.

Prints the ratios beside their bars and the seconds and memory that they come from; puts the seconds
and memory into the page as well where one is named.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from page import place, table

__all__ = ["Run"]

RATIOS = (
    ("toy D3 R5", "naive", "auto", 20.0),
    ("toy D3 R5", "GPy", "auto", 30.0),
    ("toy D3 R5", "GPy", "naive", 1 / 1.1),
    ("toy D6 R10, one child", "naive", "auto", 150.0),
    ("toy D6 R10, one child", "GPy", "auto", 200.0),
    ("toy D6 R10, one child", "GPy", "naive", 1 / 1.1),
    ("toy D6 R10, all children", "naive", "auto", 2.0),
    ("toy D6 R10, all children", "GPy", "auto", 5.0),
    ("mocap Q1", "naive", "auto", 200.0),
    ("mocap Q1", "GPy", "auto", 400.0),
    ("mocap Q1", "dense", "auto", 30.0),
    ("mocap Q1", "state-space", "auto", 5.0),
    ("mocap Q3", "naive", "auto", 120.0),
    ("mocap Q3", "dense", "auto", 15.0),
    ("D62 N300 R39, complete", "state-space", "auto", 3.5),
    ("D62 N300 R39, one child", "state-space", "auto", 3.5),
    ("D62 N1000 R39, complete", "latent-split", "state-space", 1.7),
    ("D62 N1000 R39, one child", "latent-split", "state-space", 1.7),
    ("multitask D39 N90", "GPyTorch", "auto", 1.0),
    ("command line", "imports", "help", 1 / 1.3),
)
"""Size, the slower way, the faster one, and how many times as fast it must be."""

LIMITS = (
    ("D62 N300 R39, complete", "auto", "peak_mb", 1e3),
    ("D62 N300 R39, one child", "auto", "peak_mb", 1e3),
    ("D62 N1000 R39, complete", "state-space", "peak_mb", 6e3),
    ("D62 N1000 R39, one child", "state-space", "peak_mb", 6e3),
    ("harness: toy", "run", "core_ms", 20.0),
    ("harness: recordings", "run", "core_ms", 20.0),
    ("mocap Q1", "fit", "evaluations", 200.0),
    ("mocap Q1", "fit", "nats_below_best", 1.0),
)
"""Size, way, what was counted and its upper limit."""

UNKNOWN = ("not measured", "")
WAYS = ("naive", "GPy", "GPyTorch", "dense", "latent-split", "state-space", "auto")


@dataclass(frozen=True)
class Run:
    """The benchmarks of one run by size and way.

    Parameters
    ----------
    benchmarks : mapping of (str, str) to mapping
        What pytest-benchmark wrote of each.
    machine : mapping
        What it wrote of the machine.
    """

    benchmarks: Mapping[tuple[str, str], Mapping[str, Any]]
    machine: Mapping[str, Any]

    @classmethod
    def read(cls, path: Path) -> Run:
        """Read pytest-benchmark's JSON."""
        saved = json.loads(path.read_text(encoding="utf-8"))
        by_way = {
            (each["params"]["size"], each["params"]["how"]): each
            for each in saved["benchmarks"]
            if {"size", "how"} <= set(each["params"] or {})
        }
        return cls(by_way, saved["machine_info"])

    @property
    def about(self) -> str:
        """The machine and the versions."""
        versions = ", ".join(f"{k} {v}" for k, v in self.machine["versions"].items())
        cpu = self.machine["cpu"]
        return (
            f"{cpu.get('brand_raw', 'CPU unknown')}, {cpu.get('count', '?')} cores; "
            f"Python {self.machine['python_version']}, {versions}."
        )

    @property
    def bars(self) -> str:
        """The table of ratios and limits."""
        return table(("size", "what", "bar", "measured", ""), [*self._ratios(), *self._limits()])

    @property
    def seconds(self) -> str:
        """The table of seconds and, in brackets, peak memory in MB."""
        sizes = dict.fromkeys(size for size, how in self.benchmarks if how in WAYS)
        return table(
            ("size", *WAYS), [(size, *(self._cell(size, how) for how in WAYS)) for size in sizes]
        )

    def _ratios(self) -> Iterator[tuple[str, ...]]:
        for size, slow, fast, bar in RATIOS:
            claim = (size, f"`{fast}` against `{slow}`", f"≥ {bar:.3g}×")
            slower, faster = (self.benchmarks.get((size, how)) for how in (slow, fast))
            if slower is None or faster is None:
                yield (*claim, *UNKNOWN)
                continue
            ratio = slower["stats"]["min"] / faster["stats"]["min"]
            yield (*claim, f"{ratio:.3g}×", _mark(ratio >= bar))

    def _limits(self) -> Iterator[tuple[str, ...]]:
        for size, how, what, limit in LIMITS:
            claim = (size, f"`{how}`: {what.replace('_', ' ')}", f"≤ {limit:g}")
            extra = self.benchmarks.get((size, how), {}).get("extra_info", {})
            if what not in extra:
                yield (*claim, *UNKNOWN)
                continue
            yield (*claim, f"{extra[what]:.3g}", _mark(extra[what] <= limit))

    def _cell(self, size: str, how: str) -> str:
        found = self.benchmarks.get((size, how))
        if found is None:
            return "–"
        peak = found["extra_info"].get("peak_mb")
        return f"{found['stats']['min']:.2g}" + (f" ({peak:.0f})" if peak else "")


def _mark(reached: bool) -> str:
    return "✓" if reached else "✗"


def main(saved: str, *pages: str) -> None:
    run = Run.read(Path(saved))
    print(run.about, run.bars, run.seconds, sep="\n\n")
    for page in pages:
        place(Path(page), "speed", f"{run.about}\n\n{run.seconds}")


if __name__ == "__main__":
    main(*sys.argv[1:])
