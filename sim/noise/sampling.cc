#include "sim/noise/sampling.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <utility>

#include "planner/base/check.h"
#include "planner/base/random.h"
#include "sim/noise/possible_start.h"

namespace assay::noise {
namespace {

// Returns the generalized golden ratio, the positive root of x^(d + 1) = x + 1 (Roberts 2018, "The
// unreasonable effectiveness of quasirandom sequences").
double GoldenRatio(int dimensions) {
  double x = 2;
  for (int i = 0; i < 60; ++i) x = std::pow(1 + x, 1.0 / (dimensions + 1));
  return x;
}

// Interpolates in a form that gives the ends of a symmetric range exactly.
double At(const Interval& range, double t) { return (1 - t) * range.low + t * range.high; }

Noise At(const std::vector<Channel>& box, std::vector<double> point) {
  for (std::size_t i = 0; i < box.size(); ++i) point[i] = At(box[i].range, point[i]);
  return {box, std::move(point)};
}

// If nearly no errors are possible, the last draw is moved back as other points are.
Noise UniformNoise(const std::vector<Channel>& box, const PossibleStart& start, std::uint64_t seed,
                   int number) {
  RandomStream random(seed, fmt::format("uniform/{}", number));
  const Noise none(box, std::vector<double>(box.size(), 0));
  Noise drawn = none;
  const auto draw = [&] {
    std::vector<double> point(box.size());
    for (double& t : point) t = random.Uniform();
    drawn = At(box, std::move(point));
    return !start.FirstOverlap(drawn);
  };
  return DrawUntilPossible(draw) ? drawn : start.MovedBack(drawn, none);
}

}  // namespace

std::vector<double> CornerPoint(int dimensions, std::uint64_t seed, int number) {
  ASSAY_CHECK(dimensions >= 0 && number >= 1);
  std::vector<double> point(dimensions);
  const unsigned rows = static_cast<unsigned>(CornerDesignSize(dimensions)) / 2;
  const unsigned row = static_cast<unsigned>(number - 1) / 2;
  if (row < rows) {
    const unsigned opposite = static_cast<unsigned>(number - 1) % 2;
    for (unsigned i = 0; i < point.size(); ++i) {
      point[i] = (std::popcount(row & (i + 1)) + opposite) % 2;
    }
    return point;
  }
  RandomStream random(seed, fmt::format("corner/{}", number));
  for (double& t : point) t = random.Index(2);
  return point;
}

int CornerDesignSize(int dimensions) {
  return static_cast<int>(2 * std::bit_ceil(static_cast<unsigned>(dimensions) + 1));
}

std::vector<double> EvenPoint(int dimensions, std::uint64_t seed, int number) {
  ASSAY_CHECK(dimensions >= 0 && number >= 1);
  RandomStream random(seed, "even");
  const double ratio = GoldenRatio(dimensions);
  std::vector<double> point(dimensions);
  double step = 1;
  for (double& t : point) {
    step /= ratio;
    const double x = random.Uniform() + number * step;
    t = x - std::floor(x);
  }
  return point;
}

const std::vector<std::string>& ModeNames() {
  static const std::vector<std::string> kNames = {"none", "uniform", "vertices", "low-discrepancy"};
  return kNames;
}

std::string_view Name(Mode mode) { return ModeNames()[static_cast<std::size_t>(mode)]; }

Noise Sample(const domain::Problem& problem, const std::vector<Channel>& box, Mode mode,
             std::uint64_t seed, int number) {
  const int dimensions = static_cast<int>(box.size());
  const Noise none(box, std::vector<double>(box.size(), 0));
  const PossibleStart start(problem);
  switch (mode) {
    case Mode::kNone:
      return none;
    case Mode::kUniform:
      return UniformNoise(box, start, seed, number);
    case Mode::kVertices:
      return start.MovedBack(At(box, CornerPoint(dimensions, seed, number)), none);
    case Mode::kLowDiscrepancy:
      return start.MovedBack(At(box, EvenPoint(dimensions, seed, number)), none);
  }
  ASSAY_CHECK(false, "a mode that the switch does not know");
  return none;
}

}  // namespace assay::noise
