#include "planner/mesh_import/sections/stepped_columns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "planner/mesh_import/sections/narrows.h"
#include "planner/mesh_import/sections/nearly_even.h"
#include "planner/mesh_import/sections/section_reader.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kMostSteppedLevels = 3000;
constexpr int kMostPartsOfLayer = 64;
constexpr double kThinnestStep = 1e-4;  // metres, as a part file permits
constexpr double kRoughness = 0.125;    // of the outline of a step, as a share of the step

// The part of a mesh between two neighbouring levels.
struct Layer {
  double low = 0;
  double high = 0;
  Curves bottom;
  Curves top;
  std::vector<Column> even;  // its columns, if the part of the mesh is even

  bool IsEven() const { return !even.empty(); }
};

double MaterialOf(const Curves& curves) {
  double area = 0;
  for (const Column& curve : curves) area += (curve.is_hole ? -1 : 1) * curve.at_low.Area();
  return area;
}

bool AreAlike(const Curves& a, Curves b, double within) {
  if (a.size() != b.size()) return false;
  return std::ranges::all_of(a, [&](const Column& curve) {
    const auto match = MostAlike(curve, b);
    if (match == b.end() || !AreEqual(curve.at_low, match->at_low, within)) return false;
    b.erase(match);
    return true;
  });
}

class StepBuilder {
 public:
  StepBuilder(const TriangleMesh& mesh, const ColumnRules& rules)
      : rules_(rules), reader_(mesh, rules), levels_(LevelsOf(mesh, rules.tolerance)) {}

  Columns Build() {
    if (levels_.size() < 2 || levels_.size() > kMostSteppedLevels)
      return {.columns = {}, .reason = "it has no steps"};
    for (std::size_t i = 1; i < levels_.size(); ++i)
      layers_.push_back(LayerBetween(levels_[i - 1], levels_[i]));
    begin_ = layers_.front().low;
    for (std::size_t i = 0; i < layers_.size();) {
      const std::size_t count = layers_[i].IsEven() ? 0 : CountFrom(i);
      if (layers_[i].IsEven()) AddEven(layers_[i]);
      if (!layers_[i].IsEven() && count == 0) AddInParts(layers_[i]);
      if (count > 0) AddRun(i, count);
      i += std::max<std::size_t>(count, 1);
    }
    // What is left is thinner than a step.
    for (Column& column : result_.columns) {
      if (column.high == begin_) column.high = layers_.back().high;
    }
    FillNarrows(result_.columns);
    return std::move(result_);
  }

 private:
  Layer LayerBetween(const Level& below, const Level& above) const {
    auto [bottom, top] = reader_.EndsBetween(below, above);
    Layer layer{.low = below.Middle(),
                .high = above.Middle(),
                .bottom = std::move(bottom),
                .top = std::move(top),
                .even = {}};
    LayerColumns columns = ColumnsOfLayer(layer.bottom, layer.top, rules_.tolerance);
    if (columns.reason.empty() && IsEven(columns.columns, layer.high - layer.low))
      layer.even = std::move(columns.columns);
    return layer;
  }

  // A thin layer whose columns taper is one facet of a rounded edge. One that hardly tapers is
  // nearly even.
  bool IsEven(const std::vector<Column>& columns, double thickness) const {
    if (thickness < kThinnestStep) return false;
    return std::ranges::all_of(columns, [&](const Column& column) {
      return column.is_straight ||
             (column.at_low.IsCircle() && thickness > rules_.most_step &&
              std::abs(column.at_high.radius - column.at_low.radius) > MostOfNearlyEven(rules_));
    });
  }

  void AddEven(const Layer& layer) {
    for (Column column : layer.even) {
      column.low = begin_;
      column.high = layer.high;
      Append(result_.columns, std::move(column), rules_.tolerance);
    }
    begin_ = layer.high;
  }

  // Returns how many layers one after the other are nearly even, if they are not thin together.
  std::size_t CountOfNearlyEven(std::size_t first) const {
    std::size_t end = first;
    const auto is_alike = [&](const Curves& curves) {
      return AreAlike(layers_[first].bottom, curves, MostOfNearlyEven(rules_));
    };
    while (end < layers_.size() && !layers_[end].IsEven() && is_alike(layers_[end].bottom) &&
           is_alike(layers_[end].top))
      ++end;
    const bool is_thin =
        end == first || layers_[end - 1].high - layers_[first].low <= rules_.most_step;
    return is_thin ? 0 : end - first;
  }

