#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// A pose of the moving part as six lengths, so that all directions can be compared: (d, radius w).
using ScaledPose = Eigen::Matrix<double, kPoseDimensions, 1>;

// Gaps and limits nearer to 0 than that are reached, metres.
inline constexpr double kTouch = 1e-9;
// By how little a gap or an excess changes for a metre of a ray that is along its surface.
inline constexpr double kAlong = 1e-9;

// Where on a ray a patch is; empty: from > to.
struct Stretch {
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
  bool inside = true;  // not just along an open end of the patch
};

// The C-surfaces of primitive contacts, in contiguous arrays. A surface has a patch for each
// contact whose gap is one function of the pose (a face in several regions, a vertex on a wall and
// the edge above it). Surfaces are in the order of their first contacts. Model errors are taken to
// be 0.
//
// What of its limits belongs to a patch decides which contacts there are where contacts meet:
// - the limit of a rotation does, as a face may lie flat;
// - the end of a face or an edge does where others stop what would go past it: a corner touches
// both
//   walls that meet there, an edge still touches when the face at its end has landed;
// - the end of a face or an edge elsewhere does not, as another contact takes over there: a part
//   that slides along a wall is not under the wall's top;
// - the seam of two patches of a surface does.
class CSurfaces {
 public:
  // The indices of a patch's limits.
  struct Patch {
    int begin = 0;
    int end = 0;
  };

  CSurfaces(const std::vector<PrimitiveContact>& contacts, double radius);

  int size() const { return static_cast<int>(first_contacts_.size()); }
  int FirstContact(int surface) const { return first_contacts_[static_cast<std::size_t>(surface)]; }
  const std::vector<Patch>& Patches(int surface) const {
    return patches_[static_cast<std::size_t>(surface)];
  }
  std::vector<HalfSpace> Limits(const Patch& patch) const;
  ScaledPose Row(int surface) const { return rows_.row(surface); }
  double Offset(int surface) const { return offsets_[surface]; }

  // Of all surfaces; of all limits.
  void GapsAt(const ScaledPose& x, Eigen::VectorXd& gaps) const;
  void RatesAlong(const ScaledPose& g, Eigen::VectorXd& rates) const;
  void ExcessesAt(const ScaledPose& x, std::vector<double>& excesses) const;

  // The pose is in one of the surface's patches, or behind or over one.
  bool Covers(int surface, const ScaledPose& x) const;
  // Within one patch, and well off all of its limits that motions along the tangents come nearer
  // to.
  bool IsInside(int surface, const ScaledPose& x,
                const Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic>& tangents) const;
  // Of the ray along g from where limits are exceeded by so much.
  Stretch StretchOf(const Patch& patch, const std::vector<double>& excesses,
                    const ScaledPose& g) const;

 private:
  struct Limit {
    ScaledPose a;  // metres of excess
    double b = 0;
    bool open = false;  // where it is reached, the patch is left
  };

  Patch AddLimits(const std::vector<HalfSpace>& limits, double radius);
  void CloseEnds(int surface, const Patch& patch);
  bool StopsAtOthers(const Limit& limit, int surface) const;
  bool AreOneSeam(std::size_t limit, std::size_t other) const;

  std::vector<int> first_contacts_;
  Eigen::Matrix<double, Eigen::Dynamic, kPoseDimensions> rows_;
  Eigen::VectorXd offsets_;
  std::vector<std::vector<Patch>> patches_;
  std::vector<Limit> limits_;
};

}  // namespace assay::finemotion
