import pytest

from mocapbench.baselines.common.validation import check_jobs


@pytest.mark.parametrize("n_jobs", [None, 1, 4, -1])
def test_numbers_of_jobs_that_scikit_learn_accepts_are_accepted(n_jobs):
    check_jobs(n_jobs)


@pytest.mark.parametrize("n_jobs", [0, 1.5, "all"])
def test_other_numbers_of_jobs_are_refused(n_jobs):
    with pytest.raises(ValueError, match="expected n_jobs to be None, a positive integer"):
        check_jobs(n_jobs)
