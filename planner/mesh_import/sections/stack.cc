#include "planner/mesh_import/sections/stack.h"

#include <algorithm>
#include <cmath>

namespace assay::mesh_import {
namespace {

constexpr double kWidestChamfer = 0.25;    // share of the least width
constexpr double kHighestChamfer = 0.45;   // share of the height
constexpr double kThinnestSolid = 1e-4;    // metres, as a part file permits
constexpr double kGreatestChamfer = 0.02;  // metres, as a part file permits

// Builds the stack of one mesh from its columns. Small tapered columns at a free end of a straight
// column become a chamfer of this column.
class StackBuilder {
 public:
  StackBuilder(const std::vector<Column>& columns, const ColumnRules& rules)
      : columns_(columns), is_used_(columns.size(), false), rules_(rules) {}

  Stack Build() {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].is_straight && !columns_[i].is_step) AddStraight(i);
    }
    for (std::size_t i = 0; i < columns_.size() && stack_.reason.empty(); ++i) {
      if (is_used_[i]) continue;
      if (columns_[i].is_step) Add(columns_[i]);
      if (!columns_[i].is_straight) AddTaper(columns_[i]);
    }
    std::ranges::stable_sort(holes_, std::ranges::greater(),
                             [](const Post& hole) { return std::round(hole.at_low.Area() * 1e9); });
    for (const Post& hole : holes_) CutHole(hole);
    const auto is_thin = [](const Post& post) {
      return std::min(post.Height(), post.at_low.Bounds().sizes().minCoeff()) < kThinnestSolid;
    };
    if (std::ranges::any_of(stack_.solids, is_thin))
      stack_.reason = "a layer of it is thinner than 0.1 mm";
    if (stack_.solids.empty() && stack_.reason.empty()) stack_.reason = "it has no solid layer";
    return std::move(stack_);
  }

 private:
  static Post PostOf(const Column& column) {
    return {.at_low = column.at_low,
            .at_high = column.at_high,
            .is_straight = column.is_straight,
            .is_step = column.is_step,
            .low = column.low,
            .high = column.high,
            .mouth = column.mouth};
  }

  void Add(const Column& column) {
    (column.is_hole ? holes_ : stack_.solids).push_back(PostOf(column));
  }

  void AddStraight(std::size_t index) {
    Post post = PostOf(columns_[index]);
    const bool is_hole = columns_[index].is_hole;
    const Column& own = columns_[index];
    for (const bool top : {false, true}) {
      const Chamfer chamfer = TakeChamfer(own, top);
      (top ? post.high : post.low) += top ? chamfer.along : -chamfer.along;
      (top ? post.chamfer_high : post.chamfer_low) = chamfer;
    }
    (is_hole ? holes_ : stack_.solids).push_back(std::move(post));
  }

  // Returns whether a tapered column or a step continues a column up to a free end. An outline
  // shrinks towards its free end, and a hole widens towards its mouth.
  bool Continues(const Column& next, const Contour& contour, bool top) const {
    if (next.is_step)
      return (next.at_low.Area() > contour.Area()) == next.is_hole &&
             Overlaps(next.at_low, contour);
    return !next.is_straight && AreEqual(next.At(!top), contour, 3 * rules_.tolerance) &&
           (next.At(top).Area() > next.At(!top).Area()) == next.is_hole;
  }

  // Returns the chain of tapered columns and steps that continue a straight one up to a free end.
  std::vector<std::size_t> ChainFrom(const Column& straight, bool top) const {
    std::vector<std::size_t> chain;
    const Column* last = &straight;
    for (bool grows = true; grows;) {
      grows = false;
      for (std::size_t i = 0; i < columns_.size() && !grows; ++i) {
        const Column& next = columns_[i];
        if (is_used_[i] || next.is_hole != straight.is_hole ||
            (top ? next.low != last->high : next.high != last->low) ||
            !Continues(next, last->At(top), top))
          continue;
        chain.push_back(i);
        last = &next;
        grows = true;
      }
    }
    return chain;
  }

  // Returns true if the end of a column is free: beyond this end no material continues the solid or
  // covers the hole.
  bool IsFree(const Column& end, bool top) const {
    const double height = top ? end.high : end.low;
    return std::ranges::none_of(columns_, [&](const Column& other) {
      if ((top ? other.low : other.high) != height) return false;
      if (other.is_hole) return end.is_hole && Overlaps(other.At(!top), end.At(top));
      return Overlaps(other.At(!top), end.At(top));
    });
  }

  static bool Overlaps(const Contour& a, const Contour& b) {
    const auto reaches_into = [](const Contour& from, const Contour& to) {
      const std::vector<Vector2> outline = from.Outline(12);
      return to.Contains(from.center) ||
             std::ranges::any_of(outline, [&](const Vector2& p) { return to.Contains(p); });
    };
    return reaches_into(a, b) || reaches_into(b, a);
  }

  Chamfer TakeChamfer(const Column& straight, bool top) {
    const std::vector<std::size_t> chain = ChainFrom(straight, top);
    if (chain.empty() || !IsFree(columns_[chain.back()], top)) return {};
    const Column& end = columns_[chain.back()];
    const Vector2 widths = straight.at_low.Bounds().sizes();
    const Vector2 change = (widths - end.At(top).Bounds().sizes()) / 2;
    const Chamfer chamfer = {.across = straight.is_hole ? -change.maxCoeff() : change.minCoeff(),
                             .along = top ? end.high - straight.high : straight.low - end.low};
    if (chamfer.across <= rules_.tolerance || chamfer.across > kWidestChamfer * widths.minCoeff() ||
        chamfer.along > kHighestChamfer * (straight.high - straight.low) ||
        std::max(chamfer.across, chamfer.along) > kGreatestChamfer)
      return {};
    for (const std::size_t i : chain) is_used_[i] = true;
    return chamfer;
  }

  static bool IsConvex(const Contour& contour, double tolerance) {
    if (contour.IsCircle()) return true;
    const std::vector<Vector2>& corners = contour.corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector2 in = (corners[i] - corners[(i + corners.size() - 1) % corners.size()]);
      const Vector2 out = corners[(i + 1) % corners.size()] - corners[i];
      if (in.x() * out.y() - in.y() * out.x() < -tolerance * (in.norm() + out.norm())) return false;
    }
    return true;
  }

  void AddTaper(const Column& column) {
    if (column.is_hole && !column.at_low.IsCircle()) {
      stack_.reason = "a hole that is not round becomes narrower";
    } else if (!IsConvex(column.at_low, rules_.tolerance) ||
               !IsConvex(column.at_high, rules_.tolerance)) {
      stack_.reason = "an outline that is not convex becomes narrower";
    } else {
      Add(column);
    }
  }

  // Returns whether a larger pocket of a solid has taken all of a hole already, as around a boss in
  // the larger pocket. The hole is one of the boss then.
  bool IsInLargerPocket(const Post& hole, int solid, double low, double high) const {
    return std::ranges::any_of(stack_.pockets, [&](const StackPocket& larger) {
      const Post& post = larger.post;
      return larger.solid == solid && post.low <= low + rules_.tolerance &&
             post.high >= high - rules_.tolerance &&
             std::ranges::all_of(hole.at_low.Outline(12), [&](const Vector2& p) {
               return post.at_low.Contains(p) && post.at_high.Contains(p);
             });
    });
  }

  // Cuts a hole from each solid that it goes through.
  void CutHole(const Post& hole) {
    for (std::size_t i = 0; i < stack_.solids.size(); ++i) {
      const Post& solid = stack_.solids[i];
      const double low = std::max(hole.low, solid.low);
      const double high = std::min(hole.high, solid.high);
      if (high - low <= rules_.tolerance || !solid.at_low.Contains(hole.at_low.center) ||
          solid.at_low.Area() <= hole.at_low.Area() ||
          IsInLargerPocket(hole, static_cast<int>(i), low, high))
        continue;
      StackPocket pocket = {.post = hole,
                            .solid = static_cast<int>(i),
                            .reaches_low = low <= solid.low + rules_.tolerance,
                            .reaches_high = high >= solid.high - rules_.tolerance};
      if (hole.is_straight) {
        pocket.post.low = low;
        pocket.post.high = high;
      }
      if (low > hole.low) pocket.post.chamfer_low = {};
      if (high < hole.high) pocket.post.chamfer_high = {};
      stack_.pockets.push_back(std::move(pocket));
    }
  }

  const std::vector<Column>& columns_;
  std::vector<bool> is_used_;  // by a chamfer
  const ColumnRules rules_;
  std::vector<Post> holes_;
  Stack stack_;
};

}  // namespace

