#include "planner/finemotion/contacts/primitive_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "planner/base/check.h"

namespace assay::finemotion {

bool IsRound(ContactKind kind) { return kind >= ContactKind::kRimFace; }

ContactKey KeyOf(const PrimitiveContact& contact) {
  return {contact.kind, contact.moving, contact.stationary};
}

const PrimitiveContact* Find(const std::vector<PrimitiveContact>& contacts, const ContactKey& key) {
  const PrimitiveContact* found = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const PrimitiveContact& contact : contacts) {
    if (KeyOf(contact) != key) continue;
    double excess = -std::numeric_limits<double>::infinity();
    for (const HalfSpace& limit : contact.limits) excess = std::max(excess, -limit.b);
    if (excess >= least) continue;
    least = excess;
    found = &contact;
  }
  return found;
}

std::string Name(const ContactKey& key) {
  const auto pair = [&](const char* moving, const char* stationary) {
    return fmt::format("{} {} on {} {}", moving, key.moving, stationary, key.stationary);
  };
  switch (key.kind) {
    case ContactKind::kVertexFace:
      return pair("vertex", "face");
    case ContactKind::kFaceVertex:
      return pair("face", "vertex");
    case ContactKind::kEdgeEdge:
      return pair("edge", "edge");
    case ContactKind::kRimFace:
      return pair("rim", "face");
    case ContactKind::kRimRim:
      return pair("rim", "rim");
    case ContactKind::kSideRim:
      return pair("side", "rim");
    case ContactKind::kRimWall:
      return pair("rim", "wall");
  }
  ASSAY_CHECK(false, "no such kind of contact");
}

std::string Name(const PrimitiveContact& contact) { return Name(KeyOf(contact)); }

std::optional<ContactKey> ContactNamed(const std::string& name) {
  std::istringstream words(name);
  std::string word;
  ContactKey key;
  words >> word >> key.moving >> word >> word >> key.stationary;
  for (const auto kind : {ContactKind::kVertexFace, ContactKind::kFaceVertex,
                          ContactKind::kEdgeEdge, ContactKind::kRimFace, ContactKind::kRimRim,
                          ContactKind::kSideRim, ContactKind::kRimWall}) {
    key.kind = kind;
    if (Name(key) == name) return key;
  }
  return std::nullopt;
}

}  // namespace assay::finemotion
