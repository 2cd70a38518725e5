"""Plans robot assembly under bounded uncertainty, and attacks the plans in physics.

    s = assay.Scenario("scenarios/spar-fig15.yaml")
    p = s.plan(resolvers=["sensing"])
    p.certificates                       # what was proved, by how much, and what cost most
    r = p.run(noise="uniform", trials=50, seed=1, jobs=2)
    r.trials, r.verdicts, r.trace(3)
    p.falsify(attempts=200, seed=1).counterexamples

All numbers are in SI units: metres, radians, newtons, seconds. Tables are pandas DataFrames. Each
exit code of the program is an exception (assay.errors). Long calls let other threads run, and
Ctrl-C ends them.
"""

from ._assay import __version__
from .bounds import Bounds, Expressions, bound, sensitivity
from .errors import EnvironmentLacks, Error, Failed, NoAnswer, NoPlan, WrongInput, WrongUsage
from .knowledge import ContingentPlan, contingent
from .labels import Labels, label
from .scenario import Check, Plan, Scenario
from .sweeps import SweepDatabase, sweep
from .trials import Falsification, Run, Trace
from .view import View

__all__ = [
    "Bounds", "Check", "ContingentPlan", "EnvironmentLacks", "Error", "Expressions", "Failed",
    "Falsification", "Labels", "NoAnswer", "NoPlan", "Plan", "Run", "Scenario", "SweepDatabase",
    "Trace", "View", "WrongInput", "WrongUsage", "__version__", "bound", "contingent", "label",
    "sensitivity", "sweep",
]
