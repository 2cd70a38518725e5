#include "bench/peers/gecode_labeling.h"

#include <gecode/int.hh>
#include <gecode/search.hh>

#include "bench/peers/processor_time.h"
#include "planner/base/check.h"

namespace assay::peers {
namespace {

using network::Arc;
using network::Label;
using network::LabelSet;
using network::Relation;

Gecode::IntSet Domain(const LabelSet& labels) {
  const std::vector<int> members(labels.begin(), labels.end());
  return Gecode::IntSet(members.data(), static_cast<int>(members.size()));
}

Gecode::TupleSet Table(const Relation& relation) {
  Gecode::TupleSet table(2);
  for (Label row = 0; row < relation.rows(); ++row) {
    for (Label column = 0; column < relation.columns(); ++column) {
      if (relation.Allows(row, column)) table.add({row, column});
    }
  }
  table.finalize();
  return table;
}

class NetworkSpace : public Gecode::Space {
 public:
  explicit NetworkSpace(const std::vector<Gecode::IntSet>& domains)
      : labels_(*this, static_cast<int>(domains.size())) {
    for (int node = 0; node < labels_.size(); ++node) {
      labels_[node] = Gecode::IntVar(*this, domains[node]);
    }
  }
  NetworkSpace(NetworkSpace& other) : Space(other) { labels_.update(*this, other.labels_); }
  Gecode::Space* copy() override { return new NetworkSpace(*this); }

  void Post(const Arc& arc, const Gecode::TupleSet& table) {
    const Gecode::IntVarArgs ends = {labels_[arc.a.index()], labels_[arc.b.index()]};
    Gecode::extensional(*this, ends, table);
  }

  void Branch(GecodeLabeling::Order order) {
    using Gecode::INT_VAL_MIN;
    switch (order) {
      case GecodeLabeling::Order::kAfc:
      case GecodeLabeling::Order::kAfcRestarts:
        Gecode::branch(*this, labels_, Gecode::INT_VAR_AFC_SIZE_MAX(), INT_VAL_MIN());
        return;
      case GecodeLabeling::Order::kSize:
        Gecode::branch(*this, labels_, Gecode::INT_VAR_SIZE_MIN(), INT_VAL_MIN());
        return;
      case GecodeLabeling::Order::kAction:
        Gecode::branch(*this, labels_, Gecode::INT_VAR_ACTION_SIZE_MAX(), INT_VAL_MIN());
        return;
    }
  }

  network::Labeling labeling() const {
    network::Labeling labeling;
    for (int node = 0; node < labels_.size(); ++node) {
      labeling.labels.push_back(labels_[node].val());
    }
    return labeling;
  }

 private:
  Gecode::IntVarArray labels_;
};

using Engine = Gecode::Search::Base<NetworkSpace>;

// Gecode asks at each node. Only every tenth call reads the clock, since a reading takes as long as
// a small part of a node.
class Deadline : public Gecode::Search::Stop {
 public:
  explicit Deadline(double seconds) : end_(ProcessorSeconds() + seconds) {}
  bool stop(const Gecode::Search::Statistics&, const Gecode::Search::Options&) override {
    if (++asked_ % 10 != 0) return is_over_;
    return is_over_ = ProcessorSeconds() >= end_;
  }

 private:
  double end_;
  int asked_ = 0;
  bool is_over_ = false;
};

// A search. The stop object and the cutoff must live as long as the engine.
struct Search {
  Search(NetworkSpace& space, GecodeLabeling::Order order, double seconds) : stop(seconds) {
    Gecode::Search::Options options;
    options.threads = 1;
    options.stop = &stop;
    if (order == GecodeLabeling::Order::kAfcRestarts) {
      options.cutoff = Gecode::Search::Cutoff::geometric(200, 1.5);
      engine = std::make_unique<Gecode::RBS<NetworkSpace, Gecode::DFS>>(&space, options);
    } else {
      engine = std::make_unique<Gecode::DFS<NetworkSpace>>(&space, options);
    }
  }
  std::unique_ptr<NetworkSpace> Next() { return std::unique_ptr<NetworkSpace>(engine->next()); }
  std::int64_t visited() const { return static_cast<std::int64_t>(engine->statistics().node); }

