import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mocapbench.baselines.kriging.body import MarkerBody, to_body, to_room

seeds = st.integers(0, 2**16)


def see(places, weights):
    return MarkerBody.fit(places, weights).see(places)


def moving(seed, n_markers=5):
    """Return markers of a rigid body (12, K, 3), and how it rotated and where it went."""
    rng = np.random.default_rng(seed)
    rotations, path = Rotation.random(12, random_state=seed), rng.normal(0.0, 10.0, (12, 1, 3))
    body = rng.normal(size=(n_markers, 3))
    return np.stack([rotations.apply(marker) for marker in body], axis=1) + path


@given(seed=seeds)
def test_what_moves_with_the_body_stands_still_as_seen_from_it(seed):
    places = moving(seed)
    rotations, centres, shapes = see(places[:, 1:], np.arange(1.0, 5.0))
    seen = to_body(places[:, 0], rotations, centres)
    np.testing.assert_allclose(seen, seen[[0]].repeat(12, axis=0), atol=1e-6)
    np.testing.assert_allclose(shapes, shapes[[0]].repeat(12, axis=0), atol=1e-6)


@given(seed=seeds)
def test_seeing_and_going_back_are_inverse(seed):
    places = moving(seed) + np.random.default_rng(seed).normal(size=(12, 5, 3))
    rotations, centres, shapes = see(places[:, 1:], np.ones(4))
    seen, some = to_body(places[:, 0], rotations, centres), np.array([3, 7])
    back = to_room(seen[some], rotations[some], centres[some])
    np.testing.assert_allclose(back, places[some, 0], atol=1e-9)
    lengths = np.linalg.norm(seen - shapes[:, 0], axis=1)
    np.testing.assert_allclose(lengths, np.linalg.norm(places[:, 0] - places[:, 1], axis=1))


def test_the_shapes_have_their_weighted_centre_in_the_body():
    weights = np.array([1.0, 2.0, 3.0, 4.0])
    _, _, shapes = see(np.random.default_rng(0).normal(size=(12, 4, 3)), weights)
    np.testing.assert_allclose(np.einsum("k,tki->ti", weights, shapes), 0.0, atol=1e-12)


@given(seed=seeds)
def test_a_frame_is_seen_alike_whatever_others_it_is_seen_with(seed):
    places = moving(seed) + np.random.default_rng(seed).normal(size=(12, 5, 3))
    body = MarkerBody.fit(places, np.ones(5))
    for part, parts in zip(body.see(places[3:5]), body.see(places), strict=True):
        np.testing.assert_allclose(part, parts[3:5], atol=1e-9)
