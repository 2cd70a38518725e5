#include "sim/mujoco/data.h"

#include <mujoco/mujoco.h>

#include <algorithm>

#include "planner/base/check.h"
#include "sim/mujoco/collision/convex_pieces.h"
#include "sim/mujoco/collision/geom_bounds.h"
#include "sim/mujoco/collision/group_filter.h"
#include "sim/mujoco/engine_messages.h"

namespace assay::mujoco {
namespace {

using geometry::Pose;
using geometry::Vector3;

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Pose PoseAt(const mjtNum* position, const mjtNum* rotation) {
  Pose X = Pose::Identity();
  X.translation() = Eigen::Map<const Eigen::Vector3d>(position);
  X.linear() = Eigen::Map<const RowMajor>(rotation);
  return X;
}

std::span<double> SpanOf(mjtNum* values, int count) {
  return {values, static_cast<std::size_t>(count)};
}

template <class T, class U>
std::vector<T> Copied(const U* values, int count) {
  return {values, values + count};
}

template <class T, class U>
void CopyBack(const std::vector<T>& from, int count, U* to) {
  ASSAY_CHECK(from.size() == static_cast<std::size_t>(count), "a state of another model");
  std::copy(from.begin(), from.end(), to);
}

// Keeps qpos as it is during a computation. The engine's kinematics normalises the quaternions in
// qpos in place, which is not idempotent in the last bit. A restored state would be normalised once
// more than the saved one, and its simulation would differ.
class KeepPosition {
 public:
  explicit KeepPosition(std::span<double> qpos) : qpos_(qpos), kept_(qpos.begin(), qpos.end()) {}
  ~KeepPosition() { std::copy(kept_.begin(), kept_.end(), qpos_.begin()); }
  KeepPosition(const KeepPosition&) = delete;
  KeepPosition& operator=(const KeepPosition&) = delete;

