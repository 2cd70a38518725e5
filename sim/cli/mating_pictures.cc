#include "sim/cli/mating_pictures.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "sim/cli/contact_pictures.h"
#include "sim/cli/mating_report.h"
#include "sim/cli/output_file.h"
#include "sim/report/contact_graph_picture.h"

namespace assay::cli {
namespace {

std::string ContentsOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream contents;
  contents << in.rdbuf();
  return contents.str();
}

// "peg into block".
std::string TitleOf(const PicturedMating& pictured) {
  const domain::Problem& problem = pictured.planned.problem;
  return fmt::format("{} into {}", problem.part(pictured.mating.held).name,
                     problem.part(pictured.mating.fixed).name);
}

}  // namespace

std::vector<std::string> WriteMatingPictures(const std::filesystem::path& folder,
                                             const PicturedMating& pictured) {
  const auto& [planned, mating, geometry, topology, plan, strategy] = pictured;
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  std::vector<ContactPicture> states =
      WriteContactPictures(folder, planned.problem, scene, mating, strategy);
  std::vector<std::string> files;
  for (const ContactPicture& picture : states) files.push_back(picture.file);
  states.pop_back();  // all of them
  report::MatingSubject subject{
      .title = TitleOf(pictured),
      .summary = SummaryOf(geometry, plan),
      .graph = report::ContactGraphPicture(topology, check::PlannedContactsOf(plan)),
      .motions = MotionsOf(plan)};
  for (const ContactPicture& picture : states)
    subject.pictures.push_back({picture.caption, ContentsOf(folder / picture.file)});
  WriteFile(folder / "graph.svg", report::SvgFile(subject.graph));
  WriteFile(folder / "index.html", report::MatingPage(std::move(subject)));
  files.insert(files.end(), {"graph.svg", "index.html"});
  return files;
}

}  // namespace assay::cli
