import numpy as np
import pytest
from samples import gap

from mocapbench.baselines.choosing.candidates import FittedCandidates
from mocapbench.baselines.choosing.held_out_errors import HeldOutErrors
from mocapbench.baselines.choosing.parts import parts_of
from mocapbench.baselines.protocols import Imputer, Prediction
from mocapbench.datasets import Recording


def walk(name, n_frames=60, phase=0.0):
    angle = 2 * np.pi * np.arange(n_frames) / 20 + phase
    values = np.column_stack([np.sin(angle), np.cos(angle)])
    return Recording(name, np.arange(n_frames) / 30, values, ("a", "b"), ("",) * 2)


class Watching(Imputer):
    """Predicts 0, and keeps what it was given."""

    def __init__(self):
        self.given = []

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        self.given.extend(recordings)
        return [Prediction.around(recording, 0.0) for recording in recordings]


def watched(fitted, given):
    model = Watching()
    return model, HeldOutErrors(fitted, FittedCandidates({"zero": model}), given)


def test_real_gaps_stay_hidden_where_others_are_held_out():
    given = gap(walk("new"), 20, 28)
    model, errors = watched([walk("one")], given)
    assert len(errors.in_recording()) == 3
    assert all(not seen.visible[20:28].any() for seen in model.given)


def test_errors_are_those_of_the_copies_in_units_of_the_spread():
    given = gap(walk("new"), 20, 28)
    _, errors = watched([walk("one")], given)
    for mask, products in zip(errors.held_out, errors.in_recording(), strict=True):
        expected = np.mean((given.values / errors.scale)[mask] ** 2)
        assert products.loc["zero", "zero"] == pytest.approx(expected)


def test_products_are_means_over_hidden_entries_and_covariances_of_errors():
    fitted, given = [walk("one"), walk("two", phase=1.0)], gap(walk("new"), 20, 28)
    candidates = FittedCandidates.of(fitted)
    errors = HeldOutErrors(fitted, candidates, given)
    mask, products = errors.held_out[0], errors.in_recording()[0]
    means = candidates.means(given.hide(mask))
    linear, spline = (
        ((means[name] - given.values) / errors.scale)[mask] for name in ("linear", "pchip")
    )
    assert products.loc["linear", "pchip"] == pytest.approx(np.mean(linear * spline))
    assert np.linalg.eigvalsh(products).min() > -1e-9 * np.trace(products)


@pytest.mark.parametrize(("last", "short"), [(24, False), (55, True)])
def test_copies_are_short_where_visible_stretches_are(last, short):
    assert watched([walk("one")], gap(walk("new"), 20, last))[1].are_short() is short


def swings(name, phase=0.0):
    """Return a recording of which every channel can be told from the others."""
    angle = 2 * np.pi * np.arange(60)[:, None] / 20 + phase
    values = np.sin(angle + np.arange(6)) * np.arange(1, 7)
    return Recording(name, np.arange(60) / 30, values, tuple("abcdef"), ("",) * 6)


def test_for_channels_hidden_throughout_others_are_held_out_and_never_short():
    hidden = np.zeros((60, 6), dtype=bool)
    hidden[:, 2] = True
    hidden[20:52, 4] = True  # longer than any copy of it
    _, errors = watched([swings("one"), swings("two", 1.0)], swings("new").hide(hidden))
    parts = parts_of(errors.given)
    assert errors.are_short(parts[""])
    assert not errors.are_short(parts[", whole channels"])
    own = errors.in_recording(parts[", whole channels"])
    of_channels = [products for products in own if not products.empty]
    assert len(of_channels) == 3
    of_part = [m & parts[", whole channels"].entries(hidden | m) for m in errors.held_out]
    counted = [mask & errors.given.visible for mask in of_part if mask.any()]
    assert errors.n_entries(parts[", whole channels"]) == np.sum(counted)
    for mask, products in zip(counted, of_channels, strict=True):
        expected = np.mean((errors.given.values / errors.scale)[mask] ** 2)
        assert products.loc["zero", "zero"] == pytest.approx(expected)
    assert len([one for one in errors.in_recording(parts[""]) if not one.empty]) == len(own) - 3


@pytest.mark.parametrize("n_frames", [40, 60, 90])
def test_training_recordings_take_the_place_of_the_one_to_fill(n_frames):
    fitted = [walk("one", n_frames), walk("two", n_frames, 1.0)]
    given = gap(walk("new"), 20, 40)
    found = HeldOutErrors(fitted, FittedCandidates.of(fitted), given).elsewhere()
    assert len(found) == 2
    for with_gaps, with_copies in found:
        assert set(with_gaps) == set(with_copies) >= {"linear", "lds", "pose-kriging"}


def test_copies_as_long_as_the_gaps_are_not_compared_with_them():
    fitted = [walk("one"), walk("two", phase=1.0)]
    found = HeldOutErrors(fitted, FittedCandidates.of(fitted), gap(walk("new"), 20, 24)).elsewhere()
    assert [(with_gaps.empty, with_copies.empty) for with_gaps, with_copies in found] == [
        (False, True),
        (False, True),
    ]


def test_a_copy_that_fits_in_one_place_only_is_compared_with_the_gap_in_training():
    fitted = [walk("one"), walk("two", phase=1.0)]
    errors = HeldOutErrors(fitted, FittedCandidates.of(fitted), gap(walk("new"), 8, 56))
    assert len(errors.held_out) == 1
    assert errors.are_short()
    assert not any(with_copies.empty for _, with_copies in errors.elsewhere())


def test_one_training_recording_cannot_be_left_out():
    fitted = [walk("one")]
    assert (
        HeldOutErrors(fitted, FittedCandidates.of(fitted), gap(walk("new"), 20, 40)).elsewhere()
        == []
    )


def test_of_many_training_recordings_three_are_held_out_in_one_fit(monkeypatch):
    fitted = [walk(f"walk {k:02}", phase=0.3 * k) for k in range(16)]
    fits = []
    monkeypatch.setattr(
        FittedCandidates, "anew", lambda self, recordings: fits.append(recordings) or self
    )
    found = HeldOutErrors(fitted, FittedCandidates({}), gap(walk("new"), 20, 40)).elsewhere()
    assert len(found) == 3
    assert [len(recordings) for recordings in fits] == [13]
