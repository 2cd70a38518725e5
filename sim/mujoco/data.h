#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "planner/geometry/coordinates.h"
#include "sim/mujoco/model.h"
#include "sim/mujoco/state.h"

struct mjData_;

namespace assay::mujoco {

// A warning of the engine about a simulation: a buffer overflowed, or the numbers went bad.
struct EngineWarning {
  std::string text;  // the engine's message about the last occurrence
  int count = 0;
};

// One simulation. Between calls of its methods, poses, contacts, inertia, velocities and qfrc_bias
// belong to the present qpos and qvel. Readings of force and torque sensors need accelerations, and
// belong to the start of the last step. After Forward and Restore, these readings belong to the
// present. Only then are the forces of the contacts valid. Step(see_forces) shows the forces of the
// contacts within a step. Code that writes into qpos or qvel must call Forward before the next
// step.
class Data {
 public:
  explicit Data(const Model& model);

  const Model& model() const { return model_; }
  // The engine's structures. `own_model` differs from model() only in the equality constraints, and
  // in the heights and contact impedances of geoms.
  mjData_* get() { return data_.get(); }
  const mjData_* get() const { return data_.get(); }
  const mjModel_* own_model() const { return own_model_.get(); }

  double time() const;      // seconds
  double timestep() const;  // seconds; the model's
  std::span<double> qpos();
  std::span<const double> qpos() const;
  std::span<double> qvel();
  std::span<const double> qvel() const;
  std::span<double> ctrl();
  std::span<const double> ctrl() const;
  std::span<double> qfrc_applied();
  std::span<const double> qfrc_bias() const;
  std::span<const double> sensordata() const;

  void Step();  // one timestep
  // Executes one timestep like Step. Calls `see_forces` as soon as this step has computed the
  // forces of the contacts at its start. During the call, Contacts() still gives these contacts.
  void Step(const std::function<void()>& see_forces);
  // Executes one timestep of the unmodified engine, which finds contacts of meshes in its own way.
  // Other programs see this step. Poses and contacts afterwards belong to its start.
  void StepUnmodified();
  void Forward();  // computes all that follows from qpos, qvel and controls, at the present time

  // Computes the poses of the bodies and of the joints' axes from qpos, and nothing else. Call
  // Forward before a step.
  void MoveBodies();

  // For motion that the caller computes with MoveBodies. FindContacts finds the contacts between
  // bodies of different groups (GroupFilter), without forces. LeastSeparation returns a distance in
  // metres that bodies of different groups surely keep from each other (GeomBounds), and where the
  // caller knows of such a distance, ForgetContacts does what FindContacts would do. SetTime moves
  // the time on. Resume computes all that the next step needs from qpos and qvel.
  void FindContacts(std::span<const int> groups);
  double LeastSeparation(std::span<const int> groups) const;
  void ForgetContacts();
  void SetTime(double seconds);
  void Resume() { BeginStep(); }

  // Adds to qfrc_applied the force on a body at a point, in newtons and metres in the world's axes.
  void AddForce(BodyId body, const geometry::Vector3& p_World,
                const geometry::Vector3& force_World);
  // Computes the generalized force that gives accelerations `qacc` to a free system at rest. Both
  // have the length of qvel.
  void MultiplyByInertia(std::span<const double> qacc, std::span<double> force) const;

  geometry::Pose BodyPose(BodyId body) const;  // X_WorldBody
  geometry::Pose SitePose(SiteId site) const;  // X_WorldSite

  // Returns the z coordinate of a geom's origin in the frame of its body, in metres.
  double GeomHeight(GeomId geom) const;
  void SetGeomHeight(GeomId geom, double z);
  // Sets the impedance of a geom's contacts at every depth: between 0 and 1, stiff near 1.
  void SetImpedance(GeomId geom, double impedance);

  bool IsActive(EqualityId constraint) const;
  void Deactivate(EqualityId constraint);
  // Activates a weld that holds its second body where it is now, relative to its first body.
  void ActivateWeldHere(EqualityId weld);

  // Steps after Restore give the same bits as the steps after Save gave.
  State Save() const;
  void Restore(const State& state);  // of a Data with the same model (checked)

  // Returns the engine's warnings since the start. Steps after a warning are worthless: the engine
  // may have left out contacts, or set the simulation back to its start.
  std::vector<EngineWarning> Warnings() const;
  bool HasWarnings() const;  // whether Warnings() is not empty, but faster

 private:
  // Computes all that the next step needs except the controls.
  void BeginStep();
  // Ends the step that BeginStep began. The contacts are still those of its start.
  void EndStep();

  Model model_;
  std::unique_ptr<mjModel_, void (*)(mjModel_*)> own_model_;
  std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
  std::vector<double> gain_;  // of qvel in a step
};

}  // namespace assay::mujoco
