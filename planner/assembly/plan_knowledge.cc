#include "planner/assembly/plan_knowledge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <set>

#include "planner/assembly/open_poses.h"
#include "planner/base/check.h"
#include "planner/contingent/format/pks_file.h"
#include "planner/contingent/format/pks_lexer.h"
#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/language/spelling.h"

namespace assay::assembly {
namespace {

using domain::PartId;
using Kind = KnowledgeAction::Kind;

constexpr const char* kErrorFunctions[] = {"dx", "dy", "theta"};

std::array<Interval, 3> Coordinates(const domain::PoseError& error) {
  return {error.x, error.y, error.theta};
}

std::string Text(const Interval& interval) {
  return fmt::format("[{}, {}]", interval.low, interval.high);
}

std::string Both(const std::vector<std::string>& queries) {
  return queries.empty() ? "true" : fmt::format("{}", fmt::join(queries, " & "));
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

const domain::OpenPose& OpenPoseOf(const domain::Problem& world, PartId part) {
  return *std::ranges::find(world.open_poses, part, &domain::OpenPose::part);
}

// Returns true if the worlds have the same poses of all parts except one.
bool AgreeBeside(const domain::Problem& a, const domain::Problem& b, PartId part) {
  return std::ranges::all_of(a.open_poses, [&](const domain::OpenPose& open) {
    return open.part == part || open.chosen == OpenPoseOf(b, open.part).chosen;
  });
}

bool Matters(const std::vector<domain::Problem>& worlds, const std::vector<int>& of_plan,
             PartId part) {
  for (const int world : of_plan) {
    for (int other = 0; other < std::ssize(worlds); ++other) {
      if (std::ranges::count(of_plan, other) > 0) continue;
      if (AgreeBeside(worlds[world], worlds[other], part)) return true;
    }
  }
  return false;
}

bool IsOpen(const domain::Problem& world, PartId part) {
  return std::ranges::count(world.open_poses, part, &domain::OpenPose::part) > 0;
}

// Returns the looks at parts with an open pose among the looks with which a plan begins. At the
// knowledge level they are not steps of the plan, because their results decide which plan works.
std::vector<plan::StepId> LooksAtOpenPoses(const domain::Problem& world, const plan::Plan& plan) {
  std::vector<plan::StepId> looks;
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const auto* sense = std::get_if<plan::Sense>(&plan.step(id).action);
    if (sense == nullptr) break;
    if (IsOpen(world, sense->part)) looks.push_back(id);
  }
  return looks;
}

// Writes the domain and the problem in the .pks format.
class KnowledgeText {
 public:
  KnowledgeText(const std::vector<domain::Problem>& worlds, const std::vector<PlanOfWorlds>& plans)
      : first_(worlds.front()), worlds_(worlds), plans_(plans) {
    TakeNames();
    for (const domain::OpenPose& open : first_.open_poses) AddLooks(open);
    for (std::size_t p = 0; p < plans.size(); ++p) AddPlan(static_cast<int>(p));
  }

  std::string Domain() const {
    return fmt::format(
        "# What is known while plans for the scenario {0} are executed.\n"
        "domain assembly\n\n"
        "types: part, pose, step, error\n"
        "predicates: done(step), moved(part), passed(step), signals(step, error), "
        "operatorCalled\n"
        "functions: pose(part): pose, dx(part): number, dy(part): number, theta(part): number\n"
        "constants: {1}\n{2}",
        first_.name, Constants(), actions_text_);
  }

  // Returns the .pks problem. Its goal holds as well if a person takes over.
  std::string Problem() const {
    return fmt::format(
        "problem assembly\ndomain assembly\n\ninit: {}\ngoal: {} |\n      K(operatorCalled)\n",
        fmt::join(init_, ",\n      "), fmt::join(goals_, " |\n      "));
  }

  std::map<std::string, KnowledgeAction> Actions() { return std::move(actions_); }
  std::map<std::string, std::string> Names() { return std::move(names_); }

