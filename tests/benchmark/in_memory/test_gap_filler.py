"""The transformer keeps the rules of scikit-learn, and fills as `fill` does."""

import numpy as np
import pandas as pd
import pytest
from sklearn.base import clone
from sklearn.decomposition import PCA
from sklearn.impute import SimpleImputer
from sklearn.pipeline import make_pipeline
from sklearn.utils.estimator_checks import parametrize_with_checks

import mocapbench
from mocapbench import GapFiller
from mocapbench.baselines import MakimaImputer


@parametrize_with_checks([GapFiller(), GapFiller(MakimaImputer(), rate=30)])
def test_it_keeps_the_rules_of_scikit_learn(estimator, check):
    check(estimator)


def test_it_fills_as_fill_does(gappy):
    filled = mocapbench.fill(gappy, "cubic-spline").recording.values
    np.testing.assert_allclose(
        GapFiller("cubic-spline", rate=60).fit_transform(gappy.values), filled
    )


def test_it_stands_in_a_pipeline(gappy):
    frames = make_pipeline(GapFiller(rate=60), PCA(2)).fit_transform(gappy.values)
    assert np.isfinite(frames).all()


def test_names_of_columns_are_those_of_markers(gappy):
    table = pd.DataFrame(gappy.values, columns=gappy.channels)
    filler = GapFiller("marker-kriging", rate=60).set_output(transform="pandas")
    filled = filler.fit_transform(table)
    expected = mocapbench.fill(gappy.values, "marker-kriging", rate=60, names=gappy.channels)
    assert tuple(filled.columns) == gappy.channels
    np.testing.assert_array_equal(filled.to_numpy(), expected.recording.values)


def test_the_ends_are_filled_too(gappy):
    values = gappy.values.copy()
    values[:5] = np.nan
    values[-5:, 0] = np.nan
    assert np.isfinite(GapFiller().fit_transform(values)).all()


def test_it_learns_from_the_frames_that_it_was_fitted_to(walk):
    learnt, given = walk().values, walk(60, seed=1).values.copy()
    given[:, 2] = np.nan
    filled = GapFiller(SimpleImputer()).fit(learnt).transform(given)
    np.testing.assert_allclose(filled[:, 2], learnt[:, 2].mean())


def test_frames_without_gaps_stay_as_they_are_and_are_no_view(walk):
    values = walk().values
    filler = GapFiller().fit(values)
    same = filler.transform(values)
    np.testing.assert_array_equal(same, values)
    assert not np.shares_memory(same, values)
    assert same.flags.writeable


def test_what_it_returns_can_be_changed(gappy):
    filled = GapFiller().fit_transform(gappy.values)
    filled[0, 0] = 7.0
    assert filled[0, 0] == 7.0


@pytest.mark.parametrize(
    ("filler", "said"),
    [
        (GapFiller("liner"), "did you mean linear"),
        (GapFiller(rate=0), "expected rate= in frames per second, above 0, got 0"),
        (GapFiller(MakimaImputer), r"write MakimaImputer\(\)"),
    ],
)
def test_what_cannot_fill_is_refused_by_fit(gappy, filler, said):
    with pytest.raises(ValueError, match=said):
        filler.fit(gappy.values)


def test_a_channel_that_was_never_visible_is_refused(gappy):
    values = gappy.values.copy()
    values[:, 4] = np.nan
    with pytest.raises(ValueError, match=r"expected a visible entry .* got none of x4"):
        GapFiller().fit_transform(values)


def test_advice_is_for_those_who_write_python(gappy):
    with pytest.raises(ValueError, match="handed over itself") as error:
        GapFiller("liner").fit(gappy.values)
    assert "--" not in str(error.value)


def test_two_columns_of_one_name_are_refused(gappy):
    table = pd.DataFrame(gappy.values[:, :3], columns=["a", "b", "a"])
    with pytest.raises(ValueError, match="columns of different names, got 'a' 2 times"):
        GapFiller().fit(table)


def test_a_copy_has_its_parameters():
    filler = clone(GapFiller("makima", rate=30, seed=3))
    assert filler.get_params() == {"model": "makima", "rate": 30, "seed": 3}
