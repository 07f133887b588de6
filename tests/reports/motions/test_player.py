import numpy as np

from mocapbench.reports import Motions
from mocapbench.reports.motions.player import player

PARENTS = (-1, 0, 0, 0, 3)
JOINTS = ("root", "lfemur", "rfemur", "lowerback", "head")
HIDDEN = np.array([True, False, True, True, False])


def drawn():
    still = np.zeros((5, 5, 3))
    motions = {"knn": still, "nn": still}
    truths = {"truth": still, "other": still}
    shown = (motions, "nn", {"nn": "other"})
    return player(Motions("a-task", "Motion", "c", 0.1, JOINTS, PARENTS, HIDDEN, truths, *shown))


def test_a_side_is_that_of_a_joint_whose_counterpart_there_is():
    assert drawn()["data"]["sides"] == ["", "l", "r", "", ""]


def test_hidden_frames_are_runs():
    assert drawn()["data"]["hidden"] == [[0, 1], [2, 4]]


def test_each_motion_names_its_truth_and_the_page_knows_where_to_begin():
    figure = drawn()
    assert figure["data"]["truths"] == ["truth", "other"]
    assert figure["data"]["motions"] == [["knn", 0], ["nn", 1]]
    assert [figure[name] for name in ("labels", "beside", "id")] == [
        ("knn", "nn"),
        "nn",
        "player-a-task-motion",
    ]
