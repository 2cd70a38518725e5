#pragma once

#include <vector>

#include "planner/domain/mating/shaft_fit.h"
#include "planner/domain/problem/problem.h"
#include "sim/render/close_up.h"
#include "sim/scene/scene.h"

namespace assay::render {

// How a mating goes on, as it is seen: how deep shafts are in their holes, and where to look.
class Insertion {
 public:
  // Problem and scene must outlive this.
  Insertion(const domain::Problem& problem, const scene::Scene& scene,
            const domain::Mating& mating);

  // Along the mating vector, metres: how far the seated part is from where the first of its shafts
  // is at the first of the mouths. Where no shaft is in a hole, the length of the mating vector.
  double depth() const { return depth_; }
  // How far before the mouth a shaft shows the whole hole to who looks from aside: as far as the
  // mouth is wide, metres.
  double gap() const { return gap_; }
  // How deep the shaft truly is; below 0 before the mouth. It is measured along the mating vector
  // alone: also of a part that is beside the hole.
  double Inserted(const mujoco::Data& data) const;

  // Both parts, from the gap before the mouth to the seat. To be seen are mouths, shafts and
  // corners of the held part, before the mouth, as it enters, and half way in.
  Subject SubjectIn(const mujoco::Data& data) const;
  // What of it moves (Sight).
  std::vector<mujoco::BodyId> Moving() const;

 private:
  // A point of a mouth or of a shaft.
  struct Mark {
    Vector3 p_Part;
    domain::PartId part;
  };
  std::vector<Mark> MarksOf(const domain::ShaftFit& fit) const;

  const domain::Problem& problem_;
  const scene::Scene& scene_;
  const domain::Mating& mating_;
  std::vector<Mark> marks_;
  double depth_ = 0;
  double gap_ = 0;
};

}  // namespace assay::render
