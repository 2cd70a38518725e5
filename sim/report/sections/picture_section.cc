#include <fmt/format.h>

#include <array>

#include "sim/report/html/data_uri.h"
#include "sim/report/sections/section.h"

namespace assay::report {

Element Pictures(const Findings& findings, const std::function<std::string(int trial)>& picture) {
  const NotableTrials& notable = findings.notable;
  const std::array trials = {std::pair("best", notable.best), std::pair("typical", notable.typical),
                             std::pair("worst", notable.worst)};
  Element section("div");
  section.Add("p",
              "The pictures show the end of every step in a repeated execution. Trials are ordered "
              "by success, then by their worst verdict, then by the least margin. The typical "
              "trial is in the middle of this order.");
  for (const auto& [name, trial] : trials) {
    if (trial == 0) continue;
    const std::string words = fmt::format("The {} trial, number {}", name, trial);
    Element& figure = section.Add("figure");
    figure.Add("img")
        .Set("src", DataUri("image/png", picture(trial)))
        .Set("alt", words + ": the parts and the arm at the start and at the end of each step");
    figure.Add("figcaption", words);
  }
  return section;
}

}  // namespace assay::report
