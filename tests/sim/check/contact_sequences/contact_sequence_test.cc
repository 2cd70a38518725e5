#include "sim/check/contact_sequences/contact_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"

namespace assay::check::contact_sequence_test {
namespace {

using finemotion::CertainMotion;
using finemotion::ContactKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const ContactKey kA{ContactKind::kVertexFace, 1, 1};
const ContactKey kB{ContactKind::kVertexFace, 2, 1};
const ContactKey kC{ContactKind::kEdgeEdge, 1, 2};

std::vector<ContactSet> ContactsOf(const std::vector<ObservedState>& states) {
  std::vector<ContactSet> contacts;
  for (const ObservedState& state : states) contacts.push_back(state.contacts);
  return contacts;
}

std::vector<ContactSpan> Stream(const std::vector<std::pair<double, ContactSet>>& lengths) {
  std::vector<ContactSpan> spans;
  double time = 0;
  for (const auto& [length, contacts] : lengths) {
    spans.push_back({0, time, time + length, contacts});
    time += length;
  }
  return spans;
}

TEST(ContactSequence, ReboundsAreBridged) {
  const auto spans = Stream({{0.5, {}}, {0.01, {kA}}, {0.01, {}}, {0.5, {kA}}});
  const auto states = StatesOf(Bridged(spans));
  ASSERT_THAT(ContactsOf(states), ElementsAre(IsEmpty(), ContactSet{kA}));
  EXPECT_NEAR(states[1].start, 0.5, 1e-12);
  EXPECT_NEAR(states[1].dwell, 0.52, 1e-12);
}

TEST(ContactSequence, ALongLossIsNotBridged) {
  const auto spans = Stream({{0.5, {kA}}, {0.05, {}}, {0.5, {kA}}});
  EXPECT_THAT(ContactsOf(StatesOf(Bridged(spans))),
              ElementsAre(ContactSet{kA}, IsEmpty(), ContactSet{kA}));
}

// A short loss of one contact is bridged even if another contact is lost for good.
TEST(ContactSequence, ContactsAreBridgedEachForItself) {
  const auto spans = Stream({{0.5, {kA, kB}}, {0.02, {kA}}, {0.02, {}}, {0.5, {kA}}});
  const auto bridged = Bridged(spans);
  EXPECT_THAT(bridged[1].contacts, ElementsAre(kA));
  EXPECT_THAT(bridged[2].contacts, ElementsAre(kA));
}

TEST(ContactSequence, WhatIsShortIsNoState) {
  const auto spans = Stream({{0.5, {kA}}, {0.02, {kA, kB}}, {0.5, {kA}}});
  const auto states = StatesOf(Bridged(spans));
  ASSERT_THAT(ContactsOf(states), ElementsAre(ContactSet{kA}));
  EXPECT_NEAR(states[0].dwell, 1, 1e-12);
}

// The end of a motion does not end a contact state.
TEST(ContactSequence, AStateGoesOnInTheNextMotion) {
  std::vector<ContactSpan> spans = Stream({{0.02, {kA}}, {0.02, {kA}}});
  spans[1].motion = 1;
  const auto states = StatesOf(spans);
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states[0].motion, 0);
  EXPECT_NEAR(states[0].dwell, 0.04, 1e-12);
}

// Laws of states for random streams. Neighbouring states differ, and none is short. States are in
// order of time, and their dwell sums to no more than the whole time. If all spans are long, the
// states are exactly the spans' contacts.
TEST(ContactSequence, LawsOfStates) {
  RandomStream random(1, "streams");
  for (int round = 0; round < 300; ++round) {
    const double least = round % 2 == 0 ? 0.001 : kLeastDwell;
    std::vector<std::pair<double, ContactSet>> lengths;
    std::vector<ContactSet> there;
    double total = 0;
    for (int i = 0; i < 20; ++i) {
      ContactSet set;
      for (const ContactKey& key : {kA, kB, kC}) {
        if (random.Index(2) == 0) set.push_back(key);
      }
      lengths.push_back({random.Uniform(least, 2 * kLeastDwell), set});
      total += lengths.back().first;
      if (there.empty() || there.back() != set) there.push_back(set);
    }
    const auto states = StatesOf(Bridged(Stream(lengths)));
    double dwell = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_GE(states[i].dwell, kLeastDwell);
      dwell += states[i].dwell;
      if (i == 0) continue;
      EXPECT_NE(states[i].contacts, states[i - 1].contacts);
      EXPECT_GE(states[i].start, states[i - 1].start + kLeastDwell - 1e-12);
    }
    EXPECT_LE(dwell, total + 1e-12);
    if (least == kLeastDwell) {
      EXPECT_EQ(ContactsOf(states), there);
    }
  }
}

TEST(PlannedContacts, AreTheStatesBeforeAndAfterEachMotion) {
  finemotion::FineMotionPlan plan;
  const auto add = [&](std::vector<ContactKey> kept, std::optional<ContactKey> until) {
    CertainMotion motion;
    motion.command.kept = std::move(kept);
    motion.command.until = until;
    plan.motions.push_back(motion);
  };
  add({}, kC);
  add({kC}, kA);
  add({kA}, {});
  add({}, {});
  const PlannedContacts planned = PlannedContactsOf(plan);
  EXPECT_THAT(planned.states, ElementsAre(IsEmpty(), ContactSet{kC}, ContactSet{kA, kC},
                                          ContactSet{kA}, IsEmpty()));
  ASSERT_EQ(planned.motions.size(), 4u);
  EXPECT_TRUE(planned.motions[2].Wants(kC)) << "it is let go";
  EXPECT_FALSE(planned.motions[3].Wants(kC));
  EXPECT_FALSE(planned.motions[1].Wants(kB));
}

}  // namespace
}  // namespace assay::check::contact_sequence_test
