#include "sim/mujoco/model.h"

#include <mujoco/mujoco.h>

#include <array>
#include <cstring>
#include <utility>

#include "planner/base/check.h"
#include "sim/mujoco/collision/box_collision.h"
#include "sim/mujoco/collision/convex_pieces.h"
#include "sim/mujoco/collision/geom_bounds.h"
#include "sim/mujoco/collision/mesh_collision.h"
#include "sim/mujoco/engine_messages.h"

namespace assay::mujoco {
namespace {

constexpr char kFileName[] = "model.xml";

// A file of the engine's virtual file system, which is on the heap because it is large.
class VirtualFile {
 public:
  explicit VirtualFile(const std::string& text) : vfs_(std::make_unique<mjVFS>()) {
    mj_defaultVFS(vfs_.get());
    const int size = static_cast<int>(text.size()) + 1;
    ASSAY_CHECK(mj_makeEmptyFileVFS(vfs_.get(), kFileName, size) == 0);
    std::memcpy(vfs_->filedata[mj_findFileVFS(vfs_.get(), kFileName)], text.c_str(), text.size());
  }
  ~VirtualFile() { mj_deleteVFS(vfs_.get()); }
  VirtualFile(const VirtualFile&) = delete;
  VirtualFile& operator=(const VirtualFile&) = delete;

  const mjVFS* get() const { return vfs_.get(); }

 private:
  std::unique_ptr<mjVFS> vfs_;
};

int IndexOf(const mjModel* model, mjtObj type, std::string_view name) {
  return mj_name2id(model, type, std::string(name).c_str());
}

int CheckedIndexOf(const mjModel* model, mjtObj type, std::string_view name) {
  const int index = IndexOf(model, type, name);
  ASSAY_CHECK(index >= 0, "the model has no {} '{}'", mju_type2Str(type), name);
  return index;
}

std::string NameOf(const mjModel* model, mjtObj type, int index) {
  const char* name = mj_id2name(model, type, index);
  return name == nullptr ? std::string() : std::string(name);
}

}  // namespace

Model::Model(std::shared_ptr<const mjModel> model)
    : model_(std::move(model)), geom_bounds_(std::make_shared<const GeomBounds>(*model_)) {
  if (model_->nmesh > 0) convex_pieces_ = std::make_shared<const ConvexPieces>(*model_);
}

Model Model::FromMjcf(const std::string& mjcf) {
  HandleEngineMessages();
  CheckBoxCollisions();
  ReplaceMeshCollisions();
  TakeEngineWarnings();
  const VirtualFile file(mjcf);
  std::array<char, 1024> message{};
  mjModel* model = mj_loadXML(kFileName, file.get(), message.data(), message.size());
  const std::shared_ptr<mjModel> owner(model, [](mjModel* m) {
    if (m != nullptr) mj_deleteModel(m);
  });
  std::string complaint = message.data();  // for a model that compiled: a warning
  for (const std::string& warning : TakeEngineWarnings()) complaint += warning;
  if (model == nullptr || !complaint.empty()) throw MjcfError(complaint);
  return Model(owner);
}

double Model::timestep() const { return model_->opt.timestep; }

BodyId Model::Body(std::string_view name) const {
  return BodyId(CheckedIndexOf(get(), mjOBJ_BODY, name));
}
JointId Model::Joint(std::string_view name) const {
  return JointId(CheckedIndexOf(get(), mjOBJ_JOINT, name));
}
GeomId Model::Geom(std::string_view name) const {
  return GeomId(CheckedIndexOf(get(), mjOBJ_GEOM, name));
}
SiteId Model::Site(std::string_view name) const {
  return SiteId(CheckedIndexOf(get(), mjOBJ_SITE, name));
}
CameraId Model::Camera(std::string_view name) const {
  return CameraId(CheckedIndexOf(get(), mjOBJ_CAMERA, name));
}
ActuatorId Model::Actuator(std::string_view name) const {
  return ActuatorId(CheckedIndexOf(get(), mjOBJ_ACTUATOR, name));
}
SensorId Model::Sensor(std::string_view name) const {
  return SensorId(CheckedIndexOf(get(), mjOBJ_SENSOR, name));
}
EqualityId Model::Equality(std::string_view name) const {
  return EqualityId(CheckedIndexOf(get(), mjOBJ_EQUALITY, name));
}

CameraId Model::FindCamera(std::string_view name) const {
  return CameraId(IndexOf(get(), mjOBJ_CAMERA, name));
}

std::string Model::Name(BodyId id) const { return NameOf(get(), mjOBJ_BODY, id.index()); }
std::string Model::Name(GeomId id) const { return NameOf(get(), mjOBJ_GEOM, id.index()); }
std::string Model::Name(CameraId id) const { return NameOf(get(), mjOBJ_CAMERA, id.index()); }

BodyId Model::BodyOf(GeomId id) const { return BodyId(model_->geom_bodyid[id.index()]); }
int Model::QposAddress(JointId id) const { return model_->jnt_qposadr[id.index()]; }
int Model::DofAddress(JointId id) const { return model_->jnt_dofadr[id.index()]; }
int Model::SensorAddress(SensorId id) const { return model_->sensor_adr[id.index()]; }

}  // namespace assay::mujoco
