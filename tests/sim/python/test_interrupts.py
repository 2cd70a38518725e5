"""Ctrl-C ends a call, and what was there until then is kept."""

import os
import signal
import threading

import pytest
from conftest import MODELS

import assay


def interrupted(call, delay, done=lambda result: len(result.trials)):
    """Returns what a call that would take hours keeps at Ctrl-C, once it keeps something.

    delay: seconds until Ctrl-C; more if nothing is there by then.
    done: says how much a result has.
    """
    while True:
        timer = threading.Timer(delay, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        try:
            call()
            raise AssertionError("the call was not interrupted")
        except assay.Interrupted as error:
            assert isinstance(error, KeyboardInterrupt)
            assert "sys.last_value.result" in str(error)
            if done(error.result) > 0:
                return error.result
        except KeyboardInterrupt:
            pass  # nothing was there yet
        delay *= 2


MANY = 100_000


@pytest.fixture
def scenario(reached):
    return assay.Scenario(reached, models=[MODELS])


@pytest.mark.parametrize("settings", [{}, {"tree": True}], ids=["plan", "tree"])
def test_trials_that_were_done_are_kept(scenario, settings):
    plan = scenario.plan(**settings)
    run = interrupted(lambda: plan.run(trials=MANY), 0.5)
    assert list(run.trials["trial"]) == list(range(1, len(run.trials) + 1))
    assert len(run.trials) < MANY and run.holds
    assert run.trace(1).outcome == "done"  # work after it is not interrupted


def test_attempts_that_were_made_are_kept(known):
    found = interrupted(lambda: known.falsify(attempts=MANY), 10, lambda result: result.attempts)
    assert found.attempts < MANY and found.counts["violated"] == 0
    assert len(found.worst) > 0


def test_trials_of_a_sweep_that_were_done_are_in_its_database(tmp_path, reached):
    (tmp_path / "sweep.yaml").write_text(
        f"format: assay-sweep/1\ntitle: Many trials\nscenarios: [{reached}]\n"
        f"noise: [uniform]\nseeds: [7]\ntrials: {MANY}\n")
    database = tmp_path / "out.sqlite"
    db = interrupted(lambda: assay.sweep(tmp_path / "sweep.yaml", database, models=[MODELS],
                                         resume=database.exists()), 0.5)
    assert db.path == database and 0 < len(db.trials) < MANY
    assert list(db.trials["trial"]) == list(range(1, len(db.trials) + 1))


def test_a_notebook_has_the_result_of_the_last_exception():
    shell = pytest.importorskip("IPython.core.interactiveshell").InteractiveShell.instance()
    shell.run_cell("import assay, sys\nraise assay.Interrupted('3 of 9 trials are done', 7)")
    assert shell.run_cell("sys.last_value.result").result == 7
