from collections import Counter

from mocapbench.benchmark.tasks.hlm_recordings import CMU, SYNTHETIC
from mocapbench.benchmark.tasks.upper_body_missing import N_WALKS


def test_the_recordings_are_the_papers_39_in_four_styles():
    subjects = Counter(uri.partition(":")[2][:2] for uri in CMU.sources)
    assert subjects == {"07": 11, "08": 11, "09": 9, "35": 8}
    assert Counter(CMU.styles.values()) == {"walk": 24, "slow walk": 3, "stride": 3, "run": 9}
    assert {CMU.styles[uri] for uri in CMU.of_subject("cmu:09")} == {"run"}


def test_the_generated_recordings_are_of_the_same_styles():
    assert set(SYNTHETIC.styles.values()) == set(CMU.styles.values())
    held_out = SYNTHETIC.of_subject("gait:01")
    assert len(held_out) == len(CMU.of_subject("cmu:07")) == N_WALKS
    assert {SYNTHETIC.styles[uri] for uri in held_out} == {"walk", "slow walk"}
