#include "planner/motion/handling/carry.h"

#include <algorithm>
#include <array>
#include <utility>

#include "planner/geometry/pose.h"
#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/handling/putting_down.h"
#include "planner/motion/paths/path_search.h"
#include "planner/motion/paths/straight_line.h"
#include "planner/plan/certificates/pushing.h"
#include "planner/plan/data/tool_route.h"

namespace assay::motion {
namespace {

constexpr double kCarryClearance = 0.015;  // metres, because believed poses have errors
constexpr double kCheckPitch = 0.02;       // metres of tool travel between checks on straight lines
constexpr int kMostSearches = 20;          // path searches that use up their budget in vain
constexpr std::int64_t kCarryBudget = 20'000;  // postures that one search examines

// Searches for a free place on the table to which the held part can be carried, and for the arm's
// path to a posture above it.
class CarrySearch {
 public:
  CarrySearch(const domain::Problem& problem, const Surroundings& surroundings,
              const CarryRequest& request)
      : problem_(problem),
        workcell_(*problem.workcell),
        surroundings_(surroundings),
        request_(request),
        X_WorldHeld_(ToolAt(workcell_, request.from) * request.X_BelievedTool.inverse() *
                     surroundings.held->X_PartTool.inverse()),
        scene_(problem, surroundings),
        rules_(RulesOfCarry()),
        arm_on_lines_(scene_, {.clearance = kTravelGap, .bodies = Bodies::kArm}),
        robots_on_lines_(scene_, {.clearance = kTravelGap, .bodies = Bodies::kRobots}) {}

  TravelResult Find() {
    if (const auto now =
            MotionCheck(scene_, rules_).FindObstruction(request_.from, request_.from)) {
      return "at the start, " + Describe(scene_, rules_, *now);
    }
    const std::vector<Pose> places = FreePlaces();
    for (const Pose& X_WorldPart : places) {
      const std::vector<Vector3> corners = CornersOfPuttingDown(X_WorldPart);
      for (const JointVector& q : PosturesAbove(X_WorldPart, corners)) {
        if (searches_in_vain_ == kMostSearches) return why_;
        if (!IsFreeBelow(q, corners)) continue;
        if (auto path = PathTo(q)) return *std::move(path);
      }
    }
    if (!why_.empty()) return why_;
    return places.empty() ? "none is free" : "the arm cannot put it down on any";
  }

 private:
  using Bodies = MotionRules::Bodies;

  MotionRules RulesOfCarry() const {
    MotionRules rules{.clearance = kCarryClearance};
    if (!request_.tilt) return rules;
    const Pose X_WorldTool = X_WorldHeld_ * surroundings_.held->X_PartTool;
    rules.upright = {.up_Tool = X_WorldTool.linear().transpose() * Vector3::UnitZ(),
                     .tilt = *request_.tilt};
    return rules;
  }

  // The part leans as it does in the hand.
  std::vector<Pose> FreePlaces() const {
    Pose leaning = X_WorldHeld_;
    leaning.translation().setZero();
    const domain::Part& part = problem_.part(surroundings_.held->part);
    return FreePosesOn(request_.table, problem_, surroundings_, StraightBelow(part, leaning));
  }

  Pose Erring(const Pose& X_WorldTool) const { return X_WorldTool * request_.X_BelievedTool; }

  // Returns the corners of the straight lines that putting the part down takes: down with the part,
  // then up without it.
  std::vector<Vector3> CornersOfPuttingDown(const Pose& X_WorldPart) const {
    const Pose placed = X_WorldPart * surroundings_.held->X_PartTool;
    const Pose retreated = plan::Retreated(workcell_, placed);
    const Pose lowest = geometry::Translation(0, 0, -plan::BeyondContact(problem_, {})) * placed;
    std::vector<Vector3> corners;
    for (const Pose& X_WorldTool : {lowest, retreated, plan::AtSafeHeight(workcell_, retreated)}) {
      corners.emplace_back(Erring(X_WorldTool).translation());
    }
    return corners;
  }

  // Returns the postures with the tool at safe height above the place from which the arm can follow
  // the straight lines. Postures in the arm's present configuration come first, then nearer ones
  // before farther ones.
  std::vector<JointVector> PosturesAbove(const Pose& X_WorldPart,
                                         const std::vector<Vector3>& corners) const {
    const JointVector& from = request_.from;
    const Pose X_WorldTool = Erring(X_WorldPart * surroundings_.held->X_PartTool);
    std::vector<JointVector> postures =
        PosturesAt(workcell_, plan::AtSafeHeight(workcell_, X_WorldTool), from);
    std::erase_if(postures, [&](const JointVector& q) {
      return !FollowLines(workcell_, q, corners, kLineStep);
    });
    const auto indicators = workcell_.arm().IndicatorsOf(from);
    std::ranges::stable_sort(postures, {}, [&](const JointVector& q) {
      return std::pair(workcell_.arm().IndicatorsOf(q) != indicators,
                       (q - from).cwiseAbs().maxCoeff());
    });
    return postures;
  }

  // Returns whether the straight lines below posture `q` are free. The checks are those of
  // PlanTravel, so putting the part down needs no other posture.
  bool IsFreeBelow(const JointVector& q, const std::vector<Vector3>& corners) {
    const auto lines = FollowLines(workcell_, q, corners, kCheckPitch);
    if (!lines) return false;
    for (MotionCheck* check : {&arm_on_lines_, &robots_on_lines_}) {
      for (std::size_t i = 0; i + 1 < lines->size(); ++i) {
        const auto obstruction = check->FindObstruction((*lines)[i], (*lines)[i + 1]);
        if (!obstruction) continue;
        Note("on the way down, " + Describe(scene_, check->rules(), *obstruction));
        return false;
      }
    }
    return true;
  }

  std::optional<JointPath> PathTo(const JointVector& q) {
    PathResult way =
        FindPath(scene_, {.from = request_.from, .to = q, .rules = rules_, .budget = kCarryBudget});
    if (auto* path = std::get_if<JointPath>(&way)) return std::move(*path);
    const auto& failure = std::get<PathFailure>(way);
    if (failure.reason == PathFailure::Reason::kBudget) ++searches_in_vain_;
    Note(failure.what);
    return std::nullopt;
  }

  void Note(std::string why) {
    if (why_.empty()) why_ = std::move(why);
  }

  const domain::Problem& problem_;
  const domain::Workcell& workcell_;
  const Surroundings& surroundings_;
  const CarryRequest& request_;
  const Pose X_WorldHeld_;
  const CollisionScene scene_;
  const MotionRules rules_;
  MotionCheck arm_on_lines_;  // without the held part, which must come near the table
  MotionCheck robots_on_lines_;
  int searches_in_vain_ = 0;
  std::string why_;  // why the first place and posture failed
};

}  // namespace

TravelResult PlanCarry(const domain::Problem& problem, const Surroundings& surroundings,
                       const CarryRequest& request) {
  return CarrySearch(problem, surroundings, request).Find();
}

}  // namespace assay::motion
