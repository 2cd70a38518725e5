#pragma once

#include "planner/mesh_import/parts/part_sketch.h"

namespace assay::mesh_import {

// How much of a surface is outside of all solids.
struct Exposure {
  int points = 0;
  int exposed = 0;
  bool Some() const { return exposed > 0; }
  bool All() const { return points > 0 && exposed == points; }

  void Count(bool is_exposed) {
    ++points;
    exposed += is_exposed;
  }
};

// Samples the surfaces of posts: of a part's solids and pockets. `R` is the frame of a post, in the
// part, and `top` chooses between its two ends. The sketch must outlive the sampler.
class ExposureSampler {
 public:
  explicit ExposureSampler(const PartSketch& sketch);

  // Lengths below it count as rounding, in metres.
  double margin() const { return margin_; }

  // An end of a solid, where pockets leave material beside it.
  Exposure OfEnd(const Matrix3& R, const Post& post, bool top) const;
  // An end of a pocket. Only what is free on both sides of the end is exposed.
  Exposure OfMouth(const Matrix3& R, const Post& post, bool top) const;
  // The end of a post close to its outline: inside of it, or around it.
  Exposure OfRim(const Matrix3& R, const Post& post, bool top) const;
  Exposure AroundRim(const Matrix3& R, const Post& post, bool top) const;
  // The side between two corners of a post's outline, and all sides of a straight post.
  Exposure OfSide(const Matrix3& R, const Post& post, const Vector2& a, const Vector2& b) const;
  Exposure OfSides(const Matrix3& R, const Post& post) const;
  // Returns whether nothing of the part is in line with an end of a post, however far away.
  bool SeesOut(const Matrix3& R, const Post& post, bool top) const;

 private:
  Exposure BesideRim(const Matrix3& R, const Post& post, bool top, double outward) const;
  std::vector<double> HeightsBeyond(const Matrix3& R, double end, double sign) const;

  const PartSketch& sketch_;
  const double margin_;
};

}  // namespace assay::mesh_import
