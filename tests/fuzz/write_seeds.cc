// write_seeds FOLDER writes the seeds FOLDER/TARGET/* of every fuzz target. They are the
// repository's own files, and what the planner makes of them.

#include <algorithm>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "planner/assembly/certified_plan.h"
#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/language/externs.h"
#include "planner/contingent/pks_and_pddl/pddl_text.h"
#include "planner/contingent/pks_and_pddl/pks_file.h"
#include "planner/contingent/plan_tree/tree_file.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/plan/plan_files/plan_file.h"
#include "sim/sweep/database/store.h"
#include "tests/fuzz/reader_input.h"
#include "tests/sim/sweep/false_work.h"

namespace assay::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ASSAY_SOURCE_DIR;

std::vector<fs::path> FilesUnder(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::string ContentsOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}

  void Write(const std::string& target, const std::string& text) {
    const fs::path folder = folder_ / target;
    fs::create_directories(folder);
    std::ofstream(folder / std::to_string(++count_), std::ios::binary) << text;
  }

  void Copy(const std::string& target, const fs::path& folder, const std::string& extension) {
    for (const fs::path& file : FilesUnder(kRoot / folder, extension)) {
      Write(target, ContentsOf(file));
    }
  }

 private:
  fs::path folder_;
  int count_ = 0;
};

void WritePlan(Seeds& seeds) {
  const fs::path scenario = kRoot / "scenarios" / "uncertain-known.yaml";
  const domain::Problem problem = domain::ReadProblem(Document::Load(scenario), kModels);
  const plan::PlanResult result = assembly::MakeCertifiedPlan(problem, {}, {});
  seeds.Write("plan", plan::ToJson(result, problem, scenario.string()).dump());
}

// Returns the domain files of the folder. The key is the name of the domain.
std::map<std::string, fs::path> PksDomains() {
  std::map<std::string, fs::path> domains;
  for (const fs::path& file : FilesUnder(kRoot / "scenarios" / "know", ".pks")) {
    try {
      domains[contingent::ReadPksDomain(ContentsOf(file), file.string()).name] = file;
    } catch (const InputError&) {  // the file is a problem
    }
  }
  return domains;
}

void WriteTask(Seeds& seeds, const fs::path& domain, const fs::path& problem) {
  const std::string domain_text = ContentsOf(domain);
  const std::string problem_text = ContentsOf(problem);
  seeds.Write("pks", domain_text + std::string(kBetweenTexts) + problem_text);
  contingent::Externs externs;
  const contingent::GroundTask task =
      contingent::Ground(contingent::ReadPksDomain(domain_text, "domain.pks"),
                         contingent::ReadPksProblem(problem_text, "problem.pks"), externs);
  if (problem.stem() == "two-cans") {
    Budget budget(100'000);
    const contingent::ContingentPlan plan =
        contingent::MakePlan(task, contingent::Wanted::kFirst, budget);
    seeds.Write("tree", contingent::ToJson(task, plan.tree).dump());
  }
  const contingent::PddlFiles pddl = contingent::ToPddl(task, "seed");
  seeds.Write("pddl", pddl.domain + std::string(kBetweenTexts) + pddl.problem);
}

void WriteKnowledge(Seeds& seeds) {
  const std::map<std::string, fs::path> domains = PksDomains();
  for (const fs::path& file : FilesUnder(kRoot / "scenarios" / "know", ".pks")) {
    try {
      const auto problem = contingent::ReadPksProblem(ContentsOf(file), file.string());
      WriteTask(seeds, domains.at(problem.domain), file);
      // The file is a domain, or contingent PDDL cannot express the task.
    } catch (const InputError&) {
    }
  }
}

void WriteDatabase(Seeds& seeds) {
  const std::string text =
      "format: assay-sweep/1\nscenarios: [uncertain-known.yaml]\nnoise: [none, uniform]\n"
      "trials: 2\n";
  const fs::path scenarios = kRoot / "scenarios";
  const sweep::Sweep sweep =
      sweep::ReadSweep(Document::Parse(text, "sweep.yaml"), scenarios / "sweep.yaml", text);
  const fs::path file = ScratchFile("seed.sqlite");
  sweep::Store store = sweep::Store::Create(file, sweep::FactsOf(sweep, "1"));
  int number = 0;
  for (const sweep::Cell& cell : sweep::Cells(sweep)) {
    store.Add({sweep::FalseCell(cell)}, 0.25);
    sweep::TimedTrial trial = sweep::FalseTrial({cell, {}, nullptr}, 1);
    trial.record.trial = ++number;
    trial.record.cell = cell.number;
    trial.record.number = 1;
    store.Add({trial});
  }
  store.Close();
  seeds.Write("database", ContentsOf(file));
}

void WriteAll(const fs::path& folder) {
  Seeds seeds(folder);
  seeds.Copy("scenario", "scenarios", ".yaml");
  seeds.Copy("part", "models/parts", ".yaml");
  seeds.Copy("workcell", "models/workcells", ".yaml");
  seeds.Copy("urdf", "models", ".urdf");
  seeds.Copy("bound", "scenarios/expressions", ".yaml");
  seeds.Copy("sweep", "scenarios/sweeps", ".yaml");
  seeds.Write("network",
              R"({"nodes": {"v": ["a", "b"], "w": 3},
                  "arcs": [{"between": ["v", "w"], "pairs": [["a", 0], ["b", 2]]}]})");
  WritePlan(seeds);
  WriteKnowledge(seeds);
  WriteDatabase(seeds);
}

}  // namespace
}  // namespace assay::fuzz

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("write_seeds FOLDER\n", stderr);
    return 2;
  }
  assay::fuzz::WriteAll(argv[1]);
  return 0;
}
