"""Sweeps and their databases."""

import pytest
from conftest import KNOWN, kept_noise_floors

import assay

SWEEP = """format: assay-sweep/1
title: Two trials
scenarios: [{scenario}]
noise: [uniform]
seeds: [7]
grasp: [weld]
trials: 1
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    (folder / "sweep.yaml").write_text(SWEEP.format(scenario=KNOWN))
    return folder


# The session has read other files since the noise floor was measured.
@pytest.fixture(scope="module")
def database(folder, noisy):
    kept = kept_noise_floors()
    database = assay.sweep(folder / "sweep.yaml", folder / "mine.sqlite", jobs=2)
    assert kept_noise_floors() == kept
    return database


def test_a_sweep_does_the_trials_of_a_plan(database, noisy):
    trials = database.trials
    assert list(trials["noise"]) == list(noisy.trials["noise"])
    assert list(trials["outcome"]) == list(noisy.trials["outcome"]) == ["succeeded"]
    verdicts, mine = database.verdicts, noisy.verdicts
    assert list(verdicts["observed"]) == list(mine["observed"])
    assert list(verdicts["verdict"]) == list(mine["verdict"])


def test_trials_carry_the_settings_of_their_cell(database):
    trials = database.trials
    assert list(trials["noise_kind"]) == ["uniform"] and list(trials["seed"]) == [7]
    assert len(database.cells) == 1 and "plan" not in database.cells
    assert database.counterexamples.empty and "1 trials" in repr(database)
    assert database.query("SELECT count(*) AS n FROM trial WHERE trial > ?", [0])["n"][0] == 1


def test_a_sweep_is_resumed(folder, database):
    again = assay.sweep(folder / "sweep.yaml", folder / "mine.sqlite", resume=True)
    assert len(again.trials) == 1
    with pytest.raises(assay.WrongInput):
        assay.sweep(folder / "sweep.yaml", folder / "mine.sqlite")


def test_wrong_sweeps(folder, tmp_path, database):
    with pytest.raises(assay.WrongInput):
        assay.sweep(KNOWN, tmp_path / "out.sqlite")
    with pytest.raises(assay.WrongUsage, match="allowed: a file"):
        assay.sweep(folder / "sweep.yaml", ":memory:")
    with pytest.raises(assay.WrongUsage, match="jobs is 0"):
        assay.sweep(folder / "sweep.yaml", tmp_path / "out.sqlite", jobs=0)
    with pytest.raises(assay.WrongInput):
        assay.SweepDatabase(folder / "sweep.yaml")
    with pytest.raises(assay.WrongUsage, match="there is no table 'secrets'"):
        database.table("secrets")
    with pytest.raises(assay.WrongUsage, match="jobs is 2000"):
        assay.sweep(folder / "sweep.yaml", tmp_path / "out.sqlite", jobs=2000)
    with pytest.raises(assay.EnvironmentLacks):
        assay.sweep(folder / "sweep.yaml", tmp_path / "nowhere/out.sqlite")
    with pytest.raises(assay.WrongInput):
        assay.SweepDatabase(tmp_path / "out.sqlite")
    with pytest.raises(Exception, match="readonly"):
        database.query("DELETE FROM trial")
