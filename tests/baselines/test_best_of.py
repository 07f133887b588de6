import numpy as np
import pytest
from samples import gap

from mocapbench.baselines import MOHGP, BestOf, LinearImputer, MakimaImputer, PchipImputer
from mocapbench.baselines.choosing import candidates
from mocapbench.baselines.choosing.candidates import CANDIDATES
from mocapbench.datasets import Recording, ToyProcess


def walk(name, phase, offset=0.0, n_frames=60):
    angle = 2 * np.pi * np.arange(n_frames) / 20.3 + phase
    values = np.column_stack([np.sin(angle), np.cos(angle), np.sin(angle + 1.0)]) + offset
    return Recording(name, np.arange(n_frames) / 30, values, ("a", "b", "c"), ("",) * 3)


def still(name, n_frames=60):
    values = np.random.default_rng(0).normal(scale=0.005, size=(n_frames, 3)).cumsum(axis=0)
    return Recording(name, np.arange(n_frames) / 30, values, ("a", "b", "c"), ("",) * 3)


TRAINING = [walk("one", 0.0), walk("two", 1.0, 0.1)]
MODEL = BestOf().fit(TRAINING)
GIVEN = [
    gap(walk("new", 0.5), 20, 40),
    gap(walk("leg", 0.5), 20, 40, [0, 1]),
    gap(still("still"), 20, 40),
]


@pytest.mark.parametrize("recording", GIVEN, ids=lambda recording: recording.name)
def test_weights_of_candidates_sum_to_one(recording):
    (weights,) = MODEL.weights([recording])
    assert set(weights.index) <= set(CANDIDATES)
    assert weights.sum().to_dict() == pytest.approx({"": 1.0})
    assert weights.to_numpy().min() >= 0.0


def test_a_walk_is_filled_by_what_has_learnt_walks():
    (prediction,) = MODEL.impute(GIVEN[:1])
    (spline,) = PchipImputer().fit(TRAINING).impute(GIVEN[:1])
    truth = walk("new", 0.5).values
    error = np.abs(prediction.mean - truth).max()
    assert error < 0.1 * np.abs(spline.mean - truth).max()


@pytest.mark.slow
@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("seed", range(3))
def test_few_points_of_smooth_curves_are_filled_as_well_as_by_a_gaussian_process(seed):
    rng = np.random.default_rng(seed)
    children = ToyProcess.random(rng, n_outputs=2, noise=0.01).draw(rng, np.linspace(0, 6, 40), 4)
    hidden = np.ones((40, 2), dtype=bool)
    for channel in hidden.T:
        channel[rng.choice(40, 6, replace=False)] = False
    recordings = [*children[:-1], children[-1].hide(hidden)]
    errors = [
        np.square(model.fit(recordings).impute(recordings[-1:])[0].mean - children[-1].values).sum()
        for model in (BestOf(), MOHGP(n_components=3))
    ]
    assert errors[0] < 1.2 * errors[1]


@pytest.mark.slow
def test_where_a_body_is_and_how_it_moves_have_weights_of_their_own():
    """A walk crosses the room: errors of a few centimetres are small beside how far it goes."""
    angle = 2 * np.pi * np.arange(90) / 20.3
    rng = np.random.default_rng(0)
    joints = [np.sin(angle + phase) + 0.1 * rng.normal(size=90) for phase in range(8)]
    values = np.column_stack([*joints, 9.0 * np.arange(90) + np.sin(2 * angle)])
    channels, units = tuple("abcdefghx"), ("deg",) * 8 + ("cm",)
    truth = Recording("walk", np.arange(90) / 30, values, channels, units)
    given = gap(truth, 30, 50)
    model = BestOf().fit([given])
    (weights,), (prediction,) = model.weights([given]), model.impute([given])
    assert weights.sum().to_dict() == pytest.approx({"cm": 1.0, "deg": 1.0})
    assert not np.allclose(weights["cm"], weights["deg"], atol=0.3)
    (line,) = MakimaImputer().fit([given]).impute([given])
    room, line_room = (np.square(p.mean - values)[30:50, 8].mean() for p in (prediction, line))
    limbs, line_limbs = (np.square(p.mean - values)[30:50, :8].mean() for p in (prediction, line))
    assert room < 1.21 * line_room
    assert limbs < 0.5 * line_limbs


def test_someone_who_stands_still_is_filled_no_worse_than_by_interpolation():
    (prediction,) = MODEL.impute(GIVEN[2:])
    (spline,) = PchipImputer().fit(TRAINING).impute(GIVEN[2:])
    truth = still("still").values
    error, reference = (np.square(p.mean - truth).sum() for p in (prediction, spline))
    assert error < 1.21 * reference


@pytest.mark.slow
def test_nothing_is_random_and_neither_order_nor_company_matters():
    here = MODEL.impute(GIVEN[:1])[0]
    there = BestOf().fit(TRAINING[::-1]).impute([GIVEN[2], GIVEN[0]])[1]
    np.testing.assert_allclose(there.mean, here.mean, atol=1e-8)
    np.testing.assert_allclose(there.variance, here.variance, rtol=1e-5, atol=1e-12)


@pytest.mark.slow
def test_the_variance_includes_how_far_candidates_lie_apart():
    (prediction,) = MODEL.impute(GIVEN[:1])
    (weights,) = MODEL.weights(GIVEN[:1])
    answers = MODEL.candidates_.impute(GIVEN[0], weights.index)
    shares = weights[""].items()
    spread = sum(w * (answers[name].mean - prediction.mean) ** 2 for name, w in shares)
    assert (prediction.variance >= spread).all()


def test_a_complete_recording_stays_as_it_is():
    (prediction,) = MODEL.impute([walk("new", 0.5)])
    np.testing.assert_array_equal(prediction.mean, walk("new", 0.5).values)
    np.testing.assert_array_equal(prediction.variance, 0.0)


def test_what_cannot_be_filled_is_refused():
    with pytest.raises(ValueError, match="shrinkage to be a number from 0 to 1"):
        BestOf(shrinkage=1.5).fit(TRAINING)
    with pytest.raises(ValueError, match="expected channels"):
        MODEL.impute([walk("new", 0.0).select(["a"])])
    unseen = [gap(recording, 0, 60, [0]) for recording in TRAINING]
    with pytest.raises(ValueError, match=r"none of \['a'\]"):
        BestOf().fit(unseen).impute(unseen[:1])


def test_candidates_that_cannot_learn_are_left_out_with_their_reason(monkeypatch):
    class Broken(LinearImputer):
        def fit(self, recordings):
            raise np.linalg.LinAlgError("singular matrix")

    monkeypatch.setattr(candidates, "CANDIDATES", {**candidates.CANDIDATES, "broken": Broken})
    model = BestOf().fit([gap(walk("new", 0.0), 20, 30)])
    assert model.left_out_["broken"] == "LinAlgError: singular matrix"
    assert not set(model.left_out_) & set(model.candidates_.models)
    assert {*model.left_out_, *model.candidates_.models} == set(candidates.CANDIDATES)
