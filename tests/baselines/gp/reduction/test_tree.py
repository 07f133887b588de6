import pytest

from mocapbench.baselines.gp.reduction.tree import grow

NAMES = ["a", "b", "c"]
PATHS = {"a": ("walk", "one"), "b": ["walk", "two"], "c": ("run", "one")}


def test_without_paths_replicates_are_children_of_the_root():
    assert grow(NAMES) == {"parent": ((),) * 3, "child": (("a",), ("b",), ("c",))}
    assert grow(NAMES, dict.fromkeys(NAMES, ())) == grow(NAMES)


def test_groups_of_one_name_in_different_groups_are_different():
    tree = grow(NAMES, PATHS)
    assert list(tree) == ["parent", "group-1", "group-2", "child"]
    assert tree["group-1"] == (("walk",), ("walk",), ("run",))
    assert tree["group-2"] == (("walk", "one"), ("walk", "two"), ("run", "one"))
    assert len(set(tree["group-2"])) == 3
    assert tree["child"][2] == ("run", "one", "c")


@pytest.mark.parametrize(
    ("paths", "message"),
    [
        ([("walk",)] * 3, "mapping from the name"),
        ({"a": ("walk",)}, r"none for \['b', 'c'\]"),
        (PATHS | {"d": ("walk", "one")}, r"got one for \['d'\]"),
        (PATHS | {"a": "walk"}, "path of 'a'"),
        (PATHS | {"b": ("walk", 2)}, "path of 'b'"),
        (
            PATHS | {"c": ("run",)},
            r"equally long, got 'c' has \('run',\), .* has \('walk'|\['walk'",
        ),
    ],
)
def test_paths_are_validated(paths, message):
    with pytest.raises(ValueError, match=message):
        grow(NAMES, paths)
