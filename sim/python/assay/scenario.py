"""Scenarios."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from . import _assay
from .plans import PathLike, Plan
from .trees import PlanTree


class Scenario:
    """A scenario file: parts, a workcell, bounded errors and a goal.

    path: the scenario file.
    models: more folders of models, which are searched first.
    clearance: the gap on each side of a mated shaft in metres, instead of the file's.
    error_scale: a factor on the errors of all parts and of the hand.

    Raises WrongInput if the file or the clearance is wrong, and WrongUsage for a negative factor.
    """

    def __init__(self, path: PathLike, *, models: Iterable[PathLike] = (),
                 clearance: float | None = None, error_scale: float = 1.0) -> None:
        self.path = Path(path)
        self._settings = _assay.PlanSettings()
        self._settings.scenario = os.fspath(path)
        self._settings.models = [os.fspath(folder) for folder in models]
        self._settings.clearance = clearance
        self._settings.error_scale = error_scale
        self._described = _assay.describe(self._settings)

    @property
    def name(self) -> str:
        """The file's name without its ending."""
        return self._described["name"]

    @property
    def title(self) -> str:
        """One line for people; may be empty."""
        return self._described["title"]

    @property
    def parts(self) -> list[str]:
        """The names of the parts."""
        return self._described["parts"]

    @property
    def sensors(self) -> list[str]:
        """The names of the sensors that may be used."""
        return self._described["sensors"]

    @property
    def resolvers(self) -> list[str]:
        """The ways of reducing uncertainty, in the order in which they are tried."""
        return self._described["resolvers"]

    @property
    def clearance(self) -> float:
        """The gap on each side of a mated shaft, in metres."""
        return self._described["clearance"]

    @property
    def needs_tree(self) -> bool:
        """Whether the plan is a tree: the goal is about knowledge, or a pose is open."""
        return self._described["needs_tree"]

    def plan(self, *, resolvers: Iterable[str] | None = None, propagation: str = "sound",
             budget: int | None = None, tree: bool = False) -> Plan | PlanTree:
        """Makes a plan with certificates, or a plan tree if the scenario needs one.

        resolvers: the ways of reducing uncertainty that may be used: "sensing", "squeezing" and
            "fine-motion"; those of the scenario if left out or empty.
        propagation: how errors pass from step to step: "sound" is correct for all errors, "paper"
            uses the published rules, by which certificates can be false.
        budget: the limit of partial plans that the search may look at, or of knowledge states if
            the goal is about knowledge; the program's limit if left out.
        tree: makes a tree even if none is needed: verifications branch, recoveries repeat.

        Raises NoPlan with the conflict if it is proved that there is no plan, NoAnswer if the
        budget was spent or the planner met one of its limits, and WrongUsage for a wrong argument.
        If the goal is about knowledge, `resolvers` and `propagation` are wrong arguments.
        """
        settings = _assay.PlanSettings()
        for name in ("scenario", "models", "clearance", "error_scale"):
            setattr(settings, name, getattr(self._settings, name))
        settings.resolvers = None if resolvers is None else _names(resolvers)
        settings.propagation = propagation
        settings.budget = budget
        if tree or self.needs_tree:
            return PlanTree(_assay.Tree.make(settings), self.name)
        return Plan(_assay.Plan.make(settings))

    def __repr__(self) -> str:
        return f"<Scenario {self.name}: {self.title}>"


def _names(names: Iterable[str]) -> list[str]:
    return names.split(",") if isinstance(names, str) else list(names)
