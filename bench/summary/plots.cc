#include "bench/summary/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "bench/summary/comparison.h"
#include "bench/summary/growth.h"

namespace assay::bench {
namespace {

// Names are "noenhanced", since gnuplot otherwise reads "_" and similar characters as typesetting.
constexpr const char* kStyle = "set encoding utf8\nset grid\n";

// All panels leave the same room for their legends, in one column. Otherwise each legend would take
// room from its panel.
constexpr const char* kPanelStyle =
    "set key outside right top maxcols 1\nset rmargin at screen 0.66\n";

// Draws one row of dots for each family: the ratio of each instance to its best peer.
void DrawRatios(std::string& out, const std::vector<Family>& families) {
  out += "$ratios << END\n";
  for (std::size_t i = 0; i < families.size(); ++i) {
    for (const double ratio : Ratios(families[i], "")) {
      out += fmt::format("{:.6g} {}\n", ratio, families.size() - i);
    }
  }
  out += "END\n";
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < families.size(); ++i) {
    labels.push_back(fmt::format("\"{}\" {}", families[i].name, families.size() - i));
  }
  out += fmt::format(
      "set terminal svg size 900,{} dynamic background 'white'\nset output 'ratios.svg'\n"
      "set logscale x\nset xlabel 'time of the best peer over assay'\nset ytics noenhanced ({})\n"
      "set yrange [0.5:{}.5]\nset arrow from 1, graph 0 to 1, graph 1 nohead dashtype 2\n"
      "plot $ratios using 1:2 with points pointtype 6 notitle\nreset\n",
      140 + 40 * families.size(), fmt::join(labels, ", "), families.size());
}

// Draws a panel for each program, since sizes of different programs are not comparable.
void DrawGrowths(std::string& out, const std::vector<Growth>& growths) {
  std::vector<std::pair<std::string, std::vector<std::string>>> panels;
  for (std::size_t i = 0; i < growths.size(); ++i) {
    out += fmt::format("$curve{} << END\n", i);
    for (const Growth::Point& point : growths[i].points) {
      out += fmt::format("{:.6g} {:.6g}\n", point.size, point.seconds);
    }
    out += "END\n";
    if (panels.empty() || panels.back().first != growths[i].program) {
      panels.push_back({growths[i].program, {}});
    }
    const std::string of = growths[i].of.empty() ? "" : ", " + growths[i].of;
    panels.back().second.push_back(
        fmt::format("$curve{} with linespoints title '{}{} ({:.2f})' noenhanced", i,
                    growths[i].name, of, growths[i].Exponent()));
  }
  out += kStyle;
  out += kPanelStyle;
  out += fmt::format(
      "set terminal svg size 1000,{0} dynamic background 'white'\nset output 'growth.svg'\n"
      "set logscale xy\nset xlabel 'size'\nset ylabel 'seconds'\nset format y '10^{{%L}}'\n"
      "set multiplot layout {1},1\n",
      320 * panels.size(), panels.size());
  for (const auto& [program, curves] : panels) {
    out +=
        fmt::format("set title '{}' noenhanced\nplot {}\n", program, fmt::join(curves, ", \\\n  "));
  }
  out += "unset multiplot\n";
}

}  // namespace

std::string PlotScript(const Measurements& measurements) {
  std::string out = kStyle;
  const std::vector<Family> families = Families(measurements);
  const auto has_ratios = [](const Family& family) { return !Ratios(family, "").empty(); };
  if (std::ranges::any_of(families, has_ratios)) DrawRatios(out, families);
  const std::vector<Growth> growths = Growths(measurements);
  if (!growths.empty()) DrawGrowths(out, growths);
  return out;
}

}  // namespace assay::bench
