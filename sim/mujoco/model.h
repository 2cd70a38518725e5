#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "planner/base/id.h"

struct mjModel_;  // mjModel of mujoco.h, which only source files include

namespace assay::mujoco {

// The engine's own indices, with one type for each kind of object.
using BodyId = Id<struct BodyTag>;
using JointId = Id<struct JointTag>;
using GeomId = Id<struct GeomTag>;
using SiteId = Id<struct SiteTag>;
using CameraId = Id<struct CameraTag>;
using ActuatorId = Id<struct ActuatorTag>;
using SensorId = Id<struct SensorTag>;
using EqualityId = Id<struct EqualityTag>;

class ConvexPieces;
class GeomBounds;

// Thrown if the engine's compiler does not accept an MJCF text, or warns about it.
class MjcfError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A compiled model. It is immutable, so that threads may share it. If a simulation changes settings
// of the model, for example by switching equality constraints, it changes the copy in its Data.
class Model {
 public:
  // Compiles a model. Throws MjcfError with the engine's message.
  static Model FromMjcf(const std::string& mjcf);

  const mjModel_* get() const { return model_.get(); }
  double timestep() const;  // seconds
  // Returns the solids by which meshes collide; null if the model has no mesh.
  const ConvexPieces* convex_pieces() const { return convex_pieces_.get(); }
  const GeomBounds& geom_bounds() const { return *geom_bounds_; }

  // Each function returns the object of this name, which must exist (checked).
  BodyId Body(std::string_view name) const;
  JointId Joint(std::string_view name) const;
  GeomId Geom(std::string_view name) const;
  SiteId Site(std::string_view name) const;
  CameraId Camera(std::string_view name) const;
  ActuatorId Actuator(std::string_view name) const;
  SensorId Sensor(std::string_view name) const;
  EqualityId Equality(std::string_view name) const;

  // Returns None if there is no camera of this name, because users name cameras.
  CameraId FindCamera(std::string_view name) const;

  std::string Name(BodyId id) const;  // empty if it has none; the world is "world"
  std::string Name(GeomId id) const;
  std::string Name(CameraId id) const;

  BodyId BodyOf(GeomId id) const;
  int QposAddress(JointId id) const;     // first index in qpos
  int DofAddress(JointId id) const;      // first index in qvel, qfrc_...
  int SensorAddress(SensorId id) const;  // first index in sensordata

 private:
  explicit Model(std::shared_ptr<const mjModel_> model);

  std::shared_ptr<const mjModel_> model_;
  std::shared_ptr<const ConvexPieces> convex_pieces_;
  std::shared_ptr<const GeomBounds> geom_bounds_;
};

}  // namespace assay::mujoco
