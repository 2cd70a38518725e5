#include "sim/mujoco/collision/mesh_collision.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <ranges>
#include <thread>

#include "planner/base/random.h"
#include "planner/geometry/box.h"
#include "planner/geometry/contact/contact_manifold.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "sim/mujoco/collision/convex_pieces.h"
#include "sim/mujoco/contact.h"
#include "sim/mujoco/data.h"
#include "tests/oracle/random_pose.h"
#include "tests/sim/mujoco/convex_bodies.h"

namespace assay::mujoco::mesh_collision_test {
namespace {

using geometry::Translation;

void Put(const Pose& X, std::size_t at, Data& data) {
  const Vector3 p = X.translation();
  const Eigen::Quaterniond turn(X.linear());
  const double values[7] = {p.x(), p.y(), p.z(), turn.w(), turn.x(), turn.y(), turn.z()};
  std::copy(values, values + 7, data.qpos().begin() + static_cast<std::ptrdiff_t>(at));
}

// The engine moves the vertices of a mesh into a frame of its own. They must come out where they
// were.
TEST(MeshCollision, VerticesAreWhereTheFileHasThem) {
  RandomStream random(331, "vertices");
  for (int i = 0; i < 30; ++i) {
    Points points;
    const Vector3 middle = oracle::RandomVector(random, 0.02);
    for (int k = 0; k < 5 + i; ++k) points.push_back(middle + oracle::RandomVector(random, 0.02));
    const Model model = Model::FromMjcf(ModelOf({{.name = "body", .pieces = {points}}}));
    const mjModel& m = *model.get();
    const Data data(model);
    const geometry::ConvexHull& hull = model.convex_pieces()->SolidOf(0)->hull;
    const geometry::ConvexHull expected = geometry::HullOf(points);
    ASSERT_EQ(hull.vertices.size(), expected.vertices.size());
    ASSERT_EQ(hull.facets.size(), expected.facets.size());
    const auto R =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data.get()->geom_xmat);
    for (const Vector3& vertex : hull.vertices) {
      const Vector3 p = R * vertex + Eigen::Map<const Vector3>(data.get()->geom_xpos);
      const auto apart = [&](const Vector3& q) { return (p - q).norm(); };
      EXPECT_LT(std::ranges::min(expected.vertices | std::views::transform(apart)), 5e-9);
    }
    EXPECT_EQ(m.nmesh, 1);
  }
}

// A wedge of a ring is not stopped by the side of its neighbour: wherever the corner of a box dips
// into a ring of flush pieces, the contact pushes it out of the top.
TEST(MeshCollision, APieceIsNotStoppedByTheEndOfAnother) {
  const Model model = Model::FromMjcf(
      ModelOf({{.name = "ring", .pieces = Ring(32, 0.004, 0.03, -0.02, 0), .is_free = false},
               {.name = "box", .pieces = {BoxPoints(0.03, 0.02, -0.01, 0.01)}}}));
  Data data(model);
  RandomStream random(332, "a corner over seams");
  for (int i = 0; i < 5000; ++i) {
    Pose X(geometry::RotationZ(random.Uniform(-3, 3)) *
           geometry::RotationX(random.Uniform(0.01, 0.03)) *
           geometry::RotationY(random.Uniform(0.01, 0.03)));
    Vector3 lowest(0, 0, 1);
    for (const Vector3& corner : BoxPoints(0.03, 0.02, -0.01, 0.01)) {
      if ((X * corner).z() < lowest.z()) lowest = X * corner;
    }
    const double angle = random.Uniform(-3, 3);
    const double depth = std::exp(random.Uniform(std::log(1e-9), std::log(2e-6)));
    const Vector3 at(0.015 * std::cos(angle), 0.015 * std::sin(angle), -depth);
    X.pretranslate(at - lowest);
    Put(X, 0, data);
    data.Forward();
    const auto contacts = ContactsBetween(data, model.Body("ring"), model.Body("box"));
    ASSERT_FALSE(contacts.empty()) << i;
    for (const Contact& contact : contacts) ASSERT_GT(contact.normal.z(), 0.9) << i;
    ASSERT_NEAR(std::ranges::min(contacts, {}, &Contact::distance).distance, -depth / 2, 1e-8) << i;
  }
}

// A box as a mesh has the contacts of a box of the engine. Its contacts have half of the true
// depth. The engine's contacts of boxes have half of the depth in most poses, and all of it in
// some.
TEST(MeshCollision, AMeshOfABoxCollidesLikeTheBox) {
  const auto box = geometry::Box::FromCorners({-0.03, -0.02, -0.01}, {0.03, 0.02, 0.01});
  const ConvexBody ground{.name = "ground",
                          .pieces = {},
                          .boxes = {geometry::Box::FromCorners({-0.2, -0.2, -0.02}, {0.2, 0.2, 0})},
                          .is_free = false};
  Data of_box(Model::FromMjcf(ModelOf({ground, {.name = "box", .pieces = {}, .boxes = {box}}})));
  Data of_mesh(Model::FromMjcf(
      ModelOf({ground, {.name = "box", .pieces = {BoxPoints(0.03, 0.02, -0.01, 0.01)}}})));
  RandomStream random(333, "box and mesh");
  for (int i = 0; i < 2000; ++i) {
    Pose X(geometry::RotationZ(random.Uniform(-3, 3)) *
           geometry::RotationX(i % 3 == 0 ? 0 : random.Uniform(-0.1, 0.1)) *
           geometry::RotationY(i % 2 == 0 ? 0 : random.Uniform(-0.1, 0.1)));
    double lowest = 1;
    for (const Vector3& corner : box.Corners()) lowest = std::min(lowest, (X * corner).z());
    X.pretranslate(Vector3(0, 0, -lowest - random.Uniform(1e-7, 1e-5)));
    Put(X, 0, of_box);
    Put(X, 0, of_mesh);
    of_box.Forward();
    of_mesh.Forward();
    const auto expected = Contacts(of_box);
    const auto found = Contacts(of_mesh);
    ASSERT_EQ(expected.size(), found.size()) << i;
    for (const Contact& contact : found) {
      const auto apart = [&](const Contact& other) {
        return (other.position - contact.position).norm();
      };
      const Contact& nearest = std::ranges::min(expected, {}, apart);
      EXPECT_LT(apart(nearest), 1e-5) << i;
      const double share = std::round(nearest.distance / contact.distance);
      EXPECT_TRUE(share == 1 || share == 2) << i;
      EXPECT_NEAR(nearest.distance, share * contact.distance, 1e-8) << i;
      EXPECT_LT((nearest.normal - contact.normal).norm(), 1e-6) << i;
    }
  }
}

// Two bodies of 64 pieces each lie on each other with few contacts.
TEST(MeshCollision, BodiesOfManyPiecesHaveFewContacts) {
  const std::vector<Points> ring = Ring(64, 0.008, 0.03, 0, 0.02);
  const Model model = Model::FromMjcf(ModelOf(
      {{.name = "lower", .pieces = ring, .is_free = false},
       {.name = "upper", .pieces = ring, .X_World = Translation(0.002, 0.001, 0.02 - 1e-7)}}));
  Data data(model);
  EXPECT_LE(Contacts(data).size(), geometry::kMostContactPoints);
  while (data.time() < 0.2) data.Step();
  EXPECT_FALSE(data.HasWarnings());
  const Vector3 moved =
      data.BodyPose(model.Body("upper")).translation() - Vector3(0.002, 0.001, 0.02);
  EXPECT_LT(moved.norm(), 2e-6);
}

std::vector<double> Simulated(const Model& model) {
  Data data(model);
  while (data.time() < 0.2) data.Step();
  return {data.qpos().begin(), data.qpos().end()};
}

// Models with different pieces are simulated at the same time. The results have the same bits as
// those of simulations one after the other.
TEST(MeshCollision, ThreadsDoNotDisturbEachOther) {
  std::vector<Model> models;
  for (const int sides : {6, 16, 32, 64}) {
    models.push_back(Model::FromMjcf(
        ModelOf({{.name = "ring", .pieces = Ring(sides, 0.0081, 0.03, -0.02, 0), .is_free = false},
                 {.name = "prism",
                  .pieces = {Prism(sides, 0.01, 0, 0.02)},
                  .X_World = Translation(0.001, 0, 0.003) * geometry::RotationX(0.1)}})));
  }
  std::vector<std::vector<double>> alone;
  for (const Model& model : models) alone.push_back(Simulated(model));
  std::vector<std::vector<double>> together(4 * models.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < together.size(); ++i) {
    threads.emplace_back([&, i] { together[i] = Simulated(models[i % models.size()]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < together.size(); ++i)
    EXPECT_EQ(together[i], alone[i % models.size()]);
}

// Outside of Data, the engine's own collisions decide, as in other programs.
TEST(MeshCollision, BelongsToThisLibraryAlone) {
  const Model model = Model::FromMjcf(
      ModelOf({{.name = "ring", .pieces = Ring(16, 0.004, 0.03, -0.02, 0), .is_free = false},
               {.name = "prism", .pieces = {Prism(16, 0.01, 0, 0.02)}}}));
  EXPECT_EQ(CollidingPieces::Present(), nullptr);
  Data data(model);
  EXPECT_EQ(CollidingPieces::Present(), nullptr);
  const std::unique_ptr<mjData, void (*)(mjData*)> plain(mj_makeData(model.get()), mj_deleteData);
  for (int i = 0; i < 100; ++i) mj_step(model.get(), plain.get());
  for (int i = 0; i < mjNWARNING; ++i) EXPECT_EQ(plain->warning[i].number, 0);
}

TEST(MeshCollision, AMeshStandsOnAPlane) {
  std::string mjcf = ModelOf({{.name = "prism", .pieces = {Prism(64, 0.01, 0, 0.02)}}});
  const std::string world = "<worldbody>";
  mjcf.insert(mjcf.find(world) + world.size(), "<geom type=\"plane\" size=\"1 1 1\"/>");
  const Model model = Model::FromMjcf(mjcf);
  Data data(model);
  while (data.time() < 0.1) data.Step();
  EXPECT_EQ(Contacts(data).size(), geometry::kMostContactPoints);
  EXPECT_LT(std::abs(data.BodyPose(model.Body("prism")).translation().z()), 1e-6);
}

}  // namespace
}  // namespace assay::mujoco::mesh_collision_test
