#include <gtest/gtest.h>

#include <cstdlib>

#include "planner/base/input_files/document.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"
#include "planner/mesh_import/parts/account.h"
#include "planner/mesh_import/parts/part_import.h"
#include "tests/planner/mesh_import/made_mesh.h"

namespace assay::mesh_import {
namespace {

int MutationCount() {
  const char* count = std::getenv("ASSAY_MUTATIONS");
  return count == nullptr ? 2000 : std::atoi(count);
}

std::vector<TriangleMesh> MeshesToDamage() {
  const Curve slotted = {{0, 0},   {40, 0},  {40, 30}, {28, 30},
                         {28, 20}, {12, 20}, {12, 30}, {0, 30}};
  return {ChamferedPeg(8, 50, 0.5, 14), Extruded(RectangleOf(25, 25), 9, {CircleOf(8, 13)}),
          FootWithStem(RectangleOf(30, 20), RectangleOf(10, 10), 10, 40), Extruded(slotted, 20),
          BlockWithBlindHole(RectangleOf(40, 30), CircleOf(8, 12), 8, 20)};
}

// Damages the mesh as broken programs do.
void Damage(TriangleMesh& mesh, RandomStream& random) {
  const auto any_triangle = [&]() -> Triangle& {
    return mesh
        .triangles[static_cast<std::size_t>(random.Index(static_cast<int>(mesh.triangles.size())))];
  };
  const auto any_vertex = [&]() -> Vector3& {
    return mesh
        .vertices[static_cast<std::size_t>(random.Index(static_cast<int>(mesh.vertices.size())))];
  };
  switch (random.Index(9)) {
    case 0:
      any_triangle() = mesh.triangles.back();
      if (mesh.triangles.size() > 1) mesh.triangles.pop_back();
      break;
    case 1:
      std::swap(any_triangle().corners[0], any_triangle().corners[1]);
      break;
    case 2:
      any_triangle().corners[0] = any_triangle().corners[2];
      break;
    case 3:
      mesh.triangles.push_back(any_triangle());
      break;
    case 4:
      any_vertex() += Vector3(random.Uniform(-3, 3), random.Uniform(-3, 3), random.Uniform(-3, 3));
      break;
    case 5:
      any_vertex() *= std::pow(10, random.Uniform(-6, 5));
      break;
    case 6:
      any_vertex() = any_vertex();
      break;
    case 7: {
      const Vector3 scale(1, 1, std::pow(10, random.Uniform(-9, 1)));
      mesh = mesh.Transformed(scale.asDiagonal());
      break;
    }
    default: {
      const Vector3 axis(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
      mesh = mesh.Transformed(
          Eigen::AngleAxisd(random.Uniform(0, 6), axis.normalized()).toRotationMatrix());
    }
  }
}

// Damages the bytes of a file.
void DamageBytes(std::string& bytes, RandomStream& random) {
  if (bytes.empty()) return;
  const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(bytes.size())));
  switch (random.Index(4)) {
    case 0:
      bytes[at] = static_cast<char>(random.Index(256));
      break;
    case 1:
      bytes.erase(at, static_cast<std::size_t>(random.Index(40)));
      break;
    case 2:
      bytes.insert(at,
                   bytes.substr(static_cast<std::size_t>(random.Index(static_cast<int>(at) + 1)),
                                static_cast<std::size_t>(random.Index(60))));
      break;
    default:
      bytes.resize(at);
  }
}

constexpr int kShares = 2;  // of the mutations, which run side by side

class MeshMutations : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Shares, MeshMutations, ::testing::Range(0, kShares));

// A damaged mesh is refused with an InputError, or taken: then its file parses. The variable
// ASSAY_MUTATIONS sets another number of meshes, like 100000. A crash leaves the last mesh in the
// temporary folder.
TEST_P(MeshMutations, AreRefusedOrTaken) {
  const std::vector<TriangleMesh> meshes = MeshesToDamage();
  RandomStream random(20261126, fmt::format("meshes/{}", GetParam()));
  const int count = MutationCount() / kShares;
  int taken = 0;
  for (int trial = 0; trial < count; ++trial) {
    TriangleMesh mesh =
        meshes[static_cast<std::size_t>(random.Index(static_cast<int>(meshes.size())))];
    for (int slips = random.Index(4); slips > 0; --slips) Damage(mesh, random);
    const int format = random.Index(3);
    std::string bytes = format == 0 ? StlText(mesh) : format == 1 ? BinaryStl(mesh) : ObjText(mesh);
    if (random.Index(4) == 0) DamageBytes(bytes, random);
    const std::filesystem::path file =
        Written(fmt::format("mutation-{}.{}", GetParam(), format == 2 ? "obj" : "stl"), bytes);
    try {
      const ImportedPart part = Import({file}, "damaged", {});
      Document::Parse(part.PartFile(), "part.yaml").RequireFormat("assay-part/1");
      EXPECT_FALSE(ReadmeText(part).empty());
      EXPECT_TRUE(std::isfinite(part.Distance())) << trial;
      ++taken;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("mutation-"), std::string::npos)
          << trial << ": " << error.what();
    }
  }
  EXPECT_GT(taken, count / 10);
  EXPECT_LT(taken, count * 9 / 10);
}

}  // namespace
}  // namespace assay::mesh_import
