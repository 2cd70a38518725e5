#include "planner/assembly/travel_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "planner/algebra/expression/text.h"
#include "planner/assembly/part_error_bounds.h"
#include "planner/assembly/plan_walk.h"
#include "planner/assembly/way_conditions.h"
#include "planner/base/check.h"
#include "planner/motion/clear/sway.h"
#include "planner/motion/path/path_search.h"
#include "planner/motion/path/straight_line.h"
#include "planner/motion/path/travel.h"
#include "planner/plan/data/coverage.h"

namespace assay::assembly {
namespace {

using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;
using motion::CollisionScene;
using motion::JointPath;
using motion::MotionCheck;
using motion::MotionRules;
using motion::Obstruction;
using motion::SwayAlong;
using plan::StepId;
using plan::ToolRoute;

// metres between the postures that are checked on straight lines
constexpr double kLineStep = 0.02;
// the greatest clearance that is claimed for a path, in metres
constexpr double kFurthestClearance = 0.1;
constexpr double kAccuracy = 5e-4;  // the accuracy of the claimed clearance, in metres
constexpr double kSameOrientation = 1e-9;
constexpr char kNotStraight[] = "the arm cannot follow the next straight line from this pose";
constexpr double kSamePosture = 1e-6;  // tolerance for equal postures, radians
constexpr double kSameClaim = 1e-6;    // tolerance for equal claims, metres or radians

bool IsTurned(const domain::Workcell& workcell, const Pose& X_WorldTool, const JointVector& q) {
  return geometry::AngleBetween(motion::ToolAt(workcell, q).linear(), X_WorldTool.linear()) >
         kSameOrientation;
}

// Appends a straight line to a pose of the tool from the last posture of the path. Returns false if
// the arm cannot follow it.
bool AppendLine(const domain::Workcell& workcell, const Pose& X_WorldTool, JointPath& path) {
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

// A travel with its own straight lines and the straight lines of the work after it.
struct Way {
  JointPath rise;  // straight up from the posture after the previous step
  JointPath over;  // the travel's path
  JointPath down;  // straight down to the approach pose
  // straight lines from the approach pose on; the tool keeps its orientation in each section
  std::vector<JointPath> work = {};
  motion::Sway sway = {};

  const JointVector& after() const { return work.back().back(); }
  JointPath AllOfWork() const {
    JointPath all;
    for (const JointPath& section : work) all.insert(all.end(), section.begin(), section.end());
    return all;
  }
};

// The search for one travel, with the straight lines of the step after it.
class TravelSearch {
 public:
  TravelSearch(const PlanWalk& walk, StepId id, const JointVector& from)
      : walk_(walk),
        workcell_(walk.workcell()),
        surroundings_(walk.Surroundings()),
        scene_(walk.Scene()),
        route_(walk.RouteTo(id)),
        doubt_(walk.DoubtOn(id)),
        is_guarded_(walk.IsGuarded(id)),
        clearance_(kTravelClearance + HandDoubt(walk.problem())),
        from_(from) {}

  const ToolRoute& route() const { return route_; }
  double clearance() const { return clearance_; }  // the least clearance of travels

  struct Found {
    plan::Travel travel;
    JointVector after;  // the joint values after the step
    WayCertainty certainty;
  };

  // Tries the usual travel: up, across at safe height, and down. Returns none if it is not free.
  std::optional<Found> GoUsually() {
    JointPath rise = {from_};
    if (!Rise(rise)) return std::nullopt;
    const motion::TravelResult over = motion::PlanTravel(walk_.problem(), surroundings_,
                                                         {.from = rise.back(),
                                                          .X_WorldTool = Above(),
                                                          .corners = Corners(),
                                                          .line_step = kLineStep});
    const auto* path = std::get_if<JointPath>(&over);
    if (path == nullptr) return std::nullopt;
    const plan::Travel travel = {*path, clearance_, true};
    const std::optional<Way> way = WayBy(travel);
    const auto certainty = way ? CertaintyOf(*way, clearance_) : std::nullopt;
    if (!certainty) return std::nullopt;
    return Found{travel, way->after(), *certainty};
  }

  // Searches for a path around the obstacles. Returns the reason in words if there is none.
  std::variant<Found, std::string> Search(const TravelEffort& effort) {
    in_the_way_ =
        "no configuration of the arm reaches this pose and can follow the next straight line";
    int tried = 0;
    for (const JointVector& end : motion::PosturesAt(workcell_, route_.poised, from_)) {
      std::optional<Way> way = WayBy({{from_, end}, clearance_, false});
      if (!way || !IsFree(way->AllOfWork(), AtWork({}))) continue;
      if (tried++ == effort.destinations) break;
      motion::PathResult result = FindPath(
          scene_,
          {.from = from_, .to = end, .rules = OnTheWay(*way, clearance_), .budget = effort.budget});
      if (auto* path = std::get_if<JointPath>(&result)) {
        way->over = *path;
        const auto certainty = CertaintyOf(*way, clearance_);
        ASSAY_CHECK(certainty, "a path that was found keeps to its rules");
        return Found{{*path, ClearanceOf(*way), false}, way->after(), *certainty};
      }
      in_the_way_ = std::get<motion::PathFailure>(result).what;
    }
    return in_the_way_;
  }

  // Returns the travel with its straight lines. Returns none if the arm cannot follow them;
  // in_the_way() then gives the reason.
  std::optional<Way> WayBy(const plan::Travel& travel) {
    Way way = {.rise = {from_}, .over = travel.path, .down = {travel.path.back()}};
    const bool comes_down = travel.is_usual && !route_.to_work.empty();
    in_the_way_ = kNotStraight;
    if (travel.is_usual && !Rise(way.rise)) return std::nullopt;
    if (comes_down && !AppendLine(workcell_, route_.poised, way.down)) return std::nullopt;
    way.work = {{way.down.back()}};
    if (!Work(way.work)) return std::nullopt;
    way.sway = SwayAlong(workcell_, way.rise, walk_.doubt_left());
    Take(way.down, way.sway);
    for (const JointPath& section : way.work) Take(section, way.sway);
    return way;
  }

  // Returns what is proved about the way. Returns none if something is in the way even without
  // errors of the arm, or if the travel does not keep the claimed clearance.
  std::optional<WayCertainty> CertaintyOf(const Way& way, double clearance) {
    const WayCertainty certainty = {way.sway, kTravelClearance};
    if (!IsFree(way.over, OnTheWay(way, clearance))) return std::nullopt;
    if (certainty.Reaches() && AreLinesFree(way, ErrorsOf(way))) return certainty;
    if (!AreLinesFree(way, {})) return std::nullopt;
    return WayCertainty{way.sway, 0};
  }
  // the obstruction of the last search
  const std::string& in_the_way() const { return in_the_way_; }

 private:
  // The bounds on the tool's pose error and on the resulting errors of the arm's joints.
  struct ArmErrors {
    JointVector joints = JointVector::Zero();
    plan::ToolErrorBox tool = {};
  };

  // Returns the tool's pose at safe height above its work, or its pose at home.
  Pose Above() const {
    return route_.to_work.empty() ? route_.poised : plan::AtSafeHeight(workcell_, route_.poised);
  }
  bool Rise(JointPath& path) const {
    return !walk_.rises() ||
           AppendLine(workcell_, plan::AtSafeHeight(workcell_, walk_.left()), path);
  }

  // Extends the sway to another line.
  void Take(const JointPath& line, motion::Sway& sway) const {
    if (!sway.is_bounded) return;
    const motion::Sway other = SwayAlong(workcell_, line, doubt_);
    sway = {other.is_bounded, sway.turn.cwiseMax(other.turn), std::min(sway.room, other.room)};
  }
  ArmErrors ErrorsOf(const Way& way) const {
    return {way.sway.turn, doubt_.Or(walk_.doubt_left())};
  }

  // On a travel the arm follows the planned joint values, so no errors are added.
  MotionRules OnTheWay(const Way& way, double clearance) const {
    return {.clearance = clearance, .given = {from_, way.down.back()}};
  }
  MotionRules OnLines(const Way& way, const ArmErrors& errors) const {
    return {.clearance = clearance_,
            .sway = errors.joints,
            .tool = errors.tool,
            .given = {from_, way.down.back()}};
  }
  MotionRules AtWork(const ArmErrors& errors) const {
    return {.clearance = clearance_,
            .sway = errors.joints,
            .tool = errors.tool,
            .bodies = MotionRules::Bodies::kArm};
  }

  bool IsFree(const JointPath& path, const MotionRules& rules) {
    if (path.size() < 2) return true;
    MotionCheck check(scene_, rules);
    const auto obstruction = FindObstruction(check, path);
    if (!obstruction) return true;
    const bool is_work = rules.bodies == MotionRules::Bodies::kArm;
    in_the_way_ = fmt::format("on the {}, {}", is_work ? "straight lines of its work" : "path",
                              motion::Describe(scene_, {}, *obstruction));
    return false;
  }
  bool AreLinesFree(const Way& way, const ArmErrors& errors) {
    const MotionRules rules = OnLines(way, errors);
    return IsFree(way.rise, rules) && IsFree(way.down, rules) &&
           IsFree(way.AllOfWork(), AtWork(errors));
  }

  // Returns the greatest clearance that the path surely keeps, up to `kFurthestClearance`.
  double ClearanceOf(const Way& way) {
    double kept = clearance_;
    double refused = kFurthestClearance;
    while (refused - kept > kAccuracy) {
      const double middle = (kept + refused) / 2;
      (IsFree(way.over, OnTheWay(way, middle)) ? kept : refused) = middle;
    }
    return kept;
  }

  // Returns the corners of the executor's path from the pose above the work on.
  std::vector<Vector3> Corners() const {
    std::vector<Vector3> corners = {route_.poised.translation()};
    for (const Pose& pose : route_.to_work) corners.push_back(pose.translation());
    for (const Pose& pose : route_.away) corners.push_back(pose.translation());
    return corners;
  }

  // Follows the straight lines of the work, including the end of a guarded move. Where a strategy
  // has turned the tool, a new section begins at the nearest posture. The motion in between is
  // checked elsewhere.
  bool Work(std::vector<JointPath>& sections) {
    std::vector<Pose> poses = route_.to_work;
    if (is_guarded_) {
      poses.push_back(Beyond());
      poses.push_back(route_.to_work.back());
    }
    poses.insert(poses.end(), route_.away.begin(), route_.away.end());
    for (const Pose& pose : poses) {
      if (!IsTurned(workcell_, pose, sections.back().back())) {
        if (!AppendLine(workcell_, pose, sections.back())) return false;
        continue;
      }
      const auto q = motion::NearestPosture(workcell_, pose, sections.back().back());
      if (!q) return false;
      sections.push_back({*q});
    }
    return true;
  }

  // Returns the farthest pose to which a guarded move may lead the tool beyond its work.
  Pose Beyond() const {
    const Pose& work = route_.to_work.back();
    const Vector3 way = work.translation() - route_.poised.translation();
    return geometry::Translation(workcell_.rules().guarded_travel * way.normalized()) * work;
  }

  const PlanWalk& walk_;
  const domain::Workcell& workcell_;
  motion::Surroundings surroundings_;
  CollisionScene scene_;
  ToolRoute route_;
  plan::ToolErrorBox doubt_;
  bool is_guarded_;
  double clearance_;
  JointVector from_;
  std::string in_the_way_;
};

// Returns the steps and the homing. A plan without steps leaves the arm at home.
std::vector<StepId> WithHoming(const plan::Plan& plan) {
  std::vector<StepId> steps = plan.ExecutionOrder();
  if (!steps.empty()) steps.push_back(StepId::None());
  return steps;
}

std::optional<plan::Travel>& TravelTo(StepId id, plan::Plan& plan) {
  return id.IsNone() ? plan.homing : plan.steps[id.index()].travel;
}

std::string NameOfStep(StepId id, const plan::Plan& plan) {
  return id.IsNone() ? "home" : plan.step(id).name;
}

// A travel other than the usual one is only known to be free in the order for which it was planned.
void KeepOrder(plan::Plan& plan) {
  const std::vector<StepId> order = plan.ExecutionOrder();
  plan.ordering.clear();
  for (std::size_t i = 1; i < order.size(); ++i) {
    plan.ordering.emplace_back(order[i - 1], order[i]);
  }
}

// The preconditions of the way home belong to the last step.
void AddConditions(StepId id, const WayCertainty& certainty, plan::Plan& plan) {
  const StepId owner = id.IsNone() ? plan.ExecutionOrder().back() : id;
  plan::Certificate& certificate = plan.steps[owner.index()].certificate;
  // the plan was made without regard to uncertainty
  if (certificate == plan::Certificate{}) return;
  std::vector<plan::CertifiedPrecondition>& all = certificate.preconditions;
  const auto conditions = WayConditions(certainty, id.IsNone() ? Whither::kHome : Whither::kWork);
  all.insert(all.end(), conditions.begin(), conditions.end());
}

// Lists in each certificate the preconditions about ways that are not proved.
void AddExcuses(plan::Plan& plan, uncertainty::Propagation propagation) {
  for (plan::PlannedStep& step : plan.steps) {
    if (step.certificate == plan::Certificate{}) continue;
    step.certificate.not_needed = plan::NotNeededIn(
        step.certificate.preconditions, step.action, step.strategy ? &*step.strategy : nullptr,
        propagation == uncertainty::Propagation::kPaper);
  }
}

bool IsAtEnds(const plan::Travel& travel, const PlanWalk& walk, const ToolRoute& route,
              std::vector<std::string>& flaws) {
  const domain::Workcell& workcell = walk.workcell();
  const auto high = [&](bool is_high, const Pose& X_WorldTool) {
    return is_high ? plan::AtSafeHeight(workcell, X_WorldTool) : X_WorldTool;
  };
  const Pose start = high(travel.is_usual && walk.rises(), walk.left());
  const Pose end = high(travel.is_usual && !route.to_work.empty(), route.poised);
  if (!plan::PosesAgree(motion::ToolAt(workcell, travel.path.front()), start)) {
    flaws.push_back("the path does not start where the step before leaves the tool");
  }
  if (!plan::PosesAgree(motion::ToolAt(workcell, travel.path.back()), end)) {
    flaws.push_back("the path does not end where the tool is poised");
  }
  return flaws.empty();
}

// Returns true if the two claims differ only in the bound.
bool IsSaidOf(const plan::CertifiedPrecondition& claim, plan::CertifiedPrecondition other) {
  other.expression = algebra::Text(algebra::Expression(claim.bound));
  other.bound = other.margin = claim.bound;
  return claim == other;
}

// Adds a flaw for each claim about a way that differs from the recomputed one.
void CheckClaims(const WayCertainty& certainty, Whither whither, const plan::PlannedStep& step,
                 std::vector<std::string>& flaws) {
  const auto anew = WayConditions(certainty, whither);
  for (const plan::CertifiedPrecondition& claim : step.certificate.preconditions) {
    if (!IsWayCondition(claim.condition) || WhitherOf(claim) != whither) continue;
    const auto own =
        std::ranges::find(anew, claim.condition, &plan::CertifiedPrecondition::condition);
    if (own == anew.end() || claim.bound > own->bound + kSameClaim) {
      flaws.push_back(fmt::format(
          "the file says that {} is above {:.6g}, but the new computation does not confirm this",
          claim.condition.name(), claim.bound));
    } else if (!IsSaidOf(claim, *own)) {
      flaws.push_back(
          fmt::format("{} in the file differs from the new computation", claim.condition.name()));
    }
  }
}

// Returns the flaws of a travel. Updates `posture` to the posture after the step, or to none if
// that is unknown.
std::vector<std::string> FlawsOfTravel(const plan::Travel& travel, const PlanWalk& walk, StepId id,
                                       std::optional<JointVector>& posture) {
  if (travel.path.size() < 2) return {"a path of less than two postures"};
  std::vector<std::string> flaws;
  if (!posture) {
    posture = motion::PostureLike(walk.workcell(), walk.left(), travel.path.front());
    if (!posture)
      return {"the step before does not leave the arm in a posture in which the path can start"};
  }
  TravelSearch search(walk, id, *std::exchange(posture, std::nullopt));
  const std::optional<Way> way = search.WayBy(travel);
  if (!IsAtEnds(travel, walk, search.route(), flaws)) return flaws;
  if (!way) return {search.in_the_way()};
  if (!(travel.path.front() - way->rise.back()).isZero(kSamePosture)) {
    flaws.push_back("the path does not start in the posture in which the arm then is");
  }
  if (travel.clearance < search.clearance()) {
    flaws.push_back(fmt::format("a clearance of {:.2f} mm is less than {:.2f} mm",
                                1e3 * travel.clearance, 1e3 * search.clearance()));
  }
  const auto certainty = search.CertaintyOf(*way, travel.clearance);
  if (!certainty) {
    flaws.push_back(search.in_the_way());
    return flaws;
  }
  const StepId owner = id.IsNone() ? walk.plan().ExecutionOrder().back() : id;
  CheckClaims(*certainty, id.IsNone() ? Whither::kHome : Whither::kWork, walk.plan().step(owner),
              flaws);
  posture = way->after();
  return flaws;
}

bool SaysWhatIsCertain(const plan::Plan& plan) {
  return std::ranges::any_of(plan.steps, [](const plan::PlannedStep& step) {
    return std::ranges::any_of(step.certificate.preconditions,
                               [](const auto& claim) { return IsWayCondition(claim.condition); });
  });
}

}  // namespace

std::optional<std::string> AddTravels(const domain::Problem& problem, const TravelEffort& effort,
                                      plan::Plan& plan, uncertainty::Propagation propagation) {
  for (plan::PlannedStep& step : plan.steps) RemoveWayConditions(step.certificate);
  PlanWalk walk(problem, plan, propagation);
  JointVector posture = problem.workcell->home();
  bool only_in_this_order = false;
  for (const StepId id : WithHoming(plan)) {
    walk.ComeTo(id);
    TravelSearch search(walk, id, posture);
    std::optional<TravelSearch::Found> found = search.GoUsually();
    if (!found) {
      auto result = search.Search(effort);
      if (const auto* why = std::get_if<std::string>(&result)) {
        return fmt::format("no way to {} was found: {}", NameOfStep(id, plan), *why);
      }
      found = std::get<TravelSearch::Found>(std::move(result));
    }
    posture = found->after;
    only_in_this_order |= !found->travel.is_usual;
    TravelTo(id, plan) = std::move(found->travel);
    if (propagation == uncertainty::Propagation::kSound) AddConditions(id, found->certainty, plan);
    if (!id.IsNone()) walk.Do(id);
  }
  AddExcuses(plan, propagation);
  if (only_in_this_order) KeepOrder(plan);
  return std::nullopt;
}

std::vector<plan::Flaw> FlawsOfTravels(const domain::Problem& problem, const plan::Plan& plan) {
  std::vector<plan::Flaw> flaws;
  PlanWalk walk(problem, plan,
                SaysWhatIsCertain(plan) ? uncertainty::Propagation::kSound
                                        : uncertainty::Propagation::kPaper);
  std::optional<JointVector> posture = problem.workcell->home();
  for (const StepId id : WithHoming(plan)) {
    walk.ComeTo(id);
    const std::optional<plan::Travel>& travel = id.IsNone() ? plan.homing : plan.step(id).travel;
    if (travel) {
      for (std::string& what : FlawsOfTravel(*travel, walk, id, posture)) {
        flaws.push_back({id, "the travel: " + std::move(what)});
      }
    } else {
      posture.reset();
    }
    if (!id.IsNone()) walk.Do(id);
  }
  return flaws;
}

}  // namespace assay::assembly
