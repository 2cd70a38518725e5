#pragma once

#include <filesystem>
#include <vector>

#include "planner/base/random.h"
#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/finemotion/forward_projections/forward_projection.h"

namespace assay::workloads {

struct ProjectionAndContact {
  finemotion::ForwardProjection projection;
  finemotion::PrimitiveContact contact;
};

// One of the instances that peers were measured with: a box that does not move.
struct JudgedProjection {
  ProjectionAndContact given;
  bool meets = false;
  bool meets_at_an_edge = false;
};

// Reads a file of the form of bench/workloads/projection/box-vs-contact.txt, whose first lines
// describe the form.
std::vector<JudgedProjection> ReadProjections(const std::filesystem::path& file);

enum class StartShape { kBox, kZonotope };

struct ProjectionModel {
  int tolerances = 0;
  // The greatest number of tolerances with a coefficient in the contact's rows. A contact of two
  // faces has few of them.
  int tolerances_read = 1000;
  int limits = 0;
  StartShape start = StartShape::kBox;
  int velocity_errors = 0;
  double time = 0;  // 0 if the start does not move
};

// Returns a random projection with errors of up to 1, speeds of up to 1 and unit rows. About half
// of them meet the contact.
ProjectionAndContact RandomProjection(const ProjectionModel& model, RandomStream& random);

}  // namespace assay::workloads
