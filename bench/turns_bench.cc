// Asks for first labelings and counts of the networks of labeling_bench, in turn. In each round
// every contestant is asked about every network once, so that neither caches nor branch prediction
// know the next question.
//   labeling-in-turn/NETWORK/CONTESTANT
//   counting-in-turn/NETWORK/CONTESTANT

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#ifdef ASSAY_PEER_GECODE_LABELING
#include "bench/peers/gecode_labeling.h"
#endif
#include "bench/harness/contest.h"
#include "bench/peers/labeling_answer.h"
#include "bench/workloads/networks.h"
#include "planner/network/labeling/count.h"
#include "planner/network/labeling/search.h"

namespace assay::network {
namespace {

using peers::CountAnswer;
using peers::LabelingAnswer;
using workloads::MeasuredNetwork;
using workloads::NetworkWorkload;

constexpr int kRounds = 5;
// A contestant that took this long for a network in earlier rounds is not asked about it again. At
// such lengths, having been asked before makes no difference.
constexpr double kEnoughSeconds = 0.02;
[[maybe_unused]] constexpr double kPeerSeconds = 10;  // limit for one question

// A network in the forms that the contestants use.
struct Instance {
  NetworkWorkload workload;
  Network network = workload.Build();
#ifdef ASSAY_PEER_GECODE_LABELING
  peers::GecodeLabeling gecode{workload};
#endif
};
using Instances = std::vector<std::unique_ptr<Instance>>;

std::vector<MeasuredNetwork> Measured() {
  return workloads::MeasuredNetworks(
      ASSAY_SOURCE_DIR "/bench/workloads/networks", bench::Seed(),
      bench::Tiny() ? workloads::Extent::kTiny : workloads::Extent::kWhole);
}

std::vector<MeasuredNetwork> MeasuredAndCountable() {
  std::vector<MeasuredNetwork> networks = Measured();
  std::erase_if(networks, [](const MeasuredNetwork& network) { return !network.is_countable; });
  return networks;
}

Instances Made(const std::vector<MeasuredNetwork>& networks) {
  Instances instances;
  for (const MeasuredNetwork& network : networks) {
    instances.push_back(std::make_unique<Instance>(network.make()));
  }
  return instances;
}

// A contestant's answer about one network, and its times in the rounds.
template <class Answer>
struct Answered {
  Answer answer;
  std::vector<double> seconds;

  double Spent() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }
  double Median() const {
    std::vector<double> sorted = seconds;
    std::ranges::sort(sorted);
    return sorted[sorted.size() / 2];
  }
};

template <class Answer>
using Ask = std::function<Answer(const Instance&)>;

template <class Answer>
std::vector<Answered<Answer>> AskInTurn(const Instances& instances, const Ask<Answer>& ask) {
  using Clock = std::chrono::steady_clock;
  std::vector<Answered<Answer>> all(instances.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < instances.size(); ++i) {
      if (all[i].Spent() > kEnoughSeconds) continue;
      const Clock::time_point start = Clock::now();
      all[i].answer = ask(*instances[i]);
      all[i].seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
  }
  return all;
}

bool Agree(const Instance& instance, const LabelingAnswer& peer, const LabelingAnswer& ours) {
  return peer.outcome == ours.outcome &&
         (peer.outcome != Outcome::kFound || instance.network.Satisfies(peer.labeling));
}

bool Agree(const Instance&, const CountAnswer& peer, const CountAnswer& ours) {
  return peer.count == ours.count;
}

// Compares assay's answer with the answer of assay's other way to decide a network.
bool IsRight(const Instance& instance, const LabelingAnswer& ours) {
  return Agree(instance, ours, {.outcome = instance.workload.Build().Decide(), .labeling = {}});
}

bool IsRight(const Instance& instance, const CountAnswer& ours) {
  const bool has_labeling = instance.workload.Build().Decide() == Outcome::kFound;
  return (ours.count > 0) == has_labeling;
}

// One question about many networks, with the contestants that answer it.
template <class Answer>
class Contest {
 public:
  Contest(std::string family, std::vector<MeasuredNetwork> networks)
      : family_(std::move(family)), networks_(std::move(networks)) {}

  // Adds a contestant. Assay must be the first.
  void Add(std::string contestant, Ask<Answer> ask) {
    contestants_.push_back({std::move(contestant), std::move(ask), {}});
  }

  void Register() {
    for (std::size_t i = 0; i < networks_.size(); ++i) {
      for (Contestant& contestant : contestants_) {
        bench::AddTimedContestant(
            family_, networks_[i].name, contestant.name,
            [=, this, &contestant](benchmark::State& state) { Tell(state, contestant, i); });
      }
    }
  }

