#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "planner/base/check.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"
#include "planner/base/input_files/quotation.h"
#include "planner/domain/workcell/arm_site.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/arm_options.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/own_workcell.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace init_verb {

namespace fs = std::filesystem;

struct Options : ArmOptions {
  fs::path folder;
  fs::path robot;  // a URDF file; empty for the arm that comes with the program
};

// The user's arm, and where it stands.
struct StandingArm {
  std::string name;
  kinematics::ArmInFile arm;
  domain::ArmSite site;
};

constexpr const char* kScenario = "plate-on-stud.yaml";
constexpr const char* kSweep = "clearances.yaml";
// The files of the folder scenarios/start of the program, which are copied.
constexpr std::array kFiles = {"README.md", kScenario, "models/parts/stud/part.yaml",
                               "models/parts/plate/part.yaml", kSweep};
constexpr std::size_t kMostBytes = std::size_t{1} << 20;

fs::path StartFolder() {
  const fs::path models = scenario::ModelsOfTheProgram();
  if (models.empty()) throw EnvironmentError("the files that come with the program are missing");
  return models.parent_path() / "scenarios/start";
}

// The texts of the files to write, by their paths below the folder.
using Files = std::vector<std::pair<fs::path, std::string>>;

Files StartFiles() {
  const fs::path start = StartFolder();
  Files files;
  for (const char* file : kFiles) {
    files.emplace_back(file, ReadInput(start / file, "a file of the program", kMostBytes));
  }
  return files;
}

void ReplaceIn(const std::string& from, const std::string& to, std::string& text) {
  const std::size_t at = text.find(from);
  ASSAY_CHECK(at != std::string::npos, "the template lacks '{}'", from);
  text.replace(at, from.size(), to);
}

// Returns the name of the URDF file as the name of a workcell: small letters, digits and hyphens.
std::string WorkcellName(const fs::path& robot) {
  std::string name = robot.stem().string();
  for (char& c : name) {
    const auto letter = static_cast<unsigned char>(c);
    c = std::isalnum(letter) != 0 ? static_cast<char>(std::tolower(letter)) : '-';
  }
  return name + "-table";
}

// Returns the path to `to` as a file in `folder` names it.
std::string PathFrom(const fs::path& folder, const fs::path& to) {
  return fs::absolute(to).lexically_normal().lexically_relative(
      fs::absolute(folder).lexically_normal());
}

// Finds where the arm stands. Of an arm with seven joints, the joint that is best to lock is locked
// at the first value with which no other one gives a much larger square. Solutions that could be
// told apart stay so.
StandingArm PlaceArm(const Options& options, const kinematics::Gripper& gripper) {
  const kinematics::RobotModel model =
      kinematics::ReadUrdf(options.robot, kinematics::UrdfContents::kBodies, options.packages);
  constexpr double kMuchLarger = 1.3;
  std::optional<StandingArm> best;
  bool best_tells_apart = false;
  for (const kinematics::LockedJoints& locked :
       kinematics::Lockings(model, options.arm.base, options.arm.flange)) {
    kinematics::ArmInFile in_file = options.arm;
    in_file.locked = locked;
    const bool is_other_joint = best && !locked.contains(best->arm.locked.begin()->first);
    if (is_other_joint) continue;
    const auto arm = kinematics::Arm::FromModel(model, in_file);
    if (best && best_tells_apart && !arm.IndicatorsTellAllApart()) break;
    const auto site = domain::FindArmSite(arm, gripper);
    if (!site || (best && site->half_side < kMuchLarger * best->site.half_side)) continue;
    best = {arm.model().name, in_file, *site};
    best_tells_apart = arm.IndicatorsTellAllApart();
  }
  if (best) return *best;
  throw InputError({options.robot.string()},
                   "the arm reaches no square of 20 cm with its tool straight down",
                   "a longer arm, because the gripper reaches below its flange");
}

// Adds a workcell with the user's arm, and puts the parts of the scenario where the arm reaches.
void UseOwnArm(const Options& options, Files& files) {
  const fs::path gripper = scenario::ModelsOfTheProgram() / "grippers/parallel-jaw/gripper.urdf";
  const StandingArm standing = PlaceArm(options, kinematics::Gripper::FromUrdf(gripper));
  const std::string name = WorkcellName(options.robot);
  const fs::path folder = fs::path("models/workcells") / name;
  OwnArm own = {.name = standing.name,
                .urdf = PathFrom(options.folder / folder, options.robot),
                .gripper = PathFrom(options.folder / folder, gripper),
                .arm = standing.arm};
  for (const fs::path& package : options.packages) {
    own.packages.push_back(PathFrom(options.folder / folder, package));
  }
  files.emplace_back(folder / "workcell.yaml", WorkcellText(own, standing.site));
  const auto scenario = std::ranges::find(files, fs::path(kScenario), &Files::value_type::first);
  const double x = 1e3 * standing.site.middle.x();
  const double y = 0.7e3 * standing.site.half_side;
  ReplaceIn("workcell: puma762-table", "workcell: " + name, scenario->second);
  ReplaceIn("at: [600, 50]", fmt::format("at: [{:.0f}, {:.0f}]", x, y), scenario->second);
  ReplaceIn("at: [500, -200]", fmt::format("at: [{:.0f}, {:.0f}]", x, -y), scenario->second);
}

// Nothing is written if anything is there.
void RefuseToOverwrite(const fs::path& folder, const Files& files) {
  for (const auto& [file, text] : files) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(folder / file, error))) continue;
    throw UsageError(fmt::format("init: {} is there already; allowed: a folder without it",
                                 Quote((folder / file).string())));
  }
}

ExitCode Execute(const Options& options) {
  const fs::path& folder = options.folder;
  Files files = StartFiles();
  if (!options.robot.empty()) UseOwnArm(options, files);
  RefuseToOverwrite(folder, files);
  std::string text;
  for (const auto& [file, content] : files) {
    MakeFolder((folder / file).parent_path());
    WriteFile(folder / file, content);
    text += fmt::format("{}\n", (folder / file).string());
  }
  text += fmt::format(
      "\nNow try:\n  assay plan {0}/{1}\n  assay run {0}/{1} --noise uniform --trials 4\n  assay "
      "sweep {0}/{2}\n{0}/README.md describes the files.\n",
      folder.string(), kScenario, kSweep);
  Print(text);
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option(
          "folder", options->folder,
          "folder for the files, which is made if it does not exist; no file is overwritten")
      ->required();
  command.add_option("--robot", options->robot,
                     "URDF file of your own arm, for which a workcell is written");
  AddArmOptions(command, *options);
  return [options] { return Execute(*options); };
}

}  // namespace init_verb

const Verb kInit = {
    .name = "init",
    .summary = "writes a template for your own assembly, and a workcell for your own arm",
    .page = "scenarios/your-own-part.md",
    .example =
        "assay init own\n  assay plan own/plate-on-stud.yaml\n  assay init own --robot arm.urdf",
    .declare = init_verb::Declare,
};

}  // namespace assay::cli
