"""Labelings of binary constraint networks."""

from __future__ import annotations

import json
import os
from collections.abc import Hashable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from . import _assay
from .errors import NoAnswer, NoPlan, WrongInput, WrongUsage

_REQUESTS = ("first", "all", "count")


class Labels:
    """The labelings of a network.

    labelings: a list of dicts with a label for each node: one dict for "first", none for "count".
    count: the number of labelings; None for "first".
    or_more: whether there may be more labelings than `count`.
    visited: the number of visited nodes of the search tree.
    """

    def __init__(self, labelings: list[dict[Hashable, Hashable]], count: int | None, or_more: bool,
                 visited: int) -> None:
        self.labelings = labelings
        self.count = count
        self.or_more = or_more
        self.visited = visited

    @property
    def labeling(self) -> dict[Hashable, Hashable]:
        """The first labeling. Raises IndexError if only the count was asked for."""
        return self.labelings[0]

    @property
    def table(self) -> pd.DataFrame:
        """One row for each labeling, one column for each node."""
        return pd.DataFrame(self.labelings)

    def __repr__(self) -> str:
        if self.count is not None:
            return f"<Labels: {self.count} labelings{' or more' if self.or_more else ''}>"
        return f"<Labels: {self.labelings[0]}>"


def label(network: str | os.PathLike[str] | Mapping[str, Any], request: str = "first", *,
          budget: int = 100_000_000) -> Labels:
    """Labels a binary constraint network.

        allowed = ~numpy.eye(3, dtype=bool)
        assay.label({"nodes": {"a": 3, "b": ["red", "green", "blue"]},
                     "arcs": [{"between": ["a", "b"], "allowed": allowed}]})

    network: a file, or a mapping with the contents of such a file. `nodes` has for each node a
        list of labels, or their number n for the labels 0 to n - 1. Each of `arcs` is between two
        nodes, with the allowed `pairs`, the `forbidden` ones, or `allowed`, a matrix of bools whose
        rows are the labels of the first node and whose columns are those of the second.
    request: "first" for one labeling, "all", or "count" for their number alone.
    budget: the limit of visited nodes of the search tree.

    Raises NoPlan if there is no labeling, NoAnswer if the budget was spent, and WrongInput if the
    network is wrong.
    """
    if request not in _REQUESTS:
        raise WrongUsage(f"there is no request {request!r}; allowed: {', '.join(_REQUESTS)}")
    if budget < 1:
        raise WrongUsage(f"the budget is {budget}; allowed: 1 or more")
    if isinstance(network, Mapping):
        nodes, labels, handle = _of_mapping(network)
        found = handle.label(_REQUESTS.index(request), budget)
        labelings = [{node: labels[node][name] for node, name in zip(nodes, labeling.values())}
                     for labeling in found["labelings"]]
    else:
        found = _assay.load_network(os.fspath(network)).label(_REQUESTS.index(request), budget)
        labelings = found["labelings"]
    if found["outcome"] == NoPlan.exit_code:
        raise NoPlan("the network has no labeling")
    if found["outcome"] == NoAnswer.exit_code:
        raise NoAnswer("the budget of search nodes was spent")
    return Labels(labelings, found["count"], found["or_more"], found["visited"])


def _of_mapping(network: Mapping[str, Any]) -> tuple[list[Any], dict[Any, Any], _assay.Network]:
    """Returns the nodes, the labels of each node by the names that the engine has for them, and the
    network."""
    given, arcs = network.get("nodes", {}), network.get("arcs", ())
    if not isinstance(given, Mapping) or not all(isinstance(arc, Mapping) for arc in arcs):
        raise WrongInput("<network>: allowed: a mapping `nodes`, and a list `arcs` of mappings")
    nodes = list(given)
    labels = {node: _labels(node, of) for node, of in given.items()}
    if not any("allowed" in arc for arc in arcs):
        named = {node: {_name(label): label for label in labels[node]} for node in nodes}
        return nodes, named, _assay.Network(json.dumps(network, default=_plain), "<network>")
    numbered = {node: {str(i): label for i, label in enumerate(labels[node])} for node in nodes}
    places = {node: place for place, node in enumerate(nodes)}
    matrices = []
    for number, arc in enumerate(arcs):
        between = list(arc.get("between", ()))
        if len(between) != 2 or not all(node in places for node in between):
            raise WrongInput(f"<network>: arc {number} is between {between!r}; allowed: two of "
                             f"{', '.join(map(repr, nodes))}")
        a, b = between
        matrices.append((places[a], places[b], _matrix(number, arc, labels[a], labels[b])))
    return nodes, numbered, _assay.Network([len(labels[node]) for node in nodes], matrices)


def _labels(node: Any, given: Any) -> Sequence[Any]:
    """Returns the labels of a node, or raises WrongInput."""
    is_number = isinstance(given, (int, np.integer)) and not isinstance(given, bool)
    if is_number and 0 <= given <= _assay.MOST_LABELS:
        return range(given)
    if is_number or isinstance(given, (str, bytes)) or not isinstance(given, Iterable):
        raise WrongInput(f"<network>: the node {node!r} has the labels {given!r}; allowed: a list, "
                         f"or their number, 0 to {_assay.MOST_LABELS}")
    labels = list(given)
    if len(labels) > _assay.MOST_LABELS:
        raise WrongInput(f"<network>: the node {node!r} has {len(labels)} labels; allowed: at most "
                         f"{_assay.MOST_LABELS}")
    seen: set[Hashable] = set()
    for label in labels:
        if not isinstance(label, Hashable) or label in seen:
            raise WrongInput(f"<network>: the label {label!r} of node {node!r} is "
                             f"{'given twice' if isinstance(label, Hashable) else 'no label'}")
        seen.add(label)
    return labels


def _name(label: Any) -> str:
    """Returns how a file names a label."""
    return label if isinstance(label, str) else json.dumps(label, default=_plain)


def _matrix(number: int, arc: Mapping[str, Any], rows: Sequence[Any],
            columns: Sequence[Any]) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Returns the allowed pairs of an arc as a matrix."""
    shape = (len(rows), len(columns))
    if sum(kind in arc for kind in ("allowed", "pairs", "forbidden")) != 1:
        raise WrongInput(f"<network>: arc {number} has {', '.join(map(repr, arc))}; allowed: one "
                         "of 'allowed', 'pairs' and 'forbidden'")
    if "allowed" in arc:
        try:
            matrix = np.asarray(arc["allowed"], dtype=bool)
        except ValueError as error:
            raise WrongInput(f"<network>: `allowed` of arc {number}: {error}") from None
        if matrix.shape != shape:
            raise WrongInput(f"<network>: `allowed` of arc {number} has the shape {matrix.shape}; "
                             f"allowed: {shape}")
        return matrix
    matrix = np.full(shape, "forbidden" in arc)
    for pair in arc["forbidden" if "forbidden" in arc else "pairs"]:
        try:
            row, column = pair
            matrix[rows.index(row), columns.index(column)] = "forbidden" not in arc
        except (TypeError, ValueError):
            raise WrongInput(f"<network>: arc {number} has no pair {pair!r}") from None
    return matrix


def _plain(value: Any) -> Any:
    """Numbers and arrays of numpy for JSON."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise WrongInput(f"<network>: {value!r} is no name, number or list")
