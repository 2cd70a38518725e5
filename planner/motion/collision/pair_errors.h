#pragma once

#include <Eigen/Core>

#include "planner/motion/collision/collision_scene.h"
#include "planner/plan/data/tool_error_box.h"

namespace assay::motion {

// The errors that move two bodies of a scene against each other, as a box of nine coordinates. The
// first six are the turns of the joints from their planned values, followed by ErrorCoordinate. All
// of them are in radians. Errors without a direction are in `shift`.
enum ErrorCoordinate {
  kToolTurn = 6,  // plan::ToolErrorBox::turn
  kToolSpin = 7,  // plan::ToolErrorBox::spin
  kPartTurn = 8,  // PlaceError::turn of the first body
};
using ErrorVector = Eigen::Matrix<double, 9, 1>;

// Links from the wrist on are tested against standing bodies as seen from the tool, whose errors
// are small, and not from the arm's base. The box of such a link contains the joints between the
// link and the tool, and the errors of the tool. The box of any other pair contains the joints
// between its two bodies.
class PairErrors {
 public:
  // No joint turns farther than `sway` from its planned value, radians.
  PairErrors(const CollisionScene& scene, const BodyPair& pair, const JointVector& sway,
             const plan::ToolErrorBox& tool);

  // Half the widths of the box, whose middle is 0.
  const ErrorVector& greatest() const { return greatest_; }
  // How much farther any point may be from its place than the box says, metres.
  double shift() const { return shift_; }
  // Returns how far all errors of the box together move any point of the second body, as seen from
  // the first, in any posture. In metres.
  double GreatestDisplacement() const;

  // Returns the poses with these errors of what the first body stands on and of the second body's
  // link, and of the flange if the pair is seen from the tool. Other poses are undefined. Without
  // errors the arm is in posture q with the poses X_BaseLink.
  LinkPoses PosesWith(const ErrorVector& errors, const JointVector& q,
                      const LinkPoses& X_BaseLink) const;

  // Returns how far each coordinate moves any point of the second body, as seen from the first, if
  // it differs by at most `half` from its value in the poses X_BaseLink, which PosesWith returned.
  // In metres.
  ErrorVector DisplacementIn(const ErrorVector& half, const LinkPoses& X_BaseLink) const;
  // Returns a distance that the bodies surely keep if no coordinate differs by more than `half`
  // from its value in these poses, in metres. It is the least width of empty slabs between them,
  // whose directions are `slabs` if they are known. It is tight if the slabs are those of the
  // nearest points. Bodies that keep `enough` even by the displacements above may be left out.
  double DistanceIn(const ErrorVector& half, const LinkPoses& X_BaseLink,
                    const CollisionScene::Slabs& slabs, double enough) const;
  // Returns how far any point of the second body moves, as seen from the first, whatever the errors
  // are, while no joint turns by more than `turn` (radians, >= 0) and the tool keeps its
  // orientation. In metres.
  double GreatestMotion(const JointVector& turn) const;

 private:
  void ReachFromTool(const Body& body);
  Pose FlangeWith(const ErrorVector& errors, const Pose& X_BaseFlange) const;

  const CollisionScene* scene_;
  BodyPair pair_;
  bool is_seen_from_tool_;
  ErrorVector greatest_ = ErrorVector::Zero();
  double shift_;
  // Greatest distance in any posture of the second body from the axes of the joints and from the
  // tool's origin, and of the first body from the vertical about which it turns. In metres.
  ErrorVector reach_ = ErrorVector::Zero();
};

}  // namespace assay::motion
