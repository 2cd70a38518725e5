#pragma once

#include <vector>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/problem/problem.h"
#include "sim/render/close_up.h"
#include "sim/scene/scene.h"

namespace assay::render {

// A mating from the view of a camera: the depth of shafts in their holes, and the points to show.
class Insertion {
 public:
  // Problem and scene must outlive this.
  Insertion(const domain::Problem& problem, const scene::Scene& scene,
            const domain::Mating& mating);

  // Returns the depth of the seated part along the mating vector, metres. It is the distance from
  // the pose at which the first shaft reaches the first mouth. If there is no shaft in a hole, it
  // is the length of the mating vector.
  double depth() const { return depth_; }
  // Returns how far a shaft is drawn before the mouth, in metres, so that a camera beside it sees
  // the whole mouth. This is the width of the mouth.
  double gap() const { return gap_; }
  // Returns the true depth of the shaft along the mating vector, metres. It is negative before the
  // mouth. It is defined for a part beside the hole, too.
  double Inserted(const mujoco::Data& data) const;

  // Returns the subject of close-ups. It frames both parts, for every depth of the held part from
  // gap() before the mouth to the seat. Points of mouths and shafts must be visible while the held
  // part is before the mouth, as it enters, and when it is half inserted.
  Subject SubjectIn(const mujoco::Data& data) const;
  // Returns the bodies that move during the mating (for Sight).
  std::vector<mujoco::BodyId> Moving() const;

 private:
  // A point of a mouth or of a shaft, in the frame of its part.
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
