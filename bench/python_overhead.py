"""Prints how much longer calls of the Python package take than the library's work in them.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/python_overhead.py

Times are the processor's, each the least of some repetitions. The library's is the time inside the
extension.
"""

import time

import numpy as np

import assay
from assay import _assay

REPETITIONS = 30


def least_seconds(call):
    seconds = []
    for _ in range(REPETITIONS):
        start = time.process_time()
        call()
        seconds.append(time.process_time() - start)
    return min(seconds)


def report(what, call, inside):
    whole, library = least_seconds(call), least_seconds(inside)
    print(f"{what}: {1000 * whole:.2f} ms, in the library {1000 * library:.2f} ms: "
          f"{100 * (whole / library - 1):+.1f} %")


scenario = assay.Scenario("scenarios/spar-fig13.yaml")
settings = _assay.PlanSettings()
settings.scenario = str(scenario.path)
report("plan for figure 13", scenario.plan, lambda: _assay.Plan.make(settings))

low = np.linspace(-1, 0, 1000)
expressions = assay.Expressions("3*cos(t)*x + sin(t*y) - x^2", {
    "t": (low, low + 0.3), "x": (0, 1), "y": (low, 1)})
boxes, _ = expressions._boxes()
report("bounds over 1000 boxes", expressions.bound,
       lambda: expressions._compiled.bounds(boxes, "refined", 1e-6, 200_000))

n = 12
columns = np.arange(n)
apart = np.abs(columns[:, None] - columns[None, :])
arcs = [(a, b, (apart != 0) & (apart != b - a)) for a in range(n) for b in range(a + 1, n)]
queens = {"nodes": {row: n for row in range(n)},
          "arcs": [{"between": [a, b], "allowed": allowed} for a, b, allowed in arcs]}
report("how many labelings twelve queens have", lambda: assay.label(queens, "count"),
       lambda: _assay.Network([n] * n, arcs).label(2, 10**9))
