#pragma once

#include <Eigen/Core>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "planner/finemotion/meeting.h"

namespace assay::finemotion {

// A primitive contact by its features, wherever it is linearized.
struct ContactKey {
  ContactKind kind = ContactKind::kVertexFace;
  int moving = 0;
  int stationary = 0;

  auto operator<=>(const ContactKey&) const = default;
};
ContactKey KeyOf(const PrimitiveContact& contact);
std::string Name(const ContactKey& key);  // "vertex 3 on face 1"
// Of several with these features (a face in regions) the one that the pose where they are
// linearized is most inside of; null: there is none.
const PrimitiveContact* Find(const std::vector<PrimitiveContact>& contacts, const ContactKey& key);

// What is known of where the moving part is: nominally at X, displaced and with model errors by any
// point of the region, in contact with what it keeps.
struct Belief {
  Pose X_StationaryMoving = Pose::Identity();
  Eigen::MatrixXd errors;  // generators of the region about 0, a column each
  std::vector<ContactKey> kept = {};
};

// The moving part displaced by a point of generalized space: d added, turned by w about its origin.
Pose Displaced(const Pose& X_StationaryMoving, const GeneralizedPoint& z);

// The least change of a pose, from z, that closes the contacts' gaps to first order; rotations
// count as lengths at `radius`.
GeneralizedPoint Closing(const std::vector<const PrimitiveContact*>& contacts,
                         const GeneralizedPoint& z, double radius);

// A straight motion in a contact state, and what ends it.
struct Command {
  Eigen::VectorXd displacement;  // generalized; without errors it leads so far
  std::vector<ContactKey> kept;  // of those there were; the others are let go
  std::optional<ContactKey> until = {};
};

// A contact that must not be made, or one that must not be lost: that is kept, or waited for.
struct Unwanted {
  ContactKey contact;
  bool is_loss = false;
  double scale = 0;  // the least enlargement of all errors of the ladder at which it happens
};

// Enlargements of errors (Dakin and Popplestone, section 4; the steps are ours).
inline constexpr double kLadder[] = {1, 1.25, 1.5, 2, 3, 4};
inline constexpr double kBeyondLadder = 8;  // where none of them does it

// What becomes of a command, whatever the errors.
struct SegmentCheck {
  // The sequence of contact states is certain: nothing unwanted happens with errors as they are.
  bool certain = false;
  std::vector<Unwanted> unwanted;  // by rising scale; of those that can happen on the ladder
  Belief after;
  double longest = 1;  // how many displacements it may take at most
};

struct SegmentModel {
  // Linearized where the command leads without errors.
  const std::vector<PrimitiveContact>& contacts;
  // Of a displacement: of its length, and of its turn times the radius, in each direction; of its
  // turn about each axis.
  double velocity_error = 0.02;
  double radius = 0.02;  // metres
};

// A loop over all contacts with the exact test (meeting.h). The hand turns the part about where it
// believes the tip to be, so that errors turn with it. Kept contacts may run off their ends by 20
// micrometres and 2 milliradians, which is what linear rows leave out. Not certain, with nothing
// unwanted: a contact of the command is not there, or its end never surely comes. `whole`: all
// unwanted contacts and their scales are told; else it ends at the first that can happen with
// errors as they are.
SegmentCheck Check(const SegmentModel& model, const Belief& belief, const Command& command,
                   bool whole);

}  // namespace assay::finemotion
