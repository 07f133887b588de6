from collections import Counter

from mocapbench.benchmark.tasks.hlm_recordings import CMU, SYNTHETIC, select_subject
from mocapbench.benchmark.tasks.upper_body_missing import N_WALKS


def test_the_recordings_are_the_papers_39_in_four_styles():
    subjects = Counter(uri.partition(":")[2][:2] for uri in CMU)
    assert subjects == {"07": 11, "08": 11, "09": 9, "35": 8}
    assert Counter(CMU.values()) == {"walk": 24, "slow walk": 3, "stride": 3, "run": 9}
    assert {CMU[uri] for uri in select_subject(CMU, "cmu:09")} == {"run"}


def test_the_generated_recordings_are_of_the_same_styles():
    assert set(SYNTHETIC.values()) == set(CMU.values())
    held_out = select_subject(SYNTHETIC, "gait:01")
    assert len(held_out) == len(select_subject(CMU, "cmu:07")) == N_WALKS
    assert {SYNTHETIC[uri] for uri in held_out} == {"walk", "slow walk"}
