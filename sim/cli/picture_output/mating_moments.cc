#include "sim/cli/picture_output/mating_moments.h"

#include <fmt/format.h>

#include <cmath>

namespace assay::cli {
namespace {

// Depths of the shaft at which events happen, as shares of the whole depth.
constexpr double kEnters = 0.1;
constexpr double kHalf = 0.5;
constexpr double kAlike = 0.05;

std::string PartsOf(const domain::Problem& problem, const domain::Mating& mating) {
  const std::vector<domain::ShaftFit> fits = domain::FitsOf(problem, mating);
  const bool goes_in = fits.empty() || fits.front().shaft_is_held;
  return fmt::format("{} {} {}", problem.part(mating.held).name, goes_in ? "into" : "onto",
                     problem.part(mating.fixed).name);
}

}  // namespace

MatingMoments::MatingMoments(const domain::Problem& problem, const scene::Scene& scene,
                             const domain::Mating& mating, const mujoco::Data& data, double aspect)
    : parts_(PartsOf(problem, mating)),
      insertion_(problem, scene, mating),
      camera_(render::CloseUp(insertion_.SubjectIn(data), render::Sight(data, insertion_.Moving()),
                              aspect)),
      ahead_({{"before", -insertion_.gap()},
              {"enters", kEnters * insertion_.depth()},
              {"half", kHalf * insertion_.depth()}}) {}

std::optional<Snapshot> MatingMoments::Look(const mujoco::Data& data) {
  const double inserted = insertion_.Inserted(data);
  std::string come;
  while (!ahead_.empty() && inserted >= ahead_.front().second) {
    come = ahead_.front().first;
    ahead_.erase(ahead_.begin());
  }
  if (come.empty()) return std::nullopt;
  return At(come, inserted);
}

std::optional<Snapshot> MatingMoments::LookAtRest(const mujoco::Data& data) {
  const double inserted = insertion_.Inserted(data);
  const double alike = kAlike * insertion_.depth();
  if (rest_ && std::abs(inserted - *rest_) < alike) return std::nullopt;
  rest_ = inserted;
  return At(std::abs(inserted - insertion_.depth()) < alike ? "seated" : "stopped", inserted);
}

Snapshot MatingMoments::At(const std::string& name, double inserted) const {
  if (inserted < 0) {
    return {name, fmt::format("{}: {:.1f} mm before it enters", parts_, -1e3 * inserted)};
  }
  return {name, fmt::format("{}: {}, {:.1f} of {:.1f} mm", parts_, name, 1e3 * inserted,
                            1e3 * insertion_.depth())};
}

}  // namespace assay::cli
