#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <thread>

#include "planner/base/counted.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/quotation.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/sweep_output/sweep_report.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/sweep/database/merge.h"
#include "sim/sweep/runner/machine.h"
#include "sim/sweep/runner/runner.h"
#include "sim/sweep/shell_commands/slurm.h"

namespace assay::cli {
namespace sweep_verb {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Options {
  fs::path sweep;
  fs::path database;  // empty: named after the sweep file
  domain::ModelPath models;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool resume = false;
  std::string shard = "1/1";
  bool json = false;
  // Options of `merge` and `show`.
  fs::path out;
  std::vector<fs::path> parts;
  // Options of `slurm`.
  int tasks = 4;
  int jobs_of_task = 1;

  fs::path Database() const {
    return database.empty() ? fs::path(sweep.stem().string() + ".sqlite") : database;
  }
};

sweep::Shard ShardFrom(const std::string& text) {
  static const std::regex kShard("([0-9]{1,6})/([0-9]{1,6})");
  std::smatch match;
  if (std::regex_match(text, match, kShard)) {
    const sweep::Shard shard{std::stoi(match[1]), std::stoi(match[2])};
    if (shard.index >= 1 && shard.index <= shard.count) return shard;
  }
  throw UsageError(fmt::format("--shard: '{}' is no share; allowed: I/N with I from 1 to N", text));
}

// Shows to people how many trials there are, how long they will take, and how many are done.
class Narrator {
 public:
  explicit Narrator(int jobs, double seconds_of_trial)
      : jobs_(jobs), seconds_of_trial_(seconds_of_trial) {}

  void Tell(const sweep::Advance& advance) {
    if (advance.trials == 0 && advance.attempts == 0) {
      if (advance.cells > 0 && advance.cells_planned == 0) {
        Line(fmt::format("planning {} cells", advance.cells));
      }
      progress_.Tell({advance.cells_planned, advance.cells, "cells planned"});
      return;
    }
    if (!announced_) Announce(advance);
    // The first trials of all threads, and as many again, are a fair sample.
    if (advance.trials_done == 2 * jobs_ && seconds_of_trial_ == 0 && !foretold_) {
      foretold_ = true;
      Line(fmt::format("{} trials will take about {}", advance.trials,
                       DurationText(advance.seconds * advance.trials / advance.trials_done)));
    }
    if (advance.attempts_made > 0) {
      progress_.Tell({advance.attempts_made, advance.attempts, "attempts"});
    } else if (advance.trials_done > 0) {
      progress_.Tell({advance.trials_done, advance.trials, "trials"});
    }
  }

 private:
  void Announce(const sweep::Advance& advance) {
    announced_ = true;
    std::string text =
        fmt::format("{} on {}", Counted(advance.trials, "trial"), Counted(jobs_, "thread"));
    if (seconds_of_trial_ > 0) {
      text += fmt::format(", about {}", DurationText(seconds_of_trial_ * advance.trials / jobs_));
    }
    if (advance.attempts > 0)
      text += fmt::format(", {} of attacks", Counted(advance.attempts, "attempt"));
    Line(text);
  }

  // Wipes the progress from the line before printing.
  static void Line(const std::string& text) {
    Remark(fmt::format("{}{}\n", RemarksAreSeen() ? "\r\033[K" : "", text));
  }

  const int jobs_;
  const double seconds_of_trial_;  // 0 if not known
  bool announced_ = false;
  bool foretold_ = false;
  Progress progress_{"sweep"};
};

// Ends an interrupted program while plans are made. Some parts of planning cannot be broken off,
// and nothing of a plan that is being made could be kept. The watch ends the program within a
// second or two of an interruption. The plans before it are on the disk, where transactions leave
// nothing half done.
class PlanningWatch {
 public:
  explicit PlanningWatch(const fs::path& database)
      : database_(database), thread_([this](const std::stop_token& end) { Watch(end); }) {}

  void Tell(const sweep::Advance& advance) {
    cells_ = advance.cells;
    cells_planned_ = advance.cells_planned;
    is_planning_ = advance.trials == 0 && advance.attempts == 0;
  }

 private:
  static constexpr std::chrono::milliseconds kInterval{100};
  static constexpr int kPatience = 10;  // intervals

