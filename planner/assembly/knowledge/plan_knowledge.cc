#include "planner/assembly/knowledge/plan_knowledge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <set>

#include "planner/assembly/knowledge/knowledge_constants.h"
#include "planner/assembly/open_poses.h"
#include "planner/base/check.h"
#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/language/formula.h"
#include "planner/contingent/language/spelling.h"

namespace assay::assembly {
namespace {

using contingent::All;
using contingent::Any;
using contingent::Atom;
using contingent::Change;
using contingent::Constant;
using contingent::Equal;
using contingent::Forget;
using contingent::Know;
using contingent::Known;
using contingent::KnowValue;
using contingent::KnowWhether;
using contingent::Literal;
using contingent::Not;
using contingent::NumberTerm;
using contingent::Of;
using contingent::Query;
using contingent::TypedName;
using domain::PartId;
using Kind = KnowledgeAction::Kind;

std::array<Interval, 3> Coordinates(const domain::PoseError& error) {
  return {error.x, error.y, error.theta};
}

// Returns the errors that the verifications of a step may signal, each once.
std::vector<std::string> ErrorsAfter(const plan::Plan& plan, plan::StepId step) {
  std::vector<std::string> errors;
  for (const plan::Verification& check : plan.verifications) {
    if (check.step != step) continue;
    for (const std::string& error : {check.below, check.above}) {
      if (!error.empty() && std::ranges::count(errors, error) == 0) errors.push_back(error);
    }
  }
  return errors;
}

// Returns true if no recovery can correct the error, so only a person can correct it.
bool IsForOperator(const plan::Plan& plan, plan::StepId step, const std::string& error) {
  return std::ranges::none_of(plan.recoveries, [&](const plan::Recovery& recovery) {
    return recovery.step == step && recovery.error == error &&
           recovery.strategy != domain::RecoveryStrategy::kCallOperator;
  });
}

// Returns the looks at parts with an open pose among the looks with which a plan begins. At the
// knowledge level they are not steps of the plan, because their results decide which plan works.
std::vector<plan::StepId> LooksAtOpenPoses(const domain::Problem& world, const plan::Plan& plan) {
  std::vector<plan::StepId> looks;
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const plan::Action& action = plan.step(id).action;
    if (!action.Is(domain::kSense)) break;
    if (IsOpen(world, action.part)) looks.push_back(id);
  }
  return looks;
}

// Returns, for each error function, half the width of the interval that the sensor makes known.
std::vector<std::pair<const char*, double>> PromisesOf(const domain::Problem& problem,
                                                       const std::string& sensor) {
  const auto* model = problem.workcell->uncertainty_operations().FindSensor(sensor);
  ASSAY_CHECK(model != nullptr, "the workcell has no sensor '{}'", sensor);
  std::vector<std::pair<const char*, double>> promises;
  for (const auto& [function, promise] :
       {std::pair(kErrorFunctions[0], model->x), std::pair(kErrorFunctions[1], model->y),
        std::pair(kErrorFunctions[2], model->theta)}) {
    const double half_width = (promise.high - promise.low) / 2;
    if (std::isfinite(half_width)) promises.emplace_back(function, half_width);
  }
  return promises;
}

KnowledgeAction WithKind(Kind kind, KnowledgeAction action, std::string error = {}) {
  action.kind = kind;
  action.error = std::move(error);
  return action;
}

// Builds the domain and the problem.
class KnowledgeTask {
 public:
  KnowledgeTask(const std::vector<domain::Problem>& worlds, const std::vector<PlanOfWorlds>& plans)
      : first_(worlds.front()), worlds_(worlds), plans_(plans) {
    for (std::size_t p = 0; p < plans.size(); ++p) {
      for (const plan::StepId id : plans[p].plan.ExecutionOrder()) {
        constants_.Reserve(StepName(static_cast<int>(p), id));
      }
    }
    for (const domain::OpenPose& open : first_.open_poses) AddLooks(open);
    for (std::size_t p = 0; p < plans.size(); ++p) AddPlan(static_cast<int>(p));
    DeclareSymbols();
    domain_.constants = constants_.Declarations();
    NameProblem();
  }

