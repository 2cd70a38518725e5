#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// A pose of the moving part as six lengths (d, radius w), so that all directions can be compared.
using ScaledPose = Eigen::Matrix<double, kPoseDimensions, 1>;

// Gaps and limits within this distance of 0 count as reached, metres.
inline constexpr double kTouch = 1e-9;
// A ray runs along a surface or a limit if the gap to the surface, or the excess over the limit,
// changes by less than this for one metre of the ray.
inline constexpr double kAlong = 1e-9;

// The stretch of a ray that is in a patch, in metres. It is empty if from > to.
struct Stretch {
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
  bool inside = true;  // false if the ray only runs along an open end of the patch
};

// The C-surfaces of primitive contacts, in contiguous arrays. Contacts whose gaps are the same
// function of the pose share one surface, and each of them is a patch of it (a face in several
// regions, or a vertex on a wall and the edge above it). Surfaces are in the order of their first
// contacts. Model errors are taken to be 0.
//
// A patch may include its limits (closed) or not (open). This decides which contacts exist where
// contacts meet:
//  - The limit of a rotation is closed, since a face may lie flat.
//  - The end of a face or an edge is closed where other contacts stop whatever would go past it. A
//    corner touches both walls that meet there, and an edge still touches when the face at its end
//    has landed.
//  - The end of a face or an edge is open elsewhere, since another contact takes over there. A part
//    that slides along a wall is not under the wall's top.
//  - The seam of two patches of a surface is closed.
class CSurfaces {
 public:
  // The range of a patch's limits among all limits: from `begin` up to but without `end`.
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

  // Computes the gap of each surface at x, its rate of change along g, or the excess over each
  // limit at x.
  void GapsAt(const ScaledPose& x, Eigen::VectorXd& gaps) const;
  void RatesAlong(const ScaledPose& g, Eigen::VectorXd& rates) const;
  void ExcessesAt(const ScaledPose& x, std::vector<double>& excesses) const;

  // Returns whether the pose is on one of the surface's patches, or in front of or behind one.
  bool Covers(int surface, const ScaledPose& x) const;
  // Returns whether x is within one patch and well inside each limit that a motion along the
  // tangents can approach.
  bool IsInside(int surface, const ScaledPose& x,
                const Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic>& tangents) const;
  // Returns the stretch of a ray that is in the patch. The ray leads along g from the point with
  // these excesses.
  Stretch StretchOf(const Patch& patch, const std::vector<double>& excesses,
                    const ScaledPose& g) const;

 private:
  struct Limit {
    ScaledPose a;  // gradient of the excess over a scaled pose, without a unit
    double b = 0;
    bool open = false;  // true if the patch excludes the points at this limit
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
