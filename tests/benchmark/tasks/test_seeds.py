import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.tasks.seeds import Seeds

NAMES = st.text(min_size=1, max_size=8)
ADDRESSES = st.builds(
    Seeds, st.integers(0, 2**32), NAMES, st.integers(1, 9), NAMES, st.integers(0, 20)
)


def _words(seeds, stream, label=None):
    return tuple(seeds.sequence(stream, label).generate_state(4))


@given(ADDRESSES, ADDRESSES, NAMES, NAMES)
def test_streams_are_equal_exactly_when_their_addresses_are(one, other, stream, another):
    same = (one, stream) == (other, another)
    assert (_words(one, stream) == _words(other, another)) is same


@given(ADDRESSES)
def test_a_label_is_not_a_stream(seeds):
    assert _words(seeds, "init", "a") != _words(seeds, "init")
    assert _words(seeds, "init", "a") != _words(seeds, "init", "b")


def test_fields_do_not_run_together():
    assert _words(Seeds(0, "ab", 1, "c", 0), "data") != _words(Seeds(0, "a", 1, "bc", 0), "data")


def test_seeds_are_the_same_in_every_version():
    seeds = Seeds(0, "toy-interpolation-1", 1, "test 1", 0)
    assert seeds.random_state("init", "mohgp-3") == 978011371
    assert seeds.generator("data").standard_normal() == -1.1527604325336174


def test_global_random_state_is_left_alone():
    before = np.random.get_state()[1].copy()  # noqa: NPY002
    Seeds(0, "task", 1, "case", 0).generator("data").standard_normal(10)
    assert (np.random.get_state()[1] == before).all()  # noqa: NPY002
