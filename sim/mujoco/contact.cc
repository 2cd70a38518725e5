#include "sim/mujoco/contact.h"

#include <mujoco/mujoco.h>

#include <utility>

namespace assay::mujoco {
namespace {

using geometry::Vector3;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// The engine's normal points from geom1 to geom2. Its force, in the contact's frame, acts on geom2.
Contact ContactAt(const Data& data, int index) {
  const mjContact& engine = data.get()->contact[index];
  mjtNum force[6];
  mj_contactForce(data.own_model(), data.get(), index, force);
  const Eigen::Map<const RowMajor> R_ContactWorld(engine.frame);
  const GeomId a(engine.geom1);
  const GeomId b(engine.geom2);
  return {.geom_a = a,
          .geom_b = b,
          .body_a = data.model().BodyOf(a),
          .body_b = data.model().BodyOf(b),
          .position = Eigen::Map<const Vector3>(engine.pos),
          .normal = R_ContactWorld.row(0),
          .distance = engine.dist,
          .friction = engine.friction[0],
          .force_on_b = R_ContactWorld.transpose() * Eigen::Map<const Vector3>(force)};
}

Contact Turned(Contact contact) {
  std::swap(contact.geom_a, contact.geom_b);
  std::swap(contact.body_a, contact.body_b);
  contact.normal = -contact.normal;
  contact.force_on_b = -contact.force_on_b;
  return contact;
}

}  // namespace

std::vector<Contact> Contacts(const Data& data) {
  std::vector<Contact> contacts;
  for (int i = 0; i < data.get()->ncon; ++i) contacts.push_back(ContactAt(data, i));
  return contacts;
}

std::vector<Contact> ContactsBetween(const Data& data, BodyId a, BodyId b) {
  std::vector<Contact> contacts;
  for (const Contact& contact : Contacts(data)) {
    if (contact.body_a == a && contact.body_b == b) contacts.push_back(contact);
    if (contact.body_a == b && contact.body_b == a) contacts.push_back(Turned(contact));
  }
  return contacts;
}

}  // namespace assay::mujoco
