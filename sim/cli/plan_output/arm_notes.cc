#include "sim/cli/plan_output/arm_notes.h"

#include <fmt/format.h>

#include "planner/kinematics/derived_inertia.h"

namespace assay::cli {
namespace {

using kinematics::Link;
using kinematics::MeshFit;

std::string FitText(const Link& link, const MeshFit& fit) {
  const std::string pieces =
      fit.pieces == 1 ? "its convex hull" : fmt::format("{} convex pieces", fit.pieces);
  const std::string ratio =
      fit.volume_ratio
          ? fmt::format(", with {:.2f} times the volume of the mesh", *fit.volume_ratio)
          : ". The mesh is not closed, so its volume is unknown";
  return fmt::format("The collision mesh {} of link {} counts as {}{}.\n", fit.file, link.name,
                     pieces, ratio);
}

}  // namespace

std::string ArmNotes(const kinematics::RobotModel& arm) {
  std::string text;
  for (const Link& link : arm.links) {
    for (const MeshFit& fit : link.fits) text += FitText(link, fit);
    if (link.inertial_is_derived) {
      text += fmt::format(
          "Link {} has no mass in its file. It counts as a body with its collision shapes and {} "
          "kg/m^3: {:.3g} kg.\n",
          link.name, kinematics::kDerivedDensity, link.inertial->mass);
    }
  }
  return text;
}

}  // namespace assay::cli
