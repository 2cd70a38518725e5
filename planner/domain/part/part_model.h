#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/document.h"
#include "planner/base/id.h"
#include "planner/domain/grasp/grasp.h"
#include "planner/domain/part/stable_pose.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"

namespace assay::domain {

using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// Rounding may change metres, radians and numbers near 1 by at most this.
inline constexpr double kRounding = 1e-9;

using FaceId = Id<struct FaceTag>;

// The whole exposed surface of a part that lies in one plane and looks the same way.
struct Face {
  Vector3 normal;                          // unit, outward, part frame
  double offset = 0;                       // normal . p == offset on the face
  Pose X_PartFace;                         // origin on the plane, z = normal
  std::vector<geometry::Polygon> patches;  // in the face's x and y; disjoint, convex

  // Returns whether every point of the polygon (face coordinates, convex) is on the face. This is
  // pad contact.
  bool Covers(const geometry::Polygon& polygon) const;
};

// The mouth of a hole or recess in a face.
struct Mouth {
  FaceId face;
  geometry::Polygon outline;  // in the face's x and y
};

// An inner side of a hole or recess.
struct Wall {
  FaceId face;
  geometry::Polygon outline;  // in the face's x and y
  // True if a greater clearance sets the wall back by as much: the pocket is widened along this
  // axis.
  bool moves_with_clearance = false;
};

// A named geometric element, with the number of the part file as in the papers (Spar: surfaces 7
// and 8 of peg and block mate). It is made of faces, or it is a hole.
struct Feature {
  FeatureNumber number;
  std::string description;    // text for people: "square hole"
  std::vector<FaceId> faces;  // empty for a hole
  std::vector<Mouth> mouths;  // a through hole has two
  std::vector<Wall> walls;    // inner sides of a hole, with its floor
  Pose X_PartFeature;         // the mating frame: origin on the axis at the mouth, z along the
                              // axis, outward; of a shaft: at the centre of its tip; of a face:
                              // at its centroid, z = normal
  // Size of the bevelled edges of a hole's mouth or of a shaft's tip, across the axis and along it,
  // in metres. The boxes do not show the bevels.
  double chamfer = 0;

  bool is_plain_face() const { return faces.size() == 1 && mouths.empty(); }
};

// The content of a part file, with everything that is computed from it. It is immutable and shared:
// two parts of one problem may have the same model.
class PartModel {
 public:
  // Reads models/parts/NAME/part.yaml ("assay-part/1"). `clearance` (metres, each side) widens the
  // pockets that are marked as mating holes. Throws InputError.
  static std::shared_ptr<const PartModel> Load(const std::filesystem::path& file, double clearance);

  // Returns the same part with another clearance, read and computed anew. With a negative
  // clearance, shafts are too wide for their holes. Throws InputError if a pocket becomes
  // impossible.
  std::shared_ptr<const PartModel> WithClearance(double clearance) const;
  geometry::MassProperties MassWithClearance(double clearance) const;  // mass of that part

  const std::string& name() const { return name_; }
  const std::string& initial() const { return initial_; }             // start of labels: BP1, BG1
  double clearance() const { return clearance_; }                     // metres on each side
  const std::vector<geometry::Box>& boxes() const { return boxes_; }  // disjoint or overlapping
  const std::vector<Eigen::Vector4f>& colors() const { return colors_; }  // rgba of each box
  const geometry::CollisionShape& shape() const { return shape_; }
  const geometry::ConvexHull& hull() const { return hull_; }
  const geometry::MassProperties& mass() const { return mass_; }
  double friction() const { return friction_; }  // of its material against itself

  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<Feature>& features() const { return features_; }
  const Feature* FindFeature(FeatureNumber number) const;  // null if the part has none
  // Returns the features that a convex region on a face touches or covers, in increasing number.
  std::vector<FeatureNumber> FeaturesUnder(FaceId face, const geometry::Polygon& region) const;

  // Returns the poses in which the part rests on the table (computed, stable_pose.h).
  const std::vector<StablePose>& stable_poses() const { return stable_poses_; }
  StablePoseId FindStablePose(std::string_view name) const;  // None if no pose has the name

 private:
  explicit PartModel(const Document& file, double clearance)
      : file_(file), clearance_(clearance), shape_({}) {}
  friend class PartFile;

  Document file_;
  double clearance_;
  std::string name_;
  std::string initial_;
  std::vector<geometry::Box> boxes_;
  std::vector<Eigen::Vector4f> colors_;
  geometry::CollisionShape shape_;
  geometry::ConvexHull hull_;
  geometry::MassProperties mass_;
  double friction_ = 0;
  std::vector<Face> faces_;
  std::vector<Feature> features_;
  std::vector<StablePose> stable_poses_;
};

}  // namespace assay::domain
