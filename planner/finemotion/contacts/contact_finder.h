#pragma once

#include <memory>
#include <span>
#include <vector>

#include "planner/finemotion/contacts/contact_range.h"
#include "planner/finemotion/contacts/parallel_edges.h"
#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// Finds the primitive contacts of two parts (see PrimitiveContacts) at one pose after another. The
// constructor works out once whatever depends on the parts alone.
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
