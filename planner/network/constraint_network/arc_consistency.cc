#include "planner/network/constraint_network/arc_consistency.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "planner/network/constraint_network/support.h"

namespace assay::network {
namespace {

// Calls visit(label) for each label in the words, in increasing order.
template <class Visit>
void ForEachLabel(std::span<const Word> words, const Visit& visit) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (Word rest = words[i]; rest != 0; rest &= rest - 1) {
      visit(static_cast<int>(i) * kWordBits + std::countr_zero(rest));
    }
  }
}

constexpr std::size_t kCompared = 32;  // nodes of the queue that TakeSmallest compares

enum class SmallerSet { kRevised, kChanged };

}  // namespace

void ArcConsistency::AddNode() {
  first_at_.push_back(kNoDirection);
  cause_.push_back(kNotQueued);
}

void ArcConsistency::RemoveLastNode() {
  if (cause_.back() != kNotQueued) std::erase(queue_, static_cast<int>(cause_.size()) - 1);
  first_at_.pop_back();
  cause_.pop_back();
}

void ArcConsistency::AddArc(int arc, int a, int b, const Relation& relation) {
  const auto add = [&](int changed, int revised, const Relation::Direction& supports,
                       const Relation::Direction& supported) {
    directions_.push_back({.revised = revised,
                           .arc = arc,
                           .most_unsupporting = supports.most_unsupporting,
                           .residues = static_cast<int>(residues_.size()),
                           .next = std::exchange(first_at_[changed], std::ssize(directions_)),
                           .supports = supports.supports.data(),
                           .supported = supported.supports.data()});
    if (supports.words > 1) residues_.resize(residues_.size() + supports.count, 0);
  };
  if (std::ssize(weights_) <= arc) weights_.resize(arc + 1, 1);
  add(b, a, relation.by_row(), relation.by_column());
  add(a, b, relation.by_column(), relation.by_row());
}

void ArcConsistency::RemoveLastArc(int a, int b) {
  first_at_[a] = directions_.back().next;
  directions_.pop_back();
  first_at_[b] = directions_.back().next;
  residues_.resize(directions_.back().residues);
  weights_.resize(directions_.back().arc);
  directions_.pop_back();
}

void ArcConsistency::ForgetWeights() { std::fill(weights_.begin(), weights_.end(), 1); }

bool ArcConsistency::Propagate(LabelStore& labels, Counters& counters) {
  while (!queue_.empty()) {
    if (!ReviseAround(TakeSmallest(labels), labels, counters)) {
      ++counters.wipe_outs;
      ClearQueue();
      return false;
    }
  }
  return true;
}

void ArcConsistency::Enqueue(int node, int arc) {
  if (cause_[node] == kNotQueued) {
    queue_.push_back(node);
    cause_[node] = arc;
  } else if (cause_[node] != arc) {
    cause_[node] = kManyArcs;
  }
}

void ArcConsistency::ClearQueue() {
  for (int node : queue_) cause_[node] = kNotQueued;
  queue_.clear();
}

// Only the last nodes of the queue are compared, so that a long queue does not take quadratic time.
int ArcConsistency::TakeSmallest(const LabelStore& labels) {
  std::size_t smallest = queue_.size() > kCompared ? queue_.size() - kCompared : 0;
  for (std::size_t i = smallest + 1; i < queue_.size(); ++i) {
    if (labels.count(queue_[i]) < labels.count(queue_[smallest])) smallest = i;
  }
  const int node = queue_[smallest];
  queue_[smallest] = queue_.back();
  queue_.pop_back();
  return node;
}

inline ArcConsistency::Revision ArcConsistency::Revise(const Direction& direction, int changed,
                                                       LabelStore& labels) {
  const int revised = direction.revised;
  if (!labels.IsOneWord(revised) || !labels.IsOneWord(changed)) {
    return ReviseWide(direction, changed, labels);
  }
  const Word before = labels.OneWord(revised);
  const Word kept = Supported(direction.supports, before, labels.OneWord(changed));
  if (kept == before) return Revision::kUnchanged;
  if (kept == 0) return Revision::kWipedOut;
  labels.SetOneWord(revised, kept);
  return Revision::kChanged;
}

