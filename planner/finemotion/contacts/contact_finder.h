#pragma once

#include <memory>
#include <span>
#include <vector>

#include "planner/finemotion/contacts/contact_range.h"
#include "planner/finemotion/contacts/parallel_edges.h"
#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// The primitive contacts that parts whose features touch to within `reach` (metres) at
// X_StationaryMoving can make near there, turned by at most `turn` (radians) against it: contacts
// that exist only when turned are among them, edges that may be parallel are not. Where gap and
// limits are those of one contact seen twice (an edge that lies in a face), it is named once. For
// many poses: ContactFinder.
std::vector<PrimitiveContact> PrimitiveContacts(const Polyhedron& moving,
                                                const Polyhedron& stationary,
                                                const Pose& X_StationaryMoving, double reach,
                                                const std::vector<ModelTolerance>& tolerances = {},
                                                double turn = 0);

// Finds the primitive contacts of two parts at one pose after another (PrimitiveContacts tells
// which these are): what depends on the parts alone is worked out once.
class ContactFinder {
 public:
  ContactFinder(const Polyhedron& moving, const Polyhedron& stationary,
                const std::vector<ModelTolerance>& tolerances = {});

  std::vector<PrimitiveContact> Near(const Pose& X_StationaryMoving,
                                     const ContactRange& range) const;
  // Edges that may be parallel there, and are no contacts for that.
  std::vector<ParallelEdges> NearlyParallel(const Pose& X_StationaryMoving,
                                            const ContactRange& range) const;
  // Only those of these features, however far apart; what the parts have not, is none.
  std::vector<PrimitiveContact> Of(std::span<const ContactKey> keys, const Pose& X_StationaryMoving,
                                   double turn) const;

 private:
  class Parts;

  std::shared_ptr<const Parts> parts_;
};

}  // namespace assay::finemotion
