"""Scenarios, plans, certificates, explanations and checks."""

import ast
import functools
import inspect
import json
import os
import re
import signal
import subprocess
import sys
import textwrap
import threading

import pytest
from conftest import KNOWN, SCENARIOS, TREE, program

import assay
from assay import _assay


def test_a_scenario_is_described():
    scenario = assay.Scenario(SCENARIOS / "spar-fig15.yaml")
    assert scenario.name == "spar-fig15"
    assert scenario.parts == ["block", "peg"]
    assert scenario.sensors == ["overhead-camera"]
    assert scenario.resolvers == ["sensing", "squeezing"]
    assert scenario.clearance > 0 and not scenario.needs_tree
    assert "spar-fig15" in repr(scenario)


def test_the_plan_file_is_that_of_the_program(tmp_path, fig15):
    mine, theirs = tmp_path / "mine.json", tmp_path / "theirs.json"
    fig15.save(mine)
    program("plan", SCENARIOS / "spar-fig15.yaml", "-o", theirs)
    assert mine.read_bytes() == theirs.read_bytes()
    assert fig15.json == json.loads(mine.read_text())
    again = assay.Plan.read(mine)
    assert again.json == fig15.json
    assert str(again) == str(fig15) and str(fig15) in program("plan", mine).stdout
    assert repr(fig15) == str(fig15).rstrip("\n")


def test_certificates_are_those_of_the_plan_file(fig15):
    table = fig15.certificates
    in_file = [p for a in sorted(fig15.json["actions"], key=lambda a: a["executed"])
               for p in a["certificate"]["preconditions"]]
    assert list(table["bound"]) == [p["bound"] for p in in_file]
    assert list(table["worst"]) == [p["worst"] for p in in_file]
    assert (table["proved"] == (table["margin"] > 0)).all() and fig15.proved
    is_less = table["relation"] == "<"
    margins = (table["limit"] - table["bound"]).where(is_less, table["bound"] - table["limit"])
    assert margins.sub(table["margin"]).abs().max() < 1e-9
    assert list(fig15.steps["preconditions"]) == list(table.groupby("step").size())
    assert list(fig15.steps["step"]) == [1, 2, 3, 4]
    assert fig15.steps["action"][0] == "sense(peg, overhead-camera, initial)"


def test_costs_are_of_variables_at_their_worst_corner(fig15):
    costs = fig15.sensitivity
    assert (costs["cost"] >= 0).all() and (costs["low"] <= costs["high"]).all()
    worst = costs.dropna(subset="worst")
    assert ((worst["low"] <= worst["worst"]) & (worst["worst"] <= worst["high"])).all()
    for place, group in costs.groupby("precondition"):
        row = fig15.certificates.iloc[place]
        assert row["cost"] == dict(zip(group["variable"], group["cost"]))
        assert list(group["cost"]) == sorted(group["cost"], reverse=True)


def test_error_sets_shrink_when_a_part_is_looked_at(fig15):
    sets = fig15.error_sets
    x = sets[(sets["step"] == 1) & (sets["component"] == "x")].set_index("when")
    width = x["high"] - x["low"]
    assert width["after"] < width["before"] / 10
    assert set(sets["unit"]) == {"m", "rad"}


def test_the_error_box_has_the_errors_of_parts_and_hand(fig15):
    box = fig15.error_box.set_index("variable")
    assert box.loc["dx_block", "high"] == pytest.approx(0.002794)
    assert box.loc["theta_block", "unit"] == "rad"
    assert any(name.startswith("dx_hand@") for name in box.index)


def test_a_step_is_explained_in_the_words_of_the_program(fig15):
    plan = SCENARIOS / "spar-fig15.yaml"
    assert fig15.explain(2) == program("plan", plan, "--explain", 2).stdout
    assert fig15.explain("action_2") == fig15.explain(2)
    with pytest.raises(assay.WrongUsage, match="there is no step 5; allowed: 1 to 4, or an id"):
        fig15.explain(5)


def test_a_right_plan_passes_its_check(known):
    check = known.check()
    assert check.holds and check and check.flaws.empty and check.orders >= 1
    assert repr(check) in program("plan", KNOWN, "--check").stdout