  Deadline stop;
  std::unique_ptr<Engine> engine;
};

}  // namespace

struct GecodeLabeling::Tables {
  std::vector<Gecode::IntSet> domains;
  std::vector<Arc> arcs;
  std::vector<Gecode::TupleSet> of_arcs;

  std::unique_ptr<NetworkSpace> Post(Order order) const {
    auto space = std::make_unique<NetworkSpace>(domains);
    for (std::size_t arc = 0; arc < arcs.size(); ++arc) space->Post(arcs[arc], of_arcs[arc]);
    space->Branch(order);
    return space;
  }
};

std::string_view GecodeLabeling::Name(Order order) {
  switch (order) {
    case Order::kAfc:
      return "gecode:afc";
    case Order::kSize:
      return "gecode:size";
    case Order::kAction:
      return "gecode:action";
    case Order::kAfcRestarts:
      return "gecode:afc_restarts";
  }
  return "";
}

GecodeLabeling::GecodeLabeling(const workloads::NetworkWorkload& workload) {
  auto tables = std::make_unique<Tables>();
  for (const LabelSet& labels : workload.nodes) tables->domains.push_back(Domain(labels));
  for (const Arc& arc : workload.arcs) tables->of_arcs.push_back(Table(*arc.relation));
  tables->arcs = workload.arcs;
  tables_ = std::move(tables);
}

GecodeLabeling::~GecodeLabeling() = default;

LabelingAnswer GecodeLabeling::First(Order order, double seconds) const {
  const std::unique_ptr<NetworkSpace> space = tables_->Post(order);
  Search search(*space, order, seconds);
  LabelingAnswer answer;
  if (const auto labeled = search.Next()) {
    answer = {.outcome = Outcome::kFound, .labeling = labeled->labeling()};
  } else {
    answer.outcome = search.engine->stopped() ? Outcome::kBudget : Outcome::kNone;
  }
  answer.visited = search.visited();
  return answer;
}

CountAnswer GecodeLabeling::Count(Order order, double seconds) const {
  const std::unique_ptr<NetworkSpace> space = tables_->Post(order);
  Search search(*space, order, seconds);
  CountAnswer answer;
  while (search.Next()) ++answer.count;
  answer.visited = search.visited();
  answer.outcome = search.engine->stopped() ? Outcome::kBudget
                   : answer.count == 0      ? Outcome::kNone
                                            : Outcome::kFound;
  return answer;
}

std::vector<Outcome> GecodeLabeling::PostArcByArc(Order order, double seconds) const {
  const double end = ProcessorSeconds() + seconds;
  std::vector<Outcome> outcomes;
  auto accepted = std::make_unique<NetworkSpace>(tables_->domains);
  accepted->Branch(order);
  for (std::size_t arc = 0; arc < tables_->arcs.size(); ++arc) {
    accepted->status();  // only a propagated space can be cloned
    std::unique_ptr<NetworkSpace> posted(static_cast<NetworkSpace*>(accepted->clone()));
    posted->Post(tables_->arcs[arc], tables_->of_arcs[arc]);
    Search search(*posted, order, end - ProcessorSeconds());
    const bool found = search.Next() != nullptr;
    if (!found && search.engine->stopped()) return outcomes;
    outcomes.push_back(found ? Outcome::kFound : Outcome::kNone);
    if (found) accepted = std::move(posted);
  }
  return outcomes;
}

std::function<Outcome()> GecodeLabeling::AskForLastArc(Order order, double seconds) const {
  const auto others = std::make_shared<NetworkSpace>(tables_->domains);
  others->Branch(order);
  const std::size_t last = tables_->arcs.size() - 1;
  for (std::size_t arc = 0; arc < last; ++arc) {
    others->Post(tables_->arcs[arc], tables_->of_arcs[arc]);
  }
  others->status();  // only a propagated space can be cloned
  return [=, this] {
    const std::unique_ptr<NetworkSpace> posted(static_cast<NetworkSpace*>(others->clone()));
    posted->Post(tables_->arcs[last], tables_->of_arcs[last]);
    Search search(*posted, order, seconds);
    if (search.Next() != nullptr) return Outcome::kFound;
    return search.engine->stopped() ? Outcome::kBudget : Outcome::kNone;
  };
}

}  // namespace assay::peers
