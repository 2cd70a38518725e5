#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/input_files/document.h"
#include "planner/domain/parts/feature.h"
#include "planner/domain/resting/stable_pose.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {

// The content of a part file, with everything that is computed from it. It is immutable and shared:
// two parts of one problem may have the same model.
class PartModel {
 public:
  const std::string& name() const { return name_; }
  const std::string& initial() const { return initial_; }  // start of labels: BP1, BG1
  double clearance() const { return clearance_; }          // metres on each side
  // Convex pieces in the part frame, disjoint or overlapping.
  const std::vector<geometry::ConvexHull>& pieces() const { return pieces_; }
  const std::vector<Eigen::Vector4f>& colors() const { return colors_; }  // rgba of each piece
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
  explicit PartModel(const Document& file, double clearance) : file_(file), clearance_(clearance) {}
  friend class PartFile;

  Document file_;
  double clearance_;
  std::string name_;
  std::string initial_;
  std::vector<geometry::ConvexHull> pieces_;
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