// Returns true if the node has one label and is not in the queue. Its neighbours then have only
// labels that support this label.
inline bool ArcConsistency::IsSettled(int node, const LabelStore& labels) const {
  return labels.count(node) == 1 && cause_[node] == kNotQueued;
}

bool ArcConsistency::ReviseAround(int node, LabelStore& labels, Counters& counters) {
  const int cause = cause_[node];
  cause_[node] = kNotQueued;
  const int count = labels.count(node);
  // If more labels are left here than any label at the other end forbids, each label there has a
  // support.
  for (const Direction& direction : at(node)) {
    if (direction.arc == cause || count > direction.most_unsupporting ||
        IsSettled(direction.revised, labels)) {
      continue;
    }
    ++counters.revisions;
    switch (Revise(direction, node, labels)) {
      case Revision::kUnchanged:
        break;
      case Revision::kChanged:
        Enqueue(direction.revised, direction.arc);
        break;
      case Revision::kWipedOut:
        ++weights_[direction.arc];
        last_wipe_out_ = {.arc = direction.arc, .changed = node, .revised = direction.revised};
        return false;
    }
  }
  return true;
}

ArcConsistency::Revision ArcConsistency::ReviseWide(const Direction& direction, int changed,
                                                    LabelStore& labels) {
  const std::span<const Word> before = labels.Words(direction.revised);
  const int words = static_cast<int>(before.size());
  const SmallerSet smaller = labels.count(changed) * words <= labels.count(direction.revised)
                                 ? SmallerSet::kChanged
                                 : SmallerSet::kRevised;
  kept_.assign(before.size(), 0);
  if (smaller == SmallerSet::kChanged) {
    KeepSupported(direction, changed, labels);
  } else {
    DropUnsupported(direction, changed, labels);
  }
  return Replace(direction.revised, labels);
}

ArcConsistency::Revision ArcConsistency::Replace(int node, LabelStore& labels) {
  const std::span<const Word> before = labels.Words(node);
  if (std::equal(before.begin(), before.end(), kept_.begin())) return Revision::kUnchanged;
  if (std::all_of(kept_.begin(), kept_.end(), [](Word word) { return word == 0; })) {
    return Revision::kWipedOut;
  }
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const Word lost = before[i] ^ kept_[i];
    if (lost != 0) labels.SetWord(node, static_cast<int>(i), kept_[i]);
  }
  return Revision::kChanged;
}

void ArcConsistency::KeepSupported(const Direction& direction, int changed,
                                   const LabelStore& labels) {
  const std::span<const Word> before = labels.Words(direction.revised);
  ForEachLabel(labels.Words(changed), [&](Label label) {
    const Word* supported = direction.supported + label * std::ssize(before);
    for (std::size_t i = 0; i < before.size(); ++i) kept_[i] |= supported[i];
  });
  for (std::size_t i = 0; i < before.size(); ++i) kept_[i] &= before[i];
}

void ArcConsistency::DropUnsupported(const Direction& direction, int changed,
                                     const LabelStore& labels) {
  const std::span<const Word> others = labels.Words(changed);
  ForEachLabel(labels.Words(direction.revised), [&](Label label) {
    if (HasSupport(direction, label, others)) kept_[label / kWordBits] |= BitOf(label);
  });
}

bool ArcConsistency::HasSupport(const Direction& direction, Label label,
                                std::span<const Word> others) {
  const Word* supports = direction.supports + label * std::ssize(others);
  if (others.size() == 1) return (supports[0] & others[0]) != 0;
  std::uint16_t& residue = residues_[direction.residues + label];
  if ((supports[residue] & others[residue]) != 0) return true;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if ((supports[i] & others[i]) != 0) {
      residue = static_cast<std::uint16_t>(i);
      return true;
    }
  }
  return false;
}

}  // namespace assay::network
