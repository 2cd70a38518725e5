#pragma once

#include <memory>
#include <span>
#include <vector>

#include "planner/finemotion/contacts/contact_range.h"
#include "planner/finemotion/contacts/parallel_edges.h"
#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// Returns the primitive contacts that the parts can make near X_StationaryMoving: those whose
// features are within `reach` (metres), for poses turned from there by at most `turn` (radians).
// Contacts that exist only when the part is turned are included; edges that may be parallel are
// not. A contact that is seen twice, with the same gap and limits (an edge that lies in a face), is
// returned once. For many poses, ContactFinder is faster.
std::vector<PrimitiveContact> PrimitiveContacts(const Polyhedron& moving,
                                                const Polyhedron& stationary,
                                                const Pose& X_StationaryMoving, double reach,
                                                const std::vector<ModelTolerance>& tolerances = {},
                                                double turn = 0);

// Finds the primitive contacts of two parts (see PrimitiveContacts) at one pose after another. The
// constructor computes, once, everything that depends on the parts alone.
class ContactFinder {
 public:
  ContactFinder(const Polyhedron& moving, const Polyhedron& stationary,
                const std::vector<ModelTolerance>& tolerances = {});

  std::vector<PrimitiveContact> Near(const Pose& X_StationaryMoving,
                                     const ContactRange& range) const;
  // Returns the pairs of edges that may be parallel near the pose. They are not among the contacts
  // that Near returns.
  std::vector<ParallelEdges> NearlyParallel(const Pose& X_StationaryMoving,
                                            const ContactRange& range) const;
  // Returns the contacts of the named features alone, however far apart these are. A key is skipped
  // if the parts do not have its features.
  std::vector<PrimitiveContact> Of(std::span<const ContactKey> keys, const Pose& X_StationaryMoving,
                                   double turn) const;

 private:
  class Parts;

  std::shared_ptr<const Parts> parts_;
};

}  // namespace assay::finemotion
