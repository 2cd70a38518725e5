"""Plan trees: plans that branch on what sensors tell."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import pandas as pd

from . import _assay
from .errors import Failed, Interrupted, WrongUsage
from .plans import PathLike, Plan
from .trials import Trace, require_count, require_jobs, require_seed
from .view import View


class PlanTree:
    """A plan that branches on what sensors tell. Scenario.plan makes it.

    name: the name of the scenario.
    plans: the plans for the worlds that the open poses of a scenario allow. Each plan has its own
        certificates. The list is empty if the goal is about knowledge. Such a tree has no
        certificates, and everything that needs certificates raises WrongUsage.
    """

    def __init__(self, handle: _assay.Tree, name: str) -> None:
        self._handle = handle
        self.name = name
        self.plans: list[Plan] = [
            Plan(plan, _world(of["worlds"]))
            for plan, of in zip(handle.plans(), self.json.get("plans", ()))]

    @cached_property
    def json(self) -> dict[str, Any]:
        """What `assay plan --json` prints: `tree` with its nodes, and the plans of the worlds."""
        return self._handle.json()

    @property
    def tree(self) -> dict[str, Any]:
        """The nodes of the tree, as in the files of plan trees."""
        return self.json["tree"]

    @cached_property
    def dot(self) -> str:
        """The tree for Graphviz."""
        return self._handle.dot()

    def save(self, path: PathLike) -> Path:
        """Writes what `assay plan --json` prints, and returns the path. No command reads it."""
        file = Path(path)
        file.write_text(self._handle.file_text(), encoding="utf-8")
        return file

    @cached_property
    def steps(self) -> pd.DataFrame:
        """One row for each line of the tree.

        Columns: step (from 1), depth (how many branches are above), kind ("action", "branch", or
        "go to" for a sub-plan that is shared), action (the text of the line).
        """
        rows = [(place, line["depth"], line["kind"], line["text"])
                for place, line in enumerate(self._handle.lines(), 1)]
        return pd.DataFrame(rows, columns=["step", "depth", "kind", "action"])

    @property
    def proved(self) -> bool:
        """Whether every precondition of every step of all plans is proved."""
        return all(plan.proved for plan in self._certified("preconditions with bounds"))

    @cached_property
    def certificates(self) -> pd.DataFrame:
        """Plan.certificates of all plans. The first column, plan, is the plan's number from 1."""
        return self._joined("certificates")

    @cached_property
    def sensitivity(self) -> pd.DataFrame:
        """Plan.sensitivity of all plans, with the column plan. The column precondition is the index
        in PlanTree.certificates."""
        table = self._joined("sensitivity")
        before = np.cumsum([0, *(len(plan.certificates) for plan in self.plans)])
        table["precondition"] += before[table["plan"].to_numpy(dtype=int) - 1]
        return table

    @cached_property
    def error_sets(self) -> pd.DataFrame:
        """Plan.error_sets of all plans, with the column plan."""
        return self._joined("error_sets")

    @cached_property
    def error_box(self) -> pd.DataFrame:
        """Plan.error_box of all plans, with the column plan."""
        return self._joined("error_box")

    def explain(self, step: int | str, plan: int = 1) -> str:
        """Explains why a step of a plan is safe or not. `plan` is the plan's number, from 1."""
        plans = self._certified("certificates to explain")
        if not 1 <= plan <= len(plans):
            raise WrongUsage(f"there is no plan {plan!r}; allowed: 1 to {len(plans)}")
        return plans[plan - 1].explain(step)

    def check(self, *, worlds: int = _assay.WORLDS) -> TreeCheck:
        """Runs the tree in the worlds that the initial knowledge allows, and checks each plan.

        worlds: up to this many worlds are run one by one. If there are more, all of them are run as
            sets. If sets cannot decide, this many worlds are drawn at random.
        """
        require_count("worlds", worlds)
        return TreeCheck(self._handle.check(worlds), self.plans)

    def view(self, trial: int = 1, *, worlds: str = "drawn") -> View:
        """Executes the trial with this number, from 1, and returns the page that shows it."""
        require_count("trial", trial)
        return View(_assay.TreeTrials(self._handle, _settings(worlds)).traced(trial).page())

    def run(self, *, noise: str | None = "uniform", trials: int | None = None,
            seed: int | None = None, jobs: int = 1, worlds: str = "drawn",
            sensing_errors: float = 0.0) -> TreeRun:
        """Executes the tree in physics, and compares what it claims to know with the simulator.

        noise: "uniform" or None. Trials of trees always draw the errors of parts and hand uniformly
            within their bounds.
        trials: the number of trials. If left out, there is one trial, or with worlds="all" one
            trial for each leaf that a world leads to.
        jobs: the number of threads. The result does not depend on it.
        seed: the seed of errors and hidden facts; the scenario's seed if left out.
        worlds: "drawn" draws the hidden facts; with "all", the trials go through the leaves and
            repeats of the tree in turn.
        sensing_errors: the probability, from 0 to 1, with which an observation is made wrong.

        Failed trials are in the result. Raises WrongUsage for wrong arguments, and Interrupted at
        Ctrl-C, with the trials that were done in `result`.
        """
        if noise not in (None, "uniform"):
            raise WrongUsage(f"trials of a plan tree have no noise {noise!r}; allowed: uniform")
        require_jobs(jobs)
        runner = _assay.TreeTrials(self._handle, _settings(worlds, sensing_errors, seed))
        count = runner.usual_count if trials is None else trials
        require_count("trials", count)
        result, is_interrupted = runner.run(count, jobs)
        made = TreeRun(runner, result)
        if is_interrupted:
            raise Interrupted(f"{len(made.trials)} of {count} trials are done", made)
        return made

    def falsify(self, **_: Any) -> NoReturn:
        """Raises WrongUsage, because attempts are made at the steps of one plan.

        Each of `plans` can be falsified, and `run(sensing_errors=...)` makes sensed values wrong.
        """
        self._certified("certificates to falsify")
        raise WrongUsage("attempts are made at the steps of one plan, and the plan for "
                         f"{self.name} is a tree; allowed: plans[0].falsify(), and "
                         "run(sensing_errors=...)")

    def _certified(self, what: str) -> list[Plan]:
        if not self.plans:
            raise WrongUsage(f"the goal of {self.name} is about knowledge, so its plan tree has no "
                             f"{what}")
        return self.plans

    def _joined(self, name: str) -> pd.DataFrame:
        tables = [getattr(plan, name) for plan in self._certified(name.replace("_", " "))]
        joined = pd.concat(tables, keys=range(1, len(tables) + 1), names=["plan", None])
        return joined.reset_index(level="plan").reset_index(drop=True)

    def __str__(self) -> str:
        return self._handle.text()

    def __repr__(self) -> str:
        return self._handle.text().rstrip("\n")