  void Watch(const std::stop_token& end) {
    for (int waited = 0; !end.stop_requested() && waited < kPatience;) {
      std::this_thread::sleep_for(kInterval);
      waited = Interruption::Requested() && is_planning_ ? waited + 1 : 0;
    }
    if (end.stop_requested()) return;
    PrintError(
        fmt::format("interrupted: {} of {} cells are planned, in {}; the same command with "
                    "--resume goes on",
                    cells_planned_.load(), cells_.load(), database_.string()));
    std::_Exit(static_cast<int>(Interruption::CodeOr(ExitCode::kDone)));
  }

  const fs::path database_;
  std::atomic<bool> is_planning_ = true;
  std::atomic<int> cells_ = 0;
  std::atomic<int> cells_planned_ = 0;
  std::jthread thread_;  // last, since it uses the members above
};

ExitCode Show(const sweep::Store& store, const fs::path& database, bool json) {
  const SweepResults results = ResultsOf(store, database.string());
  Print(json ? plan::JsonText(ToJson(results)) : ForPeople(results));
  return ExitCodeOf(results);
}

sweep::RunEnd RunShard(const sweep::Sweep& sweep, const sweep::Shard& shard, sweep::Store& store,
                       const Options& options) {
  const sweep::Work work = sweep::RealWork(sweep, options.models, KeptNoiseFloor);
  const Interruption interruption;
  Narrator narrator(options.jobs, store.MeanSeconds());
  PlanningWatch watch(store.file());
  return sweep::RunSweep(sweep, work, store,
                         {.jobs = options.jobs,
                          .shard = shard,
                          .stop = Interruption::Requested,
                          .tell = [&](const sweep::Advance& advance) {
                            narrator.Tell(advance);
                            watch.Tell(advance);
                          }});
}

void RequireDiskFile(const fs::path& database) {
  if (database != ":memory:") return;
  throw UsageError("sweep: --db: ':memory:' would be lost at the end; allowed: a file");
}

ExitCode Execute(const Options& options) {
  const sweep::Shard shard = ShardFrom(options.shard);
  RequireDiskFile(options.database);
  const sweep::Sweep sweep = sweep::Load(options.sweep);
  const fs::path database = options.Database();
  const sweep::SweepFacts facts = sweep::FactsOf(sweep, ASSAY_VERSION);
  sweep::Store store = options.resume ? sweep::Store::Resume(database, facts)
                                      : sweep::Store::Create(database, facts);
  store.Add(sweep::ThisRun(ASSAY_VERSION, options.shard, options.jobs));
  const sweep::RunEnd end = RunShard(sweep, shard, store, options);
  store.Finish(end.throughput);
  store.Close();
  if (end.stopped) {
    PrintError(
        fmt::format("interrupted: {} trials are written to {}, {} are left; the same "
                    "command with --resume goes on",
                    end.before + end.done, database.string(), end.left));
    return Interruption::CodeOr(ExitCode::kBudgetSpent);
  }
  return Show(sweep::Store::Open(database), database, options.json);
}

ExitCode ExecuteMerge(const Options& options) {
  std::error_code ignored;
  if (fs::exists(options.out, ignored)) {
    throw InputError({.file = options.out.string()}, "there is something in this file already",
                     "the name of a new file");
  }
  RequireWritable(options.out);
  WriteFileBy(options.out, [&](const fs::path& path) { sweep::Merge(path, options.parts); });
  const SweepResults results = ResultsOf(sweep::Store::Open(options.out), options.out.string());
  Print(options.json ? plan::JsonText(ToJson(results))
                     : fmt::format("{} of {} trials from {} databases\n", results.Done(),
                                   results.trials, options.parts.size()));
  return ExitCode::kDone;
}

ExitCode ExecuteShow(const Options& options) {
  Show(sweep::Store::Open(options.database), options.database, options.json);
  return ExitCode::kDone;
}

// Refuses a path with control characters: a line break would end a script's comment, and the
// printed script would show other control characters differently.
void RequirePlainName(const fs::path& path) {
  if (path.empty()) return;
  const std::string absolute = fs::absolute(path).string();
  if (absolute.find('\n') == std::string::npos && ShowLines(absolute) == absolute) return;
  throw UsageError(
      fmt::format("sweep: slurm: {} cannot stand in a script; allowed: names without "
                  "line breaks and control characters",
                  Quote(absolute)));
}

ExitCode ExecuteSlurm(const Options& options) {
  sweep::Load(options.sweep);
  for (const fs::path& path : {options.sweep, options.Database()}) RequirePlainName(path);
  std::ranges::for_each(options.models.folders(), RequirePlainName);
  Print(sweep::SlurmScript({.program = fs::read_symlink("/proc/self/exe"),
                            .sweep = options.sweep,
                            .database = options.Database(),
                            .models = options.models,
                            .tasks = options.tasks,
                            .jobs = options.jobs_of_task}));
  return ExitCode::kDone;
}

// A word after `sweep`. Each has its own options.
struct Part {
  const char* name;
  const char* summary;
  const char* example;
  void (*declare)(CLI::App& command, Options& options);
  ExitCode (*execute)(const Options& options);
};

void AddJson(CLI::App& command, Options& options) {
  command.add_flag("--json", options.json, "print the result as JSON");
}

void AddDatabase(CLI::App& command, Options& options) {
  command.add_option("--db", options.database,
                     "database for the results; SWEEP.sqlite if left out");
}

void AddModels(CLI::App& command, Options& options) { AddModelsOption(command, options.models); }

constexpr std::array kParts = {
    Part{
        "merge", "puts the databases of shards together into one",
        "assay sweep merge all.sqlite fig15-1.sqlite fig15-2.sqlite",
        [](CLI::App& command, Options& options) {
          command.add_option("out", options.out, "the database to be made")->required();
          command.add_option("databases", options.parts, "the databases of the shards")->required();
          AddJson(command, options);
        },
        ExecuteMerge},
    Part{"show",
         "prints what is in a database: rates of success, counts of verdicts, falsifications",
         "assay sweep show fig15.sqlite",
         [](CLI::App& command, Options& options) {
           command.add_option("database", options.database, "database of a sweep")->required();
           AddJson(command, options);
         },
         ExecuteShow},
    Part{"slurm", "prints a Slurm job array script, one task for each shard",
         "assay sweep slurm scenarios/sweeps/spar-fig15.yaml --tasks 8 > fig15.sh",
         [](CLI::App& command, Options& options) {
           command.add_option("sweep", options.sweep, "sweep file")->required();
           command.add_option("--tasks", options.tasks, "number of shards")
               ->check(CLI::Range(1, 100'000))
               ->capture_default_str();
           command.add_option("--jobs", options.jobs_of_task, "number of threads of each task")
               ->check(CLI::Range(1, 1024))
               ->capture_default_str();
           AddDatabase(command, options);
           AddModels(command, options);
         },
         ExecuteSlurm},
};

void DeclareRun(CLI::App& command, Options& options) {
  command.add_option("sweep", options.sweep, "sweep file");
  AddDatabase(command, options);
  command.add_option("--jobs", options.jobs, "number of threads; all cores if left out")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--resume", options.resume,
                   "run only the trials that are not in the database yet");
  command.add_option("--shard", options.shard,
                     "I/N: run only every N-th trial, beginning with trial I");
  AddJson(command, options);
  AddModels(command, options);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  DeclareRun(command, *options);
  const auto chosen = std::make_shared<const Part*>(nullptr);
  for (const Part& part : kParts) {
    CLI::App* const app = command.add_subcommand(part.name, part.summary);
    app->footer(fmt::format("Example:\n  {}", part.example));
    part.declare(*app, *options);
    app->final_callback([chosen, &part] { *chosen = &part; });
  }
  return [options, chosen] {
    if (*chosen != nullptr) return (*chosen)->execute(*options);
    if (options->sweep.empty()) {
      throw UsageError("sweep: a sweep file is required (see assay sweep --help)");
    }
    return Execute(*options);
  };
}

}  // namespace sweep_verb

const Verb kSweep = {
    .name = "sweep",
    .summary = "runs a grid of trials in parallel, and writes the results into a database",
    .page = "sim/sweeps.md",
    .example =
        "assay sweep scenarios/sweeps/spar-fig15.yaml --db fig15.sqlite\n  assay sweep "
        "scenarios/sweeps/spar-fig15.yaml --db fig15.sqlite --resume\n\nAn interrupted sweep ends "
        "with exit code 130 or 143. --resume runs the remaining trials.",
    .declare = sweep_verb::Declare,
};

}  // namespace assay::cli
