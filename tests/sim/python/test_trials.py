"""Trials, traces, pages and falsifications. Executions take seconds, so each serves many tests."""

import json

import numpy as np
import pytest

import assay


@pytest.fixture(scope="module")
def trace(noisy):
    return noisy.trace(1)


def test_trials_under_noise_are_judged(noisy):
    assert list(noisy.trials["trial"]) == [1] and list(noisy.trials["outcome"]) == ["succeeded"]
    assert set(noisy.verdicts["step"]) == {1, 2} and noisy.seed == 7
    counts = noisy.verdicts["verdict"].value_counts()
    for verdict in ("contained", "violated", "inconclusive"):
        assert counts.get(verdict, 0) == noisy.trials[verdict].sum()
    assert noisy.holds and noisy.require() is noisy and noisy.untestable == ""
    assert repr(noisy) == "<Run: 1 of 1 trials succeeded>"


def test_claims_hold_the_observed_values(noisy):
    assert set(noisy.claims["about"]) == {"before", "precondition", "after"}
    contained = noisy.verdicts[noisy.verdicts["verdict"] == "contained"]
    assert not contained.empty
    assert ((contained["low"] <= contained["observed"])
            & (contained["observed"] <= contained["high"])).all()


def test_the_errors_of_a_trial_repeat_it(known, noisy):
    again = known.run(errors=noisy.trials["noise"][0])
    assert again.claims.equals(noisy.claims) and again.verdicts.equals(noisy.verdicts)


def test_errors_are_written_as_the_program_writes_them():
    assert assay.trials.errors_text({"dx_peg": 1e-4, "theta_peg": np.float64(-1e-3)}) == (
        "dx_peg=0.0001 theta_peg=-0.001")
    assert assay.trials.errors_text("dx_peg=0") == "dx_peg=0"
    assert assay.trials.errors_text(None) is None


def test_a_trial_without_noise_has_no_verdicts(known):
    run = known.run()
    assert run.holds and run.verdicts.empty and run.claims.empty and run.trials["noise"][0] == ""


def test_failures_are_results_until_they_are_required(noisy):
    failed = noisy.trials.copy()
    failed["outcome"], failed["violated"] = "not-seated", 2
    run = assay.Run(noisy._runner, [], "")
    run.trials = failed
    assert not run.holds
    with pytest.raises(assay.Failed, match="0 of 1 trials succeeded; 2 claims are violated"):
        run.require()
    untestable = assay.Run(noisy._runner, [], "violated without any noise")
    assert not untestable.holds and repr(untestable) == untestable.untestable
    with pytest.raises(assay.Failed, match="violated without any noise"):
        untestable.require()


def test_a_trace_has_its_events_in_order(trace):
    header, *events = map(json.loads, trace.lines.splitlines())
    assert header["format"] == "assay-trace/1" and events == trace.events
    times = [event["time"] for event in events if "time" in event]
    assert times == sorted(times)
    assert trace.outcome == "done" and repr(trace).startswith("<Trace: done after ")


def test_poses_are_unit_quaternions_at_50_hertz(trace):
    poses = trace.poses
    assert set(poses["body"]) == {"tool", "block", "peg"}
    assert set(poses["which"]) == {"true", "believed"}
    assert np.allclose(np.linalg.norm(poses[["qw", "qx", "qy", "qz"]], axis=1), 1)
    assert np.median(np.diff(trace.wrist["time"])) == pytest.approx(0.02, abs=0.002)
    assert trace.wrist["opening"].between(-0.001, 0.2).all()


def test_the_page_of_a_trial_needs_nothing_else(tmp_path, trace):
    view = trace.view()
    assert view.html.startswith("<!DOCTYPE html>") and "trial 1" in view.html
    assert "the plan without noise" in view.html  # is shown beside it
    assert view.save(tmp_path / "page.html").read_text(encoding="utf-8") == view.html
    cell = view._repr_html_()
    assert cell.startswith("<iframe srcdoc=") and "&lt;!DOCTYPE html&gt;" in cell
    assert "kB" in repr(view)
    with pytest.raises(OSError):
        view.save(tmp_path / "nowhere/page.html")


def test_a_plan_is_viewed(known):
    assert "executed without noise" in known.view().html