def test_a_budget_is_that_of_the_program(tmp_path):
    file = tmp_path / "jigs.yaml"
    known = SCENARIOS / "uncertain-known.yaml"
    file.write_text(re.sub("sensing: .*", "resolvers: [squeezing]", known.read_text()))
    budget = assay.Scenario(file).plan().budget()
    told = json.loads(program("budget", file, "--json").stdout)
    del told["seconds"]
    assert budget == told
    with pytest.raises(assay.WrongUsage, match="'nut.x' is no error"):
        assay.Scenario(file).plan().budget(front=["peg.x", "nut.x"])


def test_a_wrong_plan_fails_its_check_and_is_not_executed(tmp_path, known):
    wrong = json.loads(json.dumps(known.json))
    wrong["actions"][0]["certificate"]["preconditions"][0]["bound"] -= 1
    file = tmp_path / "plan.json"
    file.write_text(json.dumps(wrong))
    plan = assay.Plan.read(file)
    check = plan.check()
    assert not check.holds and not check
    assert list(check.flaws["step"])[0] == wrong["actions"][0]["id"]
    with pytest.raises(assay.Failed) as error:
        plan.run()
    assert str(error.value) == repr(check) and error.value.exit_code == 12


def test_settings_change_the_plan():
    scenario = assay.Scenario(SCENARIOS / "spar-fig15.yaml")
    assert not scenario.plan(resolvers=["fine-motion"]).proved
    assert scenario.plan(resolvers="sensing").proved
    sound, paper = scenario.plan(), scenario.plan(propagation="paper")
    assert sound.certificates["bound"].tolist() != paper.certificates["bound"].tolist()
    exact = assay.Scenario(scenario.path, error_scale=0).plan()
    assert exact.proved and len(exact.steps) == 2  # nothing is looked at
    assert assay.Scenario(scenario.path, clearance=0.001).clearance == 0.001


def test_no_plan_is_an_exception_with_the_words_of_the_program():
    path = SCENARIOS / "impossible.yaml"
    told = program("plan", path)
    with pytest.raises(assay.NoPlan) as error:
        assay.Scenario(path).plan()
    assert str(error.value) and str(error.value) in told.stdout
    assert error.value.exit_code == told.returncode == 10
    assert error.value.details["outcome"] == "none" and error.value.details["conflict"]
    with pytest.raises(assay.NoAnswer) as error:
        assay.Scenario(SCENARIOS / "spar-fig13.yaml").plan(budget=1)
    assert error.value.exit_code == 11


def test_wrong_input_has_its_place(tmp_path):
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text(KNOWN.read_text().replace("format:", "fromat:"))
    with pytest.raises(assay.WrongInput) as error:
        assay.Scenario(wrong)
    assert f"assay: {error.value}\n" == program("plan", wrong).stderr
    assert isinstance(error.value, ValueError) and error.value.exit_code == 3
    with pytest.raises(assay.WrongInput, match="nothing.yaml"):
        assay.Scenario(tmp_path / "nothing.yaml")
    with pytest.raises(assay.WrongInput):
        assay.Plan.read(KNOWN)
    with pytest.raises(assay.WrongInput, match="models"):
        assay.Scenario(KNOWN, models=[tmp_path])


@pytest.mark.parametrize("arguments, words", [
    ({"resolvers": ["smelling"]}, "there is no resolver 'smelling'; allowed: sensing"),
    ({"propagation": "loud"}, "there is no propagation 'loud'; allowed: sound, paper"),
    ({"budget": 0}, "the budget is 0; allowed: 1 or more"),
])
def test_wrong_arguments_of_plan(arguments, words):
    with pytest.raises(assay.WrongUsage, match=words) as error:
        assay.Scenario(KNOWN).plan(**arguments)
    assert error.value.exit_code == 2


def test_wrong_arguments_of_a_scenario():
    with pytest.raises(assay.WrongInput, match="-1 m instead of this clearance is out of range"):
        assay.Scenario(KNOWN, clearance=-1)
    with pytest.raises(assay.WrongUsage, match="the error scale is"):
        assay.Scenario(KNOWN, error_scale=float("nan"))
    with pytest.raises(TypeError):
        assay.Scenario(KNOWN, clearance="wide")


