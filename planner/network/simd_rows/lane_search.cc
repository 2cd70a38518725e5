#include "planner/network/simd_rows/lane_search.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "planner/network/labeling/tree_search.h"
#include "planner/network/simd_rows/lane_rows.h"
#include "planner/network/simd_rows/lanes.h"
#include "planner/network/simd_rows/open_lanes.h"

namespace assay::network {
namespace {

constexpr std::size_t kMostRowBytes = 1 << 20;

// Returns the width of the narrowest elements that can hold all labels of the scope.
int LaneBits(std::span<const int> scope, const LabelStore& labels) {
  Word all = 0;
  for (int node : scope) all |= labels.OneWord(node);
  return std::max(16, static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::bit_width(all)))));
}

template <class Lane>
class LaneSearch {
 public:
  LaneSearch(std::span<const int> scope, const LabelStore& labels, const ArcConsistency& arcs,
             std::span<const Label> preferred, Counters& counters);

  Outcome Any(Budget& budget);
  Label label(int lane) const { return std::countr_zero(lanes()[lane]); }

 private:
  LaneSearch(std::span<const int> scope, const std::vector<int>& lane_of, const LabelStore& labels,
             const ArcConsistency& arcs, std::span<const Label> preferred, Counters& counters);

  struct Decision {
    int lane;
    Label label;
    int open;  // the length of open_ before the decision
  };

  std::optional<Outcome> Advance(Budget& budget, std::int64_t wipe_out_limit);
  int ChooseLane();
  Label ChooseLabel(int lane) const;
  bool Descend(int lane);
  bool Backtrack();
  void Rewind();
  void Set(int lane, Word labels);
  bool Propagate();
  int TakeChanged();
  static int TakeFirst(std::vector<Word>& lanes);

  Block<Lane>* state() { return states_.data() + decisions_.size() * rows_.blocks(); }
  const Block<Lane>* state() const { return states_.data() + decisions_.size() * rows_.blocks(); }
  Lane* lanes() { return state()->lanes; }
  const Lane* lanes() const { return state()->lanes; }

  LaneRows<Lane> rows_;
  OpenLanes open_;
  Counters& counters_;
  std::vector<Label> preferred_;  // indexed by node of the scope
  NarrowLanes<Lane> narrow_ = QuickestNarrowLanes<Lane>();

  std::vector<Block<Lane>> states_;  // one before each decision, and the present one last
  std::vector<Decision> decisions_;
  // Nodes to be propagated, and those of them that have one label.
  std::vector<Word> changed_, single_;
};

template <class Lane>
LaneSearch<Lane>::LaneSearch(std::span<const int> scope, const LabelStore& labels,
                             const ArcConsistency& arcs, std::span<const Label> preferred,
                             Counters& counters)
    : LaneSearch(scope, LanesOf(scope, labels.node_count()), labels, arcs, preferred, counters) {}

template <class Lane>
LaneSearch<Lane>::LaneSearch(std::span<const int> scope, const std::vector<int>& lane_of,
                             const LabelStore& labels, const ArcConsistency& arcs,
                             std::span<const Label> preferred, Counters& counters)
    : rows_(scope, lane_of, labels, arcs),
      open_(scope, lane_of, arcs),
      counters_(counters),
      states_((scope.size() + 1) * rows_.blocks()),
      changed_(WordsFor(rows_.blocks() * kLanesOfBlock<Lane>), 0),
      single_(changed_) {
  decisions_.reserve(scope.size());
  // All bits of an element without a node are set, so that it never restricts a label.
  std::fill_n(lanes(), rows_.blocks() * kLanesOfBlock<Lane>, static_cast<Lane>(~Lane{0}));
  for (std::size_t lane = 0; lane < scope.size(); ++lane) {
    lanes()[lane] = static_cast<Lane>(labels.OneWord(scope[lane]));
    preferred_.push_back(preferred[scope[lane]]);
  }
}

template <class Lane>
Outcome LaneSearch<Lane>::Any(Budget& budget) {
  auto limit = static_cast<double>(TreeSearch::kFirstWipeOutLimit);
  while (true) {
    if (const auto outcome = Advance(budget, static_cast<std::int64_t>(limit))) return *outcome;
    Rewind();
    limit *= TreeSearch::kWipeOutLimitGrowth;
  }
}

template <class Lane>
std::optional<Outcome> LaneSearch<Lane>::Advance(Budget& budget, std::int64_t wipe_out_limit) {
  const std::int64_t wipe_outs_before = counters_.wipe_outs;
  bool consistent = true;
  while (consistent) {
    if (counters_.wipe_outs - wipe_outs_before >= wipe_out_limit) return std::nullopt;
    const int lane = ChooseLane();
    if (lane < 0) return Outcome::kFound;
    if (!budget.Spend()) return Outcome::kBudget;
    consistent = Descend(lane) || Backtrack();
  }
  return Outcome::kNone;
}

