#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "planner/posting/uncertainty_phase/shortfall.h"
#include "planner/uncertainty/errors/world_tree.h"

namespace assay::posting {

// The worlds of a plan instance, had it been told between any two actions all that remedies could
// tell: x, y and theta of every part that rests, by squeezing or sensing, and z if a sensor that
// may be used measures it. Whatever remedies are inserted, these worlds are among those that remain
// possible; so what is not proved in them is not proved by any remedy that does not absorb it.
class BestKnown {
 public:
  // Whether that is so: not where an error promises to be other than 0, nor where errors of
  // different actions may cancel (paper propagation).
  static bool Bounds(const domain::Problem& problem, uncertainty::Propagation propagation);

  // The problem must outlive it.
  BestKnown(const domain::Problem& problem, uncertainty::Propagation propagation,
            const algebra::BoundRequest& bound);

  uncertainty::MomentId Beginning() const { return worlds_.Beginning(); }
  uncertainty::MomentId After(uncertainty::MomentId before, const plan::Action& action,
                              const plan::Strategy* strategy);

  const uncertainty::UncertainWorld& WorldAt(uncertainty::MomentId moment) {
    return worlds_.WorldAt(moment);
  }
  std::int64_t moments() const { return worlds_.size(); }  // that were asked for

  // What is not proved of the action that leads to a moment, `absorbable` conditions apart.
  std::vector<uncertainty::Unproved> UnprovedAt(uncertainty::MomentId after,
                                                const std::vector<std::string>& absorbable);
  // What it falls short by at least.
  Shortfall LeastShortfall(uncertainty::MomentId after, const std::vector<std::string>& absorbable);

 private:
  // The first moment that was met at which no more was to be known: with an empty hand, what is
  // told of all parts is all that matters of what was done.
  uncertainty::MomentId FirstAlike(uncertainty::MomentId moment);
  uncertainty::MomentId FindAlike(uncertainty::MomentId moment);

  const domain::Problem& problem_;
  uncertainty::WorldTree worlds_;
  std::vector<uncertainty::MomentId> with_empty_hand_;  // no two alike
  std::map<uncertainty::MomentId, uncertainty::MomentId> first_alike_;
};

}  // namespace assay::posting
