#include "planner/assembly/travel_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "planner/assembly/part_doubts.h"
#include "planner/motion/path_search.h"
#include "planner/motion/straight_line.h"
#include "planner/motion/travel.h"
#include "planner/plan/tool_route.h"
#include "planner/plan/world_state.h"

namespace assay::assembly {
namespace {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;
using motion::CollisionScene;
using motion::JointPath;
using motion::MotionCheck;
using motion::MotionRules;
using motion::Obstruction;
using plan::StepId;
using plan::ToolRoute;

constexpr double kLineStep = 0.02;          // metres between postures that are looked at on lines
constexpr double kFurthestClearance = 0.1;  // that is told of a path, metres
constexpr double kAccuracy = 5e-4;          // of what is told, metres
constexpr double kSameOrientation = 1e-9;

// Straight to a pose of the tool, from the last posture of the path on. False if the arm cannot.
bool AppendLine(const domain::Workcell& workcell, const Pose& X_WorldTool, JointPath& path) {
  const Pose now = motion::ToolAt(workcell, path.back());
  if (geometry::AngleBetween(now.linear(), X_WorldTool.linear()) > kSameOrientation) {
    // By a strategy, which is checked otherwise.
    const auto q = motion::NearestPosture(workcell, X_WorldTool, path.back());
    if (q) path.push_back(*q);
    return q.has_value();
  }
  const auto line = motion::FollowLine(workcell, path.back(), X_WorldTool.translation(), kLineStep);
  if (line.path) path.insert(path.end(), line.path->q.begin() + 1, line.path->q.end());
  return line.path.has_value();
}

std::optional<Obstruction> FindObstruction(MotionCheck& check, const JointPath& path) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (auto obstruction = check.FindObstruction(path[i], path[i + 1])) return obstruction;
  }
  return std::nullopt;
}

// What travels are about: what is where, how well that is known, and where the arm is.
class Walk {
 public:
  Walk(const domain::Problem& problem, const plan::Plan& plan)
      : problem_(problem),
        workcell_(*problem.workcell),
        plan_(plan),
        state_(plan::InitialState(problem)),
        doubts_(problem),
        arm_(motion::ArmBodies(workcell_.arm())),
        clearance_(kTravelClearance + HandDoubt(problem)),
        left_(plan::HomeTool(workcell_)) {}

  double clearance() const { return clearance_; }
  const domain::Workcell& workcell() const { return workcell_; }
  const domain::Problem& problem() const { return problem_; }
  // Where the tool is when the travel begins.
  const Pose& left() const { return left_; }

  // None: home, after the last step.
  ToolRoute RouteTo(StepId id) const {
    if (id.IsNone()) return {.poised = plan::HomeTool(workcell_)};
    const plan::Action& action = plan_.step(id).action;
    return plan::RouteOf(problem_, plan_.step(id),
                         state_.part(plan::PartOf(problem_, action)).X_WorldPart);
  }

  // Before the travel to a step.
  void ComeTo(StepId id) {
    if (!id.IsNone()) doubts_.Take(plan_.step(id).certificate.before);
  }
  motion::Surroundings Surroundings() const {
    motion::Surroundings surroundings{.doubts = doubts_.In(state_),
                                      .opening = workcell_.gripper().max_opening()};
    for (std::size_t p = 0; p < state_.parts.size(); ++p) {
      if (PartId(p) == state_.in_hand) continue;
      surroundings.parts.push_back({PartId(p), state_.parts[p].X_WorldPart});
    }
    if (!state_.in_hand.IsNone()) {
      surroundings.held = motion::HeldPart{state_.in_hand, state_.hold.X_PartTool};
      surroundings.opening = state_.hold.width;
    }
    return surroundings;
  }
  CollisionScene Scene() const { return {problem_, Surroundings(), arm_}; }
  void Do(StepId id) {
    left_ = RouteTo(id).left();
    state_ = plan::StateAfter(problem_, std::move(state_), plan_.step(id).action, id);
    doubts_.Take(plan_.step(id).certificate.after);
  }

 private:
  const domain::Problem& problem_;
  const domain::Workcell& workcell_;
  const plan::Plan& plan_;
  plan::WorldState state_;
  PartDoubts doubts_;
  const std::vector<motion::Body> arm_;
  double clearance_;
  Pose left_;
};

