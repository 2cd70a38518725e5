#include "sim/cli/tasks/body_export.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/domain/parts/part_file.h"
#include "sim/check/measurements/effective_clearance.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/options/file_format.h"
#include "sim/cli/plan_output/part_report.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/scenario/scenario.h"
#include "sim/scene/exchange/exported_body.h"

namespace assay::cli {
namespace {

namespace fs = std::filesystem;

// What is exported: a part, or the two parts of the last mating of a problem.
struct Subject {
  std::string name;
  std::vector<scene::ExportedBody> bodies;
  std::optional<domain::Problem> problem = {};
};

Subject PartSubject(const Document& document, const BodyExport& request) {
  const auto model = domain::PartFile::Read(document, request.clearance_mm / 1000);
  return {model->name(), {{.name = model->name(), .model = model}}};
}

// Returns sentences about the play of the shaft of a pair.
std::vector<std::string> PlaysOf(const Subject& subject) {
  if (!subject.problem) return {};
  const Progress progress("measuring the play in the engine");
  const domain::Problem& problem = *subject.problem;
  const std::string mjcf = scene::BodiesToMjcf(subject.name, subject.bodies);
  const domain::MatingId mating(problem.matings.size() - 1);
  const std::string held = problem.part(problem.mating(mating).held).name;
  const std::string fixed = problem.part(problem.mating(mating).fixed).name;
  std::vector<std::string> plays;
  for (const check::Play& play : check::ExportedClearance(problem, mating, mjcf)) {
    plays.push_back(fmt::format(
        "play of {} in {} along {}: {:.4f} mm as drawn, {:.4f} mm measured in MuJoCo", held, fixed,
        DirectionText(play.axis), 1000 * play.nominal, 1000 * play.measured));
  }
  return plays;
}

Subject PairSubject(const Document& document, const BodyExport& request) {
  domain::Problem problem = scenario::ReadWorlds(document, request.models).front();
  if (problem.matings.empty()) {
    throw UsageError(fmt::format("export: {}: no goal mates parts", request.input.string()));
  }
  std::vector<scene::ExportedBody> bodies = scene::ExportedPair(problem, problem.matings.back());
  return {problem.name, std::move(bodies), std::move(problem)};
}

Subject SubjectOf(const BodyExport& request) {
  const bool is_folder = fs::is_directory(request.input);
  const Document document = Document::Load(is_folder ? request.input / "part.yaml" : request.input);
  switch (FormatOf(document)) {
    case FileFormat::kPartFile:
      return PartSubject(document, request);
    case FileFormat::kScenarioFile:
      return PairSubject(document, request);
    default:
      throw UsageError(
          fmt::format("export: {} is neither a part nor a scenario", request.input.string()));
  }
}

std::string WithComment(const std::vector<std::string>& plays, const std::string& mjcf) {
  std::string text;
  for (const std::string& play : plays) text += fmt::format("<!-- {} -->\n", play);
  return text + mjcf;
}

// Returns the file that was asked for, and after it the files to which it refers.
std::vector<scene::ExportedFile> FilesOf(const Subject& subject, const BodyExport& request) {
  const std::string name = request.output.empty() ? subject.name : request.output.stem().string();
  switch (request.format) {
    case BodyExport::Format::kMjcf:
      return {{"", scene::BodiesToMjcf(name, subject.bodies)}};
    case BodyExport::Format::kUrdf:
      return scene::BodiesToUrdf(name, subject.bodies);
    case BodyExport::Format::kObj:
      return {{"", scene::BodiesToObj(subject.bodies)}};
  }
  return {};
}

}  // namespace

void ExportBodies(const BodyExport& request) {
  const Subject subject = SubjectOf(request);
  std::vector<scene::ExportedFile> files = FilesOf(subject, request);
  if (request.output.empty() && files.size() > 1) {
    throw UsageError("export: --urdf needs a file for each piece that is no box; --output FILE");
  }
  const std::vector<std::string> plays = PlaysOf(subject);
  if (request.format == BodyExport::Format::kMjcf) {
    files.front().text = WithComment(plays, files.front().text);
  }
  if (request.output.empty()) return Print(files.front().text);
  WriteFile(request.output, files.front().text);
  for (std::size_t i = 1; i < files.size(); ++i) {
    WriteFile(request.output.parent_path() / files[i].name, files[i].text);
  }
  for (const std::string& play : plays) Print(play + "\n");
}

}  // namespace assay::cli