def test_other_threads_run_while_the_planner_works():
    scenario = assay.Scenario(SCENARIOS / "uncertain-clutter.yaml")
    planning = threading.Thread(target=scenario.plan)
    planning.start()
    rounds = 0
    while planning.is_alive():
        planning.join(timeout=0.001)
        rounds += 1
    assert rounds > 10


def test_ctrl_c_stops_the_planner():
    script = textwrap.dedent(f"""
        import assay
        scenario = assay.Scenario({str(SCENARIOS / "spar-fig13.yaml")!r})
        print("ready", flush=True)
        try:
            while True:
                scenario.plan(budget=2_000_000)
        except KeyboardInterrupt:
            print("interrupted", len(scenario.plan().steps))
        """)
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    child.stdout.flush()
    threading.Event().wait(0.2)
    os.kill(child.pid, signal.SIGINT)
    out, _ = child.communicate(timeout=60)
    assert out.startswith("interrupted ") and child.returncode == 0


def signature(documented: str) -> tuple[list[str], str]:
    """Returns the names of arguments, and the type of the result, of pybind11's documentation."""
    arguments, result = re.match(r"\w+\((.*)\) -> (.+)", documented).groups()
    return re.findall(r"(\w+): ", arguments), result


def require_same_signature(node: ast.FunctionDef, real, place: str) -> None:
    names = [argument.arg for argument in node.args.args]
    found, result = signature(real.__doc__)
    assert found == names, place
    if result in ("str", "int", "bool", "float", "None"):
        assert ast.unparse(node.returns) == result, place


def require_same_class(node: ast.ClassDef, real: type) -> None:
    functions = [m for m in node.body if isinstance(m, ast.FunctionDef)]
    members = {m.name for m in functions} | {
        m.target.id for m in node.body if isinstance(m, ast.AnnAssign)}
    assert members - {"__init__"} == {m for m in dir(real) if not m.startswith("_")}, node.name
    for function in functions:
        decorators = {ast.unparse(d) for d in function.decorator_list}
        member = getattr(real, function.name)
        if "property" in decorators:
            assert isinstance(member, property)
        elif "overload" not in decorators:
            require_same_signature(function, member, f"{node.name}.{function.name}")


def test_the_types_of_the_extension_are_those_of_its_stub():
    stub = ast.parse((TREE / "sim/python/assay/_assay.pyi").read_text())
    declared = {node.name: node for node in stub.body
                if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    constants = {node.target.id: ast.unparse(node.annotation) for node in stub.body
                 if isinstance(node, ast.AnnAssign)}
    there = {name for name in dir(_assay) if not name.startswith("_")}
    assert set(declared) | set(constants) - {"__version__"} == there
    for name, annotation in constants.items():
        assert type(getattr(_assay, name)).__name__ == annotation, name
    for name, node in declared.items():
        if isinstance(node, ast.ClassDef):
            require_same_class(node, getattr(_assay, name))
        else:
            require_same_signature(node, getattr(_assay, name), name)
    assert (TREE / "sim/python/assay/py.typed").exists()


def public_members():
    """Returns every public class and function with its name, and those inside public classes."""
    for name in assay.__all__:
        public = getattr(assay, name)
        if not callable(public):
            continue
        yield name, public
        for method, member in vars(public).items() if isinstance(public, type) else ():
            if method.startswith("_"):
                continue
            if isinstance(member, property):
                yield f"{name}.{method}", member.fget
            elif isinstance(member, functools.cached_property):
                yield f"{name}.{method}", member.func
            elif callable(getattr(public, method)):
                yield f"{name}.{method}", getattr(public, method)


def test_everything_public_is_documented_and_typed():
    for name, member in public_members():
        assert member.__doc__, name
        if isinstance(member, type) or "." not in name and not inspect.isfunction(member):
            continue
        signature = inspect.signature(member)
        assert signature.return_annotation is not signature.empty, name
        for argument in list(signature.parameters.values())["." in name:]:
            assert argument.annotation is not argument.empty, f"{name}: {argument}"
