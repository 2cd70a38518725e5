#pragma once

#include <filesystem>
#include <vector>

#include "planner/base/random.h"
#include "planner/finemotion/graph/forward_projection.h"

namespace assay::workloads {

struct ProjectionAndContact {
  finemotion::ForwardProjection projection;
  finemotion::PrimitiveContact contact;
};

// One of the peers' measured instances: a box that does not move.
struct JudgedProjection {
  ProjectionAndContact given;
  bool meets = false;
  bool meets_at_an_edge = false;
};

// `file` as bench/workloads/projection/box-vs-contact.txt, whose first lines tell its form.
std::vector<JudgedProjection> ReadProjections(const std::filesystem::path& file);

enum class StartShape { kBox, kZonotope };

struct ProjectionModel {
  int tolerances = 0;
  int tolerances_read = 1000;  // by the rows of the contact, at most: those of two faces are few
  int limits = 0;
  StartShape start = StartShape::kBox;
  int velocity_errors = 0;
  double time = 0;  // 0: does not move
};

// Errors of up to 1, speeds of up to 1, unit rows; about half of them meet.
ProjectionAndContact RandomProjection(const ProjectionModel& model, RandomStream& random);

}  // namespace assay::workloads
