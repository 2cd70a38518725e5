"""Trials, traces, pages and falsifications."""

import json

import numpy as np
import pytest
from conftest import KNOWN, SCENARIOS, program_json

import assay


@pytest.fixture(scope="module")
def noisy(known):
    return known.run(noise="uniform", trials=3, seed=7, jobs=2)


def test_trials_are_those_of_the_program(noisy):
    theirs = program_json("run", KNOWN, "--noise", "uniform", "--trials", 3, "--seed", 7)
    assert list(noisy.trials["noise"]) == [row["noise"] for row in theirs["rows"]]
    assert list(noisy.trials["outcome"]) == [row["outcome"] for row in theirs["rows"]]
    counts = noisy.verdicts["verdict"].value_counts()
    for verdict in ("contained", "violated", "inconclusive"):
        assert counts.get(verdict, 0) == theirs["verdicts"][verdict]
    assert noisy.seed == theirs["seed"] == 7
    assert noisy.holds and noisy.require() is noisy and noisy.untestable == ""
    assert repr(noisy) == "<Run: 3 of 3 trials succeeded>"


def test_claims_hold_the_observed_values(noisy):
    claims = noisy.claims
    assert set(claims["about"]) == {"before", "precondition", "after"}
    contained = noisy.verdicts[noisy.verdicts["verdict"] == "contained"]
    assert ((contained["low"] <= contained["observed"])
            & (contained["observed"] <= contained["high"])).all()
    assert set(noisy.verdicts["step"]) == {1, 2}


def test_the_result_does_not_depend_on_threads(known, noisy):
    alone = known.run(noise="uniform", trials=3, seed=7)
    assert alone.trials.equals(noisy.trials) and alone.claims.equals(noisy.claims)
    other = known.run(noise="uniform", trials=1, seed=8)
    assert other.trials["noise"][0] != noisy.trials["noise"][0]


def test_a_trial_without_noise_has_no_verdicts(known):
    run = known.run()
    assert run.holds and run.verdicts.empty and run.trials["noise"][0] == ""


def test_given_errors_are_executed(known):
    errors = {"dx_peg": 1e-4, "theta_peg": -1e-3}
    run = known.run(errors=errors)
    assert run.trials["noise"][0] == "dx_peg=0.0001 theta_peg=-0.001"
    assert known.run(errors="dx_peg=0.0001 theta_peg=-0.001").claims.equals(run.claims)


def test_a_trace_is_that_of_the_program(tmp_path, noisy):
    from conftest import program
    program("run", KNOWN, "--noise", "uniform", "--trials", 3, "--seed", 7, "-o", tmp_path)
    trace = noisy.trace(3)
    assert trace.lines == (tmp_path / "trace-3.jsonl").read_text()
    assert trace.outcome == "done" and repr(trace).startswith("<Trace: done after ")
    assert [json.loads(line) for line in trace.lines.splitlines()[1:]] == trace.events


def test_poses_are_unit_quaternions_at_50_hertz(noisy):
    trace = noisy.trace(1)
    poses = trace.poses
    assert set(poses["body"]) == {"tool", "block", "peg"}
    norms = np.linalg.norm(poses[["qw", "qx", "qy", "qz"]], axis=1)
    assert np.allclose(norms, 1)
    times = trace.wrist["time"]
    assert np.median(np.diff(times)) == pytest.approx(0.02, abs=0.002)
    assert trace.wrist["opening"].between(-0.001, 0.2).all()


def test_the_page_of_a_trial_needs_nothing_else(tmp_path, noisy):
    view = noisy.trace(2).view()
    assert view.html.startswith("<!DOCTYPE html>") and "trial 2" in view.html
    assert view.save(tmp_path / "page.html").read_text(encoding="utf-8") == view.html
    cell = view._repr_html_()
    assert cell.startswith("<iframe srcdoc=") and "&lt;!DOCTYPE html&gt;" in cell
    assert "kB" in repr(view)
    with pytest.raises(OSError):
        view.save(tmp_path / "nowhere/page.html")


def test_a_plan_is_viewed_as_the_program_does(tmp_path, known):
    from conftest import program
    page = tmp_path / "page.html"
    program("view", KNOWN, "-o", page)
    theirs = page.read_text()
    mine = known.view().html
    assert abs(len(mine) - len(theirs)) < 1000 and mine[:200] == theirs[:200]


def test_an_unproved_plan_may_fail(unproved):
    assert not unproved.proved and (unproved.steps["unproved"] > 0).any()
    run = unproved.run(noise="vertices", trials=2, seed=1)
    if not run.holds:
        with pytest.raises(assay.Failed, match="trials succeeded"):
            run.require()


def test_a_proved_plan_is_not_falsified(known):
    result = known.falsify(attempts=20, seed=1, jobs=2)
    theirs = program_json("run", KNOWN, "--noise", "attack", "--attempts", 20, "--seed", 1)
    assert result.attempts == theirs["attempts"] == 20
    assert result.holds and result.counterexamples.empty and result.require() is result
    assert result.counts["contained"] == theirs["verdicts"]["contained"]
    assert sorted(result.worst["observed"]) == sorted(row["observed"] for row in theirs["worst"])
    assert repr(result) == "<Falsification: not falsified in 20 attempts>"


def test_a_false_certificate_is_falsified():
    scenario = assay.Scenario(SCENARIOS / "spar-fig15.yaml")
    plan = scenario.plan(propagation="paper")
    result = plan.falsify(attempts=40, seed=1, jobs=2)
    assert not result.holds and len(result.counterexamples) > 0
    with pytest.raises(assay.Failed, match="violated in"):
        result.require()
    example = result.counterexamples.iloc[0]
    assert "--errors" in example["replay"] and "--propagation paper" in example["replay"]
    again = result.replay(example["number"])
    assert again.trials["noise"][0] == example["noise"]
    if example["replayed"]:
        assert again.trials["violated"][0] > 0


@pytest.mark.parametrize("arguments, error, words", [
    ({"noise": "loud"}, assay.WrongUsage, "there is no noise 'loud'; allowed: none, uniform"),
    ({"sensing": "nose"}, assay.WrongUsage, "there is no sensing 'nose'"),
    ({"grasp": "glue"}, assay.WrongUsage, "there is no grasp 'glue'; allowed: friction, weld"),
    ({"trials": 0}, assay.WrongUsage, "trials is 0; allowed: 1 or more"),
    ({"jobs": -1}, assay.WrongUsage, "jobs is -1; allowed: 1 or more"),
    ({"noise": "uniform", "errors": "dx_peg=0"}, assay.WrongUsage, "exclude each other"),
    ({"errors": "dx_nobody=0.1"}, assay.WrongInput, "dx_nobody"),
    ({"errors": {"dx_peg": 7}}, assay.WrongInput, "dx_peg"),
    ({"seed": -1}, TypeError, ""),
])
def test_wrong_arguments_of_run(known, arguments, error, words):
    with pytest.raises(error, match=words):
        known.run(**arguments)


def test_wrong_arguments_of_falsify(known):
    with pytest.raises(assay.WrongUsage, match="attempts is 0"):
        known.falsify(attempts=0)
