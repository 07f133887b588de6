"""The conformance kit: whether a model, a task, a metric or a format keeps its promises.

For the tests of a package that adds its own::

    from mocapbench.benchmark.testing import check_metric, check_model, check_task


    def test_my_model_conforms():
        check_model(MyModel)

A failure is a `ConformanceError` that says what was expected, what was got and what to do. The
checks are small functions, also to be had one by one (`model_checks`), each a test of its own.
"""

from mocapbench.benchmark.testing.errors import ConformanceError
from mocapbench.benchmark.testing.formats import check_format, damage_bytes
from mocapbench.benchmark.testing.metrics import check_metric
from mocapbench.benchmark.testing.models import check_model, model_checks
from mocapbench.benchmark.testing.tasks import check_task

__all__ = [
    "ConformanceError",
    "check_format",
    "check_metric",
    "check_model",
    "check_task",
    "damage_bytes",
    "model_checks",
]
