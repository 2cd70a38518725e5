#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/assembly/travel/plan_walk.h"
#include "planner/assembly/travel/way_conditions.h"
#include "planner/assembly/travel/work_lines.h"
#include "planner/motion/collision/motion_check.h"
#include "planner/motion/collision/sway.h"

namespace assay::assembly {

// The least distance in metres that two bodies keep on travels, whatever the errors are.
inline constexpr double kTravelClearance = 0.005;

// How much is searched for travels.
struct TravelEffort {
  // the greatest number of postures at the end of one travel to which paths are searched for
  int destinations = 4;
  // the greatest number of postures visited in each search (motion::PathRequest)
  std::int64_t budget = 100'000;
  // the same, where a travel is known and one of which everything is proved is searched for
  std::int64_t certain = 2'000;
  // the number of postures that all searches in vain may still visit together
  std::int64_t left = std::numeric_limits<std::int64_t>::max();
};

// The postures of the arm on a travel, and on the straight lines of the work to which the travel
// leads.
struct Way {
  motion::JointPath rise;  // straight up from the posture after the previous step
  motion::JointPath over;  // the travel's path
  motion::JointPath down;  // straight down to the approach pose
  WorkLines work = {};
  motion::Sway sway_of_rise = {};
  motion::Sway sway = {};  // on the way down and on the straight lines of the work

  const kinematics::JointVector& after() const { return work.back().back(); }
  motion::JointPath AllOfWork() const {
    motion::JointPath all;
    for (const motion::JointPath& section : work)
      all.insert(all.end(), section.begin(), section.end());
    return all;
  }
};

// The search for one travel, and for the straight lines of the work to which it leads. The walk
// must outlive the search.
class TravelSearch {
 public:
  // The walk must have come to the step. `from` are the joint values after the step before.
  TravelSearch(const PlanWalk& walk, plan::StepId id, const kinematics::JointVector& from);

  const plan::ToolRoute& route() const { return route_; }
  double clearance() const { return clearance_; }  // the least clearance of travels

  struct Found {
    plan::Travel travel;
    kinematics::JointVector after;  // the joint values after the step
    WayCertainty certainty;
  };

  // Tries the usual travel: up, across at safe height, and down. Returns none if it is not free.
  std::optional<Found> GoUsually();

  // Searches for a path around the obstacles. Returns the reason if there is none.
  // Takes from `effort.left` what a search in vain has cost.
  std::variant<Found, plan::Reason> Search(TravelEffort& effort);
  // Searches for a travel about which everything is proved.
  std::optional<Found> SearchCertain(TravelEffort& effort);

  // Returns the travel with its straight lines. Returns none if the arm cannot follow them;
  // in_the_way() then gives the reason.
  std::optional<Way> WayBy(const plan::Travel& travel);

  // Returns what is proved about the way. Returns none if something is in the way even without
  // errors of the arm, or if the travel does not keep the claimed clearance.
  std::optional<WayCertainty> CertaintyOf(const Way& way, double clearance);

  // Returns the greatest share of the tool's pose errors with which the arm surely stays clear on
  // the straight lines, to a hundredth. Returns none if the errors of parts prevent a proof even
  // without errors of the arm. The lines must be free without any errors of the arm.
  std::optional<double> ClearShareOfErrors(const Way& way);

  const plan::Reason& in_the_way() const { return in_the_way_; }  // what stopped the last search

 private:
  // The bounds on the tool's pose error and on the resulting errors of the arm's joints.
  struct ArmErrors {
    kinematics::JointVector joints = kinematics::JointVector::Zero();
    plan::ToolErrorBox tool = {};
  };
  // The first line still has the errors of the step before.
  struct WayErrors {
    ArmErrors of_rise;
    ArmErrors of_rest;
  };

  enum class Aim { kFree, kCertain };
  std::variant<Found, plan::Reason> SearchFor(Aim aim, TravelEffort& effort);
  // Returns whether everything about the way is proved, but for its travel.
  bool MayBeCertain(const Way& way);
  geometry::Pose Above() const;
  bool Rise(motion::JointPath& path) const;
  std::vector<geometry::Vector3> Corners() const;

  void Take(const motion::JointPath& line, motion::Sway& sway) const;
  WayErrors ErrorsOf(const Way& way, double share = 1) const;
  motion::MotionRules OnTheWay(const Way& way, double clearance) const;
  // Adds errors of the arm to the rules, and that the way is to be clear for certain.
  motion::MotionRules InSpiteOf(const ArmErrors& errors, motion::MotionRules rules) const;
  motion::MotionRules AtWork(const ArmErrors& errors) const;
  bool IsFree(const motion::JointPath& path, const motion::MotionRules& rules);
  bool AreLinesFree(const Way& way);  // without errors of the arm
  bool AreLinesFreeInSpiteOf(const WayErrors& errors, const Way& way);
  // Returns whether the errors of all parts are bounded as far as proofs need it.
  bool ArePartsNearTheirPlaces();
  double ClearanceOf(const Way& way);
  plan::Reason NotReached(const char* text) const;
  plan::Reason Obstructed(std::string text, const motion::Obstruction& obstruction) const;

  const PlanWalk& walk_;
  const domain::Workcell& workcell_;
  motion::Surroundings surroundings_;
  motion::CollisionScene scene_;
  plan::ToolRoute route_;
  plan::ToolErrorBox doubt_;
  std::vector<domain::PartId> at_work_;
  bool is_guarded_;
  double hand_doubt_;
  double clearance_;
  kinematics::JointVector from_;
  plan::Reason in_the_way_;
};

}  // namespace assay::assembly
