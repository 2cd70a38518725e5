// Measures how much of the engine's speed a sweep keeps, and what a second thread adds.
//
// The same trials are executed by a sweep on one thread, by a bare loop of mj_step, and by a sweep
// on two threads. The bare loop runs right after each trial of the first sweep, and its time is
// subtracted. All this is repeated in several rounds, and medians are reported. A loaded machine
// therefore changes the seconds more than the ratios.
//
// The loop is a fair peer because it sees the same contacts. The cost of a step depends on its
// contacts. It differs by a factor between a hand on its way and a peg in its hole. All steps of
// the trials are recorded once, with full dynamics: the state before each step, the controls and
// the timestep. The loop writes them back and calls mj_step. The benchmark checks that the loop has
// as many contacts, and as many iterations of the solver, as the recorded trials. The sweep itself
// moves robots without dynamics while no force decides anything, so it needs fewer steps. Its pace
// counts the steps that full dynamics need for its trials. Both the loop and the sweep
// include the check that follows the engine's collision detection for boxes. The sweep alone does
// everything else: it compiles scenes, lets the parts settle, draws noise, and runs servos,
// trajectories, sensing, claims and the database. Settling takes steps as well, but these are not
// counted.
//
// Trials differ in length, and when none is left to begin, one thread waits for the other. With a
// thousand trials this wait is negligible; with a few it is long. Two threads are therefore judged
// by the time in which both work, and the whole time is reported beside it.
//
// CPU time is that of the whole process. On a loaded machine two threads cannot be twice as fast in
// wall time. Twice the ratio in CPU time is then the expectation for two free cores.

#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/check.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/execution/walk/executor.h"
#include "sim/mujoco/collision/convex_pieces.h"
#include "sim/sweep/runner/machine.h"
#include "sim/sweep/runner/runner.h"

namespace assay {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string scenario = "spar-fig15";
  double error_scale = 1;
  int trials = 8;  // the recording of each trial takes 100 MB of memory
  int rounds = 3;
};

// ---- time

struct Seconds {
  double wall = 0;
  double cpu = 0;

  Seconds operator-(const Seconds& other) const { return {wall - other.wall, cpu - other.cpu}; }
  Seconds& operator+=(const Seconds& other) {
    wall += other.wall;
    cpu += other.cpu;
    return *this;
  }
};

Seconds Now() {
  timespec cpu = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(wall).count(),
          static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
}

Seconds Since(const Seconds& start) { return Now() - start; }

// ---- recording

// The cost of a step for the engine.
struct Load {
  std::int64_t steps = 0, contacts = 0, iterations = 0;

  void Add(const Load& other) {
    steps += other.steps;
    contacts += other.contacts;
    iterations += other.iterations;
  }
  bool operator==(const Load&) const = default;
};

using ModelCopy = std::unique_ptr<mjModel, void (*)(mjModel*)>;

// All steps of an execution.
struct Recording {
  // Sizes of qpos, qvel and ctrl.
  std::size_t nq = 0, nv = 0, nu = 0;
  ModelCopy model = {nullptr, mj_deleteModel};
  // For each step in turn: timestep, ctrl, qfrc_applied, qpos, qvel, qacc_warmstart.
  std::vector<double> numbers = {};
  // The places of geoms from a step on, since tables are raised during a trial.
  struct Raised {
    std::int64_t from = 0;
    std::vector<double> geom_pos;
  };
  std::vector<Raised> raised = {};
  Load load = {};
};

// Records the steps of a simulation while the recorder lives. There is at most one recorder at a
// time. The engine calls mjcb_control at the end of mj_step1, which ends each step of mujoco::Data.
// At that time the controls of the step are still present, and the state is the one before the next
// step. The quaternions in qpos are an exception: the engine has normalised them, and mujoco::Data
// restores them after mj_step1. A second normalisation can change their last bit, so qpos is taken
// after the step.
class Recorder {
 public:
  explicit Recorder(const mujoco::Data& data) {
    const mjModel& m = *data.own_model();
    recording_ = {.nq = static_cast<std::size_t>(m.nq),
                  .nv = static_cast<std::size_t>(m.nv),
                  .nu = static_cast<std::size_t>(m.nu),
                  .model = {mj_copyModel(nullptr, &m), mj_deleteModel}};
    geom_pos_.assign(m.geom_pos, m.geom_pos + 3 * m.ngeom);
    KeepState(*data.get());
    ASSAY_CHECK(current == nullptr);
    current = this;
    mjcb_control = [](const mjModel* model, mjData* now) { current->See(*model, *now); };
  }
  ~Recorder() {
    mjcb_control = nullptr;
    current = nullptr;
  }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void EndStep(const mujoco::Data& data) { std::ranges::copy(data.qpos(), state_.begin()); }

