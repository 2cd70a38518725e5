#include "planner/assembly/travel/travel_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/geometry/pose.h"
#include "planner/motion/paths/obstruction_situation.h"
#include "planner/motion/paths/path_search.h"
#include "planner/motion/paths/straight_line.h"
#include "planner/motion/paths/travel.h"

namespace assay::assembly {
namespace {

using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;
using motion::JointPath;
using motion::MotionCheck;
using motion::MotionRules;
using motion::Obstruction;
using motion::SwayAlong;

// the greatest clearance that is claimed for a path, in metres
constexpr double kFurthestClearance = 0.1;
constexpr double kAccuracy = 5e-4;  // the accuracy of the claimed clearance, in metres
// the greatest number of postures at the end of a travel of which everything is to be proved
constexpr std::size_t kMostCertainEnds = 8;
constexpr char kNotStraight[] = "the arm cannot follow the next straight line from this pose";

// Returns bounds that hold on the lines of both.
motion::Sway Both(const motion::Sway& a, const motion::Sway& b) {
  return {a.is_bounded && b.is_bounded, a.turn.cwiseMax(b.turn), std::min(a.room, b.room)};
}

}  // namespace

TravelSearch::TravelSearch(const PlanWalk& walk, plan::StepId id, const JointVector& from)
    : walk_(walk),
      workcell_(walk.workcell()),
      surroundings_(walk.Surroundings()),
      scene_(walk.Scene()),
      route_(walk.RouteTo(id)),
      doubt_(walk.DoubtOn(id)),
      at_work_(walk.PartsAtWork(id)),
      is_guarded_(walk.IsGuarded(id)),
      hand_doubt_(HandDoubt(walk.problem())),
      clearance_(kTravelClearance + hand_doubt_),
      from_(from) {}

std::optional<TravelSearch::Found> TravelSearch::GoUsually() {
  JointPath rise = {from_};
  if (!Rise(rise)) return std::nullopt;
  const motion::TravelResult over = motion::PlanTravel(walk_.problem(), surroundings_,
                                                       {.from = rise.back(),
                                                        .X_WorldTool = Above(),
                                                        .corners = Corners(),
                                                        .line_step = kWorkLineStep});
  const auto* path = std::get_if<JointPath>(&over);
  if (path == nullptr) return std::nullopt;
  const plan::Travel travel = {*path, clearance_, true};
  const std::optional<Way> way = WayBy(travel);
  const auto certainty = way ? CertaintyOf(*way, clearance_) : std::nullopt;
  if (!certainty) return std::nullopt;
  return Found{travel, way->after(), *certainty};
}

std::variant<TravelSearch::Found, plan::Reason> TravelSearch::Search(TravelEffort& effort) {
  return SearchFor(Aim::kFree, effort);
}

std::optional<TravelSearch::Found> TravelSearch::SearchCertain(TravelEffort& effort) {
  if (!ArePartsNearTheirPlaces()) return std::nullopt;
  auto result = SearchFor(Aim::kCertain, effort);
  auto* const found = std::get_if<Found>(&result);
  return found != nullptr ? std::optional(std::move(*found)) : std::nullopt;
}

std::variant<TravelSearch::Found, plan::Reason> TravelSearch::SearchFor(Aim aim,
                                                                        TravelEffort& effort) {
  in_the_way_ = NotReached(
      "no configuration of the arm reaches this pose and can follow the next straight line");
  std::optional<plan::Reason> why;  // there is no path to a posture from which the arm can work
  std::vector<JointVector> ends = motion::PosturesAt(workcell_, route_.poised, from_);
  // A joint that turns more than once has many postures that are alike.
  if (aim == Aim::kCertain) ends.resize(std::min<std::size_t>(ends.size(), kMostCertainEnds));
  int tried = 0;
  for (const JointVector& end : ends) {
    std::optional<Way> way = WayBy({{from_, end}, clearance_, false});
    if (!way || !IsFree(way->AllOfWork(), AtWork({}))) continue;
    if (aim == Aim::kCertain && !MayBeCertain(*way)) continue;
    if (tried++ == effort.destinations) break;
    const MotionRules rules = OnTheWay(*way, clearance_);
    const std::int64_t budget = aim == Aim::kCertain ? effort.certain : effort.budget;
    motion::PathResult result =
        FindPath(scene_, {.from = from_,
                          .to = end,
                          .rules = aim == Aim::kCertain ? InSpiteOf({}, rules) : rules,
                          .budget = std::min(budget, effort.left)});
    if (auto* path = std::get_if<JointPath>(&result)) {
      way->over = *path;
      // The search has tested shorter pieces of the path. A pair of bodies that comes near to the
      // clearance may be decided on the shorter pieces, but not on the whole path.
      const auto certainty = CertaintyOf(*way, clearance_);
      if (!certainty || (aim == Aim::kCertain && !certainty->IsComplete())) continue;
      return Found{{*path, ClearanceOf(*way), false}, way->after(), *certainty};
    }
    const auto& failure = std::get<motion::PathFailure>(result);
    effort.left = std::max<std::int64_t>(0, effort.left - failure.postures);
    why = Obstructed(failure.what, failure.obstruction);
  }
  return why ? *why : in_the_way_;
}

std::optional<Way> TravelSearch::WayBy(const plan::Travel& travel) {
  Way way = {.rise = {from_}, .over = travel.path, .down = {travel.path.back()}};
  const bool comes_down = travel.is_usual && !route_.to_work.empty();
  in_the_way_ = NotReached(kNotStraight);
  if (travel.is_usual && !Rise(way.rise)) return std::nullopt;
  if (comes_down && !AppendLine(workcell_, route_.poised, way.down)) return std::nullopt;
  auto work = FollowWork(workcell_, route_, is_guarded_, way.down.back());
  if (!work) return std::nullopt;
  way.work = std::move(*work);
  way.sway_of_rise = SwayAlong(workcell_, way.rise, walk_.doubt_left());
  way.sway = SwayAlong(workcell_, way.down, doubt_);
  for (const JointPath& section : way.work) Take(section, way.sway);
  return way;
}

bool TravelSearch::MayBeCertain(const Way& way) {
  const WayCertainty certainty = {Both(way.sway_of_rise, way.sway), kTravelClearance};
  return certainty.Reaches() && AreLinesFreeInSpiteOf(ErrorsOf(way), way);
}

std::optional<WayCertainty> TravelSearch::CertaintyOf(const Way& way, double clearance) {
  const WayCertainty certainty = {Both(way.sway_of_rise, way.sway), kTravelClearance};
  // A path may keep a greater clearance than its certainty needs.
  const bool is_over_certain = IsFree(way.over, InSpiteOf({}, OnTheWay(way, clearance_)));
  if ((!is_over_certain || clearance > clearance_) && !IsFree(way.over, OnTheWay(way, clearance)))
    return std::nullopt;
  const bool is_known = is_over_certain && certainty.Reaches() && ArePartsNearTheirPlaces();
  if (is_known && AreLinesFreeInSpiteOf(ErrorsOf(way), way)) return certainty;
  if (!AreLinesFree(way)) return std::nullopt;
  return WayCertainty{certainty.sway, 0};
}

bool TravelSearch::ArePartsNearTheirPlaces() {
  const auto far = std::ranges::find_if_not(surroundings_.errors, &motion::PlaceError::is_bounded);
  if (far == surroundings_.errors.end()) return true;
  const auto part = static_cast<std::size_t>(far - surroundings_.errors.begin());
  in_the_way_ = {
      fmt::format("{} may be more than {:.0f} mm from its place, and ways are proved for "
                  "smaller distances only",
                  walk_.problem().parts[part].name, 1e3 * PartErrorBounds::kMost)};
  return false;
}

std::optional<double> TravelSearch::ClearShareOfErrors(const Way& way) {
  if (!ArePartsNearTheirPlaces()) return std::nullopt;
  if (!IsFree(way.over, InSpiteOf({}, OnTheWay(way, clearance_)))) return std::nullopt;
  if (!AreLinesFreeInSpiteOf({}, way)) return std::nullopt;
  constexpr int kShares = 100;
  int clear = 0;
  int refused = kShares;
  while (refused - clear > 1) {
    const int middle = (clear + refused) / 2;
    const double share = static_cast<double>(middle) / kShares;
    (AreLinesFreeInSpiteOf(ErrorsOf(way, share), way) ? clear : refused) = middle;
  }
  return static_cast<double>(clear) / kShares;
}

// Returns the tool's pose at safe height above its work, or its pose at home.
Pose TravelSearch::Above() const {
  return route_.to_work.empty() ? route_.poised : plan::AtSafeHeight(workcell_, route_.poised);
}

bool TravelSearch::Rise(JointPath& path) const {
  return !walk_.rises() || AppendLine(workcell_, plan::AtSafeHeight(workcell_, walk_.left()), path);
}

// Returns the corners of the executor's path from the pose above the work on.
std::vector<Vector3> TravelSearch::Corners() const {
  std::vector<Vector3> corners = {route_.poised.translation()};
  for (const Pose& pose : route_.to_work) corners.push_back(pose.translation());
  for (const Pose& pose : route_.away) corners.push_back(pose.translation());
  return corners;
}

// Extends the sway to another line.
void TravelSearch::Take(const JointPath& line, motion::Sway& sway) const {
  if (sway.is_bounded) sway = Both(sway, SwayAlong(workcell_, line, doubt_));
}

TravelSearch::WayErrors TravelSearch::ErrorsOf(const Way& way, double share) const {
  const auto shared = [&](const motion::Sway& sway, const plan::ToolErrorBox& tool) -> ArmErrors {
    return {share * sway.turn, {share * tool.shift, share * tool.turn, share * tool.spin}};
  };
  return {shared(way.sway_of_rise, walk_.doubt_left()), shared(way.sway, doubt_)};
}

// On a travel the arm follows the planned joint values, so no errors are added.
MotionRules TravelSearch::OnTheWay(const Way& way, double clearance) const {
  return {.clearance = clearance, .given = {from_, way.down.back()}};
}

// The conditions kHandClear and kPassingClear keep the load clear of the parts at work.
MotionRules TravelSearch::InSpiteOf(const ArmErrors& errors, MotionRules rules) const {
  rules.sway = errors.joints;
  rules.tool = errors.tool;
  rules.certain_clearance = hand_doubt_;
  rules.at_work = at_work_;
  return rules;
}

MotionRules TravelSearch::AtWork(const ArmErrors& errors) const {
  return {.clearance = clearance_,
          .sway = errors.joints,
          .tool = errors.tool,
          .bodies = MotionRules::Bodies::kArm};
}

bool TravelSearch::IsFree(const JointPath& path, const MotionRules& rules) {
  if (path.size() < 2) return true;
  MotionCheck check(scene_, rules);
  const auto obstruction = FindObstruction(check, path);
  if (!obstruction) return true;
  const bool is_work = rules.bodies == MotionRules::Bodies::kArm;
  in_the_way_ =
      Obstructed(fmt::format("on the {}, {}", is_work ? "straight lines of its work" : "path",
                             motion::Describe(scene_, {}, *obstruction)),
                 *obstruction);
  return false;
}

// The hand is shown where the work begins.
plan::Reason TravelSearch::NotReached(const char* text) const {
  plan::Situation situation = motion::SituationAt(from_, workcell_, surroundings_);
  situation.hand->X_WorldTool = route_.poised;
  situation.hand->posture.reset();
  if (surroundings_.held) {
    situation.parts.back().X_WorldPart = route_.poised * surroundings_.held->X_PartTool.inverse();
  }
  return {text, std::move(situation)};
}

plan::Reason TravelSearch::Obstructed(std::string text, const Obstruction& obstruction) const {
  return {std::move(text), motion::SituationOf(obstruction, scene_, surroundings_)};
}

bool TravelSearch::AreLinesFree(const Way& way) {
  const MotionRules rules = OnTheWay(way, clearance_);
  return IsFree(way.rise, rules) && IsFree(way.down, rules) && IsFree(way.AllOfWork(), AtWork({}));
}

bool TravelSearch::AreLinesFreeInSpiteOf(const WayErrors& errors, const Way& way) {
  const MotionRules rules = OnTheWay(way, clearance_);
  return IsFree(way.rise, InSpiteOf(errors.of_rise, rules)) &&
         IsFree(way.down, InSpiteOf(errors.of_rest, rules)) &&
         IsFree(way.AllOfWork(), AtWork(errors.of_rest));
}

// Returns the greatest clearance that the path surely keeps, up to `kFurthestClearance`.
double TravelSearch::ClearanceOf(const Way& way) {
  double kept = clearance_;
  double refused = kFurthestClearance;
  while (refused - kept > kAccuracy) {
    const double middle = (kept + refused) / 2;
    (IsFree(way.over, OnTheWay(way, middle)) ? kept : refused) = middle;
  }
  return kept;
}

}  // namespace assay::assembly