 private:
  // Names of sensors, errors, parts and poses are arbitrary, so they are spelled as .pks names
  // here.
  void AddAction(const std::string& name, KnowledgeAction action, const std::string& precondition,
                 const std::string& effects) {
    const std::string spelled = contingent::Unique(contingent::Spelled(name), action_names_);
    actions_text_ +=
        fmt::format("\naction {}\n  preconds: {}\n  effects: {}\n", spelled, precondition, effects);
    actions_.emplace(spelled, std::move(action));
  }

  const std::string& ConstantOf(const std::string& type, const std::string& name) {
    const auto [known, is_new] = spelled_.try_emplace({type, name});
    if (is_new) {
      known->second = contingent::Unique(contingent::Spelled(name), constant_names_);
      constants_[type].insert(known->second);
      names_.emplace(known->second, name);
    }
    return known->second;
  }
  const std::string& ConstantOf(const domain::Part& part) { return ConstantOf("part", part.name); }

  // Reserves the names that no constant of a part, pose or error may have.
  void TakeNames() {
    constant_names_.insert(contingent::kPksSections.begin(), contingent::kPksSections.end());
    constant_names_.insert("pose");
    constant_names_.insert(std::begin(kErrorFunctions), std::end(kErrorFunctions));
    for (std::size_t p = 0; p < plans_.size(); ++p) {
      for (const plan::StepId id : plans_[p].plan.ExecutionOrder()) {
        constant_names_.insert(StepName(static_cast<int>(p), id));
      }
    }
  }

  std::string StepName(int plan, plan::StepId step) const {
    return fmt::format("plan{}-{}", plan + 1, plans_[plan].plan.step(step).name);
  }

  void AddLooks(const domain::OpenPose& open) {
    const std::string& part = ConstantOf(first_.part(open.part));
    std::vector<std::string> alternatives;
    for (const std::string& name : open.names) {
      alternatives.push_back(fmt::format("pose({}) = {}", part, ConstantOf("pose", name)));
    }
    init_.push_back(fmt::format("add(Kx, {})", fmt::join(alternatives, " | ")));
    init_.push_back(fmt::format("add(Kf, !moved({}))", part));
    const auto errors = Coordinates(first_.part(open.part).error);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      init_.push_back(
          fmt::format("add(Kf, {}({}) = {})", kErrorFunctions[i], part, Text(errors[i])));
    }
    for (const std::string& sensor : first_.sensors) AddLook(part, open.part, sensor);
  }

  // Adds a look, which is possible only while the part has not moved. The part's pose becomes known
  // if no two of its poses look alike.
  void AddLook(const std::string& part, PartId id, const std::string& sensor) {
    std::vector<std::string> effects;
    if (!FindAlike(worlds_, id, sensor)) effects.push_back(fmt::format("add(Kv, pose({}))", part));
    for (const auto& [function, half_width] : PromisesOf(sensor)) {
      effects.push_back(fmt::format("add(Kv, {}({}) within {})", function, part, half_width));
    }
    if (effects.empty()) return;
    AddAction(fmt::format("look-{}-{}", part, sensor),
              {.kind = Kind::kLook, .part = id, .sensor = sensor},
              fmt::format("K(!moved({}))", part), fmt::format("{}", fmt::join(effects, ", ")));
  }

  // Knowledge is about the present. After the next step is done, nothing is known about whether the
  // earlier step passed. After a part is picked up, its initial pose and errors are unknown.
  void AddPlan(int index) {
    const plan::Plan& plan = plans_[index].plan;
    std::string ready = Both(Requirements(index));
    std::string past;
    const std::vector<plan::StepId> steps = StepsOf(plan);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const plan::StepId id = steps[i];
      const std::string step = StepName(index, id);
      constants_["step"].insert(step);
      init_.push_back(fmt::format("add(Kf, !done({}))", step));
      const KnowledgeAction meaning = {
          .kind = Kind::kStep, .plan = index, .step = id, .name = step};
      AddAction(step, meaning, fmt::format("{} & K(!done({}))", ready, step),
                fmt::format("add(Kf, done({})){}{}", step, past, LeftPose(plan.step(id))));
      ready = fmt::format("K(done({}))", step);
      past.clear();
      const std::vector<std::string> errors = ErrorsAfter(plan, id);
      if (errors.empty()) continue;
      const bool is_last = i + 1 == steps.size();
      AddVerification(step, is_last ? "" : StepName(index, steps[i + 1]), meaning, errors);
      ready += fmt::format(" & K(passed({}))", step);
      past = fmt::format(", del(Kf, passed({}))", step);
    }
    goals_.push_back(ready);
  }

