"""The task that CONTRIBUTING.md shows is a valid one."""

import re
from pathlib import Path

from mocapbench.benchmark.testing import check_task

PAGE = (Path(__file__).parents[1] / "CONTRIBUTING.md").read_text(encoding="utf-8")


def test_its_task_conforms():
    (source,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    shown = {}
    exec(source, shown)
    check_task(shown["wave"])
