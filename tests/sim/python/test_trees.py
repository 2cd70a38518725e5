"""Plan trees: scenarios whose goal is about knowledge, or where a pose is open."""

import json

import numpy as np
import pytest
from conftest import KNOWN, SCENARIOS, program, program_json

import assay
from assay import _assay

BOTTLES = SCENARIOS / "bottles.yaml"  # a goal of knowledge, two leaves
FALLEN = SCENARIOS / "fallen-peg.yaml"  # a peg stands or lies


@pytest.fixture(scope="module")
def bottles():
    return assay.Scenario(BOTTLES).plan()


@pytest.fixture(scope="module")
def fallen():
    return assay.Scenario(FALLEN).plan()


# Executions of other trees take much longer.
@pytest.fixture(scope="module")
def jigs():
    return assay.Scenario(KNOWN).plan(tree=True)


@pytest.fixture(scope="module")
def walked(jigs):
    return jigs.run(noise="uniform", trials=1, seed=3)


@pytest.mark.parametrize("name, arguments", [("bottles", [BOTTLES]), ("jigs", [KNOWN, "--tree"])])
def test_a_tree_is_that_of_the_program(request, tmp_path, name, arguments):
    tree = request.getfixturevalue(name)
    assert isinstance(tree, assay.PlanTree)
    theirs = program_json("plan", *arguments)
    theirs.pop("seconds")
    assert tree.json == theirs and tree.tree == theirs["tree"]
    assert json.loads(tree.save(tmp_path / "tree.json").read_text()) == theirs
    assert repr(tree) == str(tree).rstrip("\n") and tree.dot.startswith("digraph")


def test_the_steps_of_a_tree_are_its_lines(fallen):
    steps = fallen.steps
    assert list(steps["step"]) == list(range(1, len(steps) + 1)) and (steps["depth"] >= 0).all()
    assert set(steps["kind"]) <= {"action", "branch", "go to"}
    assert steps["action"].str.startswith("look(peg").any()
    assert steps[steps["kind"] == "branch"]["action"].str.startswith("if ").all()


def test_certificates_of_a_tree_are_those_of_its_plans(fallen):
    table = fallen.certificates
    assert len(fallen.plans) >= 2 and set(table["plan"]) == set(range(1, len(fallen.plans) + 1))
    for number, plan in enumerate(fallen.plans, 1):
        of_plan = table[table["plan"] == number].drop(columns="plan").reset_index(drop=True)
        assert of_plan.equals(plan.certificates)
        assert set(plan.world) == {"peg"}
    assert fallen.proved == table["proved"].all()
    costs = fallen.sensitivity
    for place, group in costs.groupby("precondition"):
        row = table.iloc[place]
        assert row["cost"] == dict(zip(group["variable"], group["cost"]))
        assert set(group["plan"]) == {row["plan"]}
    assert set(fallen.error_sets["plan"]) == set(fallen.error_box["plan"]) == set(table["plan"])


def test_a_step_of_a_tree_is_explained_by_its_plan(fallen):
    assert fallen.explain(1, plan=2) == fallen.plans[1].explain(1) != ""
    with pytest.raises(assay.WrongUsage, match="there is no plan 9; allowed: 1 to"):
        fallen.explain(1, plan=9)
    with pytest.raises(assay.WrongUsage, match="there is no step 99"):
        fallen.explain(99)


def test_a_plan_of_one_world_is_no_file(fallen, tmp_path):
    with pytest.raises(assay.WrongUsage, match="allowed: save the tree"):
        fallen.plans[0].save(tmp_path / "plan.json")


def test_trees_are_checked_in_all_worlds(bottles, fallen):
    for tree in (bottles, fallen):
        check = tree.check()
        assert check and check.holds and check.flaws.empty
        assert repr(check).startswith("check: holds in all of the worlds")
    assert "plan 2: " in fallen.check().text
    with pytest.raises(assay.WrongUsage, match="worlds is 0"):
        bottles.check(worlds=0)


@pytest.mark.parametrize("what", ["certificates", "sensitivity", "error_sets", "error_box",
                                  "proved"])
def test_a_goal_of_knowledge_has_no_certificates(bottles, what):
    with pytest.raises(assay.WrongUsage, match="the goal of bottles is about knowledge"):
        getattr(bottles, what)


