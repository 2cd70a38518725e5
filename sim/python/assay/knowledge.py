"""Planning with knowledge that is available only during execution (PKS, contingent PDDL)."""

from __future__ import annotations

import json
import os
from typing import Any

from . import _assay
from .errors import WrongUsage


class ContingentPlan:
    """A plan tree.

    json: what `assay contingent --json` prints: `tree` with its nodes, sizes, `check`.
    dot: the tree for Graphviz.
    """

    def __init__(self, text: str, as_json: str, dot: str) -> None:
        self._text = text
        self.json: dict[str, Any] = json.loads(as_json)
        self.dot = dot

    @property
    def tree(self) -> dict[str, Any]:
        """The nodes of the tree, as in the files of plan trees."""
        return self.json["tree"]

    @property
    def depth(self) -> int:
        """The number of actions on the longest path."""
        return self.json["depth"]

    @property
    def leaves(self) -> int:
        """The number of leaves."""
        return self.json["leaves"]

    @property
    def guarantee(self) -> str:
        """What the tree promises, in words."""
        return self.json["guarantee"]

    @property
    def holds(self) -> bool | None:
        """Whether the tree passed its check in the worlds; None if it was not checked."""
        return self.json["check"]["holds"] if "check" in self.json else None

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return self._text.rstrip("\n")


def contingent(domain: str | os.PathLike[str], problem: str | os.PathLike[str], *,
               shortest: bool = False, check: bool = False, worlds: int = _assay.WORLDS,
               budget: int = _assay.KNOWLEDGE_STATES) -> ContingentPlan:
    """Makes a plan tree for a problem of knowledge.

    domain, problem: files that end in .pks or .pddl, or their texts. A text that begins with "("
        is PDDL.
    shortest: finds the tree of least depth. This search is for small problems.
    check: runs the tree in every world that the initial knowledge allows. Up to `worlds` worlds are
        run one by one. If there are more, all of them are run as sets. If sets cannot decide,
        `worlds` worlds are drawn at random.
    budget: the limit of knowledge states that the search may look at.

    Raises NoPlan if no tree follows from the known facts, NoAnswer if the budget was spent or the
    search left out a step, and WrongInput if a text is wrong.
    """
    if worlds < 1 or budget < 1:
        raise WrongUsage("allowed: 1 world or more, and a budget of 1 or more")
    if _is_path(domain) != _is_path(problem):
        raise WrongUsage("domain and problem are both files or both texts")
    if _is_path(domain):
        task = _assay.Task(os.fspath(domain), os.fspath(problem))
    else:
        task = _assay.Task.of_texts(str(domain).lstrip().startswith("("), domain, problem)
    as_json, text, dot = task.plan(shortest, check, worlds, budget)
    return ContingentPlan(text, as_json, dot)


def _is_path(given: str | os.PathLike[str]) -> bool:
    return not isinstance(given, str) or given.endswith((".pks", ".pddl"))
