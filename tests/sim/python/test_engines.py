"""Bounds, labels and contingent planning, without files and with them."""

import itertools
import json

import numpy as np
import pytest
from conftest import SCENARIOS, program, program_json

import assay

TEXT = "3*cos(t) + x"
BOX = {"t": (-0.1, 0.1), "x": (0, 1)}


def test_bounds_hold_every_sample():
    bounds = assay.bound(TEXT, BOX)
    random = np.random.default_rng(1)
    t, x = random.uniform(-0.1, 0.1, 1000), random.uniform(0, 1, 1000)
    values = 3 * np.cos(t) + x
    assert bounds.inf <= values.min() and values.max() <= bounds.sup
    assert bounds.inf == pytest.approx(3 * np.cos(0.1), abs=1e-6)
    assert bounds.sup == pytest.approx(4, abs=1e-6)
    assert 0 <= bounds.gap <= 1e-6 and isinstance(bounds.method, str)


def test_bounds_are_those_of_the_program(tmp_path):
    file = tmp_path / "bounds.json"
    file.write_text(json.dumps({"variables": BOX, "expressions": [TEXT, "x^2 - x*sin(t)"],
                                "constraints": ["x <= 2*t + 1"]}))
    theirs = program_json("bound", file)["expressions"]
    mine = assay.bound([TEXT, "x^2 - x*sin(t)"], BOX, ["x <= 2*t + 1"])
    assert list(mine.inf) == [row["inf"] for row in theirs]
    assert list(mine.sup) == [row["sup"] for row in theirs]
    assert list(mine.method) == [row["rung"] for row in theirs]


def test_arrays_are_bounded_box_by_box():
    low, high = np.linspace(-1, 0, 6), np.linspace(0.5, 1, 6)
    many = assay.bound("x^2 - y", {"x": (low, high), "y": (np.zeros((2, 1)), 1)})
    assert many.inf.shape == many.sup.shape == many.gap.shape == many.method.shape == (2, 6)
    for i in range(6):
        one = assay.bound("x^2 - y", {"x": (low[i], high[i]), "y": (0, 1)})
        assert many.inf[1, i] == pytest.approx(one.inf, abs=2e-6)
        assert many.sup[0, i] == pytest.approx(one.sup, abs=2e-6)
    two = assay.Expressions(["x", "2*x"], {"x": (low, high)}).bound(method="termwise")
    assert two.sup.shape == (6, 2) and np.array_equal(two.sup[:, 1], 2 * two.sup[:, 0])
    assert assay.bound("x", {"x": (np.zeros(0), np.zeros(0))}).sup.shape == (0,)


def test_ends_may_be_infinite_or_degrees():
    bounds = assay.bound("min(x, y)", {"x": (0, float("inf")), "y": ("-90 deg", "2")})
    assert bounds.inf == pytest.approx(-np.pi / 2) and bounds.sup == 2


def test_a_box_without_points_is_empty():
    bounds = assay.bound("x", {"x": (0, 1)}, ["x >= 2"])
    assert bounds.inf == np.inf and bounds.sup == -np.inf


def test_sensitivity_names_what_costs_most():
    costs = assay.sensitivity("10*x + y", {"x": (0, 1), "y": (0, 1)})
    sup = costs[costs["bound"] == "sup"].set_index("variable")["cost"]
    assert sup["x"] == pytest.approx(5) and sup["y"] == pytest.approx(0.5)


@pytest.mark.parametrize("arguments, error, words", [
    (("3*cos(u)", BOX), assay.WrongInput, "'u'"),
    (("3*", BOX), assay.WrongInput, "<expressions>"),
    (("x", {"x": (1, 0)}), assay.WrongInput, "greater than the upper end"),
    (("x", {"x": 1}), assay.WrongUsage, "the variable 'x' has no two ends"),
    (("x", {"x": ([0, 1], [2, 3, 4])}), assay.WrongUsage, "shapes that do not agree"),
    (("x", {"x": ([0, 5], [1, 2])}), assay.WrongUsage, "lower end"),
    (("x", {"x": (0, 1)}, ["x"]), assay.WrongInput, ""),
    (("x", {"x": (float("nan"), 1)}), assay.WrongInput, "x"),
    (("x", {"x": ([0, np.nan], [1, 1])}), assay.WrongInput, ""),
    (("x", {"x": ("left", 1)}), assay.WrongInput, "left"),
    (("x", {"x": ([[0], [1, 2]], 3)}), ValueError, ""),
    ((7, BOX), TypeError, ""),
    (("x", {"x y": (0, 1)}), assay.WrongInput, "x y"),
])
def test_wrong_bounds(arguments, error, words):
    with pytest.raises(error, match=words):
        assay.bound(*arguments)


