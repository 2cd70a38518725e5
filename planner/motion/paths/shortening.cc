#include "planner/motion/paths/shortening.h"

#include <algorithm>
#include <utility>

#include "planner/base/random.h"
#include "planner/motion/paths/joint_trajectory.h"

namespace assay::motion {
namespace {

class Shortening {
 public:
  Shortening(JointPath path, MotionCheck& check, const ShorteningEffort& effort)
      : path_(std::move(path)),
        check_(check),
        rates_(RatesOf(check.scene().workcell())),
        effort_(effort),
        limit_(check.postures() + effort.postures),
        random_(effort.seed, "shortening") {}

  JointPath Run() {
    LeaveOutCorners();
    for (int i = 0; i < effort_.shortcuts && path_.size() > 2; ++i) TryShortcut();
    LeaveOutCorners();
    return std::move(path_);
  }

 private:
  // A point of the path: `share` of the way along the motion that starts at corner `corner`.
  struct Point {
    std::size_t corner = 0;
    double share = 0;
    auto operator<=>(const Point&) const = default;
  };

  bool IsFree(const JointVector& from, const JointVector& to) {
    return check_.postures() < limit_ && !check_.FindObstruction(from, to);
  }

  // Joins each corner directly with the last corner that can be reached from it.
  void LeaveOutCorners() {
    for (std::size_t i = 0; i + 2 < path_.size(); ++i) {
      std::size_t last = path_.size() - 1;
      while (last > i + 1 && !IsQuicker({i, 0}, {last, 0})) --last;
      path_.erase(path_.begin() + static_cast<std::ptrdiff_t>(i + 1),
                  path_.begin() + static_cast<std::ptrdiff_t>(last));
    }
  }

  void TryShortcut() {
    Point from = Draw();
    Point to = Draw();
    if (to < from) std::swap(from, to);
    if (from.corner == to.corner || !IsQuicker(from, to)) return;
    JointPath path(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(from.corner + 1));
    path.push_back(At(from));
    path.push_back(At(to));
    path.insert(path.end(), path_.begin() + static_cast<std::ptrdiff_t>(to.corner + 1),
                path_.end());
    path_ = std::move(path);
  }

  Point Draw() {
    const int motion = random_.Index(static_cast<int>(path_.size()) - 1);
    return {static_cast<std::size_t>(motion), random_.Uniform()};
  }

  JointVector At(const Point& point) const {
    if (point.share == 0) return path_[point.corner];
    const JointVector& from = path_[point.corner];
    return from + point.share * (path_[point.corner + 1] - from);
  }

  // Returns whether the path is free and quicker if it goes straight between the two points.
  bool IsQuicker(const Point& from, const Point& to) {
    const JointVector start = At(from);
    const JointVector end = At(to);
    // A point within a motion splits that motion in two, with a stop between them.
    const auto kept = [&](const Point& point, const JointVector& near, const JointVector& corner) {
      return point.share == 0 ? 0 : Time(near, corner);
    };
    double before = 0;
    const std::size_t last = to.share == 0 ? to.corner : to.corner + 1;
    for (std::size_t i = from.corner; i < last; ++i) before += Time(path_[i], path_[i + 1]);
    const double after =
        kept(from, path_[from.corner], start) + Time(start, end) + kept(to, end, path_[last]);
    return after < before && IsFree(start, end);
  }

  double Time(const JointVector& from, const JointVector& to) const {
    return MoveDuration(from, to, rates_);
  }

  JointPath path_;
  MotionCheck& check_;
  JointRates rates_;
  ShorteningEffort effort_;
  std::int64_t limit_;
  RandomStream random_;
};

}  // namespace

JointPath Shortened(JointPath path, MotionCheck& check, const ShorteningEffort& effort) {
  return Shortening(std::move(path), check, effort).Run();
}

}  // namespace assay::motion