class TreeCheck:
    """What the check of a plan tree says.

    holds: whether no flaw was found.
    flaws: a DataFrame with the columns plan (its number from 1, or None for the tree), step (the
        step's id, or None for the whole plan) and what.
    text: the result of the check as a text for people.
    """

    def __init__(self, tree: Mapping[str, Any], plans: list[Plan]) -> None:
        checks = [plan.check() for plan in plans]
        rows = [] if tree["holds"] else [(None, None, tree["failure"])]
        for number, check in enumerate(checks, 1):
            rows += [(number, *flaw) for flaw in check.flaws.itertuples(index=False)]
        self.flaws = pd.DataFrame(rows, columns=["plan", "step", "what"])
        self.holds: bool = not rows
        self.text: str = tree["text"] + "".join(
            f"plan {number}: {check.text}" for number, check in enumerate(checks, 1))

    def __bool__(self) -> bool:
        return self.holds

    def __repr__(self) -> str:
        return self.text.rstrip("\n")


class TreeRun:
    """Trials of a plan tree.

    trials: a DataFrame with one row for each trial: trial (from 1), outcome ("reached" or what
        failed), reason, mishap (the fault that the simulator added, or empty), goal (whether it is
        true in the end), greatest_tilt (of parts that can spill, radians), spilled, fallen (lists
        of parts), simulated (seconds), holds.
    steps: one row for each action that was executed: trial, step (from 1), action, end (simulated
        seconds).
    branches: one row for each branch that was taken: trial, outcome, flipped (whether the
        observation was made wrong on purpose).
    false_claims: one row for each fact that the tree claimed to know falsely: trial, after_step,
        atom, claimed, true, truth.
    leaves: one row for each leaf of the tree: outcomes (the branches to it), unreachable (why no
        world leads there, or empty), trials, reached, operator_called, greatest_tilt (radians).
    collisions: one row for each collision: trial, time (seconds), robot, other.
    seed: the seed of errors and hidden facts.
    """

    def __init__(self, runner: _assay.TreeTrials, result: Mapping[str, Any]) -> None:
        self._runner = runner
        self.seed: int = runner.seed
        rows = result["rows"]
        self.trials = pd.DataFrame(
            [{**row, "greatest_tilt": np.deg2rad(row["greatest_tilt"]),
              "holds": row["outcome"] == "reached"
              or row["outcome"] == "operator-called" and bool(row["mishap"])} for row in rows],
            columns=["trial", "outcome", "reason", "mishap", "goal", "greatest_tilt", "spilled",
                     "fallen", "simulated", "holds"])
        self.steps = _of_trials(rows, "steps", ["action", "end"])
        self.steps.insert(1, "step", self.steps.groupby("trial").cumcount() + 1)
        self.branches = _of_trials(rows, "branches", ["outcome", "flipped"])
        self.false_claims = _of_trials(rows, "false_claims",
                                       ["after_step", "atom", "claimed", "true", "truth"])
        self.collisions = _of_trials(rows, "collisions", ["time", "robot", "other"])
        self.leaves = pd.DataFrame(result["leaves"],
                                   columns=["outcomes", "unreachable", "trials", "reached",
                                            "operator_called", "greatest_tilt"])
        self.leaves["greatest_tilt"] = np.deg2rad(self.leaves["greatest_tilt"].astype(float))

    @property
    def verdicts(self) -> NoReturn:
        """Raises WrongUsage, because trials of trees judge no certificates. See `false_claims`."""
        raise WrongUsage("trials of a plan tree judge no certificates; allowed: false_claims, "
                         "which has what the tree claimed to know falsely")

    @property
    def holds(self) -> bool:
        """Whether every trial reached the goal, or called a person after a fault, as planned."""
        return bool(self.trials["holds"].all())

    def require(self) -> TreeRun:
        """Returns the run if it holds. Raises Failed, exit code 12, if it does not."""
        if self.holds:
            return self
        failed = self.trials[~self.trials["holds"]].iloc[0]
        raise Failed(f"{int((~self.trials['holds']).sum())} of {len(self.trials)} trials failed; "
                     f"trial {failed['trial']}: {failed['outcome']}: {failed['reason']}")

    def trace(self, trial: int) -> Trace:
        """Executes the trial with this number, from 1, again and returns its trace."""
        require_count("trial", trial)
        return Trace(self._runner.traced(trial))

    def __repr__(self) -> str:
        reached = int((self.trials["outcome"] == "reached").sum())
        return f"<TreeRun: {reached} of {len(self.trials)} trials reached the goal>"


def _world(worlds: list[dict[str, str]]) -> dict[str, list[str]]:
    """Returns the poses of each part in these worlds."""
    return {part: sorted({world[part] for world in worlds}) for part in worlds[0]}


def _settings(worlds: str, sensing_errors: float = 0.0,
              seed: int | None = None) -> _assay.TreeTrialSettings:
    if worlds not in ("drawn", "all"):
        raise WrongUsage(f"there are no worlds {worlds!r}; allowed: drawn, all")
    if not 0 <= sensing_errors <= 1:
        raise WrongUsage(f"sensing_errors is {sensing_errors}; allowed: 0 to 1")
    require_seed(seed)
    settings = _assay.TreeTrialSettings()
    settings.is_every_leaf = worlds == "all"
    settings.sensing_errors = sensing_errors
    settings.seed = seed
    return settings


def _of_trials(rows: list[dict[str, Any]], name: str, columns: list[str]) -> pd.DataFrame:
    records = [{"trial": row["trial"], **record} for row in rows for record in row[name]]
    return pd.DataFrame(records, columns=["trial", *columns])
