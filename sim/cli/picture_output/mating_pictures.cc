#include "sim/cli/picture_output/mating_pictures.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "sim/cli/mating_output/fine_motion_report.h"
#include "sim/cli/picture_output/contact_graphs.h"
#include "sim/cli/picture_output/contact_pictures.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/report/fine_motion/contact_graph_picture.h"

namespace assay::cli {
namespace {

std::string ContentsOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream contents;
  contents << in.rdbuf();
  return contents.str();
}

// Returns "peg into block".
std::string TitleOf(const PicturedMating& pictured) {
  const domain::Problem& problem = pictured.planned.problem;
  return fmt::format("{} into {}", problem.part(pictured.mating.held).name,
                     problem.part(pictured.mating.fixed).name);
}

}  // namespace

std::vector<std::string> WriteMatingPictures(const std::filesystem::path& folder,
                                             const PicturedMating& pictured) {
  const auto& [planned, mating, geometry, chain, plan, strategy, study] = pictured;
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  std::vector<ContactPicture> states =
      WriteContactPictures(folder, planned.problem, scene, mating, strategy);
  std::vector<std::string> files;
  for (const ContactPicture& picture : states) files.push_back(picture.file);
  states.pop_back();  // the last picture shows all states
  report::MatingSubject subject{.title = TitleOf(pictured),
                                .summary = SummaryOf(geometry, plan),
                                .graphs = ContactGraphs(chain, plan),
                                .motions = MotionsOf(plan)};
  if (study) subject.trials = TrialsOf(*study);
  int number = 0;
  for (const ContactPicture& picture : states)
    subject.pictures.push_back({picture.caption, ContentsOf(folder / picture.file)});
  for (const report::Element& graph : subject.graphs) {
    const std::string file = fmt::format("graph-{}.svg", ++number);
    WriteFile(folder / file, report::SvgFile(graph));
    files.push_back(file);
  }
  WriteFile(folder / "index.html", report::MatingPage(std::move(subject)));
  files.emplace_back("index.html");
  return files;
}

}  // namespace assay::cli
