"""Trees of replicates, which say which draws each replicate is a sum of.

This is eq. 8 of J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion
Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017. A node is named by the labels on the
way to it from the root, which is ``()``; the leaf of a replicate is its path followed by its name.
A layer has one draw for each node of one depth, common to all replicates below that node.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mocapbench.baselines.gp.prior.parameters import CHILD, PARENT

__all__ = ["Node", "Path", "Tree", "grow", "is_path"]

Path = Sequence[str]
"""The groups that a replicate is in, from the largest to the smallest."""
Node = tuple[str, ...]
"""A node, by its labels from the root."""
Tree = Mapping[str, Sequence[Node]]
"""For each layer, from the trend down, the node of each replicate at that depth."""


def grow(names: Sequence[str], paths: Mapping[str, Path] | None = None) -> Tree:
    """Return the tree of replicates with the given paths.

    Parameters
    ----------
    names : sequence of str
        The replicates.
    paths : mapping of str to sequence of str, optional
        The path of each, all of one length; without it every replicate is a child of the root.

    Returns
    -------
    mapping of str to tuple of tuple of str
        For each layer, the node of each replicate at that depth. The layers are ``"parent"``, then
        ``"group-1"``, ``"group-2"`` and so on by their depth, and ``"child"``.

    Raises
    ------
    ValueError
        If a replicate has no path, a path has no replicate, a path is not a sequence of labels,
        or paths differ in length.
    """
    by_name = dict.fromkeys(names, ()) if paths is None else _check_tree(names, paths)
    leaves = [(*by_name[name], name) for name in names]
    groups = (f"group-{level}" for level in range(1, len(leaves[0])))
    layers = (PARENT, *groups, CHILD)
    return {layer: tuple(leaf[:level] for leaf in leaves) for level, layer in enumerate(layers)}


def is_path(value: object) -> bool:
    """Return whether ``value`` is a tuple or a list of labels."""
    return isinstance(value, (tuple, list)) and all(isinstance(label, str) for label in value)


def _check_tree(names: Sequence[str], paths: Mapping[str, Path]) -> Mapping[str, Path]:
    if not isinstance(paths, Mapping):
        raise ValueError(
            f"expected tree to be a mapping from the name of each recording to its path, such as "
            f"{{{names[0]!r}: ('walk',)}}, got {paths!r}"
        )
    _check_names(set(names), set(paths))
    for name, path in paths.items():
        if not is_path(path):
            raise ValueError(
                f"expected the path of {name!r} in tree to be a tuple of names of groups, such as "
                f"('walk',), got {path!r}"
            )
    lengths = {len(path): name for name, path in paths.items()}
    if len(lengths) > 1:
        examples = ", ".join(f"{name!r} has {paths[name]!r}" for _, name in sorted(lengths.items()))
        raise ValueError(
            f"expected all paths in tree to be equally long, got {examples}: give a recording that "
            "has no group at some depth a group with that recording alone"
        )
    return paths


def _check_names(names: set[str], known: set[str]) -> None:
    if names - known:
        raise ValueError(
            f"expected tree to have a path for every recording given to fit, got none for "
            f"{sorted(names - known)}"
        )
    if known - names:
        raise ValueError(
            f"expected tree to have paths of recordings given to fit, {sorted(names)}, got one "
            f"for {sorted(map(str, known - names))}: leave it out, or give fit the recording"
        )
