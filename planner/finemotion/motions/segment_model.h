#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/finemotion/contacts/parallel_edges.h"
#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/finemotion/motions/believed_pose.h"

namespace assay::finemotion {

// A straight motion in a contact state, and the contact that ends it.
struct Command {
  PoseChange displacement;       // the whole motion without errors
  std::vector<ContactKey> kept;  // contacts that stay closed; other contacts are let go
  std::optional<ContactKey> until = {};
};

// The test that decides whether errors can make a contact.
enum class MeetingTest {
  kExact,
  kEdges,    // the paper's, where there are few enough errors; it misses some contacts
  kCompare,  // the exact test, compared with the paper's
};

struct SegmentModel {
  // The contacts, linearized where the command leads without errors.
  const std::vector<PrimitiveContact>& contacts;
  // The relative error of a displacement. In each direction, the translation errs by at most this
  // fraction of the length plus the turn times the radius. About each axis, the rotation errs by at
  // most this fraction of the turn.
  double velocity_error = 0.02;
  double radius = 0.02;  // metres; a rotation times this radius counts as a length
  MeetingTest test = MeetingTest::kExact;
  // Edges that may be parallel, at the same pose. None of them may touch.
  std::span<const ParallelEdges> parallel_edges = {};
};

}  // namespace assay::finemotion
