"""The masks of the paper, and the errors that are printed for them."""

import csv

import pytest
from shared_files import shared

from mocapbench.datasets.occlusion.fixed_masks import fixed_masks, published_errors


@pytest.mark.parametrize("n_markers", [3, 6, 9])
def test_each_mask_hides_so_many_markers_for_370_of_400_frames(n_markers):
    masks = fixed_masks(n_markers)
    assert len(masks) == len(published_errors(n_markers)) == 50
    for mask in masks:
        assert len({marker for marker, *_ in mask}) == len(mask) == n_markers
        assert all(0 <= marker < 41 for marker, *_ in mask)
        assert all(0 < start < stop == start + 370 <= 400 for _, start, stop in mask)


def test_there_are_none_of_other_numbers_of_markers():
    assert fixed_masks(4) == published_errors(4) == ()


def test_masks_and_errors_are_those_that_were_gathered():
    text = shared("published", "lwpca.csv").read_text(encoding="utf-8")
    rows = [*csv.DictReader(text.splitlines())]
    ours = [
        (str(n), " ".join(f"{marker}:{start}-{stop}" for marker, start, stop in mask), error)
        for n in (3, 6, 9)
        for mask, error in zip(fixed_masks(n), published_errors(n), strict=True)
    ]
    gathered = [(row["n_markers"], row["runs"], float(row["published_mae"])) for row in rows]
    assert ours == gathered
