"""Labelings of binary constraint networks."""

from __future__ import annotations

import json
import os
from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from . import _assay
from .errors import NoAnswer, NoPlan, WrongInput, WrongUsage

_REQUESTS = ("first", "all", "count")


class Labels:
    """The labelings of a network.

    labelings: a list of dicts, a label for each node; at most one for "first", none for "count".
    count: how many labelings there are; None for "first".
    or_more: whether there are that many or more.
    visited: how many nodes of the search tree were visited.
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
    budget: how many nodes of the search tree are visited.

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
    nodes = list(network.get("nodes", {}))
    labels = {node: range(given) if isinstance(given, (int, np.integer)) else list(given)
              for node, given in network.get("nodes", {}).items()}
    if not any("allowed" in arc for arc in network.get("arcs", ())):
        named = {node: {_name(label): label for label in labels[node]} for node in nodes}
        return nodes, named, _assay.Network(json.dumps(network, default=_plain), "<network>")
    numbered = {node: {str(i): label for i, label in enumerate(labels[node])} for node in nodes}
    places = {node: place for place, node in enumerate(nodes)}
    arcs = []
    for number, arc in enumerate(network["arcs"]):
        a, b = arc["between"]
        if a not in places or b not in places:
            raise WrongInput(f"<network>: arc {number} is between {a!r} and {b!r}; allowed: "
                             f"{', '.join(map(repr, nodes))}")
        arcs.append((places[a], places[b], _matrix(number, arc, labels[a], labels[b])))
    return nodes, numbered, _assay.Network([len(labels[node]) for node in nodes], arcs)


def _name(label: Any) -> str:
    """Returns how a file names a label."""
    return label if isinstance(label, str) else json.dumps(label, default=_plain)


def _matrix(number: int, arc: Mapping[str, Any], rows: Sequence[Any],
            columns: Sequence[Any]) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Returns the allowed pairs of an arc as a matrix."""
    shape = (len(rows), len(columns))
    if "allowed" in arc:
        matrix = np.asarray(arc["allowed"], dtype=bool)
        if matrix.shape != shape:
            raise WrongInput(f"<network>: `allowed` of arc {number} has the shape {matrix.shape}; "
                             f"allowed: {shape}")
        return matrix
    matrix = np.full(shape, "forbidden" in arc)
    for row, column in arc["forbidden" if "forbidden" in arc else "pairs"]:
        try:
            matrix[rows.index(row), columns.index(column)] = "forbidden" not in arc
        except ValueError:
            raise WrongInput(f"<network>: arc {number} has no pair {(row, column)!r}") from None
    return matrix


def _plain(value: Any) -> Any:
    """Numbers and arrays of numpy for JSON."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise WrongInput(f"<network>: {value!r} is no name, number or list")
