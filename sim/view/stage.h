#pragma once

#include <string>
#include <vector>

#include "planner/geometry/coordinates.h"
#include "planner/geometry/hull.h"
#include "sim/scene/scene.h"

namespace assay::view {

using geometry::Pose;
using geometry::Vector3;

// A shape that is drawn, fixed to a body.
struct Shape {
  std::string type;           // "box", "cylinder" (along z), "sphere", "plane" (z is 0), "hull"
  Vector3 size;               // metres: half extents of a box; radius and half length; radius
  geometry::ConvexHull hull;  // of a hull; otherwise empty
  Pose X_BodyShape;
  std::string color;  // "#rrggbb"
};

struct Body {
  std::string name;  // "arm/forearm", "part/peg"
  mujoco::BodyId id;
  std::vector<Shape> shapes;
};

// Returns the bodies of a model that are drawn, the world first.
std::vector<Body> BodiesOf(const mujoco::Model& model);

// A camera that stands still. It looks along `forward`.
struct Camera {
  std::string name;
  Vector3 eye;      // metres, world frame
  Vector3 forward;  // unit vectors, world frame
  Vector3 up;
  double vertical_angle = 0;  // radians
};

// Returns the cameras by which pictures are taken, without the eyes of sensors.
std::vector<Camera> CamerasOf(const scene::Scene& scene);

}  // namespace assay::view