// A layer between two similar outlines has the volume of a frustum. A chamfer's outline is taken to
// be similar to that of its post.
double Post::Volume(bool is_hole) const {
  const auto frustum = [](double height, double a, double b) {
    return height * (a + b + std::sqrt(a * b)) / 3;
  };
  const auto end_area = [&](const Contour& contour, double across) {
    const Vector2 sizes = contour.Bounds().sizes();
    const Vector2 end = sizes + Vector2::Constant(is_hole ? 2 * across : -2 * across);
    return contour.Area() * end.prod() / sizes.prod();
  };
  const double low_area = at_low.Area();
  const double high_area = at_high.Area();
  return frustum(Height() - chamfer_low.along - chamfer_high.along, low_area, high_area) +
         frustum(chamfer_low.along, low_area, end_area(at_low, chamfer_low.across)) +
         frustum(chamfer_high.along, high_area, end_area(at_high, chamfer_high.across));
}

bool Post::Contains(const Vector3& p) const {
  if (p.z() < low || p.z() > high) return false;
  if (is_straight) return at_low.Contains(p.head<2>());
  const double share = (p.z() - low) / Height();
  const Vector2 center = at_low.center + share * (at_high.center - at_low.center);
  const Vector2 to = p.head<2>() - center;
  return to.norm() <= (1 - share) * at_low.Reach(to) + share * at_high.Reach(to);
}

std::size_t Stack::Cost() const {
  return Count() +
         static_cast<std::size_t>(std::ranges::count_if(pockets, [](const StackPocket& pocket) {
           return pocket.post.mouth && !(pocket.reaches_low && pocket.reaches_high);
         }));
}

double Stack::Volume() const {
  double volume = 0;
  for (const Post& solid : solids) volume += solid.Volume(false);
  for (const StackPocket& pocket : pockets) volume -= pocket.post.Volume(true);
  return volume;
}

Stack StackOf(const std::vector<Column>& columns, const ColumnRules& rules) {
  return StackBuilder(columns, rules).Build();
}

}  // namespace assay::mesh_import
