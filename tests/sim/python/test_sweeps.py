"""Sweeps and their databases."""

import pytest
from conftest import SCENARIOS, program

import assay

SWEEP = """format: assay-sweep/1
title: Three trials
scenarios: [{scenario}]
noise: [none, uniform]
seeds: [1]
trials: 2
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    (folder / "sweep.yaml").write_text(SWEEP.format(scenario=SCENARIOS / "uncertain-known.yaml"))
    return folder


@pytest.fixture(scope="module")
def database(folder):
    return assay.sweep(folder / "sweep.yaml", folder / "mine.sqlite", jobs=2)


def test_the_database_is_that_of_the_program(folder, database):
    program("sweep", folder / "sweep.yaml", "--db", folder / "theirs.sqlite")
    theirs = assay.SweepDatabase(folder / "theirs.sqlite")
    for table in ("trial", "verdict", "observation", "claim", "cell"):
        assert database.table(table).equals(theirs.table(table)), table


def test_trials_carry_the_settings_of_their_cell(database):
    trials = database.trials
    assert len(trials) == 3 and list(trials["trial"]) == [1, 2, 3]
    assert sorted(trials["noise_kind"]) == ["none", "uniform", "uniform"]
    assert (trials["outcome"] == "succeeded").all()
    assert len(database.cells) == 2 and "plan" not in database.cells
    assert set(database.verdicts["trial"]) <= set(trials["trial"])
    assert database.counterexamples.empty and "3 trials" in repr(database)
    assert database.query("SELECT count(*) AS n FROM trial WHERE trial > ?", [1])["n"][0] == 2


def test_a_sweep_is_resumed(folder, database):
    again = assay.sweep(folder / "sweep.yaml", folder / "mine.sqlite", resume=True)
    assert len(again.trials) == 3
    with pytest.raises(assay.WrongInput):
        assay.sweep(folder / "sweep.yaml", folder / "mine.sqlite")


def test_wrong_sweeps(folder, tmp_path, database):
    with pytest.raises(assay.WrongInput):
        assay.sweep(SCENARIOS / "uncertain-known.yaml", tmp_path / "out.sqlite")
    with pytest.raises(assay.WrongUsage, match="allowed: a file"):
        assay.sweep(folder / "sweep.yaml", ":memory:")
    with pytest.raises(assay.WrongUsage, match="jobs is 0"):
        assay.sweep(folder / "sweep.yaml", tmp_path / "out.sqlite", jobs=0)
    with pytest.raises(assay.WrongInput):
        assay.SweepDatabase(folder / "sweep.yaml")
    with pytest.raises(assay.WrongUsage, match="there is no table 'secrets'"):
        database.table("secrets")
    with pytest.raises(Exception, match="readonly"):
        database.query("DELETE FROM trial")
