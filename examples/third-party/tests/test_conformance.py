"""What this package adds keeps mocapbench's protocols."""

import pytest
from mocapbench_waves.metric import median_absolute_error
from mocapbench_waves.model import StraightLines
from mocapbench_waves.task import waves

from mocapbench.benchmark.testing import check_metric, check_task, model_checks


@pytest.mark.parametrize("check", model_checks(StraightLines), ids=lambda check: check.__name__)
def test_the_model(check):
    check(StraightLines)


def test_the_task():
    check_task(waves)


def test_the_metric():
    check_metric(median_absolute_error)
