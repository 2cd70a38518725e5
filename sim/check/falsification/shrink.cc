#include "sim/check/falsification/shrink.h"

#include <span>
#include <utility>
#include <vector>

#include "sim/noise/possible_start.h"

namespace assay::check {
namespace {

constexpr int kHalvings = 5;

noise::Noise Multiple(const noise::Noise& noise, double factor) {
  std::vector<double> values = noise.values();
  for (double& value : values) value *= factor;
  return {noise.box(), std::move(values)};
}

class Shrinking {
 public:
  Shrinking(const Experiment& experiment, Counterexample& example)
      : experiment_(experiment), start_(experiment.problem), example_(example) {}

  void Run() {
    example_.replayed = Accepts(example_.noise);
    if (!example_.replayed) return;
    LeaveOut(ErrorsThatAreLeft(), Knowledge::kNone);
    ScaleDown();
    example_.is_simplest = !is_spent_;
  }

 private:
  // The result of earlier replays in which several errors were left out at once.
  enum class Knowledge { kNone, kTooMany };
  using Channels = std::span<const std::size_t>;

  // Replays the violation with other errors, and keeps them if the claim is violated again.
  bool Accepts(const noise::Noise& noise) {
    if (is_spent_ || start_.FirstOverlap(noise)) return false;
    steps_replayed_ += example_.steps;
    if (steps_replayed_ > kMostStepsReplayed) is_spent_ = true;
    if (is_spent_) return false;
    const std::optional<Claim> claim = ObserveAgain(experiment_, example_.claim, noise);
    if (!claim || !claim->IsViolated()) return false;
    example_.claim = *claim;
    example_.noise = noise;
    return true;
  }

  std::vector<std::size_t> ErrorsThatAreLeft() const {
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < example_.noise.values().size(); ++i) {
      if (example_.noise.values()[i] != 0) left.push_back(i);
    }
    return left;
  }

  // Leaves out these errors, or else as many of them as possible. Usually a few errors cause a
  // violation, so a half that contains none of them can be left out at once. Returns whether all
  // were left out.
  bool LeaveOut(Channels channels, Knowledge knowledge) {
    if (channels.empty()) return true;
    if (knowledge == Knowledge::kNone) {
      noise::Noise without = example_.noise;
      for (const std::size_t i : channels) without.Set(i, 0);
      if (Accepts(without)) return true;
    }
    if (channels.size() == 1) return false;
    const std::size_t half = channels.size() / 2;
    const bool first = LeaveOut(channels.first(half), Knowledge::kNone);
    // Without the first half, leaving out the second one leaves out all of them again.
    const bool second =
        LeaveOut(channels.subspan(half), first ? Knowledge::kTooMany : Knowledge::kNone);
    return first && second;
  }

  void ScaleDown() {
    const noise::Noise all_of_it = example_.noise;
    double holds = 0;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (holds + example_.multiple) / 2;
      (Accepts(Multiple(all_of_it, middle)) ? example_.multiple : holds) = middle;
    }
  }

  const Experiment& experiment_;
  const noise::PossibleStart start_;
  Counterexample& example_;
  int steps_replayed_ = 0;
  bool is_spent_ = false;  // the budget did not suffice
};

}  // namespace

void Shrink(const Experiment& experiment, Counterexample& example) {
  Shrinking(experiment, example).Run();
}

}  // namespace assay::check