  Recording Take() { return std::move(recording_); }

 private:
  void See(const mjModel& m, const mjData& d) {
    if (d.time > time_) {
      AddStep(m, d);
      KeepState(d);
      return;
    }
    contacts_ = d.ncon;
    if (!std::equal(geom_pos_.begin(), geom_pos_.end(), m.geom_pos)) {
      geom_pos_.assign(m.geom_pos, m.geom_pos + 3 * m.ngeom);
      recording_.raised.push_back({recording_.load.steps, geom_pos_});
    }
  }

  void AddStep(const mjModel& m, const mjData& d) {
    std::vector<double>& numbers = recording_.numbers;
    numbers.push_back(m.opt.timestep);
    numbers.insert(numbers.end(), d.ctrl, d.ctrl + recording_.nu);
    numbers.insert(numbers.end(), d.qfrc_applied, d.qfrc_applied + recording_.nv);
    numbers.insert(numbers.end(), state_.begin(), state_.end());
    recording_.load.Add({1, contacts_, d.solver_iter});
  }

  void KeepState(const mjData& d) {
    time_ = d.time;
    contacts_ = d.ncon;
    state_.assign(d.qpos, d.qpos + recording_.nq);
    state_.insert(state_.end(), d.qvel, d.qvel + recording_.nv);
    state_.insert(state_.end(), d.qacc_warmstart, d.qacc_warmstart + recording_.nv);
  }

  static Recorder* current;

  Recording recording_;
  double time_ = 0;
  std::int64_t contacts_ = 0;
  std::vector<double> state_, geom_pos_;
};

Recorder* Recorder::current = nullptr;

Recording Record(const sweep::PlannedCell& cell, int number) {
  const noise::Noise noise = sweep::NoiseOf(cell, number);
  const scenario::Scenario& scenario = cell.preparation->scenario;
  const scene::Scene scene(scenario.problem,
                           execution::TrueScene(scenario.simulation.scene, noise));
  mujoco::Data data = execution::StartOf(scenario.problem, scene, noise);
  execution::ExecutorOptions options;
  options.sample_rate = 0;
  options.kinematic_step = 0;
  options.noise = noise;
  Recorder recorder(data);
  options.on_timestep = [&](const mujoco::Data& now) { recorder.EndStep(now); };
  const execution::Trace trace =
      execution::Execute(scenario.problem, cell.preparation->plan, scene, data, options);
  Recording recording = recorder.Take();
  ASSAY_CHECK(recording.load.steps == trace.end().steps);
  return recording;
}

// Returns the work of a sweep, all of whose cells have one plan. The noise floor of this plan is
// measured by the first call alone, since the program keeps the noise floor, too
// (sim/cli/tasks/noise_floor_cache.h).
sweep::Work WorkOf(const sweep::Sweep& sweep) {
  return sweep::RealWork(
      sweep, {},
      [](const domain::Problem& problem, const plan::Plan& plan, const scene::SceneOptions& scene) {
        static const check::NoiseFloor kept = check::MeasureNoiseFloor(problem, plan, scene);
        return kept;
      });
}

std::vector<Recording> RecordAll(const sweep::Sweep& sweep) {
  const sweep::PlannedCell cell = WorkOf(sweep).plan(sweep::Cells(sweep).front());
  ASSAY_CHECK(cell.preparation != nullptr, "no plan");
  std::vector<Recording> recordings;
  for (int number = 1; number <= sweep.trials; ++number) {
    recordings.push_back(Record(cell, number));
  }
  return recordings;
}

// ---- the bare loop

struct Pace {
  double steps = 0;
  Seconds taken = {};

  Pace& operator+=(const Pace& other) {
    steps += other.steps;
    taken += other.taken;
    return *this;
  }
};

const double* Write(const double* from, std::size_t count, mjtNum* to) {
  std::copy(from, from + count, to);
  return from + count;
}

Load Steps(const Recording& recording, mjModel* m, mjData* d) {
  Load load;
  const double* next = recording.numbers.data();
  auto raised = recording.raised.begin();
  while (load.steps < recording.load.steps) {
    for (; raised != recording.raised.end() && raised->from == load.steps; ++raised) {
      std::ranges::copy(raised->geom_pos, m->geom_pos);
    }
    next = Write(next, 1, &m->opt.timestep);
    next = Write(next, recording.nu, d->ctrl);
    next = Write(next, recording.nv, d->qfrc_applied);
    next = Write(next, recording.nq, d->qpos);
    next = Write(next, recording.nv, d->qvel);
    next = Write(next, recording.nv, d->qacc_warmstart);
    mj_step(m, d);
    load.Add({1, d->ncon, d->solver_iter});
  }
  return load;
}