  PlanKnowledge Take() {
    PlanKnowledge knowledge;
    contingent::Externs externs;
    knowledge.task = contingent::Ground(domain_, problem_, externs);
    knowledge.domain = std::move(domain_);
    knowledge.problem = std::move(problem_);
    knowledge.actions = std::move(actions_);
    knowledge.names = constants_.TakeNames();
    return knowledge;
  }

 private:
  void DeclareSymbols() {
    domain_.file = first_.name + "-domain.pks";
    domain_.name = "assembly";
    domain_.types = {{.name = "part"}, {.name = "pose"}, {.name = "step"}, {.name = "error"}};
    const auto of = [](const char* type) { return TypedName{.name = "", .type = type}; };
    domain_.predicates = {{.name = "done", .parameters = {of("step")}},
                          {.name = "moved", .parameters = {of("part")}},
                          {.name = "passed", .parameters = {of("step")}},
                          {.name = "signals", .parameters = {of("step"), of("error")}},
                          {.name = "operatorCalled"}};
    domain_.functions = {{.name = "pose", .parameters = {of("part")}, .range = "pose"}};
    for (const char* function : kErrorFunctions) {
      domain_.functions.push_back(
          {.name = function, .parameters = {of("part")}, .range = contingent::kNumberType});
    }
  }

  // The goal holds as well if a person takes over.
  void NameProblem() {
    problem_.file = first_.name + "-problem.pks";
    problem_.name = domain_.name;
    problem_.domain = domain_.name;
    goals_.push_back(Known(Atom("operatorCalled", {})));
    problem_.goal = Any(std::move(goals_));
  }

  void AddAction(const std::string& name, KnowledgeAction meaning, Query precondition,
                 std::vector<Change> changes) {
    contingent::Action action;
    action.name = contingent::Unique(contingent::Spelled(name), action_names_);
    action.precondition = std::move(precondition);
    action.effects.resize(1);
    action.effects.front().changes = std::move(changes);
    actions_.emplace(action.name, std::move(meaning));
    domain_.actions.push_back(std::move(action));
  }

  const std::string& ConstantOf(const domain::Part& part) {
    return constants_.Of("part", part.name);
  }

  // Returns pose(part) = name.
  Literal PoseIs(const std::string& part, const std::string& name) {
    return Equal(Of("pose", part), Constant(constants_.Of("pose", name)));
  }

  std::string StepName(int plan, plan::StepId step) const {
    return fmt::format("plan{}-{}", plan + 1, plans_[plan].plan.step(step).name);
  }

  void AddLooks(const domain::OpenPose& open) {
    const std::string& part = ConstantOf(first_.part(open.part));
    std::vector<Literal> alternatives;
    for (const std::string& name : open.names) alternatives.push_back(PoseIs(part, name));
    problem_.init.push_back(contingent::KnowOneOf(std::move(alternatives)));
    problem_.init.push_back(Know(Not(Atom("moved", {part}))));
    const auto errors = Coordinates(first_.part(open.part).error);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      problem_.init.push_back(Know(Equal(Of(kErrorFunctions[i], part), NumberTerm(errors[i]))));
    }
    for (const std::string& sensor : first_.sensors) AddLook(part, open.part, sensor);
  }

  // Adds a look, which is possible only while the part has not moved. The part's pose becomes known
  // if no two of its poses look alike.
  void AddLook(const std::string& part, PartId id, const std::string& sensor) {
    std::vector<Change> changes;
    if (!FindAlike(worlds_, id, sensor)) changes.push_back(KnowValue(Of("pose", part), {}));
    for (const auto& [function, half_width] : PromisesOf(first_, sensor)) {
      changes.push_back(KnowValue(Of(function, part), half_width));
    }
    if (changes.empty()) return;
    AddAction(fmt::format("look-{}-{}", part, sensor),
              {.kind = Kind::kLook, .part = id, .sensor = sensor},
              Known(Not(Atom("moved", {part}))), std::move(changes));
  }