def test_wrong_methods_of_bounds():
    with pytest.raises(assay.WrongUsage, match="there is no method 'guess'"):
        assay.bound("x", {"x": (0, 1)}, method="guess")
    with pytest.raises(assay.WrongUsage):
        assay.bound("x", {"x": (0, 1)}, gap=-1)


def labelings(network):
    """All labelings, by trying all."""
    nodes = network["nodes"]
    for labels in itertools.product(*(range(count) for count in nodes.values())):
        at = dict(zip(nodes, labels))
        if all(arc["allowed"][at[arc["between"][0]], at[arc["between"][1]]]
               for arc in network["arcs"]):
            yield at


@pytest.mark.parametrize("seed", range(10))
def test_labelings_of_matrices_are_all_there_are(seed):
    random = np.random.default_rng(seed)
    nodes = {name: int(random.integers(1, 4)) for name in "abcd"}
    network = {"nodes": nodes, "arcs": [
        {"between": [a, b], "allowed": random.random((nodes[a], nodes[b])) < 0.7}
        for a, b in itertools.combinations(nodes, 2)]}
    expected = sorted(tuple(at.values()) for at in labelings(network))
    if not expected:
        with pytest.raises(assay.NoPlan, match="the network has no labeling"):
            assay.label(network)
        return
    assert sorted(tuple(at.values()) for at in assay.label(network, "all").labelings) == expected
    assert assay.label(network, "count").count == len(expected)
    assert tuple(assay.label(network).labeling.values()) in expected


def test_labels_keep_their_types():
    colours = ["red", 7, "blue"]
    differ = ~np.eye(3, dtype=bool)
    network = {"nodes": {1: colours, "b": colours},
               "arcs": [{"between": [1, "b"], "allowed": differ}]}
    table = assay.label(network, "all").table
    assert len(table) == 6 and list(table.columns) == [1, "b"] and (table[1] != table["b"]).all()
    pairs = {"nodes": {"v": ["a", 5], "w": 3}, "arcs": [{"between": ["v", "w"], "pairs": [[5, 2]]}]}
    assert assay.label(pairs).labeling == {"v": 5, "w": 2}
    assert assay.label({**pairs, "arcs": [*pairs["arcs"], {
        "between": ["v", "w"], "allowed": np.ones((2, 3))}]}).labeling == {"v": 5, "w": 2}
    assert "5" in repr(assay.label(pairs)) and "1 labelings" in repr(assay.label(pairs, "count"))


def test_a_network_file_is_labeled_as_the_program_does(tmp_path):
    file = tmp_path / "network.json"
    file.write_text('{"nodes": {"v": ["a", "b"], "w": 3},'
                    ' "arcs": [{"between": ["v", "w"], "pairs": [["a", 0], ["b", 2]]}]}')
    theirs = json.loads(program("label", file, "--all").stdout)
    mine = assay.label(file, "all")
    assert mine.labelings == theirs["labelings"] and mine.count == theirs["count"]
    assert mine.visited == theirs["visited"]


