#include "sim/check/contact_sequences/contact_observer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/geometry/pose.h"
#include "sim/check/contact_sequences/sequence_comparison.h"
#include "sim/execution/trial/mating_trial.h"
#include "tests/sim/execution/figure15.h"

namespace assay::check::contact_observer_test {
namespace {

using finemotion::ContactKind;
using finemotion::PrimitiveContact;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kMicrometre = 1e-6;

// --- Which contacts bear a force, for contacts that the test makes itself.

PrimitiveContact Touching(int moving, const Vector3& at, const Vector3& normal, double gap = 0) {
  PrimitiveContact contact;
  contact.kind = ContactKind::kVertexFace;
  contact.moving = moving;
  contact.at = at;
  contact.normal = normal;
  contact.offset = gap;
  return contact;
}

const Vector3 kUp = Vector3::UnitZ();
const Pose kHere = geometry::Translation(0.1, 0.2, 0.3);
const Vector3 kOrigin = kHere.translation();

std::vector<std::pair<int, double>> Loads(const ContactPoint& point,
                                          const std::vector<PrimitiveContact>& contacts,
                                          const PlannedContacts::Motion& wanted = {}) {
  std::vector<std::pair<int, double>> loads;
  for (const ContactLoad& load : LoadsOf(point, contacts, kHere, wanted))
    loads.emplace_back(load.contact.moving, load.force);
  return loads;
}

TEST(Loads, AreOfWhatTouchesThere) {
  const std::vector<PrimitiveContact> contacts = {
      Touching(1, Vector3::Zero(), kUp), Touching(2, {0.01, 0, 0}, kUp),
      Touching(3, Vector3::Zero(), Vector3::UnitX()),
      Touching(4, Vector3::Zero(), kUp, 50 * kMicrometre)};
  EXPECT_THAT(Loads({kOrigin + 10 * kMicrometre * kUp, kUp, 4}, contacts),
              ElementsAre(std::pair(1, 4.0)));
  EXPECT_THAT(Loads({kOrigin + Vector3(0.01, 0, 0), kUp, 4}, contacts),
              ElementsAre(std::pair(2, 4.0)));
  EXPECT_THAT(Loads({kOrigin, Vector3::UnitX(), 4}, contacts), ElementsAre(std::pair(3, 4.0)));
  EXPECT_THAT(Loads({kOrigin, Vector3::UnitY(), 4}, contacts), IsEmpty());
  EXPECT_THAT(Loads({kOrigin + Vector3(0, 0.001, 0), kUp, 4}, contacts), IsEmpty());
}

TEST(Loads, OfSeveralAtOnePlaceAreOfTheOneThatIsWanted) {
  const std::vector<PrimitiveContact> contacts = {Touching(1, Vector3::Zero(), kUp),
                                                  Touching(2, {20 * kMicrometre, 0, 0}, kUp)};
  const ContactPoint point{kOrigin, kUp, 4};
  EXPECT_THAT(Loads(point, contacts), ElementsAre(std::pair(1, 4.0)));
  PlannedContacts::Motion wanted;
  wanted.after = {finemotion::KeyOf(contacts[1])};
  EXPECT_THAT(Loads(point, contacts, wanted), ElementsAre(std::pair(2, 4.0)));
}

// An edge lies on a face and is pressed at a seam of the face. The law of the lever shares the
// force between both contacts.
TEST(Loads, BetweenTwoContactsAreShared) {
  const std::vector<PrimitiveContact> contacts = {Touching(1, Vector3::Zero(), kUp),
                                                  Touching(2, {0.01, 0, 0}, kUp)};
  const auto loads = Loads({kOrigin + Vector3(0.002, 0, 0), kUp, 5}, contacts);
  ASSERT_EQ(loads.size(), 2u);
  for (const auto& [moving, force] : loads) EXPECT_NEAR(force, moving == 1 ? 4 : 1, 1e-6);
  EXPECT_THAT(Loads({kOrigin - Vector3(0.002, 0, 0), kUp, 5}, contacts), IsEmpty());
}

// --- Which contacts touch in the simulation.

const domain::Problem& Square() {
  static const domain::Problem problem = domain::ReadProblem(
      Document::Load(ASSAY_SOURCE_DIR "/scenarios/mate-square.yaml"), ASSAY_SOURCE_DIR "/models");
  return problem;
}

std::vector<PrimitiveContact> ContactsAt(const finemotion::Passage& passage, const Pose& X) {
  return finemotion::PrimitiveContacts(passage.moving, passage.stationary, X, 0.012, {}, 0.02);
}

// Returns a motion along `direction` until the first contact that is not kept. The motion is a pure
// shift, so the rows of the contacts stay as they are.
finemotion::CertainMotion MoveToContact(const finemotion::Passage& passage, const Pose& from,
                                        const std::vector<ContactKey>& kept,
                                        const Vector3& direction) {
  finemotion::CertainMotion motion;
  double length = 0.015;
  for (const PrimitiveContact& contact : ContactsAt(passage, from)) {
    const double rate = contact.normal.dot(direction);
    const double distance = -contact.offset / rate;
    if (rate > -1e-9 || distance < 0 || distance > length) continue;
    if (std::ranges::find(kept, finemotion::KeyOf(contact)) != kept.end()) continue;
    const bool inside = std::ranges::all_of(contact.limits, [&](const auto& limit) {
      return distance * direction.dot(limit.a.template head<3>()) <= limit.b;
    });
    if (!inside) continue;
    length = distance;
    motion.command.until = finemotion::KeyOf(contact);
  }
  motion.command.kept = kept;
  motion.X_StationaryAfter = geometry::Translation(length * direction.x(), length * direction.y(),
                                                   length * direction.z()) *
                             from;
  motion.check.longest = 1.5;
  std::vector<ContactKey> touching = kept;
  if (motion.command.until) touching.push_back(*motion.command.until);
  const std::vector<PrimitiveContact> contacts = ContactsAt(passage, motion.X_StationaryAfter);
  for (const ContactKey& key : touching) {
    if (const auto* contact = finemotion::Find(contacts, key)) motion.contacts.push_back(*contact);
  }
  EXPECT_EQ(motion.contacts.size(), kept.size() + 1);
  return motion;
}

// Returns a plan in which the tilted tip comes down on the rim and then slides along the rim until
// it touches a second time.
finemotion::FineMotionPlan TwoContacts(const finemotion::Passage& passage) {
  finemotion::FineMotionPlan plan;
  Pose& X = plan.X_StationaryStart;
  X = passage.X_StationaryEntry * geometry::RotationZ(-0.082) * geometry::RotationY(-0.178) *
      geometry::RotationX(-0.014);
  X.translation() += Vector3(0.011, 0.0035, -0.0047);
  plan.motions.push_back(MoveToContact(passage, X, {}, passage.mating));
  plan.motions.push_back(MoveToContact(passage, plan.motions[0].X_StationaryAfter,
                                       {plan.motions[0].command.until.value()}, Vector3::UnitZ()));
  return plan;
}

TEST(ContactObserver, SeesThePlannedContactsWithoutErrors) {
  const domain::MatingId id(0);
  const domain::Mating& mating = Square().mating(id);
  const finemotion::MatingGeometry geometry = finemotion::GeometryOf(Square(), mating);
  const finemotion::FineMotionPlan plan = TwoContacts(geometry.passage);
  plan::Strategy strategy = finemotion::StrategyOf(geometry, plan);
  // The final slide into the crevice is left out, because the two motions do not lead there.
  strategy.motions.pop_back();
  const PlannedContacts planned = PlannedContactsOf(plan);
  ASSERT_EQ(planned.states.size(), 3u);

  const scene::Scene scene(Square(), {.grasp = scene::GraspMode::kWeld});
  ContactObserver observer(scene, mating, geometry, planned);
  const execution::MatingSetting setting{.mating = id,
                                         .hold = execution::HoldForMating(Square(), id),
                                         .X_HeldTip = geometry.X_HeldTip};
  execution::MatingTrialOptions options;
  options.observer = std::ref(observer);
  const execution::MatingResult result =
      execution::RunMatingTrial(Square(), scene, setting, strategy, options);
  EXPECT_EQ(result.end.outcome, execution::TrialOutcome::kSucceeded) << result.end.reason;

  EXPECT_GT(observer.seen().points, 20);
  EXPECT_EQ(observer.seen().unmapped, 0) << observer.seen().first_unmapped;
  const std::vector<ContactSpan> bridged = Bridged(observer.seen().spans);
  std::vector<ContactSet> states;
  for (const ObservedState& state : StatesOf(bridged)) states.push_back(state.contacts);
  EXPECT_EQ(states, planned.states);
  const SequenceComparison comparison = Compare(planned, bridged);
  EXPECT_TRUE(comparison.matches());
  EXPECT_THAT(comparison.events, IsEmpty());
}

}  // namespace
}  // namespace assay::check::contact_observer_test
