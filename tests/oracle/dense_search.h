#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "planner/base/interval.h"
#include "planner/base/random.h"

// Looks for the greatest value of a function over a box. The best of many random points are
// improved by smaller and smaller steps along the axes. The search uses only values of the
// function. Every value that is found is a value of the function, so the result never exceeds the
// true maximum. In few dimensions the result comes near the true maximum.
namespace assay::oracle {

using Function = std::function<double(const std::vector<double>&)>;  // NaN means undefined

struct Found {
  std::vector<double> point;
  double value = -std::numeric_limits<double>::infinity();

  void Take(const std::vector<double>& other_point, double other_value) {
    if (!(other_value > value)) return;
    point = other_point;
    value = other_value;
  }
};

struct DenseSearch {
  int starts = 200;
  int improved = 5;  // number of best starts that are improved
  int most_steps = 2000;
};

inline std::vector<double> RandomPoint(const std::vector<Interval>& box, RandomStream& random) {
  std::vector<double> point;
  for (const Interval& interval : box) {
    const int place = random.Index(4);  // often at an end, where extrema often are
    const double inside = random.Uniform(interval.low, interval.high);
    point.push_back(place == 0 ? interval.low : place == 1 ? interval.high : inside);
  }
  return point;
}

// Improves a point by the search of Hooke and Jeeves (1961), without its pattern moves, but with
// steps along random diagonals.
inline Found Improved(const Function& f, const std::vector<Interval>& box, Found found,
                      int most_steps, RandomStream& random) {
  double step = 0.25;  // fraction of the widths
  for (int i = 0; i < most_steps && step > 1e-9; ++i) {
    const double before = found.value;
    for (std::size_t v = 0; v <= box.size(); ++v) {
      for (double sign : {-1.0, 1.0}) {
        std::vector<double> next = found.point;
        for (std::size_t k = 0; k < box.size(); ++k) {
          const double share = v == box.size() ? random.Uniform(-1, 1) : v == k ? sign : 0.0;
          const double width = box[k].high - box[k].low;
          next[k] = std::clamp(next[k] + share * step * width, box[k].low, box[k].high);
        }
        found.Take(next, f(next));
      }
    }
    if (!(found.value > before)) step /= 2;
  }
  return found;
}

inline Found GreatestByDenseSearch(const Function& f, const std::vector<Interval>& box,
                                   RandomStream& random, const DenseSearch& effort = {}) {
  std::vector<Found> starts;
  for (int i = 0; i < effort.starts; ++i) {
    Found found;
    const std::vector<double> point = RandomPoint(box, random);
    found.Take(point, f(point));
    if (!found.point.empty()) starts.push_back(std::move(found));
  }
  std::sort(starts.begin(), starts.end(),
            [](const Found& a, const Found& b) { return a.value > b.value; });
  Found best;
  for (std::size_t i = 0; i < starts.size() && static_cast<int>(i) < effort.improved; ++i) {
    const Found found = Improved(f, box, starts[i], effort.most_steps, random);
    best.Take(found.point, found.value);
  }
  return best;
}

}  // namespace assay::oracle
