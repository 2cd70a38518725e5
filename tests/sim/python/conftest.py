"""What the tests of the Python module share."""

import json
import os
import subprocess
from pathlib import Path

import pytest

import assay

TREE = Path(__file__).resolve().parents[3]
SCENARIOS = TREE / "scenarios"
KNOWN = SCENARIOS / "uncertain-known.yaml"  # a pickup and an assembly, all proved


def program(*arguments: object) -> subprocess.CompletedProcess:
    """Runs the program, which the module is compared with."""
    return subprocess.run([os.environ["ASSAY_PROGRAM"], *map(str, arguments)], capture_output=True,
                          text=True, check=False)


def program_json(*arguments: object) -> dict:
    return json.loads(program(*arguments, "--json").stdout)


@pytest.fixture(scope="session")
def known() -> assay.Plan:
    return assay.Scenario(KNOWN).plan()


@pytest.fixture(scope="session")
def fig15() -> assay.Plan:
    return assay.Scenario(SCENARIOS / "spar-fig15.yaml").plan()


@pytest.fixture(scope="session")
def noisy(known) -> assay.Run:
    return known.run(noise="uniform", trials=1, seed=7)