 private:
  std::span<double> qpos_;
  std::vector<double> kept_;
};

}  // namespace

Data::Data(const Model& model)
    : model_(model), own_model_(nullptr, mj_deleteModel), data_(nullptr, mj_deleteData) {
  HandleEngineMessages();
  own_model_.reset(mj_copyModel(nullptr, model.get()));
  data_.reset(mj_makeData(own_model_.get()));
  ASSAY_CHECK(own_model_ != nullptr && data_ != nullptr);
  gain_.resize(own_model_->nv);
  Forward();
}

double Data::time() const { return data_->time; }
double Data::timestep() const { return own_model_->opt.timestep; }
std::span<double> Data::qpos() { return SpanOf(data_->qpos, own_model_->nq); }
std::span<const double> Data::qpos() const { return SpanOf(data_->qpos, own_model_->nq); }
std::span<double> Data::qvel() { return SpanOf(data_->qvel, own_model_->nv); }
std::span<const double> Data::qvel() const { return SpanOf(data_->qvel, own_model_->nv); }
std::span<double> Data::ctrl() { return SpanOf(data_->ctrl, own_model_->nu); }
std::span<const double> Data::ctrl() const { return SpanOf(data_->ctrl, own_model_->nu); }
std::span<double> Data::qfrc_applied() { return SpanOf(data_->qfrc_applied, own_model_->nv); }
std::span<const double> Data::qfrc_bias() const { return SpanOf(data_->qfrc_bias, own_model_->nv); }
std::span<const double> Data::sensordata() const {
  return SpanOf(data_->sensordata, own_model_->nsensordata);
}

// The engine's step is done in two halves, the second half first. The second half ends the step
// that the first half began. After it, the first half of the next step brings all quantities to the
// present, as a controller needs them, and nothing is computed twice.
//
// The engine moves a free body along the tangent of the arc on which the arm carries it. A part
// that is held by friction therefore wanders outward in the pads by J' qd dt / 2 each second, which
// is half a millimetre on a way across the table. Every position therefore also moves by dt / 2
// times the change of its velocity in the step. Contacts are then evaluated in the middle of the
// way to the next position, as in the leapfrog scheme, and the first-order error vanishes.
void Data::EndStep() {
  std::ranges::copy(qvel(), gain_.begin());
  mj_step2(own_model_.get(), data_.get());
  for (std::size_t i = 0; i < gain_.size(); ++i) gain_[i] = data_->qvel[i] - gain_[i];
  mj_integratePos(own_model_.get(), data_->qpos, gain_.data(), timestep() / 2);
}

void Data::Step() {
  EndStep();
  BeginStep();
}

void Data::Step(const std::function<void()>& see_forces) {
  EndStep();
  see_forces();
  BeginStep();
}

void Data::StepUnmodified() { mj_step(own_model_.get(), data_.get()); }

void Data::BeginStep() {
  const KeepPosition keep(qpos());
  const CollidingPieces colliding(model_.convex_pieces());
  mj_step1(own_model_.get(), data_.get());
}

void Data::Forward() {
  const KeepPosition keep(qpos());
  const CollidingPieces colliding(model_.convex_pieces());
  mj_forward(own_model_.get(), data_.get());
}

void Data::MoveBodies() {
  const KeepPosition keep(qpos());
  mj_kinematics(own_model_.get(), data_.get());
  mj_comPos(own_model_.get(), data_.get());
}

void Data::FindContacts(std::span<const int> groups) {
  const CollidingPieces colliding(model_.convex_pieces());
  const GroupFilter filter(groups);
  mj_collision(own_model_.get(), data_.get());
  for (int i = 0; i < data_->ncon; ++i) data_->contact[i].efc_address = -1;  // without forces
}

double Data::LeastSeparation(std::span<const int> groups) const {
  return model_.geom_bounds().LeastSeparation(*own_model_, *data_, groups);
}

void Data::ForgetContacts() { data_->ncon = 0; }

void Data::SetTime(double seconds) { data_->time = seconds; }

void Data::AddForce(BodyId body, const Vector3& p_World, const Vector3& force_World) {
  const Vector3 no_torque = Vector3::Zero();
  mj_applyFT(own_model_.get(), data_.get(), force_World.data(), no_torque.data(), p_World.data(),
             body.index(), data_->qfrc_applied);
}

void Data::MultiplyByInertia(std::span<const double> qacc, std::span<double> force) const {
  mj_mulM(own_model_.get(), data_.get(), force.data(), qacc.data());
}

Pose Data::BodyPose(BodyId body) const {
  return PoseAt(data_->xpos + 3 * body.index(), data_->xmat + 9 * body.index());
}

Pose Data::SitePose(SiteId site) const {
  return PoseAt(data_->site_xpos + 3 * site.index(), data_->site_xmat + 9 * site.index());
}

double Data::GeomHeight(GeomId geom) const { return own_model_->geom_pos[3 * geom.index() + 2]; }

void Data::SetGeomHeight(GeomId geom, double z) {
  own_model_->geom_pos[3 * geom.index() + 2] = z;
  BeginStep();
}

void Data::SetImpedance(GeomId geom, double impedance) {
  mjtNum* solimp = own_model_->geom_solimp + mjNIMP * geom.index();
  if (solimp[0] == impedance && solimp[1] == impedance) return;
  solimp[0] = impedance;
  solimp[1] = impedance;
  BeginStep();
}

bool Data::IsActive(EqualityId constraint) const {
  return own_model_->eq_active[constraint.index()] != 0;
}

void Data::Deactivate(EqualityId constraint) {
  own_model_->eq_active[constraint.index()] = 0;
  BeginStep();
}

// The values in eq_data for a weld are the anchor in the second body (3), the pose of the second
// body in the first body's frame (position 3, quaternion 4), and the torque scale. The anchor is
// the second body's origin here.
void Data::ActivateWeldHere(EqualityId weld) {
  const int i = weld.index();
  ASSAY_CHECK(own_model_->eq_type[i] == mjEQ_WELD);
  const Pose X_WorldFirst = BodyPose(BodyId(own_model_->eq_obj1id[i]));
  const Pose X_WorldSecond = BodyPose(BodyId(own_model_->eq_obj2id[i]));
  const Pose X_FirstSecond = X_WorldFirst.inverse() * X_WorldSecond;
  const Eigen::Quaterniond turn(X_FirstSecond.linear());
  mjtNum* values = own_model_->eq_data + mjNEQDATA * i;
  Eigen::Map<Eigen::Vector3d>(values).setZero();
  Eigen::Map<Eigen::Vector3d>(values + 3) = X_FirstSecond.translation();
  Eigen::Map<Eigen::Vector4d>(values + 6) << turn.w(), turn.x(), turn.y(), turn.z();
  own_model_->eq_active[i] = 1;
  BeginStep();
}

State Data::Save() const {
  const mjModel& m = *own_model_;
  const mjData& d = *data_;
  return {.time = d.time,
          .qpos = Copied<double>(d.qpos, m.nq),
          .qvel = Copied<double>(d.qvel, m.nv),
          .act = Copied<double>(d.act, m.na),
          .qacc_warmstart = Copied<double>(d.qacc_warmstart, m.nv),
          .ctrl = Copied<double>(d.ctrl, m.nu),
          .qfrc_applied = Copied<double>(d.qfrc_applied, m.nv),
          .xfrc_applied = Copied<double>(d.xfrc_applied, 6 * m.nbody),
          .mocap_pos = Copied<double>(d.mocap_pos, 3 * m.nmocap),
          .mocap_quat = Copied<double>(d.mocap_quat, 4 * m.nmocap),
          .eq_active = Copied<std::uint8_t>(m.eq_active, m.neq),
          .eq_data = Copied<double>(m.eq_data, mjNEQDATA * m.neq),
          .geom_pos = Copied<double>(m.geom_pos, 3 * m.ngeom),
          .geom_solimp = Copied<double>(m.geom_solimp, mjNIMP * m.ngeom)};
}

void Data::Restore(const State& state) {
  mjModel& m = *own_model_;
  mjData& d = *data_;
  d.time = state.time;
  CopyBack(state.qpos, m.nq, d.qpos);
  CopyBack(state.qvel, m.nv, d.qvel);
  CopyBack(state.act, m.na, d.act);
  CopyBack(state.ctrl, m.nu, d.ctrl);
  CopyBack(state.qfrc_applied, m.nv, d.qfrc_applied);
  CopyBack(state.xfrc_applied, 6 * m.nbody, d.xfrc_applied);
  CopyBack(state.mocap_pos, 3 * m.nmocap, d.mocap_pos);
  CopyBack(state.mocap_quat, 4 * m.nmocap, d.mocap_quat);
  CopyBack(state.eq_active, m.neq, m.eq_active);
  CopyBack(state.eq_data, mjNEQDATA * m.neq, m.eq_data);
  CopyBack(state.geom_pos, 3 * m.ngeom, m.geom_pos);
  CopyBack(state.geom_solimp, mjNIMP * m.ngeom, m.geom_solimp);
  Forward();
  // The warm start is restored last, because Forward overwrites it with its own accelerations.
  CopyBack(state.qacc_warmstart, m.nv, d.qacc_warmstart);
}

std::vector<EngineWarning> Data::Warnings() const {
  std::vector<EngineWarning> warnings;
  for (int type = 0; type < mjNWARNING; ++type) {
    const mjWarningStat& stat = data_->warning[type];
    if (stat.number > 0) warnings.push_back({mju_warningText(type, stat.lastinfo), stat.number});
  }
  return warnings;
}

bool Data::HasWarnings() const {
  return std::any_of(data_->warning, data_->warning + mjNWARNING,
                     [](const mjWarningStat& stat) { return stat.number > 0; });
}

}  // namespace assay::mujoco