  // Returns the steps in the order of execution, without the looks at parts with an open pose.
  std::vector<plan::StepId> StepsOf(const plan::Plan& plan) const {
    const std::vector<plan::StepId> looks = LooksAtOpenPoses(first_, plan);
    std::vector<plan::StepId> steps = plan.ExecutionOrder();
    std::erase_if(steps, [&](plan::StepId id) { return std::ranges::count(looks, id) > 0; });
    return steps;
  }

  std::string LeftPose(const plan::PlannedStep& step) {
    const auto* pickup = std::get_if<plan::Pickup>(&step.action);
    if (pickup == nullptr || !IsOpen(first_, pickup->part)) return {};
    const std::string& part = ConstantOf(first_.part(pickup->part));
    std::string effects = fmt::format(", add(Kf, moved({}))", part);
    for (const std::string& name : OpenPoseOf(first_, pickup->part).names) {
      effects += fmt::format(", del(Kf, pose({}) = {})", part, ConstantOf("pose", name));
    }
    for (const char* function : kErrorFunctions) {
      effects += fmt::format(", del(Kf, {}({}) = 0)", function, part);
    }
    return effects;
  }

  // Adds actions that find out whether the step passes its verifications. If it does not, they find
  // out which error is signalled. The errors are asked one after another, and the last one follows
  // by elimination. A recovery makes all these facts unknown again. A verification measures the
  // step only until the next step is done. `next` is empty if there is none.
  void AddVerification(const std::string& step, const std::string& next,
                       const KnowledgeAction& meaning, const std::vector<std::string>& errors) {
    for (const std::string& error : errors) ConstantOf("error", error);
    const std::string in_time = next.empty() ? "" : fmt::format(" & K(!done({}))", next);
    AddAction("verify-" + step, WithKind(Kind::kVerify, meaning),
              fmt::format("K(done({})){}", step, in_time),
              fmt::format("add(Kw, passed({}))", step));
    std::string so_far = fmt::format("K(!passed({}))", step);
    for (const std::string& error : errors) {
      std::string signalled = so_far;
      if (error != errors.back()) {
        AddAction(fmt::format("diagnose-{}-{}", step, error),
                  WithKind(Kind::kDiagnose, meaning, error), so_far,
                  fmt::format("add(Kw, signals({}, {}))", step, ConstantOf("error", error)));
        signalled += fmt::format(" & K(signals({}, {}))", step, ConstantOf("error", error));
        so_far += fmt::format(" & K(!signals({}, {}))", step, ConstantOf("error", error));
      }
      AddRecovery(step, meaning, error, signalled, ForgetOutcome(step, errors));
    }
  }

  void AddRecovery(const std::string& step, const KnowledgeAction& meaning,
                   const std::string& error, const std::string& signalled,
                   const std::string& forget) {
    const bool is_last_resort = IsForOperator(plans_[meaning.plan].plan, meaning.step, error);
    AddAction(fmt::format("{}-{}-{}", is_last_resort ? "call-operator" : "recover", step, error),
              WithKind(is_last_resort ? Kind::kOperator : Kind::kRecover, meaning, error),
              signalled, is_last_resort ? "add(Kf, operatorCalled)" : forget);
  }

  static KnowledgeAction WithKind(Kind kind, KnowledgeAction action, std::string error = {}) {
    action.kind = kind;
    action.error = std::move(error);
    return action;
  }

  std::string ForgetOutcome(const std::string& step, const std::vector<std::string>& errors) {
    std::string effects = fmt::format("del(Kf, passed({}))", step);
    for (const std::string& error : errors) {
      if (error == errors.back()) break;
      effects += fmt::format(", del(Kf, signals({}, {}))", step, ConstantOf("error", error));
    }
    return effects;
  }

