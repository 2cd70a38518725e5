#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/input_files/document.h"
#include "planner/domain/parts/feature.h"
#include "planner/domain/resting/stable_pose.h"
#include "planner/geometry/coordinates.h"

namespace assay::geometry {
class CollisionShape;
struct ConvexHull;
struct MassProperties;
struct RoundSolid;
}  // namespace assay::geometry

namespace assay::domain {

struct PartShape;

// The content of a part file, with everything that is computed from it. It is immutable and shared:
// two parts of one problem may have the same model.
class PartModel {
 public:
  const std::string& name() const { return name_; }
  const std::string& initial() const { return initial_; }  // start of labels: BP1, BG1
  double clearance() const { return clearance_; }          // metres on each side
  // Convex pieces in the part frame, disjoint or overlapping.
  const std::vector<geometry::ConvexHull>& pieces() const;
  const std::vector<Eigen::Vector4f>& colors() const { return colors_; }  // rgba of each piece
  const geometry::CollisionShape& shape() const;
  const geometry::ConvexHull& hull() const;
  const std::vector<Vector3>& corners() const;  // the vertices of hull()
  const geometry::MassProperties& mass() const;
  // The cylinders and cones among the solids, in the part frame. Pieces with many sides stand for
  // them.
  const std::vector<geometry::RoundSolid>& round_solids() const;
  double friction() const { return friction_; }  // between two surfaces of this part's material

  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<Feature>& features() const { return features_; }
  const Feature* FindFeature(FeatureNumber number) const;  // null if the part has none
  // Returns the features that a convex region on a face touches or covers, in increasing number.
  std::vector<FeatureNumber> FeaturesUnder(FaceId face, const geometry::Polygon& region) const;

  // Returns the poses in which the part rests on the table (computed, stable_pose.h).
  const std::vector<StablePose>& stable_poses() const { return stable_poses_; }
  StablePoseId FindStablePose(std::string_view name) const;  // None if no pose has the name

 private:
  explicit PartModel(const Document& file, double clearance) : file_(file), clearance_(clearance) {}
  friend class PartFile;
  friend class PartReader;

  Document file_;
  double clearance_;
  std::string name_;
  std::string initial_;
  // Most code about parts does not need their solids. Such code is not compiled anew when a header
  // of planner/geometry changes.
  std::shared_ptr<const PartShape> shape_;
  std::vector<Eigen::Vector4f> colors_;
  double friction_ = 0;
  std::vector<Face> faces_;
  std::vector<Feature> features_;
  std::vector<StablePose> stable_poses_;
};

}  // namespace assay::domain