// One travel, and the straight lines of the step after it.
class TravelSearch {
 public:
  TravelSearch(const Walk& walk, const ToolRoute& route, const JointVector& from)
      : walk_(walk),
        workcell_(walk.workcell()),
        surroundings_(walk.Surroundings()),
        scene_(walk.Scene()),
        route_(route),
        from_(from) {}

  // The arm after the step; none: the usual travel is not free.
  std::optional<JointVector> GoUsually() {
    JointPath path = {from_};
    if (!AppendLine(workcell_, plan::AtSafeHeight(workcell_, walk_.left()), path)) return {};
    const Pose above = plan::AtSafeHeight(workcell_, route_.poised);
    const motion::TravelResult over = motion::PlanTravel(walk_.problem(), surroundings_,
                                                         {.from = path.back(),
                                                          .X_WorldTool = above,
                                                          .corners = Corners(Up::kToSafeHeight),
                                                          .line_step = kLineStep});
    if (std::holds_alternative<std::string>(over)) return {};
    const auto& way = std::get<JointPath>(over);
    path.insert(path.end(), way.begin() + 1, way.end());
    if (!AppendLine(workcell_, route_.poised, path)) return {};
    MotionCheck check(scene_, Rules(path.back()));
    if (FindObstruction(check, path)) return {};
    return AfterWork(path.back());
  }

  // A path, and where the arm is after the step.
  struct Found {
    plan::Travel travel;
    JointVector after;
  };
  std::variant<Found, std::string> Search(const TravelEffort& effort) {
    std::string why = "no configuration of the arm comes there and goes on straight";
    int tried = 0;
    for (const JointVector& end : motion::PosturesAt(workcell_, route_.poised, from_)) {
      if (!motion::FollowLines(workcell_, end, Corners(Up::kNo), kLineStep)) continue;
      const auto after = AfterWork(end);
      if (!after) {
        why = in_the_way_;
        continue;
      }
      if (tried++ == effort.destinations) break;
      motion::PathResult result = FindPath(
          scene_, {.from = from_, .to = end, .rules = Rules(end), .budget = effort.budget});
      if (auto* path = std::get_if<JointPath>(&result)) {
        return Found{{std::move(*path), 0}, *after};
      }
      why = std::get<motion::PathFailure>(result).what;
    }
    return why;
  }

  std::optional<Obstruction> Check(const plan::Travel& travel) {
    MotionRules rules = Rules(travel.path.back());
    rules.clearance = travel.clearance;
    MotionCheck check(scene_, rules);
    return FindObstruction(check, travel.path);
  }
  // The greatest clearance that the path surely keeps, up to `kFurthestClearance`.
  double ClearanceOf(plan::Travel travel) {
    double kept = walk_.clearance();
    double refused = kFurthestClearance;
    while (refused - kept > kAccuracy) {
      travel.clearance = (kept + refused) / 2;
      (Check(travel) ? refused : kept) = travel.clearance;
    }
    return kept;
  }
  std::string Describe(const Obstruction& obstruction) const {
    return motion::Describe(scene_, {}, obstruction);
  }

 private:
  enum class Up { kToSafeHeight, kNo };

  MotionRules Rules(const JointVector& end) const {
    return {.clearance = walk_.clearance(), .given = {from_, end}};
  }

  // As the executor goes on.
  std::vector<Vector3> Corners(Up up) const {
    std::vector<Vector3> corners;
    if (up == Up::kToSafeHeight) corners.push_back(route_.poised.translation());
    for (const Pose& pose : route_.to_work) corners.push_back(pose.translation());
    if (up == Up::kNo && !corners.empty()) corners.back() += Beyond();
    for (const Pose& pose : route_.away) corners.push_back(pose.translation());
    return corners;
  }

  // How much farther than where it works a guarded move may lead the tool.
  Vector3 Beyond() const {
    const Vector3 way = route_.to_work.back().translation() - route_.poised.translation();
    return workcell_.rules().guarded_travel * way.normalized();
  }

  // Along the straight lines, whatever hand and held part touch there.
  std::optional<JointVector> AfterWork(const JointVector& poised) {
    JointPath path = {poised};
    for (const auto* poses : {&route_.to_work, &route_.away}) {
      for (const Pose& pose : *poses) {
        if (AppendLine(workcell_, pose, path)) continue;
        in_the_way_ = "the arm does not go straight on from there";
        return std::nullopt;
      }
    }
    MotionCheck check(scene_,
                      {.clearance = walk_.clearance(), .bodies = MotionRules::Bodies::kArm});
    if (const auto obstruction = FindObstruction(check, path)) {
      in_the_way_ = "on the straight lines of its work, " + Describe(*obstruction);
      return std::nullopt;
    }
    return path.back();
  }

