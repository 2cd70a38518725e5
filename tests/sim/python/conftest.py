"""What the tests of the Python module share."""

import json
import os
import subprocess
from pathlib import Path

import pytest

import assay

TREE = Path(__file__).resolve().parents[3]
SCENARIOS = TREE / "scenarios"
MODELS = TREE / "models"
KNOWN = SCENARIOS / "notebooks/jigs.yaml"  # a pickup and an assembly, all proved


def program(*arguments: object) -> subprocess.CompletedProcess:
    """Runs the program, which the module is compared with."""
    return subprocess.run([os.environ["ASSAY_PROGRAM"], *map(str, arguments)], capture_output=True,
                          text=True, check=False)


def program_json(*arguments: object) -> dict:
    return json.loads(program(*arguments, "--json").stdout)


def kept_noise_floors() -> set[Path]:
    return set(Path(os.environ["XDG_CACHE_HOME"], "assay/noise-floor").glob("*.json"))


@pytest.fixture(scope="session")
def known() -> assay.Plan:
    return assay.Scenario(KNOWN).plan()


@pytest.fixture(scope="session")
def reached(tmp_path_factory) -> Path:
    """A scenario whose goal holds from the start: a trial of its plan takes milliseconds."""
    file = tmp_path_factory.mktemp("reached") / "reached.yaml"
    file.write_text("format: assay-scenario/1\nworkcell: puma762-table\n"
                    "units: {length: mm, angle: degree}\n"
                    "parts: {block: {model: block, pose: {stable: on-back, at: [600, 50]}}}\n"
                    "goal: [{located: {part: block, stable: [on-back]}}]\n")
    return file


@pytest.fixture(scope="session")
def fig15() -> assay.Plan:
    return assay.Scenario(SCENARIOS / "spar-fig15.yaml").plan()


@pytest.fixture(scope="session")
def noisy(known) -> assay.Run:
    return known.run(noise="uniform", trials=1, seed=7)
