#include "planner/finemotion/strategy_search/known_beliefs.h"

#include <gtest/gtest.h>

namespace assay::finemotion::known_beliefs_test {
namespace {

const Vector3 kIn = -Vector3::UnitZ();
const ContactKey kContact{ContactKind::kVertexFace, 1, 2};

Belief BeliefOf(const PoseChange& at, double shift) {
  Belief belief;
  belief.X_StationaryMoving = Displaced(Pose::Identity(), at);
  PoseChange errors;
  errors << Vector3::Constant(shift), Vector3::Constant(0.01);
  belief.errors = errors.asDiagonal().toDenseMatrix();
  return belief;
}

PoseChange At(double x, double z, double turn) {
  PoseChange at = PoseChange::Zero();
  at[0] = x;
  at[2] = z;
  at[4] = turn;
  return at;
}

Belief Kept(Belief belief) {
  belief.kept = {kContact};
  return belief;
}

class KnownBeliefsTest : public testing::Test {
 protected:
  KnownBeliefsTest() { EXPECT_TRUE(known_.Add(0, BeliefOf(At(0, 0, 0), 1e-3))); }

  KnownBeliefs known_{kIn};
};

TEST_F(KnownBeliefsTest, TheSameIsKnown) {
  EXPECT_FALSE(known_.Add(0, BeliefOf(At(0, 0, 0), 1e-3)));
}

TEST_F(KnownBeliefsTest, SoIsOneThatKnowsLess) {
  EXPECT_FALSE(known_.Add(0, BeliefOf(At(0, 0, 0), 2e-3)));
}

TEST_F(KnownBeliefsTest, OneThatKnowsMoreIsNot) {
  EXPECT_TRUE(known_.Add(0, BeliefOf(At(0, 0, 0), 0.5e-3)));
}

TEST_F(KnownBeliefsTest, NorOneElsewhereOrTurned) {
  EXPECT_TRUE(known_.Add(0, BeliefOf(At(2e-3, 0, 0), 1e-3)));
  EXPECT_TRUE(known_.Add(0, BeliefOf(At(0, 0, 0.05), 1e-3)));
  EXPECT_TRUE(known_.Add(1, BeliefOf(At(0, 0, 0), 1e-3))) << "at another critical point";
  EXPECT_TRUE(known_.Add(0, Kept(BeliefOf(At(0, 0, 0), 1e-3)))) << "in contact";
}

TEST_F(KnownBeliefsTest, FreeOfContactThePartMayBeFartherOutButNotFartherIn) {
  EXPECT_FALSE(known_.Add(0, BeliefOf(At(0, 0.01, 0), 1e-3)));
  EXPECT_TRUE(known_.Add(0, BeliefOf(At(0, -0.01, 0), 1e-3)));
  EXPECT_TRUE(known_.Add(0, Kept(BeliefOf(At(0, 0, 0), 1e-3))));
  EXPECT_TRUE(known_.Add(0, Kept(BeliefOf(At(0, 0.01, 0), 1e-3))));
}

}  // namespace
}  // namespace assay::finemotion::known_beliefs_test
