"""The conformance kit finds formats that are careless with damaged files."""

import pytest
from format_files import sample

from mocapbench.benchmark.testing import ConformanceError, check_format
from mocapbench.datasets import CSVFormat


@pytest.mark.parametrize("method", ["likelihoods", "save"])
def test_damaged_files_are_also_asked_for_likelihoods_and_written(method, tmp_path):
    path = sample("csv", tmp_path)
    whole, careful = path.read_bytes(), getattr(CSVFormat, method)

    def take_for_whole(self, given, *rest):
        like = rest[-1] if rest else given
        if like.read_bytes() != whole:
            raise KeyError(like)
        return careful(self, given, *rest)

    with pytest.raises(ConformanceError, match="KeyError"):
        check_format(type("Careless", (CSVFormat,), {method: take_for_whole}), path)