  // Knowledge is about the present. After the next step is done, nothing is known about whether the
  // earlier step passed. After a part is picked up, its initial pose and errors are unknown.
  void AddPlan(int index) {
    const plan::Plan& plan = plans_[index].plan;
    std::vector<Query> ready = Requirements(index);
    std::vector<Change> past;
    const std::vector<plan::StepId> steps = StepsOf(plan);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const plan::StepId id = steps[i];
      const std::string step = StepName(index, id);
      constants_.AddStep(step);
      problem_.init.push_back(Know(Not(Atom("done", {step}))));
      ready.push_back(Known(Not(Atom("done", {step}))));
      std::vector<Change> changes = {Know(Atom("done", {step}))};
      std::ranges::move(past, std::back_inserter(changes));
      std::ranges::move(LeftPose(plan.step(id)), std::back_inserter(changes));
      const KnowledgeAction meaning = {
          .kind = Kind::kStep, .plan = index, .step = id, .name = step};
      AddAction(step, meaning, All(std::move(ready)), std::move(changes));
      ready = {Known(Atom("done", {step}))};
      past.clear();
      const std::vector<std::string> errors = ErrorsAfter(plan, id);
      if (errors.empty()) continue;
      const bool is_last = i + 1 == steps.size();
      AddVerification(step, is_last ? "" : StepName(index, steps[i + 1]), meaning, errors);
      ready.push_back(Known(Atom("passed", {step})));
      past.push_back(Forget(Atom("passed", {step})));
    }
    goals_.push_back(All(std::move(ready)));
  }

  // Returns the steps in the order of execution, without the looks at parts with an open pose.
  std::vector<plan::StepId> StepsOf(const plan::Plan& plan) const {
    const std::vector<plan::StepId> looks = LooksAtOpenPoses(first_, plan);
    std::vector<plan::StepId> steps = plan.ExecutionOrder();
    std::erase_if(steps, [&](plan::StepId id) { return std::ranges::count(looks, id) > 0; });
    return steps;
  }

  std::vector<Change> LeftPose(const plan::PlannedStep& step) {
    const PartId id = step.action.part;
    if (step.action.kind->leaves != domain::Leaves::kInHand || !IsOpen(first_, id)) return {};
    const std::string& part = ConstantOf(first_.part(id));
    std::vector<Change> changes = {Know(Atom("moved", {part}))};
    for (const std::string& name : OpenPoseOf(first_, id).names) {
      changes.push_back(Forget(PoseIs(part, name)));
    }
    for (const char* function : kErrorFunctions) {
      changes.push_back(Forget(Equal(Of(function, part), NumberTerm({0, 0}))));
    }
    return changes;
  }

  Literal Signals(const std::string& step, const std::string& error) {
    return Atom("signals", {step, constants_.Of("error", error)});
  }

  // Adds actions that find out whether the step passes its verifications. If the step does not
  // pass, these actions find out which error is signalled. They ask about one error after another,
  // and the last error follows by elimination. A recovery makes all these facts unknown again. A
  // verification measures the step only until the next step is done. `next` is empty if there is
  // none.
  void AddVerification(const std::string& step, const std::string& next,
                       const KnowledgeAction& meaning, const std::vector<std::string>& errors) {
    for (const std::string& error : errors) constants_.Of("error", error);
    std::vector<Query> in_time = {Known(Atom("done", {step}))};
    if (!next.empty()) in_time.push_back(Known(Not(Atom("done", {next}))));
    AddAction("verify-" + step, WithKind(Kind::kVerify, meaning), All(std::move(in_time)),
              {KnowWhether(Atom("passed", {step}))});
    std::vector<Query> so_far = {Known(Not(Atom("passed", {step})))};
    for (const std::string& error : errors) {
      std::vector<Query> signalled = so_far;
      if (error != errors.back()) {
        AddAction(fmt::format("diagnose-{}-{}", step, error),
                  WithKind(Kind::kDiagnose, meaning, error), All(so_far),
                  {KnowWhether(Signals(step, error))});
        signalled.push_back(Known(Signals(step, error)));
        so_far.push_back(Known(Not(Signals(step, error))));
      }
      AddRecovery(step, meaning, error, All(std::move(signalled)), ForgetOutcome(step, errors));
    }
  }

  void AddRecovery(const std::string& step, const KnowledgeAction& meaning,
                   const std::string& error, Query signalled, std::vector<Change> forget) {
    const bool is_last_resort = IsForOperator(plans_[meaning.plan].plan, meaning.step, error);
    if (is_last_resort) forget = {Know(Atom("operatorCalled", {}))};
    AddAction(fmt::format("{}-{}-{}", is_last_resort ? "call-operator" : "recover", step, error),
              WithKind(is_last_resort ? Kind::kOperator : Kind::kRecover, meaning, error),
              std::move(signalled), std::move(forget));
  }

  std::vector<Change> ForgetOutcome(const std::string& step,
                                    const std::vector<std::string>& errors) {
    std::vector<Change> changes = {Forget(Atom("passed", {step}))};
    for (const std::string& error : errors) {
      if (error != errors.back()) changes.push_back(Forget(Signals(step, error)));
    }
    return changes;
  }

  // Returns the facts that must be known before a plan begins. The open poses that matter must be
  // those of one of the plan's worlds. The parts that the plan looks at first must have the error
  // bounds that its certificates assume.
  std::vector<Query> Requirements(int index) {
    std::vector<Query> requirements;
    const std::vector<domain::OpenPose> matter = PosesThatMatter(worlds_, plans_[index].worlds);
    if (!matter.empty()) requirements.push_back(IsOneOf(plans_[index].worlds, matter));
    const plan::Plan& plan = plans_[index].plan;
    for (const plan::StepId id : LooksAtOpenPoses(first_, plan)) {
      const plan::Action& look = plan.step(id).action;
      for (const auto& [function, half_width] : PromisesOf(first_, look.sensor)) {
        const std::string& part = ConstantOf(first_.part(look.part));
        requirements.push_back(contingent::ValueKnown(Of(function, part), half_width));
      }
    }
    return requirements;
  }

  // Returns the query whether the open poses are known to be those of one of the worlds.
  Query IsOneOf(const std::vector<int>& worlds, const std::vector<domain::OpenPose>& open_poses) {
    std::map<std::vector<std::string>, Query> cases;  // by the poses' constants
    for (const int world : worlds) {
      std::vector<std::string> poses;
      std::vector<Query> facts;
      for (const domain::OpenPose& open : open_poses) {
        const std::string& name = open.names[OpenPoseOf(worlds_[world], open.part).chosen];
        facts.push_back(Known(PoseIs(ConstantOf(first_.part(open.part)), name)));
        poses.push_back(constants_.Of("pose", name));
      }
      cases.emplace(std::move(poses), All(std::move(facts)));
    }
    std::vector<Query> queries;
    for (auto& [poses, query] : cases) queries.push_back(std::move(query));
    return Any(std::move(queries));
  }

  const domain::Problem& first_;
  const std::vector<domain::Problem>& worlds_;
  const std::vector<PlanOfWorlds>& plans_;
  contingent::Domain domain_;
  contingent::Problem problem_;
  std::vector<Query> goals_;
  KnowledgeConstants constants_;
  std::map<std::string, KnowledgeAction> actions_;
  std::set<std::string> action_names_;
};

}  // namespace

PlanKnowledge KnowledgeOf(const std::vector<domain::Problem>& worlds,
                          const std::vector<PlanOfWorlds>& plans) {
  ASSAY_CHECK(!worlds.empty());
  return KnowledgeTask(worlds, plans).Take();
}

}  // namespace assay::assembly