// Executes the recording and checks that the loop does what the execution did.
Pace BareLoop(const Recording& recording) {
  const ModelCopy model(mj_copyModel(nullptr, recording.model.get()), mj_deleteModel);
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
  const mujoco::ConvexPieces pieces(*model);
  const mujoco::CollidingPieces colliding(model->nmesh > 0 ? &pieces : nullptr);
  const Seconds start = Now();
  const Load load = Steps(recording, model.get(), data.get());
  const Seconds taken = Since(start);
  ASSAY_CHECK(load == recording.load);
  return {static_cast<double>(load.steps), taken};
}

// ---- the sweep

sweep::Sweep TheSweep(const Options& options) {
  return {.file = fs::path(ASSAY_SOURCE_DIR) / "scenarios" / "bench.yaml",
          .text = "",
          .scenarios = {options.scenario + ".yaml"},
          .error_scales = {options.error_scale},
          .noises = {sweep::NoiseKind::kUniform},
          .seeds = {1},
          .trials = options.trials};
}

class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(fs::temp_directory_path() / fmt::format("assay-sweep-bench-{}", getpid())) {
    fs::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  fs::path File(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

// Called with the number of a trial. Its work is not part of the sweep.
using Aside = std::function<void(int)>;

// Notes when the trials of a sweep begin and end, and calls the aside after each trial.
class Watch {
 public:
  Watch(sweep::Work& work, const std::vector<double>& steps, const Aside& aside) {
    work.run = [this, run = work.run, &steps, &aside](const sweep::PlannedCell& cell, int number) {
      Trial trial{.began = Now()};
      sweep::TimedTrial timed = run(cell, number);
      trial.ended = Now();
      trial.steps = steps[static_cast<std::size_t>(number - 1)];
      const std::lock_guard lock(mutex_);
      trials_.push_back(trial);
      if (aside) aside(number);
      aside_ += Since(trial.ended);
      return timed;
    };
  }

  const Seconds& aside() const { return aside_; }

  // Returns the pace up to the time at which a thread first found no trial to begin. At that time
  // every other thread was in its last trial; the share of this trial that was done counts. There
  // must be no aside.
  Pace WhileAllWorked(int threads) const {
    const Seconds until = trials_.at(trials_.size() - static_cast<std::size_t>(threads)).ended;
    Pace pace;
    for (const Trial& trial : trials_) {
      const Seconds so_far = until - trial.began;
      if (so_far.wall > pace.taken.wall) pace.taken = so_far;
      const double share = so_far.wall / (trial.ended.wall - trial.began.wall);
      pace.steps += std::min(1.0, share) * trial.steps;
    }
    return pace;
  }

 private:
  struct Trial {
    Seconds began = {}, ended = {};
    double steps = 0;
  };

  std::mutex mutex_;
  std::vector<Trial> trials_;  // in the order in which they ended
  Seconds aside_;
};

struct SweepTurn {
  Pace while_all_worked, trials, whole;
};

// Runs a sweep. The trials' time includes all that is done for each trial, with the database. The
// time of the whole sweep includes reading and planning as well. These are done once for a cell,
// however many trials it has.
SweepTurn RunSweep(const sweep::Sweep& sweep, const std::vector<double>& steps_of_trial,
                   int threads, const Aside& aside) {
  const TemporaryFolder folder;
  sweep::Work work = WorkOf(sweep);
  const Watch watch(work, steps_of_trial, aside);
  std::optional<Seconds> trials_began;
  const auto tell = [&](const sweep::Advance& advance) {
    if (advance.trials > 0 && !trials_began) trials_began = Now();
  };
  const Seconds start = Now();
  sweep::Store store =
      sweep::Store::Create(folder.File("bench.sqlite"), sweep::FactsOf(sweep, "bench"));
  store.Add(sweep::ThisRun("bench", "1/1", threads));
  const sweep::RunEnd end = sweep::RunSweep(sweep, work, store, {.jobs = threads, .tell = tell});
  const Seconds trials = Since(trials_began.value()) - watch.aside();
  store.Finish(end.throughput);
  store.Close();
  const Seconds whole = Since(start) - watch.aside();
  ASSAY_CHECK(end.done == sweep.trials);
  const double steps = std::accumulate(steps_of_trial.begin(), steps_of_trial.end(), 0.0);
  return {watch.WhileAllWorked(threads), {steps, trials}, {steps, whole}};
}

// ---- the table

double Median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

using Clock = double Seconds::*;

// Formats one pace of each round. Ratios are to the peer's pace of the same round.
std::string Columns(const std::vector<Pace>& paces, const std::vector<Pace>& peers, Clock clock) {
  const auto rate = [&](const Pace& pace) { return pace.steps / (pace.taken.*clock); };
  std::vector<double> seconds, rates, ratios;
  for (std::size_t i = 0; i < paces.size(); ++i) {
    seconds.push_back(paces[i].taken.*clock);
    rates.push_back(rate(paces[i]));
    ratios.push_back(rate(paces[i]) / rate(peers[i]));
  }
  return fmt::format("{:9.2f} {:9.0f} {:7.3f}", Median(seconds), Median(rates), Median(ratios));
}

void PrintRow(const std::string& name, const std::vector<Pace>& paces,
              const std::vector<Pace>& peers) {
  std::vector<double> steps;
  for (const Pace& pace : paces) steps.push_back(pace.steps);
  fmt::print("{:<34}{:9.0f}  {}  {}\n", name, Median(steps), Columns(paces, peers, &Seconds::wall),
             Columns(paces, peers, &Seconds::cpu));
}

std::vector<Pace> Of(Pace SweepTurn::*part, const std::vector<SweepTurn>& turns) {
  std::vector<Pace> paces;
  for (const SweepTurn& turn : turns) paces.push_back(turn.*part);
  return paces;
}

struct Rounds {
  std::vector<Pace> bare;
  std::vector<SweepTurn> one_thread, two_threads;
};

void Print(const Rounds& rounds) {
  const std::vector<Pace> one_thread = Of(&SweepTurn::trials, rounds.one_thread);
  fmt::print("{:<34}{:>9}  {:>9} {:>9} {:>7}  {:>9} {:>9} {:>7}\n", "", "steps", "wall s",
             "steps/s", "ratio", "CPU s", "steps/s", "ratio");
  PrintRow("bare mj_step", rounds.bare, rounds.bare);
  fmt::print("ratios to the bare loop\n");
  PrintRow("  1 thread, trials", one_thread, rounds.bare);
  PrintRow("  1 thread, whole sweep", Of(&SweepTurn::whole, rounds.one_thread), rounds.bare);
  fmt::print("ratios to the trials on 1 thread\n");
  PrintRow("  2 threads, while both worked", Of(&SweepTurn::while_all_worked, rounds.two_threads),
           one_thread);
  PrintRow("  2 threads, trials", Of(&SweepTurn::trials, rounds.two_threads), one_thread);
  PrintRow("  2 threads, whole sweep", Of(&SweepTurn::whole, rounds.two_threads), one_thread);
}

void PrintLoad(const std::vector<Recording>& recordings) {
  Load load;
  for (const Recording& recording : recordings) load.Add(recording.load);
  const auto steps = static_cast<double>(load.steps);
  fmt::print("{} steps, {:.3f} contacts and {:.3f} iterations of the solver in each\n", load.steps,
             static_cast<double>(load.contacts) / steps,
             static_cast<double>(load.iterations) / steps);
}

void Measure(const Options& options) {
  const sweep::Sweep sweep = TheSweep(options);
  const std::vector<Recording> recordings = RecordAll(sweep);
  fmt::print("{}, {} trials under uniform noise, medians of {} rounds\n", options.scenario,
             options.trials, options.rounds);
  PrintLoad(recordings);
  std::vector<double> steps;  // by trial
  for (const Recording& recording : recordings) {
    steps.push_back(static_cast<double>(recording.load.steps));
  }
  Rounds rounds;
  for (int round = 0; round < options.rounds; ++round) {
    Pace& bare = rounds.bare.emplace_back();
    const auto do_again = [&](int number) { bare += BareLoop(recordings[number - 1]); };
    rounds.one_thread.push_back(RunSweep(sweep, steps, 1, do_again));
    rounds.two_threads.push_back(RunSweep(sweep, steps, 2, {}));
  }
  Print(rounds);
}

}  // namespace
}  // namespace assay

int main(int argc, char** argv) {
  assay::Options options;
  CLI::App app("steps per second of sweeps and of a bare mj_step loop");
  app.add_option("--scenario", options.scenario, "in scenarios/")->capture_default_str();
  app.add_option("--error-scale", options.error_scale)->capture_default_str();
  app.add_option("--trials", options.trials)->check(CLI::Range(2, 1'000))->capture_default_str();
  app.add_option("--rounds", options.rounds)->check(CLI::Range(1, 1'000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  assay::Measure(options);
}
