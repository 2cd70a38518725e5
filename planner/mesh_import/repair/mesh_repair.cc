#include "planner/mesh_import/repair/mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/base/input_files/input_error.h"
#include "planner/mesh_import/repair/openings.h"
#include "planner/mesh_import/repair/orientation.h"
#include "planner/mesh_import/repair/shells.h"
#include "planner/mesh_import/repair/weld.h"

namespace assay::mesh_import {
namespace {

// Shares of the size of the mesh.
constexpr double kWeld = 1e-6;
constexpr double kPlanar = 1e-4;
// A body whose volume is a smaller share of the cube of its size is a sheet.
constexpr double kLeastSolid = 1e-7;
constexpr std::size_t kMostShells = 100;

void TurnAround(TriangleMesh& mesh) {
  for (Triangle& triangle : mesh.triangles) std::swap(triangle.corners[1], triangle.corners[2]);
}

// A body that is inside out and lies in the bounds of another one may be the wall of a hollow,
// which no kind of solid has.
void RefuseHollows(const std::vector<TriangleMesh>& bodies) {
  for (const TriangleMesh& body : bodies) {
    if (body.Volume() >= 0) continue;
    for (const TriangleMesh& other : bodies) {
      if (&other == &body || other.Volume() <= 0 || !other.Bounds().contains(body.Bounds()))
        continue;
      Refuse(body, body.triangles.front(), "this belongs to the wall of a closed hollow",
             "parts whose holes open to the outside");
    }
  }
}

int TurnOutward(std::vector<TriangleMesh>& bodies) {
  RefuseHollows(bodies);
  int turned = 0;
  for (TriangleMesh& body : bodies) {
    const double volume = body.Volume();
    if (std::abs(volume) <= kLeastSolid * std::pow(body.Size(), 3)) {
      Refuse(body, body.triangles.front(), "this belongs to a body without volume",
             "a surface that encloses a solid");
    }
    if (volume > 0) continue;
    TurnAround(body);
    ++turned;
  }
  return turned;
}

}  // namespace

RepairedMesh Repair(TriangleMesh mesh) {
  RepairedMesh repaired;
  const auto note = [&](int count, const char* sentence) {
    if (count > 0) repaired.repairs.push_back(fmt::format(fmt::runtime(sentence), count));
  };
  const double size = mesh.Size();
  note(Weld(mesh, kWeld * size), "{} triangles with a side of no length were dropped.");
  if (mesh.triangles.empty()) throw InputError({mesh.file}, "it has no triangles", "a surface");
  note(OrientConsistently(mesh), "{} triangles were turned to agree with their neighbours.");
  const Closing closing = CloseOpenings(mesh, kPlanar * size);
  note(closing.openings, "{} planar openings were closed.");
  if (closing.area > 0.5e-8)
    repaired.repairs.back() += fmt::format(" Together they have {:.2f} mm^2.", closing.area * 1e6);
  repaired.bodies = ShellsOf(mesh);
  if (repaired.bodies.size() > kMostShells) {
    throw InputError({mesh.file}, fmt::format("it has {} bodies", repaired.bodies.size()),
                     fmt::format("at most {}", kMostShells));
  }
  note(TurnOutward(repaired.bodies), "{} bodies were inside out and were turned.");
  std::ranges::stable_sort(repaired.bodies, std::ranges::greater(), &TriangleMesh::Volume);
  return repaired;
}

}  // namespace assay::mesh_import
