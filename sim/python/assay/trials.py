"""Executions of plans: trials, traces and falsifications."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import pandas as pd

from . import _assay
from .errors import Failed, WrongUsage
from .view import View

if TYPE_CHECKING:
    from .plans import Plan

_TRIALS = ["trial", "outcome", "reason", "violated", "inconclusive", "contained",
           "errors_signalled", "recovered", "operator_called", "simulated", "steps", "warnings",
           "noise"]
_VERDICTS = ["step", "action", "verdict", "claim", "observed", "low", "high", "margin", "gate"]
_CLAIMS = ["claim", "step", "action", "about", "name", "unit", "low", "high", "gate", "proved",
           "observed"]
_WORST = ["claim", "step", "action", "about", "name", "unit", "verdict", "observed", "low", "high",
          "margin", "gate", "phase", "attempt", "noise"]
_COUNTEREXAMPLES = ["number", "claim", "action", "unit", "observed", "low", "high", "margin",
                    "gate", "steps", "multiple", "replayed", "noise", "replay"]


def errors_text(errors: str | Mapping[str, float] | None) -> str | None:
    """Returns errors by variable as the program writes them: "dx_block=0.002 dy_peg=-0.001"."""
    if errors is None or isinstance(errors, str):
        return errors
    return " ".join(f"{name}={float(value)!r}" for name, value in errors.items())


def trial_settings(noise: str | None, errors: str | None, sensing: str, grasp: str | None,
                   seed: int | None) -> _assay.TrialSettings:
    """Returns the settings of trials; the arguments are those of Plan.run."""
    require_seed(seed)
    settings = _assay.TrialSettings()
    settings.noise = noise
    settings.errors = errors
    settings.sensing = sensing
    settings.grasp = grasp
    settings.seed = seed
    return settings


def require_count(name: str, count: int) -> None:
    """Raises WrongUsage for a number that is not 1 or more."""
    if count < 1:
        raise WrongUsage(f"{name} is {count}; allowed: 1 or more")


def require_jobs(jobs: int) -> None:
    """Raises WrongUsage for a number of threads that the program refuses, too."""
    if not 1 <= jobs <= 1024:
        raise WrongUsage(f"jobs is {jobs}; allowed: 1 to 1024")


def require_seed(seed: int | None) -> None:
    """Raises WrongUsage for a number that is no seed."""
    if seed is not None and not 0 <= seed < 2**64:
        raise WrongUsage(f"seed is {seed}; allowed: 0 to 2^64 - 1")


class Run:
    """Trials of a plan.

    trials: a DataFrame with one row for each trial: trial (from 1), outcome ("succeeded" or what
        failed), reason, violated, inconclusive, contained (how many steps have this verdict on
        their certificate), errors_signalled, recovered, operator_called, simulated (seconds), steps
        (of the engine), warnings, noise (the errors, metres and radians).
    verdicts: one row for each trial and step: trial, step, action (the step's id), verdict
        ("contained", "inconclusive", "violated", "not-claimed"), claim (the worst claim), observed,
        low, high, margin, gate (the noise floor). The table is empty without noise.
    claims: one row for each trial and claim of a certificate: trial, claim, step (from 1), action
        (the step's id), about ("before", "precondition" or "after"), name, unit, low, high (the
        predicted range), gate, proved, observed (None if nothing was observed).
    seed: the seed of the errors.
    untestable: what the plan violates even without noise, if no trial was made for this reason;
        otherwise empty.
    """

    def __init__(self, runner: _assay.Trials, rows: list[dict[str, Any]], untestable: str) -> None:
        self._runner = runner
        self.seed: int = runner.seed
        self.untestable = untestable
        self.trials = pd.DataFrame([row["trial"] for row in rows], columns=_TRIALS)
        self.verdicts = _of_trials(rows, "verdicts", _VERDICTS)
        self.claims = _of_trials(rows, "claims", _CLAIMS)

    @property
    def holds(self) -> bool:
        """Whether every trial succeeded and violated no claim."""
        bad = (self.trials["outcome"] != "succeeded") | (self.trials["violated"] > 0)
        return not self.untestable and not bad.any()

    def require(self) -> Run:
        """Returns the run if it holds. Raises Failed, exit code 12, if it does not."""
        if self.holds:
            return self
        succeeded = int((self.trials["outcome"] == "succeeded").sum())
        raise Failed(self.untestable or f"{succeeded} of {len(self.trials)} trials succeeded; "
                     f"{int(self.trials['violated'].sum())} claims are violated")

    def trace(self, trial: int) -> Trace:
        """Executes the trial with this number, from 1, again and returns its trace.

        The number may be greater than the number of trials that were made, because the errors of
        every trial follow from the seed and the number.
        """
        require_count("trial", trial)
        return Trace(self._runner.traced(trial))

    def __repr__(self) -> str:
        if self.untestable:
            return self.untestable
        succeeded = int((self.trials["outcome"] == "succeeded").sum())
        return f"<Run: {succeeded} of {len(self.trials)} trials succeeded>"


class Trace:
    """What happened in one trial.

    events: the records of the trace file in order, as dicts (sim/file-formats.md).
    """

    def __init__(self, traced: _assay.TracedTrial) -> None:
        self._traced = traced

    @cached_property
    def lines(self) -> str:
        """The text of the trace file, one JSON object on each line."""
        return self._traced.lines()

    @cached_property
    def events(self) -> list[dict[str, Any]]:
        """All records but the header."""
        return [json.loads(line) for line in self.lines.splitlines()[1:]]

    @property
    def outcome(self) -> str:
        """"done" if every command was executed; otherwise what went wrong."""
        return self.events[-1]["outcome"]

    @cached_property
    def poses(self) -> pd.DataFrame:
        """Poses at 50 Hz in the world frame.

        Columns: time (seconds), body ("tool" or a part), which ("true" or "believed"), x, y, z
        (metres), qw, qx, qy, qz (a unit quaternion).
        """
        rows = []
        for sample in self._samples:
            for body, poses in (("tool", sample["tool"]), *sample["parts"].items()):
                for which in ("true", "believed"):
                    pose = poses[which]
                    rows.append((sample["time"], body, which, *pose["position"],
                                 *pose["quaternion"]))
        return pd.DataFrame(rows, columns=["time", "body", "which", "x", "y", "z", "qw", "qx", "qy",
                                           "qz"])

    @cached_property
    def wrist(self) -> pd.DataFrame:
        """The gripper at 50 Hz: time, opening (metres), fx, fy, fz (N), tx, ty, tz (N m)."""
        rows = [(s["time"], s["opening"], *s["wrist"]["force"], *s["wrist"]["torque"])
                for s in self._samples]
        return pd.DataFrame(rows, columns=["time", "opening", "fx", "fy", "fz", "tx", "ty", "tz"])

    @property
    def _samples(self) -> list[dict[str, Any]]:
        return [event for event in self.events if event["kind"] == "sample"]

    def view(self) -> View:
        """Returns the page that shows the trial."""
        return View(self._traced.page())

    def __repr__(self) -> str:
        return f"<Trace: {self.outcome} after {self.events[-1]['time']:.2f} s>"


class Falsification:
    """The result of trying to falsify a plan.

    attempts: the number of attempts that were made.
    counterexamples: a DataFrame with one row for each violation, whose errors were reduced as far
        as possible: number (from 1), claim, action, unit, observed, low, high, margin, gate, steps
        (to be executed), multiple (the least tried multiple of these errors with a violation),
        replayed, noise (the errors), replay (the command that repeats it).
    worst: a DataFrame with one row for each claim: claim, step (from 1), action (the step's id),
        about ("before", "precondition" or "after"), name, unit, verdict, observed, low, high (the
        predicted range), margin, gate (the noise floor), phase and attempt (those that made the
        worst observation), noise (the errors of this attempt).
    counts: the number of attempts with each verdict on the step's certificate.
    seed: the seed of the attempts.
    reason: the claim that was violated, or empty.
    untestable: what the plan violates even without noise, if no attempt was made for this reason;
        otherwise empty.
    """

    def __init__(self, plan: Plan, seed: int, untestable: str, trial: dict[str, Any],
                 attack: dict[str, Any]) -> None:
        self._plan = plan
        self.seed = seed
        self.untestable = untestable
        self.attempts: int = attack["attempts"]
        self.counts: dict[str, int] = {
            name: attack[name] for name in ("contained", "inconclusive", "violated", "not_claimed")}
        self.reason: str = trial["trial"]["reason"]
        self.worst = pd.DataFrame(attack["worst"], columns=_WORST)
        self.counterexamples = pd.DataFrame(attack["counterexamples"], columns=_COUNTEREXAMPLES)

    @property
    def holds(self) -> bool:
        """Whether attempts were made and no claim was violated."""
        return not self.untestable and self.attempts > 0 and self.counts["violated"] == 0

    def require(self) -> Falsification:
        """Returns the result if attempts were made and no claim was violated. Otherwise raises
        Failed."""
        if self.holds:
            return self
        if self.attempts == 0:
            raise Failed(self.untestable or "no attempt was made")
        raise Failed(f"violated in {self.counts['violated']} of "
                     f"{self.attempts} attempts: {self.reason}")

    def replay(self, number: int) -> Run:
        """Executes the plan with the errors of the counterexample that has this number, from 1.

        Raises WrongUsage if there is no such counterexample.
        """
        found = self.counterexamples.query("number == @number")
        if found.empty:
            raise WrongUsage(f"there is no counterexample {number!r}; there are "
                             f"{len(self.counterexamples)}")
        return self._plan.run(errors=found["noise"].iloc[0])

    def __repr__(self) -> str:
        if self.untestable:
            return self.untestable
        if self.holds:
            return f"<Falsification: not falsified in {self.attempts} attempts>"
        if self.attempts == 0:
            return "<Falsification: no attempt was made>"
        return (f"<Falsification: violated in {self.counts['violated']} of {self.attempts} "
                "attempts>")


def _of_trials(rows: list[dict[str, Any]], name: str, columns: list[str]) -> pd.DataFrame:
    records = [{"trial": row["trial"]["trial"], **record} for row in rows for record in row[name]]
    return pd.DataFrame(records, columns=["trial", *columns])