@pytest.mark.parametrize("network, words", [
    ({"nodes": {"a": 2}, "arcs": [{"between": ["a", "z"], "pairs": []}]}, "'z'"),
    ({"nodes": {"a": 2}, "arcs": [{"between": ["a", "z"], "allowed": np.ones((2, 2))}]}, "'z'"),
    ({"nodes": {"a": 2, "b": 2}, "arcs": [{"between": ["a", "b"], "allowed": np.ones((2, 3))}]},
     r"has the shape \(2, 3\); allowed: \(2, 2\)"),
    ({"nodes": {"a": ["x", "x"]}}, "given twice"),
    ({"nodes": {"a": 2**20}}, "allowed: a list, or their number, 0 to 65536"),
    ({"nodes": {"a": -1}}, "allowed: a list, or their number"),
    ({"nodes": {"a": "red"}}, "the labels 'red'"),
    ({"nodes": {"a": 2.5}}, "the labels 2.5"),
    ({"nodes": {"a": [[1], [2]]}}, r"\[1\] of node 'a' is no label"),
    ({"nodes": ["a"]}, "allowed: a mapping `nodes`"),
    ({"nodes": {"a": 2}, "arcs": ["a"]}, "a list `arcs` of mappings"),
    ({"nodes": {"a": 2}, "arcs": [{"allowed": np.ones((2, 2))}]}, "allowed: two of 'a'"),
    ({"nodes": {"a": 2, "b": 1}, "arcs": [{"between": "ab", "allowed": [[1], [0, 1]]}]},
     "`allowed` of arc 0"),
    ({"nodes": {"a": 2}, "arcs": [{"between": "aa", "allowed": np.eye(2), "pairs": []}]},
     "allowed: one of 'allowed', 'pairs' and 'forbidden'"),
    ({"nodes": {"a": 2}, "arcs": [{"between": "aa", "allowed": np.eye(2)},
                                  {"between": "aa", "pairs": [1]}]}, "arc 1 has no pair 1"),
    ({}, "nodes"),
])
def test_wrong_networks(network, words):
    with pytest.raises(assay.WrongInput, match=words):
        assay.label(network)


def test_wrong_requests_of_labels():
    network = {"nodes": {"a": 2}}
    with pytest.raises(assay.WrongUsage, match="there is no request 'most'"):
        assay.label(network, "most")
    with pytest.raises(assay.WrongUsage, match="the budget is 0"):
        assay.label(network, budget=0)
    hard = {"nodes": {i: 9 for i in range(10)}, "arcs": [
        {"between": [a, b], "allowed": ~np.eye(9, dtype=bool)}
        for a, b in itertools.combinations(range(10), 2)]}
    with pytest.raises(assay.NoAnswer, match="the budget of search nodes was spent"):
        assay.label(hard, budget=3)


CANS = SCENARIOS / "know/force-sensing.pks", SCENARIOS / "know/two-cans.pks"


def test_a_plan_tree_is_that_of_the_program():
    theirs = program_json("contingent", *CANS, "--check")
    mine = assay.contingent(*CANS, check=True)
    assert mine.tree == theirs["tree"] and mine.guarantee == theirs["guarantee"]
    assert (mine.depth, mine.leaves) == (theirs["depth"], theirs["leaves"])
    assert mine.holds and mine.json["check"] == theirs["check"]
    assert str(mine) == program("contingent", *CANS, "--check").stdout
    assert mine.dot == program("contingent", *CANS, "--dot").stdout
    assert repr(mine) == str(mine).rstrip("\n")


def test_texts_are_planned_for_without_files():
    texts = [file.read_text() for file in CANS]
    mine = assay.contingent(*texts, shortest=True)
    assert mine.tree == assay.contingent(*CANS, shortest=True).tree
    assert mine.holds is None


PDDL = ("""(define (domain look) (:predicates (on ?l) (done))
             (:action look :parameters (?l) :precondition () :observe (on ?l))
             (:action stop :parameters (?l) :precondition (on ?l) :effect (done))
             (:action light :parameters (?l) :precondition (not (on ?l)) :effect (on ?l)))""",
        """(define (problem one) (:domain look) (:objects lamp)
             (:init (unknown (on lamp))) (:goal (done)))""")


def test_pddl_texts_are_known_by_their_parenthesis():
    plan = assay.contingent(*PDDL, check=True)
    assert plan.holds and plan.leaves == 2


def test_wrong_knowledge():
    domain, problem = (file.read_text() for file in CANS)
    with pytest.raises(assay.WrongInput, match="^domain:1:"):
        assay.contingent("nonsense", problem)
    with pytest.raises(assay.WrongInput, match="^problem:"):
        assay.contingent(domain, "problem")
    with pytest.raises(assay.WrongUsage, match="both files or both texts"):
        assay.contingent(CANS[0], problem)
    with pytest.raises(assay.WrongUsage):
        assay.contingent(domain, problem, budget=0)
    with pytest.raises(assay.NoAnswer):
        assay.contingent(domain, problem, budget=1)
    no_light = PDDL[0].replace("(not (on ?l))", "(done)")
    with pytest.raises(assay.NoPlan):
        assay.contingent(no_light, PDDL[1])