  // Returns how many layers one step can stand for. A step ends before nearly even layers.
  std::size_t CountFrom(std::size_t first) const {
    if (const std::size_t count = CountOfNearlyEven(first); count > 0) return count;
    bool are_alike = true;
    std::size_t end = first;
    for (; end < layers_.size() && !layers_[end].IsEven(); ++end) {
      if (end > first && CountOfNearlyEven(end) > 0) break;
      for (const Curves* curves : {&layers_[end].bottom, &layers_[end].top})
        are_alike = are_alike && AreAlike(layers_[first].bottom, *curves, rules_.most_step);
      if (!are_alike && layers_[end].high - begin_ > rules_.most_step) break;
    }
    return end - first;
  }

  void AddRun(std::size_t first, std::size_t count) {
    std::vector<const Curves*> sections;
    for (std::size_t i = first; i < first + count; ++i) {
      sections.push_back(&layers_[i].bottom);
      sections.push_back(&layers_[i].top);
    }
    AddStep(layers_[first + count - 1].high, sections);
  }

  // Cuts a layer into equally thick steps, in each of which the section changes little.
  void AddInParts(const Layer& layer) {
    std::vector<Curves> sections;
    bool are_alike = false;
    for (int parts = 2; parts <= kMostPartsOfLayer && !are_alike; parts *= 2) {
      sections = {layer.bottom};
      for (int i = 1; i < parts; ++i)
        sections.push_back(reader_.At(layer.low + i * (layer.high - layer.low) / parts));
      sections.push_back(layer.top);
      are_alike = (layer.high - layer.low) / parts <= rules_.most_step ||
                  std::ranges::adjacent_find(sections, [&](const Curves& a, const Curves& b) {
                    return !AreAlike(a, b, rules_.most_step);
                  }) == sections.end();
    }
    const auto parts = static_cast<double>(sections.size() - 1);
    const double low = layer.low;
    for (std::size_t i = 1; i < sections.size(); ++i) {
      AddStep(low + static_cast<double>(i) * (layer.high - low) / parts,
              {&sections[i - 1], &sections[i]});
    }
  }

  // Adds a step up to a height. A step that would be too thin becomes part of the next one.
  void AddStep(double high, const std::vector<const Curves*>& sections) {
    if (high - begin_ < kThinnestStep) return;
    const Curves& least =
        **std::ranges::min_element(sections, {}, [](const Curves* c) { return MaterialOf(*c); });
    const bool is_nearly_even = std::ranges::all_of(sections, [&](const Curves* curves) {
      return AreAlike(least, *curves, MostOfNearlyEven(rules_));
    });
    for (const Column& curve : least) {
      Column column =
          is_nearly_even ? NearlyEvenColumn(curve, sections, rules_) : StepOf(curve, sections);
      column.low = begin_;
      column.high = high;
      if (column.at_low.Bounds().sizes().minCoeff() < kThinnestStep) continue;
      column.at_high = column.at_low;
      Append(result_.columns, std::move(column), rules_.tolerance);
    }
    begin_ = high;
  }

  // Returns a column for sections that differ. It is no step if this curve of theirs is the same.
  Column StepOf(Column column, const std::vector<const Curves*>& sections) const {
    column.is_step = !std::ranges::all_of(sections, [&](const Curves* curves) {
      return std::ranges::any_of(*curves, [&](const Column& other) {
        return other.is_hole == column.is_hole &&
               AreEqual(other.at_low, column.at_low, rules_.tolerance);
      });
    });
    if (column.is_step) column.beyond = MaterialBeyond(column, LikeCurves(column, sections));
    if (column.is_step && !column.at_low.IsCircle())
      column.at_low =
          FitContour(column.at_low.corners, {.tolerance = kRoughness * rules_.most_step});
    return column;
  }

  const ColumnRules rules_;
  const SectionReader reader_;
  const std::vector<Level> levels_;
  std::vector<Layer> layers_;
  double begin_ = 0;  // height up to which the mesh is cut into columns
  Columns result_;
};

}  // namespace

Columns SteppedColumnsOf(const TriangleMesh& mesh, const ColumnRules& rules) {
  return StepBuilder(mesh, rules).Build();
}

}  // namespace assay::mesh_import
