#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/geometry/coordinates.h"

namespace assay::mujoco {

using geometry::Pose;
using geometry::Vector3;

// A convex piece as the points of which it is the hull.
using Points = std::vector<Vector3>;

// Returns the corners of a regular prism about the z axis. Its sides are `apothem` metres from the
// axis, and the first corner is at half the angle of a side.
inline Points Prism(int sides, double apothem, double low, double high) {
  Points points;
  const double radius = apothem / std::cos(std::numbers::pi / sides);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / sides;
    for (const double z : {low, high}) {
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return points;
}

// Returns the pieces of a ring around a regular prism: one wedge for each side of the hole.
inline std::vector<Points> Ring(int sides, double apothem, double outer, double low, double high) {
  const Points hole = Prism(sides, apothem, low, high);
  const Points outside = Prism(sides, outer, low, high);
  std::vector<Points> wedges;
  for (std::size_t i = 0; i < hole.size(); i += 2) {
    const std::size_t next = (i + 2) % hole.size();
    wedges.push_back({hole[i], hole[i + 1], hole[next], hole[next + 1], outside[i], outside[i + 1],
                      outside[next], outside[next + 1]});
  }
  return wedges;
}

inline Points BoxPoints(double x, double y, double low, double high) {
  const auto corners = geometry::Box::FromCorners({-x, -y, low}, {x, y, high}).Corners();
  return {corners.begin(), corners.end()};
}

// A body of convex pieces in a model, fixed or free.
struct ConvexBody {
  std::string name;
  std::vector<Points> pieces;             // meshes
  std::vector<geometry::Box> boxes = {};  // boxes of the engine
  Pose X_World = Pose::Identity();
  bool is_free = true;
};

struct WorldOptions {
  double friction = 0.3;
  Vector3 gravity = {0, 0, -9.81};
};

inline std::string GeomsOf(const ConvexBody& body, std::string& assets) {
  std::string geoms;
  for (std::size_t i = 0; i < body.pieces.size(); ++i) {
    const std::string mesh = fmt::format("{}/{}", body.name, i);
    assets += fmt::format("<mesh name=\"{}\" vertex=\"", mesh);
    for (const Vector3& p : body.pieces[i]) {
      assets += fmt::format("{} {} {} ", p.x(), p.y(), p.z());
    }
    assets += "\"/>\n";
    geoms += fmt::format("<geom type=\"mesh\" mesh=\"{}\"/>\n", mesh);
  }
  for (const geometry::Box& box : body.boxes) {
    const Vector3 p = box.X_FrameBox.translation();
    const Eigen::Quaterniond turn(box.X_FrameBox.linear());
    geoms += fmt::format(
        "<geom type=\"box\" pos=\"{} {} {}\" quat=\"{} {} {} {}\" size=\"{} {} {}\"/>\n", p.x(),
        p.y(), p.z(), turn.w(), turn.x(), turn.y(), turn.z(), box.half_extents.x(),
        box.half_extents.y(), box.half_extents.z());
  }
  return geoms;
}

// Returns a model of these bodies. Its contacts are as stiff as those of sim/scene.
inline std::string ModelOf(const std::vector<ConvexBody>& bodies,
                           const WorldOptions& options = {}) {
  std::string assets;
  std::string world;
  for (const ConvexBody& body : bodies) {
    const Vector3 p = body.X_World.translation();
    const Eigen::Quaterniond turn(body.X_World.linear());
    world += fmt::format("<body name=\"{}\" pos=\"{} {} {}\" quat=\"{} {} {} {}\">{}\n{}</body>\n",
                         body.name, p.x(), p.y(), p.z(), turn.w(), turn.x(), turn.y(), turn.z(),
                         body.is_free ? "<freejoint/>" : "", GeomsOf(body, assets));
  }
  return fmt::format(
      R"(<mujoco>
<option timestep="0.0005" solver="Newton" iterations="50" tolerance="1e-10" cone="elliptic"
        impratio="10" gravity="{} {} {}"><flag energy="enable"/></option>
<size njmax="800" nconmax="250"/>
<default><geom solref="0.0001 1" solimp="0.99 0.9999 0.00001" condim="3" density="2700"
               friction="{} 0.005 0.0001"/></default>
<asset>
{}</asset>
<worldbody>
{}</worldbody>
</mujoco>
)",
      options.gravity.x(), options.gravity.y(), options.gravity.z(), options.friction, assets,
      world);
}

}  // namespace assay::mujoco
