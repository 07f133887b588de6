import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark import Address, Seeds

NAMES = st.text(min_size=1, max_size=8)
ADDRESSES = st.builds(
    Address, NAMES, st.integers(1, 9), NAMES, st.integers(0, 20), st.text(max_size=8)
)
SEEDS = st.builds(Seeds, st.integers(0, 2**32), ADDRESSES)


def _words(seeds, stream):
    """Return the beginning of a stream that all entrants share."""
    return tuple(seeds.generator(stream).bit_generator.seed_seq.generate_state(4))


def _seeds(task, version, case, fold, label=""):
    return Seeds(0, Address(task, version, case, fold, label))


@given(SEEDS, SEEDS, NAMES, NAMES)
def test_streams_are_equal_exactly_when_their_problems_are(one, other, stream, another):
    problems = [Seeds(s.root, s.address._replace(label="")) for s in (one, other)]
    same = (problems[0], stream) == (problems[1], another)
    assert (_words(one, stream) == _words(other, another)) is same


@given(SEEDS, NAMES)
def test_all_entrants_of_a_fold_share_a_generator(seeds, label):
    other = Seeds(seeds.root, seeds.address._replace(label=label))
    assert _words(seeds, "data") == _words(other, "data")


@given(SEEDS)
def test_a_label_is_not_a_stream(seeds):
    a, b = (Seeds(seeds.root, seeds.address._replace(label=label)) for label in "ab")
    assert a.random_state("init") != int(_words(a, "init")[0])
    assert a.random_state("init") != b.random_state("init")


def test_fields_do_not_run_together():
    assert _words(_seeds("ab", 1, "c", 0), "data") != _words(_seeds("a", 1, "bc", 0), "data")


def test_the_fold_is_that_of_the_address():
    assert [_seeds("task", 1, "case", fold).fold for fold in (0, 3, None)] == [0, 3, 0]


def test_seeds_are_the_same_in_every_version():
    seeds = _seeds("toy-interpolation-1", 1, "test 1", 0, "mohgp-3")
    assert seeds.random_state("init") == 978011371
    assert seeds.generator("data").standard_normal() == -1.1527604325336174


def test_global_random_state_is_left_alone():
    before = np.random.get_state()[1].copy()  # noqa: NPY002
    _seeds("task", 1, "case", 0).generator("data").standard_normal(10)
    assert (np.random.get_state()[1] == before).all()  # noqa: NPY002
