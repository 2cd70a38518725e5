#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/units/units.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/round_solid.h"

namespace assay::domain {

// The solids of a part file, the pockets that are cut from them, and their bevelled edges
// (models/parts/README.md). The constructor reads them. Errors are InputErrors at the place of what
// is wrong.
class PartSolids {
 public:
  // A solid: its convex pieces, and what remains of them after the pockets are cut.
  struct Solid {
    std::string name;
    geometry::Pose X_PartSolid = geometry::Pose::Identity();  // turn from the file's coordinates
    std::vector<geometry::ConvexHull> whole;    // before pockets, with bevelled ends, part frame
    std::vector<geometry::ConvexHull> pieces;   // after pockets and bevelled mouths, part frame
    std::optional<geometry::RoundSolid> round;  // what `whole` stands for, part frame
    Eigen::Vector4f color;
  };
  struct Pocket {
    std::string name;
    int solid = 0;                            // index of the solid that it is cut from
    std::vector<geometry::ConvexHull> whole;  // widened, not clipped to the solid, part frame
    // The outward normals of the sides that move with the clearance, part frame.
    std::vector<geometry::Vector3> moved_sides;
  };

  // Reads the keys `solids` and `pockets`, and `chamfer` of the features. `clearance` is in metres,
  // on each side of the axes along which a pocket is to be widened; a negative clearance narrows
  // it.
  PartSolids(const Value& root, const Units& units, double clearance);

  const std::vector<Solid>& solids() const { return solids_; }
  // Return what remains of all solids, and the round ones among them, in the part frame.
  std::vector<geometry::ConvexHull> Pieces() const;
  std::vector<geometry::RoundSolid> RoundSolids() const;
  // Throws InputError at one of the `solids` if it is not connected with the first one.
  void CheckHangsTogether(const Value& solids) const;

  const Solid& SolidNamed(const Value& name) const;
  const Solid& SolidOf(const Pocket& pocket) const;
  // Returns the part of a pocket in the solid that it is cut from.
  std::vector<geometry::ConvexHull> Clipped(const Pocket& pocket) const;
  // Return what one name, or a list of names, refers to; at least one element.
  std::vector<const Solid*> SolidsNamed(const Value& names) const;
  std::vector<const Pocket*> PocketsNamed(const Value& names) const;

 private:
  void ReadSolids(const Value& solids);
  Solid ReadSolid(const std::string& name, const Value& entry) const;
  geometry::Pose ReadTurn(const Value& turn) const;
  // `chamfered` has the features with a chamfer.
  void ReadPockets(const Value& pockets, const std::vector<Value>& chamfered);
  void ReadTips(const std::vector<Value>& chamfered);
  Pocket ReadPocket(const std::string& name, const Value& entry) const;

  // Bevels the edges around the tip of a shaft. `place` is where errors are.
  void BevelTip(const std::vector<const Solid*>& shaft, const geometry::Vector3& axis, double size,
                const Value& place);
  // Cuts the mouth of a pocket with its bevels from pieces of its solid, if the feature is a hole
  // with this pocket. Moves the pieces around the mouth, down to the lower end of the
  // bevels, from `rest` to `bevelled`. The bevels and the pocket are so cut from different pieces,
  // and each side of the hole cuts off one piece of each.
  void CutMouth(const Value& feature, const Pocket& pocket, std::vector<geometry::ConvexHull>& rest,
                std::vector<geometry::ConvexHull>& bevelled) const;

  Units units_;
  double clearance_;
  std::vector<Solid> solids_;
  std::vector<Pocket> pockets_;
};

}  // namespace assay::domain
