#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "planner/base/counted.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/quotation.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/matings/seat.h"
#include "planner/domain/parts/part_file.h"
#include "planner/geometry/pose.h"
#include "planner/mesh_import/parts/account.h"
#include "planner/mesh_import/parts/mated_pair.h"
#include "planner/mesh_import/parts/mated_scenario.h"
#include "planner/mesh_import/parts/part_import.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/tasks/output_file.h"

namespace assay::cli {
namespace import_verb {

namespace fs = std::filesystem;
using geometry::Matrix3;
using geometry::Vector2;
using geometry::Vector3;
using mesh_import::MeshUnit;

struct Options {
  std::vector<fs::path> files;
  fs::path folder;
  mesh_import::ImportOptions import;
  bool has_sides = false;
  bool mated = false;
  bool replace = false;
};

const std::map<std::string, MeshUnit>& Units() {
  static const std::map<std::string, MeshUnit> units = [] {
    std::map<std::string, MeshUnit> names;
    for (const MeshUnit unit :
         {MeshUnit::kMetre, MeshUnit::kCentimetre, MeshUnit::kMillimetre, MeshUnit::kInch})
      names.emplace(mesh_import::Name(unit), unit);
    return names;
  }();
  return units;
}

void RequireName(const std::string& name) {
  const auto is_good = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  if (!name.empty() && std::ranges::all_of(name, is_good)) return;
  throw UsageError(
      fmt::format("import: {} cannot name a part; allowed: letters, digits, - and _", Quote(name)));
}

// Returns the last name of a path to a folder.
std::string LastName(const fs::path& path) {
  const fs::path folder = fs::absolute(path).lexically_normal();
  return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

void RefuseToOverwrite(const fs::path& file, bool replace) {
  std::error_code error;
  if (replace || !fs::exists(fs::symlink_status(file, error))) return;
  throw UsageError(fmt::format("import: {} is there already; allowed: another folder, or --replace",
                               Quote(file.string())));
}

// Writes the files of a part's folder, and returns a text about the part for people.
std::string WritePart(const mesh_import::ImportedPart& part, const fs::path& folder) {
  std::string text;
  for (const std::string& sentence : mesh_import::AccountOf(part)) text += sentence + "\n";
  for (std::size_t i = 0; i < part.sketch.features.size(); ++i)
    text += fmt::format("Feature {}: {}.\n", i + 1, part.sketch.features[i].what);
  MakeFolder(folder);
  const auto write = [&](const std::string& file, const std::string& contents) {
    WriteFile(folder / file, contents);
    text += fmt::format("{}\n", (folder / file).string());
  };
  for (const auto& [file, contents] : part.PieceFiles()) write(file, contents);
  write("part.yaml", part.PartFile());
  write("README.md", mesh_import::ReadmeText(part));
  return text;
}

mesh_import::ImportedPart Read(const std::vector<fs::path>& files, const std::string& name,
                               const Options& options) {
  const Progress progress("reading the meshes");
  return mesh_import::Import(files, name, options.import);
}

std::string WorkText(int triangles, int pieces, double seconds) {
  return fmt::format("{} became {} in {:.1f} s.\n", Counted(triangles, "triangle"),
                     Counted(pieces, "piece"), seconds);
}

ExitCode ImportPart(const Options& options) {
  const std::string name = LastName(options.folder);
  RequireName(name);
  RefuseToOverwrite(options.folder / "part.yaml", options.replace);
  const Stopwatch watch;
  const mesh_import::ImportedPart part = Read(options.files, name, options);
  const double seconds = watch.Seconds();
  Print(WritePart(part, options.folder) + WorkText(part.triangles, part.Pieces(), seconds));
  return ExitCode::kDone;
}

// Returns how far the held part of a pair is from its seat, in metres. It is 0 if the part is
// seated already, or if no seat is near, and negative if the parts overlap in their files.
double WayToSeat(const mesh_import::MatedPair& pair, const domain::PartModel& held,
                 const domain::PartModel& fixed) {
  constexpr double kFarthestSeat = 1e-3;  // metres
  const double way =
      domain::WayToSeat(held, fixed, pair.X_FixedHeld(), pair.MatingDirection(), kFarthestSeat)
          .value_or(0);
  return way >= 0 && way <= domain::kSeatGap ? 0 : way;
}

// Returns the text of a pose on the table with the middle of the part at x and y. It is the stable
// pose in which `down`, a direction of the part, points down as nearly as possible. The part is
// turned about the vertical as if the shortest turn had pointed that direction down.
std::string StablePoseText(const domain::PartModel& model, const Vector3& down, const Vector2& at) {
  const auto& poses = model.stable_poses();
  if (poses.empty()) return "{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]]}";
  const domain::StablePose& pose = *std::ranges::min_element(
      poses, {}, [&](const domain::StablePose& p) { return (p.X_TablePart.linear() * down).z(); });
  const Matrix3 R_TablePart = pose.X_TablePart.linear();
  const Matrix3 shortest = Eigen::Quaterniond::FromTwoVectors(
                               R_TablePart.transpose() * -Vector3::UnitZ(), -Vector3::UnitZ())
                               .toRotationMatrix();
  const Vector3 x = shortest * R_TablePart.transpose() * Vector3::UnitX();
  const double yaw = std::atan2(x.y(), x.x());
  Eigen::AlignedBox3d bounds;
  for (const Vector3& corner : model.corners())
    bounds.extend(geometry::RotationZ(yaw) * pose.X_TablePart * corner);
  const Vector2 origin = (at - bounds.center().head<2>()) / kLengthUnit.factor;
  return fmt::format("{{stable: {}, at: [{:.6g}, {:.6g}], yaw: {:.6g}}}", pose.label, origin.x(),
                     origin.y(), yaw / kDegree + 0.0);
}

// Imports two parts and writes a scenario beside the folder of models that holds them.
ExitCode ImportPair(const Options& options) {
  if (options.files.size() != 2 || options.files[0].stem() == options.files[1].stem())
    throw UsageError("import: --mated needs two files with different names");
  std::vector<mesh_import::ImportedPart> parts;
  const Stopwatch watch;
  for (const fs::path& file : options.files) {
    RequireName(file.stem().string());
    RefuseToOverwrite(options.folder / "models/parts" / file.stem() / "part.yaml", options.replace);
    parts.push_back(Read({file}, file.stem().string(), options));
  }
  std::optional<mesh_import::MatedPair> pair = mesh_import::FindMating(parts[0], parts[1]);
  if (!pair) {
    throw InputError({options.files[0].string()},
                     fmt::format("no shaft of it is in a hole of {}, nor the other way round",
                                 options.files[1].string()),
                     "two parts in their assembled pose");
  }
  if (!options.has_sides) {
    const int sides = mesh_import::SidesFor(*pair);
    for (mesh_import::ImportedPart& part : parts) part.options.sides = sides;
  }
  const double seconds = watch.Seconds();
  const fs::path scenario = options.folder / fmt::format("{}-into-{}.yaml", pair->held->sketch.name,
                                                         pair->fixed->sketch.name);
  RefuseToOverwrite(scenario, options.replace);
  std::string text;
  for (const mesh_import::ImportedPart& part : parts)
    text += WritePart(part, options.folder / "models/parts" / part.sketch.name);
  const auto model_of = [&](const mesh_import::ImportedPart& part) {
    return domain::PartFile::Load(options.folder / "models/parts" / part.sketch.name / "part.yaml",
                                  0);
  };
  const auto held = model_of(*pair->held);
  const auto fixed = model_of(*pair->fixed);
  pair->way_to_seat = WayToSeat(*pair, *held, *fixed);
  for (const std::string& sentence : mesh_import::AccountOf(*pair)) text += sentence + "\n";
  const auto pose = [&](const mesh_import::ImportedPart& part, const Vector3& down,
                        const Vector2& at) {
    return StablePoseText(&part == pair->held ? *held : *fixed, down, at);
  };
  WriteFile(scenario, mesh_import::ScenarioText(*pair, pose));
  text += fmt::format("{}\n", scenario.string());
  Print(text + WorkText(parts[0].triangles + parts[1].triangles,
                        parts[0].Pieces() + parts[1].Pieces(), seconds));
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("files", options->files,
                  "STL, OBJ, COLLADA or STEP files, each with bodies of the part, in one frame and "
                  "one unit")
      ->required();
  command
      .add_option("-o,--output", options->folder,
                  "folder of the part, models/parts/NAME; its last name is the part's")
      ->required();
  command
      .add_option("--units", options->import.unit,
                  "unit of the files: m, cm, mm or inch; left out: m for sizes up to 1, else mm")
      ->transform(CLI::CheckedTransformer(Units()));
  command.add_option("--density", options->import.material.density, "of the part, kg/m^3")
      ->check(Within({1, 1e5}, kRatioUnit))
      ->capture_default_str();
  command
      .add_option("--friction", options->import.material.friction, "of its material against itself")
      ->check(Within({0.001, 10}, kRatioUnit))
      ->capture_default_str();
  const CLI::Option* const sides =
      command
          .add_option("--sides", options->import.sides,
                      "of the polygons that stand for circles, a multiple of 4; with --mated as "
                      "many as the gap needs, if left out")
          ->check(CLI::Range(8, 256))
          ->check([](const std::string& text) {
            return std::stoi(text) % 4 == 0 ? std::string() : Quote(text) + " is no multiple of 4";
          })
          ->capture_default_str();
  command.add_flag("--mated", options->mated,
                   "two files are two parts in their assembled pose: -o is a folder for a scenario "
                   "and its models");
  command.add_flag("--replace", options->replace, "write into a folder that has a part already");
  return [options, sides] {
    options->has_sides = sides->count() > 0;
    return options->mated ? ImportPair(*options) : ImportPart(*options);
  };
}

}  // namespace import_verb

const Verb kImport = {
    .name = "import",
    .summary = "makes a part of STL, OBJ, COLLADA or STEP files",
    .page = "sim/importing.md",
    .example =
        "assay import peg.stl -o models/parts/peg --density 8000\n"
        "  assay import peg.obj hole.obj --mated -o own",
    .declare = import_verb::Declare,
};

}  // namespace assay::cli