template <class Lane>
int LaneSearch<Lane>::ChooseLane() {
  open_.Update(lanes());
  return open_.Heaviest(lanes());
}

template <class Lane>
Label LaneSearch<Lane>::ChooseLabel(int lane) const {
  const Word labels = lanes()[lane];
  const Label preferred = preferred_[lane];
  return preferred != TreeSearch::kNoLabel && (labels & BitOf(preferred)) != 0
             ? preferred
             : std::countr_zero(labels);
}

template <class Lane>
bool LaneSearch<Lane>::Descend(int lane) {
  const Label label = ChooseLabel(lane);
  const Block<Lane>* before = state();
  decisions_.push_back({.lane = lane, .label = label, .open = open_.count()});
  std::copy_n(before, rows_.blocks(), state());
  ++counters_.visited;
  Set(lane, BitOf(label));
  if (!Propagate()) return false;
  preferred_[lane] = label;
  return true;
}

template <class Lane>
bool LaneSearch<Lane>::Backtrack() {
  while (!decisions_.empty()) {
    const Decision decision = decisions_.back();
    decisions_.pop_back();
    open_.Reopen(decision.open);
    Set(decision.lane, lanes()[decision.lane] & ~BitOf(decision.label));
    if (Propagate()) return true;
  }
  return false;
}

template <class Lane>
void LaneSearch<Lane>::Rewind() {
  if (decisions_.empty()) return;
  open_.Reopen(decisions_.front().open);
  decisions_.clear();
}

template <class Lane>
void LaneSearch<Lane>::Set(int lane, Word labels) {
  lanes()[lane] = static_cast<Lane>(labels);
  changed_[lane / kWordBits] |= BitOf(lane);
  if (std::has_single_bit(labels)) single_[lane / kWordBits] |= BitOf(lane);
}

template <class Lane>
bool LaneSearch<Lane>::Propagate() {
  Block<Lane>* const blocks = state();
  for (int lane; (lane = TakeChanged()) >= 0;) {
    const Lane left = blocks->lanes[lane];
    if (std::popcount(left) > rows_.most_unsupporting(lane)) continue;
    counters_.revisions += rows_.degree(lane);
    const int wiped_out = narrow_(blocks, rows_.of(lane), left, {changed_.data(), single_.data()});
    if (wiped_out == kNoWipeOut) continue;
    ++counters_.wipe_outs;
    open_.Blame(lane, wiped_out);
    std::ranges::fill(changed_, 0);
    std::ranges::fill(single_, 0);
    return false;
  }
  return true;
}

template <class Lane>
int LaneSearch<Lane>::TakeChanged() {
  const int single = TakeFirst(single_);
  if (single < 0) return TakeFirst(changed_);
  changed_[single / kWordBits] &= ~BitOf(single);
  return single;
}

template <class Lane>
int LaneSearch<Lane>::TakeFirst(std::vector<Word>& lanes) {
  for (std::size_t word = 0; word < lanes.size(); ++word) {
    if (lanes[word] == 0) continue;
    const int bit = std::countr_zero(lanes[word]);
    lanes[word] &= lanes[word] - 1;
    return static_cast<int>(word) * kWordBits + bit;
  }
  return -1;
}

template <class Lane>
Outcome AnyInLanesOf(std::span<const int> scope, LabelStore& labels, const ArcConsistency& arcs,
                     std::span<const Label> preferred, Counters& counters, Budget& budget) {
  LaneSearch<Lane> search(scope, labels, arcs, preferred, counters);
  const Outcome outcome = search.Any(budget);
  if (outcome != Outcome::kFound) return outcome;
  for (std::size_t lane = 0; lane < scope.size(); ++lane) {
    labels.Assign(scope[lane], search.label(static_cast<int>(lane)));
  }
  return outcome;
}

}  // namespace

bool FitsLanes(std::span<const int> scope, const LabelStore& labels) {
  std::size_t rows = 0;
  for (int node : scope) {
    if (!labels.IsOneWord(node)) return false;
    rows += labels.count(node);
  }
  return rows * scope.size() * LaneBits(scope, labels) / 8 <= kMostRowBytes;
}

Outcome AnyInLanes(std::span<const int> scope, LabelStore& labels, const ArcConsistency& arcs,
                   std::span<const Label> preferred, Counters& counters, Budget& budget) {
  switch (LaneBits(scope, labels)) {
    case 16:
      return AnyInLanesOf<std::uint16_t>(scope, labels, arcs, preferred, counters, budget);
    case 32:
      return AnyInLanesOf<std::uint32_t>(scope, labels, arcs, preferred, counters, budget);
  }
  return AnyInLanesOf<std::uint64_t>(scope, labels, arcs, preferred, counters, budget);
}

}  // namespace assay::network
