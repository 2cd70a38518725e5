#pragma once

#include <span>
#include <vector>

#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/finemotion/search/segment.h"

namespace assay::finemotion {

// Enlargements of errors (Dakin and Popplestone, section 4; the steps are ours).
inline constexpr double kLadder[] = {1, 1.25, 1.5, 2, 3, 4};
inline constexpr double kBeyondLadder = 8;  // where none of them does it

// How much is told of what is unwanted.
enum class Margins {
  kNone,   // the first that is found with errors as they are
  kLeast,  // all that happens at the least enlargement at which anything does
  kAll,    // all that happens on the ladder, by rising scale; and the contacts
};

// A motion of a strategy and what is certain of it.
struct CertainMotion {
  Command command;
  Pose X_StationaryAfter = Pose::Identity();  // of the tip, if there are no errors
  SegmentCheck check;
  std::vector<PrimitiveContact> contacts = {};  // kept, made and unwanted, as they are then
  bool can_be_held = false;                     // by friction, in what it keeps: it is not certain
  int critical_point = 0;                       // index, of the one that it leads through
};

// As finemotion::FrictionLimit.
double FrictionLimitOf(const CertainMotion& motion);

// Checks motions of one part among the features of another: wherever errors can take the part, and
// with contacts as they are linearized where the motion leads.
class MotionChecker {
 public:
  struct Options {
    double velocity_error = 0.002;  // as SegmentModel
    double turn = 0.03;             // radians, at least, that edges are from parallel in a contact
    double radius = 0.02;
    MeetingTest test = MeetingTest::kExact;
    double friction = 0;  // of the parts, at most
  };
  // What may be touched in a motion.
  struct Nearby {
    std::vector<PrimitiveContact> contacts;
    std::vector<ParallelEdges> parallel;
  };

  MotionChecker(const Polyhedron& moving, const ContactFinder& finder, const Options& options);

  const Options& options() const { return options_; }
  const ContactFinder& finder() const { return finder_; }
  // The same, where walls lead the part: motions go exactly as they should.
  MotionChecker WithoutVelocityErrors() const;
  // Within so many metres, if the part is turned by no more than edges must be from parallel.
  std::vector<PrimitiveContact> ContactsWithin(double reach, const Pose& X_StationaryMoving) const;
  std::vector<PrimitiveContact> Of(std::span<const ContactKey> keys,
                                   const Pose& X_StationaryMoving) const;
  // The command's contacts, and all that errors enlarged by `scale` can bring near.
  Nearby NearTheWay(const Belief& belief, const Command& command, double scale = 1) const;

  SegmentCheck Check(const Nearby& nearby, const Belief& belief, const Command& command,
                     Telling telling = Telling::kFirst, double scale = 1) const;
  CertainMotion Check(const Belief& belief, const Command& command, Margins margins) const;

 private:
  ContactFinder finder_;
  Options options_;
  double size_ = 0;  // metres, of the moving part's farthest corner from its origin
};

}  // namespace assay::finemotion
