#pragma once

#include <span>
#include <vector>

#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/finemotion/motions/segment.h"

namespace assay::finemotion {

// Factors by which the errors are enlarged (Dakin and Popplestone, section 4; the values are not
// from the paper).
inline constexpr double kLadder[] = {1, 1.25, 1.5, 2, 3, 4};
inline constexpr double kBeyondLadder = 8;  // the scale if no enlargement of kLadder causes it

// Which unwanted events a check reports. An unwanted event is a contact that may be made, or a kept
// or awaited contact that may be lost.
enum class Margins {
  kNone,   // the first contact that is found with the errors as they are
  kLeast,  // all contacts at the least enlargement of the errors with a contact
  kAll,    // all contacts at all enlargements, in ascending order of scale, with their geometry
};

// A motion of a strategy, and whether it is certain.
struct CertainMotion {
  Command command;
  Pose X_StationaryAfter = Pose::Identity();  // the tip's pose afterwards, without errors
  SegmentCheck check;
  // Kept, made and unwanted contacts, as linearized at the end of the motion.
  std::vector<PrimitiveContact> contacts = {};
  // Friction in the kept contacts can hold the part, so the motion is not certain.
  bool can_be_held = false;
  int critical_point = 0;  // index of the critical point at which the motion is
};

// Returns finemotion::FrictionLimit of the motion.
double FrictionLimitOf(const CertainMotion& motion);

// Checks motions of one part among the features of another, wherever errors can take the part.
// Contacts are linearized at the pose at which the motion ends without errors.
class MotionChecker {
 public:
  struct Options {
    double velocity_error = 0.002;  // velocity error as in SegmentModel
    double turn = 0.03;  // radians; the edges of a contact are at least so far from parallel
    double radius = 0.02;
    MeetingTest test = MeetingTest::kExact;
    double friction = 0;  // the greatest coefficient of friction between the parts
  };
  // The features that may touch in a motion.
  struct Nearby {
    std::vector<PrimitiveContact> contacts;
    std::vector<ParallelEdges> parallel;
  };

  MotionChecker(const Polyhedron& moving, const ContactFinder& finder, const Options& options);

  const Options& options() const { return options_; }
  const ContactFinder& finder() const { return finder_; }
  // Returns a checker for motions that walls guide, which have no velocity errors.
  MotionChecker WithoutVelocityErrors() const;
  // Returns the contacts within `reach` metres, for parts turned by no more than options().turn.
  std::vector<PrimitiveContact> ContactsWithin(double reach, const Pose& X_StationaryMoving) const;
  std::vector<PrimitiveContact> Of(std::span<const ContactKey> keys,
                                   const Pose& X_StationaryMoving) const;
  // Returns the command's contacts, and all that errors enlarged by `scale` can bring near.
  Nearby NearTheWay(const BelievedPose& believed, const Command& command, double scale = 1) const;

  SegmentCheck Check(const Nearby& nearby, const BelievedPose& believed, const Command& command,
                     Telling telling = Telling::kFirst, double scale = 1) const;
  CertainMotion Check(const BelievedPose& believed, const Command& command, Margins margins) const;

 private:
  ContactFinder finder_;
  Options options_;
  double size_ = 0;  // metres from the moving part's origin to its farthest corner
};

}  // namespace assay::finemotion
