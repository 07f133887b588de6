import pytest

from mocapbench.benchmark import TASKS, Address, Seeds, archive_at


@pytest.fixture(scope="session")
def posed():
    """Return a function that poses the problem of a case."""

    def pose(task, case):
        task = TASKS.get(task)
        case = task.case(case)
        address = Address(task.name, task.version, case.problem_name, fold=0)
        return case.problem(Seeds(0, address), archive_at(None))

    return pose
