"""Plans robot assembly under bounded uncertainty, and attacks the plans in physics.

    s = assay.Scenario("scenarios/spar-fig15.yaml")
    p = s.plan(resolvers=["sensing"])
    p.certificates                       # what was proved, by how much, and what cost most
    r = p.run(noise="uniform", trials=50, seed=1, jobs=2)
    r.trials, r.verdicts, r.trace(3)
    p.falsify(attempts=200, seed=1).counterexamples

All numbers are in SI units: metres, radians, newtons, seconds. Tables are pandas DataFrames. Each
exit code of the program is an exception (assay.errors). Other threads run during long calls. Ctrl-C
ends a long call; the exception (assay.Interrupted) has the results that the call had by then.
"""

from ._assay import __version__
from .bounds import Bounds, Expressions, bound, sensitivity
from .errors import (EnvironmentLacks, Error, Failed, Interrupted, NoAnswer, NoPlan, WrongInput,
                     WrongUsage)
from .knowledge import ContingentPlan, contingent
from .labels import Labels, label
from .plans import Check, Plan
from .scenario import Scenario
from .sweeps import SweepDatabase, sweep
from .trees import PlanTree, TreeCheck, TreeRun
from .trials import Falsification, Run, Trace
from .view import View

__all__ = [
    "Bounds", "Check", "ContingentPlan", "EnvironmentLacks", "Error", "Expressions", "Failed",
    "Falsification", "Interrupted", "Labels", "NoAnswer", "NoPlan", "Plan", "PlanTree", "Run",
    "Scenario", "SweepDatabase", "Trace", "TreeCheck", "TreeRun", "View", "WrongInput",
    "WrongUsage", "__version__", "bound", "contingent", "label", "sensitivity", "sweep",
]
