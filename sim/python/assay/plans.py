"""Plans without branches, and what their checks say."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from . import _assay
from .errors import Interrupted, WrongUsage
from .trials import (Falsification, Run, errors_text, require_count, require_jobs,
                     trial_settings)
from .view import View

PathLike = str | os.PathLike[str]


class Check:
    """What the independent checker, and a second computation of the certificates, say about a plan.

    holds: whether no flaw was found.
    flaws: a DataFrame with the columns step (the step's id, or None for the whole plan) and what.
    text: the result of the check as a text for people.
    orders: the number of orders of the steps that the checker went through.
    """

    def __init__(self, report: Mapping[str, Any]) -> None:
        self.flaws = pd.DataFrame(report["flaws"], columns=["step", "what"])
        self.holds = self.flaws.empty
        self.text: str = report["text"]
        self.orders: int = report["orders"]

    def __bool__(self) -> bool:
        return self.holds

    def __repr__(self) -> str:
        return self.text.rstrip("\n")


class Plan:
    """A plan with its certificates. Scenario.plan makes it, and Plan.read reads it.

    Steps are numbered from 1 in the order of execution. If the plan belongs to a PlanTree, `world`
    has the poses of the parts in the plan's worlds, such as {"peg": ["lying"]}. Otherwise it is
    None.
    """

    def __init__(self, handle: _assay.Plan, world: dict[str, list[str]] | None = None) -> None:
        self._handle = handle
        self.world = world

    @classmethod
    def read(cls, path: PathLike, *, models: Iterable[PathLike] = ()) -> Plan:
        """Reads a plan file. Raises WrongInput if it, or the scenario that it names, is wrong."""
        return cls(_assay.Plan.read(os.fspath(path), [os.fspath(folder) for folder in models]))

    def save(self, path: PathLike) -> Path:
        """Writes a plan file, which the program `assay` can read. Returns the file's path.

        Raises WrongUsage if the plan belongs to a PlanTree, because no plan file can name its
        worlds.
        """
        if self.world:
            raise WrongUsage("the plan is for some worlds of a scenario, which no plan file can "
                             "name; allowed: save the tree")
        file = Path(path)
        file.write_text(self._handle.file_text(), encoding="utf-8")
        return file

    @cached_property
    def json(self) -> dict[str, Any]:
        """The contents of the plan file."""
        return self._handle.json()

    @cached_property
    def _actions(self) -> list[dict[str, Any]]:
        return sorted(self.json["actions"], key=lambda action: action["executed"])

    @property
    def proved(self) -> bool:
        """Whether every precondition of every step is proved."""
        return self.json["errors"] == 0

    @cached_property
    def steps(self) -> pd.DataFrame:
        """One row for each step.

        Columns: step (from 1), id, action, preconditions (their number), unproved (how many of them
        are not proved).
        """
        rows = []
        for action in self._actions:
            preconditions = action.get("certificate", {}).get("preconditions", [])
            rows.append({
                "step": action["executed"], "id": action["id"], "action": _action_text(action),
                "preconditions": len(preconditions),
                "unproved": sum(float(p["margin"]) <= 0 for p in preconditions)})
        return pd.DataFrame(rows, columns=["step", "id", "action", "preconditions", "unproved"])

    @cached_property
    def certificates(self) -> pd.DataFrame:
        """One row for each precondition of each step.

        Columns: step (from 1), id, action, condition, meaning, relation ("<" or ">"), limit, bound
        (SUP for "<", INF for ">"; guaranteed), margin (from the bound to the limit; positive if
        proved), proved, gap (how far the bound may be from the true value), rung (the method), unit
        (of limit, bound, margin, gap and cost), worst (a dict: the worst corner found, in metres
        and radians, by variable), cost (a dict: by how much the bound would improve if the variable
        were known, the greatest first).
        """
        rows = []
        for action, proofs in zip(self._actions, self._proofs):
            for condition, proof in zip(action["certificate"]["preconditions"], proofs):
                rows.append({
                    **_step(action), "condition": condition["condition"],
                    "meaning": condition["meaning"], "relation": condition["relation"],
                    "limit": float(condition["limit"]), "bound": float(condition["bound"]),
                    "margin": float(condition["margin"]), "proved": float(condition["margin"]) > 0,
                    "gap": float(condition["gap"]), "rung": condition["rung"],
                    "unit": proof["unit"], "worst": condition["worst"],
                    "cost": {v["variable"]: v["cost"] for v in proof["variables"]}})
        return pd.DataFrame(rows, columns=[
            "step", "id", "action", "condition", "meaning", "relation", "limit", "bound", "margin",
            "proved", "gap", "rung", "unit", "worst", "cost"])

    @cached_property
    def sensitivity(self) -> pd.DataFrame:
        """One row for each precondition and variable that costs something.

        Columns: step, id, action, condition, precondition (its index in `certificates`), variable,
        low, high (the variable's range, metres or radians), worst (its value at the worst corner),
        cost (the bound's improvement if the variable were known), unit (of the cost).
        """
        rows = []
        number = 0
        for action, proofs in zip(self._actions, self._proofs):
            for condition, proof in zip(action["certificate"]["preconditions"], proofs):
                for v in proof["variables"]:
                    rows.append({
                        **_step(action), "condition": condition["condition"],
                        "precondition": number, "variable": v["variable"], "low": v["low"],
                        "high": v["high"], "worst": v["worst"], "cost": v["cost"],
                        "unit": proof["unit"]})
                number += 1
        return pd.DataFrame(rows, columns=[
            "step", "id", "action", "condition", "precondition", "variable", "low", "high", "worst",
            "cost", "unit"])

    @cached_property
    def error_sets(self) -> pd.DataFrame:
        """The ranges of the parts' true poses about their believed poses, around each step.

        Columns: step, id, action, when ("before" or "after"), part, in_hand, component (x, y, z,
        theta; in the hand also tip and twist), low, high, unit.
        """
        rows = []
        for action in self._actions:
            for when in ("before", "after"):
                for box in action["certificate"].get(when, []):
                    for component in ("x", "y", "z", "theta", "tip", "twist"):
                        if component in box:
                            low, high = box[component]
                            rows.append({
                                **_step(action), "when": when, "part": box["part"],
                                "in_hand": box["in_hand"], "component": component,
                                "low": float(low), "high": float(high),
                                "unit": "m" if component in "xyz" else "rad"})
        return pd.DataFrame(rows, columns=[
            "step", "id", "action", "when", "part", "in_hand", "component", "low", "high", "unit"])

    @cached_property
    def error_box(self) -> pd.DataFrame:
        """One row for each bounded error that the proofs assume: variable, unit, low, high.

        The argument `errors` of `run` gives values to these variables.
        """
        return pd.DataFrame(self._handle.error_box(), columns=["variable", "unit", "low", "high"])

    def explain(self, step: int | str) -> str:
        """Explains from the certificate why a step is safe or not. `step` is its number or its id.

        Raises WrongUsage if there is no such step.
        """
        for action in self._actions:
            if step in (action["executed"], action["id"]):
                return self._handle.explain(action["executed"])
        raise WrongUsage(f"there is no step {step!r}; allowed: 1 to {len(self._actions)}, or an id "
                         f"such as {self._actions[0]['id']}")

    def budget(self, *, front: Iterable[str] = ()) -> dict[str, Any]:
        """Returns the errors that the plan can bear, as `assay budget --json` prints them.

        front: two or three errors whose Pareto front is wanted, such as ["hand.xy", "peg.theta"].
        Raises WrongUsage if the plan has no such errors.
        """
        return self._handle.budget(list(front))

    def check(self) -> Check:
        """Checks the plan by the independent checker, and computes its certificates again."""
        return Check(self._handle.check())

    def view(self) -> View:
        """Executes the plan once without noise, and returns the page that shows it."""
        runner = _assay.Trials(self._handle, _assay.TrialSettings(), False)
        return View(runner.traced(1).page())

    def run(self, *, noise: str | None = None, trials: int = 1, seed: int | None = None,
            jobs: int = 1, errors: str | Mapping[str, float] | None = None, sensing: str = "drawn",
            grasp: str | None = None) -> Run:
        """Executes the plan in physics, and judges each trial by the true poses.

        noise: how errors are drawn within the bounds that the planner assumes: "none", "uniform",
            "vertices" or "low-discrepancy". Without noise no certificate is judged.
        trials: the number of trials.
        jobs: the number of threads. The result does not depend on it.
        seed: the seed of the errors; the scenario's seed if left out.
        errors: instead of `noise`, the errors of all trials: a value for each variable of
            `error_box`, in metres and radians.
        sensing: "drawn" draws the errors of sensors within their promises; "camera" measures the
            parts in rendered pictures.
        grasp: how the gripper holds parts, "friction" or "weld"; the scenario's if left out.

        Failed trials are in the result. Raises Failed if the plan itself has flaws, WrongUsage or
        WrongInput for wrong arguments, and Interrupted at Ctrl-C, with the trials that were done in
        `result`.
        """
        require_count("trials", trials)
        require_jobs(jobs)
        settings = trial_settings(noise, errors_text(errors), sensing, grasp, seed)
        runner = _assay.Trials(self._handle, settings, False)
        wrong = runner.wrong_without_noise()
        rows, is_interrupted = ([], False) if wrong else runner.run(trials, jobs)
        made = Run(runner, rows, wrong)
        if is_interrupted:
            raise Interrupted(f"{len(rows)} of {trials} trials are done", made)
        return made

    def falsify(self, *, attempts: int = 1000, seed: int | None = None, jobs: int = 1,
                grasp: str | None = None) -> Falsification:
        """Tries to falsify each certificate by errors within the bounds.

        attempts: the number of attempts for all steps together; each attempt executes one step.
        The other arguments and the exceptions are those of `run`.
        """
        require_count("attempts", attempts)
        require_jobs(jobs)
        settings = trial_settings(None, None, "drawn", grasp, seed)
        runner = _assay.Trials(self._handle, settings, True)
        *found, is_interrupted = runner.falsify(attempts, jobs)
        made = Falsification(self, runner.seed, *found)
        if is_interrupted:
            raise Interrupted(f"{made.attempts} of {attempts} attempts are made", made)
        return made

    @cached_property
    def _proofs(self) -> list[list[dict[str, Any]]]:
        return self._handle.proofs()

    def __str__(self) -> str:
        return self._handle.text()

    def __repr__(self) -> str:
        return self._handle.text().rstrip("\n")


def _step(action: Mapping[str, Any]) -> dict[str, Any]:
    return {"step": action["executed"], "id": action["id"], "action": _action_text(action)}


def _action_text(action: Mapping[str, Any]) -> str:
    arguments = [value for value in action["arguments"].values() if isinstance(value, str)]
    return f"{action['name']}({', '.join(arguments)})"