  const Walk& walk_;
  const domain::Workcell& workcell_;
  motion::Surroundings surroundings_;
  CollisionScene scene_;
  const ToolRoute& route_;
  JointVector from_;
  std::string in_the_way_;
};

std::vector<StepId> WithHoming(const plan::Plan& plan) {
  std::vector<StepId> steps = plan.ExecutionOrder();
  steps.push_back(StepId::None());
  return steps;
}

std::optional<plan::Travel>& TravelTo(StepId id, plan::Plan& plan) {
  return id.IsNone() ? plan.homing : plan.steps[id.index()].travel;
}

std::string NameOfStep(StepId id, const plan::Plan& plan) {
  return id.IsNone() ? "home" : plan.step(id).name;
}

// Travels hold for the order that they were planned for.
void KeepOrder(plan::Plan& plan) {
  const std::vector<StepId> order = plan.ExecutionOrder();
  plan.ordering.clear();
  for (std::size_t i = 1; i < order.size(); ++i) {
    plan.ordering.emplace_back(order[i - 1], order[i]);
  }
}

std::vector<std::string> FlawsOfTravel(const plan::Travel& travel, const Walk& walk,
                                       const ToolRoute& route) {
  if (travel.path.size() < 2) return {"a path of less than two postures"};
  std::vector<std::string> flaws;
  const auto tool = [&](const JointVector& q) { return motion::ToolAt(walk.workcell(), q); };
  if (!plan::PosesAgree(tool(travel.path.front()), walk.left())) {
    flaws.push_back("the path does not start where the step before leaves the tool");
  }
  if (!plan::PosesAgree(tool(travel.path.back()), route.poised)) {
    flaws.push_back("the path does not end where the tool is poised");
  }
  if (travel.clearance < walk.clearance()) {
    flaws.push_back(fmt::format("a clearance of {:.2f} mm is less than {:.2f} mm",
                                1e3 * travel.clearance, 1e3 * walk.clearance()));
  }
  TravelSearch search(walk, route, travel.path.front());
  if (const auto obstruction = search.Check(travel)) {
    flaws.push_back("on the path, " + search.Describe(*obstruction));
  }
  return flaws;
}

}  // namespace

std::optional<std::string> AddTravels(const domain::Problem& problem, const TravelEffort& effort,
                                      plan::Plan& plan) {
  Walk walk(problem, plan);
  JointVector posture = problem.workcell->home();
  bool planned = false;
  for (const StepId id : WithHoming(plan)) {
    walk.ComeTo(id);
    const ToolRoute route = walk.RouteTo(id);
    TravelSearch search(walk, route, posture);
    std::optional<plan::Travel>& travel = TravelTo(id, plan);
    travel.reset();
    if (const auto after = search.GoUsually()) {
      posture = *after;
    } else {
      auto result = search.Search(effort);
      if (const auto* why = std::get_if<std::string>(&result)) {
        return fmt::format("no way to {} was found: {}", NameOfStep(id, plan), *why);
      }
      auto& found = std::get<TravelSearch::Found>(result);
      found.travel.clearance = search.ClearanceOf(found.travel);
      travel = std::move(found.travel);
      planned = true;
      posture = found.after;
    }
    if (!id.IsNone()) walk.Do(id);
  }
  if (planned) KeepOrder(plan);
  return std::nullopt;
}

std::vector<plan::Flaw> FlawsOfTravels(const domain::Problem& problem, const plan::Plan& plan) {
  std::vector<plan::Flaw> flaws;
  Walk walk(problem, plan);
  for (const StepId id : WithHoming(plan)) {
    walk.ComeTo(id);
    const std::optional<plan::Travel>& travel = id.IsNone() ? plan.homing : plan.step(id).travel;
    if (travel) {
      for (std::string& what : FlawsOfTravel(*travel, walk, walk.RouteTo(id))) {
        flaws.push_back({id, "the travel: " + std::move(what)});
      }
    }
    if (!id.IsNone()) walk.Do(id);
  }
  return flaws;
}

}  // namespace assay::assembly
