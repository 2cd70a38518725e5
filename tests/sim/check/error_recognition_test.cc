#include "sim/check/error_recognition.h"

#include <gtest/gtest.h>

namespace assay::check {
namespace {

using exec::MatingOutcome;
using finemotion::ContactKind;

const ContactKey kWall = {ContactKind::kVertexFace, 3, 1};
const ContactKey kRim = {ContactKind::kEdgeEdge, 2, 5};

// The wall is touched from 1 to 2 seconds, the rim from 1.5 to 3.
std::vector<ContactSpan> Spans() {
  return {{0, 0, 1, {}},
          {0, 1, 1.5, {kWall}},
          {1, 1.5, 2, {kWall, kRim}},
          {1, 2, 3, {kRim}},
          {2, 3, 4, {}}};
}

exec::RecognizedContact Made(const ContactKey& key) { return {finemotion::Name(key), false}; }
exec::RecognizedContact Lost(const ContactKey& key) { return {finemotion::Name(key), true}; }

TEST(ErrorRecognition, IsRightIfTheContactWasThere) {
  EXPECT_TRUE(IsRight(Made(kWall), 1.2, Spans()));
  EXPECT_FALSE(IsRight(Made(kRim), 1.2, Spans()));
  EXPECT_TRUE(IsRight(Made(kRim), 2.5, Spans()));
  EXPECT_FALSE(IsRight(Made(kWall), 2.5, Spans()));
  EXPECT_TRUE(IsRight(Made(kWall), 2.005, Spans())) << "it has just rebounded";
}

TEST(ErrorRecognition, OfALossIsRightIfItWasNotThere) {
  EXPECT_TRUE(IsRight(Lost(kWall), 2.5, Spans()));
  EXPECT_FALSE(IsRight(Lost(kRim), 2.5, Spans()));
}

TEST(ErrorRecognition, EveryErrorStateOfATrialCounts) {
  exec::StrategyEnd end;
  RecognitionTally tally;
  Count(end, Spans(), tally);
  EXPECT_EQ(tally.errors, 0) << "it was done at the first attempt";
  end.recovered = {{.outcome = MatingOutcome::kTimeout, .motion = 0, .time = 1.2},
                   {.outcome = MatingOutcome::kWrongContact,
                    .motion = 1,
                    .recognized = Made(kRim),
                    .time = 2.5}};
  end.outcome = MatingOutcome::kWrongContact;
  end.motion = 1;
  end.recognized = Made(kWall);
  end.time = 2.5;
  Count(end, Spans(), tally);
  EXPECT_EQ(tally.errors, 3);
  EXPECT_EQ(tally.named, 2);
  EXPECT_EQ(tally.right, 1);
  end.motion = 3;  // the way in the crevice
  end.recovered.clear();
  Count(end, Spans(), tally);
  EXPECT_EQ(tally.errors, 3);
}

}  // namespace
}  // namespace assay::check
