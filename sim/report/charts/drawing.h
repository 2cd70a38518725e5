#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/report/html/element.h"

namespace assay::report {

// What the charts draw with. Lengths are pixels; y grows downwards.

// Returns an empty drawing. `words` say what it shows to people who cannot see it.
Element Drawing(double width, double height, const std::string& words);

// `kind` is a class of the style sheet.
void AddLine(Element& svg, std::string_view kind, double x1, double y1, double x2, double y2);
void AddBox(Element& svg, std::string_view kind, double x, double y, double width, double height);
// `anchor` is "start", "middle" or "end".
void AddWords(Element& svg, std::string_view anchor, double x, double y, std::string_view words);

// An interval of numbers that is drawn from one position to another.
struct Axis {
  double low = 0, high = 1;
  double left = 0, right = 1;  // pixels, where the interval's ends are drawn

  // Numbers outside the interval are drawn at its ends.
  double At(double value) const;
};

// Returns at most `most` round numbers on the axis. Their step is 1, 2 or 5 times a power of ten.
std::vector<double> Ticks(const Axis& axis, int most);

}  // namespace assay::report