  // Returns the facts that must be known before a plan begins. The open poses that matter must be
  // those of one of the plan's worlds. The parts that the plan looks at first must have the error
  // bounds that its certificates assume.
  std::vector<std::string> Requirements(int index) {
    std::vector<std::string> requirements;
    const std::vector<domain::OpenPose> matter = PosesThatMatter(worlds_, plans_[index].worlds);
    std::set<std::string> cases;
    for (const int world : plans_[index].worlds) {
      std::vector<std::string> facts;
      for (const domain::OpenPose& open : matter) {
        const domain::OpenPose& here = OpenPoseOf(worlds_[world], open.part);
        facts.push_back(fmt::format("K(pose({}) = {})", ConstantOf(first_.part(open.part)),
                                    ConstantOf("pose", open.names[here.chosen])));
      }
      cases.insert(Both(facts));
    }
    if (!matter.empty()) requirements.push_back(fmt::format("({})", fmt::join(cases, " | ")));
    const plan::Plan& plan = plans_[index].plan;
    for (const plan::StepId id : LooksAtOpenPoses(first_, plan)) {
      AddPrecision(std::get<plan::Sense>(plan.step(id).action), requirements);
    }
    return requirements;
  }

  void AddPrecision(const plan::Sense& look, std::vector<std::string>& requirements) {
    for (const auto& [function, half_width] : PromisesOf(look.sensor)) {
      requirements.push_back(fmt::format("Kv({}({}) within {})", function,
                                         ConstantOf(first_.part(look.part)), half_width));
    }
  }

  // Returns, for each error function, half the width of the interval that the sensor makes known.
  std::vector<std::pair<const char*, double>> PromisesOf(const std::string& sensor) const {
    const auto* model = first_.workcell->uncertainty_operations().FindSensor(sensor);
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

  std::string Constants() const {
    std::vector<std::string> lists;
    for (const auto& [type, names] : constants_) {
      lists.push_back(fmt::format("{}: {}", fmt::join(names, ", "), type));
    }
    return fmt::format("{}", fmt::join(lists, ",\n           "));
  }

  const domain::Problem& first_;
  const std::vector<domain::Problem>& worlds_;
  const std::vector<PlanOfWorlds>& plans_;
  std::map<std::string, std::set<std::string>> constants_;  // indexed by type
  std::string actions_text_;
  std::vector<std::string> init_;
  std::vector<std::string> goals_;
  std::map<std::string, KnowledgeAction> actions_;
  std::map<std::pair<std::string, std::string>, std::string> spelled_;  // indexed by type and name
  std::map<std::string, std::string> names_;                            // indexed by constant
  std::set<std::string> constant_names_;                                // constants that are in use
  std::set<std::string> action_names_;
};

}  // namespace

std::vector<domain::OpenPose> PosesThatMatter(const std::vector<domain::Problem>& worlds,
                                              const std::vector<int>& of_plan) {
  std::vector<domain::OpenPose> matter = worlds.front().open_poses;
  std::erase_if(matter,
                [&](const domain::OpenPose& open) { return !Matters(worlds, of_plan, open.part); });
  return matter;
}

PlanKnowledge KnowledgeOf(const std::vector<domain::Problem>& worlds,
                          const std::vector<PlanOfWorlds>& plans) {
  ASSAY_CHECK(!worlds.empty());
  KnowledgeText text(worlds, plans);
  PlanKnowledge knowledge;
  knowledge.domain = text.Domain();
  knowledge.problem = text.Problem();
  contingent::Externs externs;
  const std::string& name = worlds.front().name;
  knowledge.task = contingent::Ground(
      contingent::ReadPksDomain(knowledge.domain, name + "-domain.pks"),
      contingent::ReadPksProblem(knowledge.problem, name + "-problem.pks"), externs);
  knowledge.actions = text.Actions();
  knowledge.names = text.Names();
  return knowledge;
}

}  // namespace assay::assembly
