import numpy as np
import pytest

from mocapbench.reports import Motions

STILL = np.zeros((3, 2, 3))
KNN = {"knn": STILL}


def motions(made=KNN, parents=(-1, 0), truth=STILL, beside="knn", against=None):
    hidden = np.zeros(3, dtype=bool)
    joints = ("root", "head")
    truths, shown = {"truth": truth}, (made, beside, against or {})
    return Motions("t", "Motion", "c", 0.1, joints, parents, hidden, truths, *shown)


def test_a_whole_picture_is_taken():
    assert motions().truth_of("knn") == "truth"


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"made": {}}, "one motion or more"),
        ({"truth": np.zeros((4, 2, 3))}, "shape"),
        ({"truth": np.full((3, 2, 3), np.nan)}, "finite"),
        ({"against": {"knn": "another"}}, "another"),
        ({"beside": "another"}, "another"),
        ({"parents": (-1,)}, "parent"),
        ({"parents": (1, -1)}, "parent"),
    ],
)
def test_what_cannot_be_played_is_refused(wrong, told):
    with pytest.raises(ValueError, match=told):
        motions(**wrong)