 private:
  struct Contestant {
    std::string name;
    Ask<Answer> ask;
    std::vector<Answered<Answer>> answered;  // answers by network, for networks that were asked
  };

  void Tell(benchmark::State& state, Contestant& contestant, std::size_t network) {
    const Answered<Answer>& told = Of(contestant)[network];
    for (auto _ : state) state.SetIterationTime(told.Median());
    if (&contestant == &contestants_.front()) {
      if (!IsRight(*instances_[network], told.answer)) state.SkipWithError("a wrong answer");
    } else {
      Compare(state, *instances_[network], told.answer, Of(contestants_.front())[network].answer);
    }
  }

  static void Compare(benchmark::State& state, const Instance& instance, const Answer& peer,
                      const Answer& ours) {
    const bool time_is_up = peer.outcome == Outcome::kBudget;
    state.counters[bench::kTimeout] = time_is_up;
    if (!time_is_up && !Agree(instance, peer, ours)) {
      state.SkipWithError("its answer is not that of assay");
    }
  }

  const std::vector<Answered<Answer>>& Of(Contestant& contestant) {
    if (instances_.empty()) instances_ = Made(networks_);
    if (contestant.answered.empty()) contestant.answered = AskInTurn(instances_, contestant.ask);
    return contestant.answered;
  }

  std::string family_;
  std::vector<MeasuredNetwork> networks_;
  Instances instances_;
  std::vector<Contestant> contestants_;
};

LabelingAnswer Label(const Instance& instance) {
  Budget budget(std::numeric_limits<std::int64_t>::max());
  FirstLabeling first = First(instance.network, {}, budget);
  return {.outcome = first.outcome, .labeling = std::move(first.labeling)};
}

CountAnswer CountAll(const Instance& instance) {
  Budget budget(std::numeric_limits<std::int64_t>::max());
  const LabelingCount count = Count(instance.network, budget);
  return {.outcome = count.outcome, .count = count.count};
}

#ifdef ASSAY_PEER_GECODE_LABELING
using peers::GecodeLabeling;

void AddGecode(Contest<LabelingAnswer>& labeling, Contest<CountAnswer>& counting) {
  for (const GecodeLabeling::Order order : GecodeLabeling::kOrders) {
    const std::string name(GecodeLabeling::Name(order));
    labeling.Add(
        name, [=](const Instance& instance) { return instance.gecode.First(order, kPeerSeconds); });
    if (order == GecodeLabeling::Order::kAfcRestarts) continue;
    counting.Add(
        name, [=](const Instance& instance) { return instance.gecode.Count(order, kPeerSeconds); });
  }
}
#else
void AddGecode(Contest<LabelingAnswer>&, Contest<CountAnswer>&) {
  bench::AddMissing("labeling-in-turn", "gecode", "libgecode-dev");
  bench::AddMissing("counting-in-turn", "gecode", "libgecode-dev");
}
#endif

void AnnounceFamilies() {
  const std::string in_turn =
      ", if networks take turns. In each round, every network is asked once. Times are those of "
      "the wall clock, because reading the processor time takes as long as the quickest answers";
  const std::string one_by_one =
      ". The networks take turns, but the contestants do not. Each contestant runs all of its "
      "rounds in a row, so other load of the machine may affect only one contestant";
  bench::Announce(
      "labeling-in-turn",
      {.measured = "the first labeling, or the proof that there is none" + in_turn,
       .unfair = "the section labeling has the reasons. Here no contestant gains from repeated "
                 "questions. The quickest networks take as long as reading them from memory" +
                 one_by_one,
       .against = "gecode",
       .at_least = 20});
  bench::Announce("counting-in-turn", {.measured = "the number of all labelings" + in_turn,
                                       .unfair = "the section counting has the reasons. Here no "
                                                 "contestant gains from repeated questions" +
                                                 one_by_one,
                                       .against = "gecode",
                                       .at_least = 10});
}

const bool kAdded = [] {
  AnnounceFamilies();
  static Contest<LabelingAnswer> labeling("labeling-in-turn", Measured());
  static Contest<CountAnswer> counting("counting-in-turn", MeasuredAndCountable());
  labeling.Add("assay", Label);
  counting.Add("assay", CountAll);
  AddGecode(labeling, counting);
  labeling.Register();
  counting.Register();
  return true;
}();

}  // namespace
}  // namespace assay::network