def test_a_proved_plan_is_not_falsified(known):
    result = known.falsify(attempts=4, seed=1, jobs=2)
    assert result.attempts == 4 and sum(result.counts.values()) == 4
    assert result.holds and result.counterexamples.empty and result.require() is result
    assert (result.worst["verdict"] != "violated").all() and not result.worst.empty
    assert repr(result) == "<Falsification: not falsified in 4 attempts>"


def test_a_counterexample_is_replayed(known):
    noise = "dx_peg=1e-05"
    example = {"number": 1, "claim": "2/after/x of peg", "action": "action_1", "unit": "m",
               "observed": 2.0, "low": 0.0, "high": 1.0, "margin": -1.0, "gate": 0.1, "steps": 2,
               "multiple": 1.0, "replayed": True, "noise": noise, "replay": "assay run"}
    attack = {"attempts": 7, "contained": 6, "inconclusive": 0, "violated": 1, "not_claimed": 0,
              "worst": [], "counterexamples": [example]}
    trial = {"trial": {"reason": "step 2: x of peg"}}
    result = assay.Falsification(known, 1, "", trial, attack)
    assert not result.holds and repr(result) == "<Falsification: violated in 1 of 7 attempts>"
    with pytest.raises(assay.Failed, match="violated in 1 of 7 attempts: step 2: x of peg"):
        result.require()
    assert result.replay(1).trials["noise"][0] == noise
    with pytest.raises(assay.WrongUsage, match="there is no counterexample 2; there are 1"):
        result.replay(2)
    untestable = assay.Falsification(known, 1, "hidden", trial, {**attack, "violated": 0})
    assert not untestable.holds and repr(untestable) == "hidden"


@pytest.mark.parametrize("arguments, error, words", [
    ({"noise": "loud"}, assay.WrongUsage, "there is no noise 'loud'; allowed: none, uniform"),
    ({"sensing": "nose"}, assay.WrongUsage, "there is no sensing 'nose'"),
    ({"grasp": "glue"}, assay.WrongUsage, "there is no grasp 'glue'; allowed: friction, weld"),
    ({"trials": 0}, assay.WrongUsage, "trials is 0; allowed: 1 or more"),
    ({"jobs": -1}, assay.WrongUsage, "jobs is -1; allowed: 1 to 1024"),
    ({"jobs": 10**6}, assay.WrongUsage, "jobs is 1000000"),
    ({"noise": "uniform", "errors": "dx_peg=0"}, assay.WrongUsage, "exclude each other"),
    ({"errors": "dx_nobody=0.1"}, assay.WrongInput, "dx_nobody"),
    ({"errors": {"dx_peg": 7}}, assay.WrongInput, "dx_peg"),
    ({"errors": {"dx_peg": float("nan")}}, assay.WrongInput, ""),
    ({"errors": {"dx_peg": "wide"}}, ValueError, "wide"),
    ({"errors": "dx_peg"}, assay.WrongInput, ""),
    ({"seed": -1}, assay.WrongUsage, r"seed is -1; allowed: 0 to 2\^64 - 1"),
    ({"seed": 2**64}, assay.WrongUsage, "seed is 18446744073709551616"),
    ({"seed": "one"}, TypeError, ""),
    ({"trials": 1.5}, TypeError, ""),
    ({"noise": 7}, TypeError, ""),
])
def test_wrong_arguments_of_run(known, arguments, error, words):
    with pytest.raises(error, match=words):
        known.run(**arguments)


def test_wrong_arguments_of_falsify(known):
    with pytest.raises(assay.WrongUsage, match="attempts is 0"):
        known.falsify(attempts=0)
    with pytest.raises(assay.WrongUsage, match="jobs is 0"):
        known.falsify(attempts=1, jobs=0)
    with pytest.raises(assay.WrongUsage, match="there is no grasp 'glue'"):
        known.falsify(attempts=1, grasp="glue")


def test_wrong_numbers_of_trials(noisy):
    for wrong in (0, -1):
        with pytest.raises(assay.WrongUsage, match=f"trial is {wrong}"):
            noisy.trace(wrong)
    with pytest.raises(TypeError):
        noisy.trace("first")