def test_calls_that_have_no_sense_for_trees_say_why(bottles, fallen):
    with pytest.raises(assay.WrongUsage, match="has no certificates to explain"):
        bottles.explain(1)
    with pytest.raises(assay.WrongUsage, match="has no certificates to falsify"):
        bottles.falsify(attempts=10, seed=1)
    with pytest.raises(assay.WrongUsage, match=r"allowed: plans\[0\].falsify\(\)"):
        fallen.falsify(attempts=10)


@pytest.mark.parametrize("arguments, words", [
    ({"noise": "vertices"}, "have no noise 'vertices'; allowed: uniform"),
    ({"trials": 0}, "trials is 0"),
    ({"jobs": 0}, "jobs is 0"),
    ({"seed": -1}, "seed is -1"),
    ({"worlds": "some"}, "there are no worlds 'some'; allowed: drawn, all"),
    ({"sensing_errors": 1.5}, "sensing_errors is 1.5; allowed: 0 to 1"),
    ({"sensing_errors": float("nan")}, "sensing_errors is nan"),
])
def test_wrong_arguments_of_runs_of_trees(bottles, arguments, words):
    with pytest.raises(assay.WrongUsage, match=words):
        bottles.run(**arguments)


@pytest.mark.parametrize("arguments, words", [
    ({"resolvers": ["sensing"]}, "resolvers and propagation are for goals of assembly"),
    ({"propagation": "paper"}, "resolvers and propagation are for goals of assembly"),
    ({"budget": 0}, "the budget is 0"),
])
def test_wrong_arguments_of_plans_of_knowledge(arguments, words):
    with pytest.raises(assay.WrongUsage, match=words):
        assay.Scenario(BOTTLES).plan(**arguments)


def test_a_tree_is_walked(walked):
    assert list(walked.trials["outcome"]) == ["reached"] and walked.holds
    assert walked.require() is walked and walked.seed == 3
    assert repr(walked) == "<TreeRun: 1 of 1 trials reached the goal>"
    assert list(walked.steps["step"]) == list(range(1, len(walked.steps) + 1))
    assert walked.steps["end"].is_monotonic_increasing
    assert not walked.branches["flipped"].any()
    assert walked.false_claims.empty and walked.collisions.empty
    assert walked.leaves["trials"].sum() == 1
    with pytest.raises(assay.WrongUsage, match="allowed: false_claims"):
        walked.verdicts


def test_trials_of_trees_are_those_of_the_program(walked):
    theirs = program_json("run", KNOWN, "--tree", "--seed", 3)["rows"][0]
    mine = walked.trials.iloc[0]
    assert mine["simulated"] == theirs["simulated"]
    assert mine["greatest_tilt"] == pytest.approx(np.deg2rad(theirs["greatest_tilt"]))
    assert walked.steps[["action", "end"]].to_dict("records") == theirs["steps"]


def test_a_trial_of_a_tree_is_traced_and_viewed(walked):
    trace = walked.trace(1)
    assert trace.outcome == "done" and not trace.poses.empty
    assert trace.events[-1]["time"] == walked.trials["simulated"][0]
    html = trace.view().html
    assert "trial 1 of the plan tree" in html
    with pytest.raises(assay.WrongUsage, match="trial is 0"):
        walked.trace(0)


def test_failed_trials_of_trees_are_results_until_they_are_required(walked):
    failed = assay.TreeRun(walked._runner, {"rows": [], "leaves": []})
    failed.trials = walked.trials.assign(outcome="spilled", reason="a can spilled", holds=False)
    assert not failed.holds
    with pytest.raises(assay.Failed, match="1 of 1 trials failed; trial 1: spilled: a can spilled"):
        failed.require()


def test_trials_go_through_all_leaves_if_asked(bottles):
    settings = _assay.TreeTrialSettings()
    settings.is_every_leaf = True
    assert _assay.TreeTrials(bottles._handle, settings).usual_count == 2
    assert _assay.TreeTrials(bottles._handle, _assay.TreeTrialSettings()).usual_count == 1


def test_any_plan_is_a_tree_if_asked(known, jigs, tmp_path):
    assert len(jigs.plans) == 1 and jigs.proved
    assert str(jigs) == program("plan", KNOWN, "--tree").stdout
    assert jigs.certificates.drop(columns="plan").equals(known.certificates)
    saved = assay.Plan.read(jigs.plans[0].save(tmp_path / "plan.json"))
    assert saved.certificates.equals(known.certificates)
