#include "planner/finemotion/motions/segment.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/contacts/contact_finder.h"
#include "tests/oracle/random_pose.h"

namespace assay::finemotion::segment_test {
namespace {

using workloads::BoxShape;
using workloads::SquareHoleShape;

using Contacts = std::vector<PrimitiveContact>;

constexpr std::uint64_t kSeed = 71;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kHalf = 0.01905;  // half of the width of the peg, metres
constexpr double kReach = 0.02;    // metres within which contacts are looked for
constexpr double kTurn = 0.02;     // radians
constexpr double kVelocityError = 0.002;
constexpr double kRadius = 0.02;
constexpr double kRounding = 1e-12;  // metres
constexpr double kClear = 3e-5;  // metres, for limits and along a motion; Check has a slack, too
constexpr double kClearTurn = 2.5e-3;  // radians, for limits that are turns
// Neighbouring surfaces, linearized at different points, do not quite join. A motion may pass the
// wanted contact by this much, metres, and still be stopped by the next one.
constexpr double kSeam = 2e-4;

const Polyhedron& Peg() {
  static const Polyhedron peg = BoxShape({-kHalf, -kHalf, 0}, {kHalf, kHalf, 0.07});
  return peg;
}

const Polyhedron& Hole() {
  static const Polyhedron hole = SquareHoleShape(kHalf + 0.25e-3, 0.038, 0.07);
  return hole;
}

Contacts ContactsAt(const Pose& X, const Polyhedron& stationary = Hole(), double turn = kTurn) {
  return PrimitiveContacts(Peg(), stationary, X, kReach, {}, turn);
}

// Returns the tolerances. Half of them concern the peg (its bottom and its width), the others the
// hole.
const std::vector<ModelTolerance>& Tolerances() {
  using Of = ModelTolerance::Of;
  static const std::vector<ModelTolerance> tolerances = {
      {"bottom", Of::kMovingFaces, {4}},   {"width", Of::kMovingFaces, {0, 1}},
      {"side", Of::kMovingFaces, {2}},     {"top", Of::kStationaryFaces, {0}},
      {"wall", Of::kStationaryFaces, {1}}, {"hole", Of::kStationaryFaces, {1, 2, 3, 4}}};
  return tolerances;
}

// Returns the contacts with the tolerances that `believed` has.
Contacts ContactsFor(const BelievedPose& believed, const Pose& X) {
  if (believed.tolerances.size() == 0) return ContactsAt(X);
  return PrimitiveContacts(Peg(), Hole(), X, kReach, Tolerances(), kTurn);
}

Pose Turned(const Vector3& w) {
  Pose X = Pose::Identity();
  if (w.norm() > 0) X.linear() = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
  return X;
}

Pose RandomTilted(RandomStream& random) {
  Pose X =
      Turned({random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), random.Uniform(-0.08, 0.08)});
  double lowest = 0;
  for (const OuterVertex& vertex : Peg().vertices) lowest = std::min(lowest, (X * vertex.p).z());
  X.pretranslate(Vector3(random.Uniform(-0.006, 0.006), random.Uniform(-0.006, 0.006),
                         random.Uniform(0.002, 0.006) - lowest));
  return X;
}

GeneralizedPoint Motion(const Vector3& d, const Vector3& w) {
  GeneralizedPoint z(kPoseDimensions);
  z << d, w;
  return z;
}

// Returns the motion that leads from one pose to the other.
GeneralizedPoint Between(const Pose& X_from, const Pose& X_to) {
  const Eigen::AngleAxisd turn(X_to.linear() * X_from.linear().transpose());
  return Motion(X_to.translation() - X_from.translation(), turn.angle() * turn.axis());
}

template <class Items, class Item>
bool Holds(const Items& items, const Item& item) {
  return std::ranges::find(items, item) != std::ranges::end(items);
}

// --- Sampled motions in the linear model.

Eigen::MatrixXd RowsOf(const Contacts& contacts, const std::vector<ContactKey>& keys) {
  Eigen::MatrixXd rows(0, kPoseDimensions);
  for (const ContactKey& key : keys) {
    const PrimitiveContact* contact = Find(contacts, key);
    if (contact == nullptr) continue;
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.row(rows.rows() - 1) = contact->row.head<kPoseDimensions>().transpose();
  }
  return rows;
}

// Returns by how much errors of the model open contacts.
Eigen::VectorXd OpenedBy(const Eigen::VectorXd& model_errors, const Contacts& contacts,
                         const std::vector<ContactKey>& keys) {
  Eigen::VectorXd opened(std::ssize(keys));
  for (Eigen::Index i = 0; i < opened.size(); ++i) {
    const PrimitiveContact* contact = Find(contacts, keys[static_cast<std::size_t>(i)]);
    opened[i] = contact->row.tail(model_errors.size()).dot(model_errors);
  }
  return opened;
}

// Returns the least change that closes contacts with these openings.
GeneralizedPoint ClosedBy(const Eigen::MatrixXd& rows, const Eigen::VectorXd& opened) {
  if (rows.rows() == 0) return GeneralizedPoint::Zero(kPoseDimensions);
  Eigen::VectorXd lengths(kPoseDimensions);
  lengths << 1, 1, 1, 1 / kRadius, 1 / kRadius, 1 / kRadius;
  const Eigen::MatrixXd scaled = rows * lengths.asDiagonal();
  const Eigen::VectorXd closing = scaled.completeOrthogonalDecomposition().solve(-opened);
  return lengths.cwiseProduct(closing);
}

GeneralizedPoint With(const GeneralizedPoint& pose, const Eigen::VectorXd& model_errors) {
  GeneralizedPoint z(pose.size() + model_errors.size());
  z << pose, model_errors;
  return z;
}

// Pads a pose with zero errors of the model: the parts are as planned.
GeneralizedPoint Padded(const GeneralizedPoint& pose, const PrimitiveContact& contact) {
  return With(pose, Eigen::VectorXd::Zero(contact.row.size() - pose.size()));
}

// Returns the projection onto the directions that do not change the gaps, by the least change. A
// radian counts as `radius` metres.
Eigen::MatrixXd TangentProjection(const Eigen::MatrixXd& rows) {
  Eigen::VectorXd weights(kPoseDimensions);
  weights << 1, 1, 1, kRadius, kRadius, kRadius;
  const Eigen::MatrixXd scaled = rows * weights.cwiseInverse().asDiagonal();
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Identity(kPoseDimensions, kPoseDimensions);
  if (rows.rows() > 0) {
    tangent -= scaled.completeOrthogonalDecomposition().pseudoInverse() * scaled;
  }
  return weights.cwiseInverse().asDiagonal() * tangent * weights.asDiagonal();
}

double RandomFactor(RandomStream& random) { return std::clamp(random.Uniform(-2, 2), -1.0, 1.0); }

GeneralizedPoint Sample(const Eigen::MatrixXd& generators, RandomStream& random) {
  GeneralizedPoint z = GeneralizedPoint::Zero(generators.rows());
  for (const auto generator : generators.colwise()) z += RandomFactor(random) * generator;
  return z;
}

// Returns the errors of the velocity: metres per metre, radians per radian, and each for the other
// at `radius`.
GeneralizedPoint VelocityErrors(const GeneralizedPoint& displacement, double velocity_error) {
  const double moved = displacement.head<3>().norm();
  const double turned = displacement.tail<3>().norm();
  GeneralizedPoint widths(kPoseDimensions);
  widths << Vector3::Constant(moved + kRadius * turned), Vector3::Constant(turned);
  return velocity_error * widths;
}

struct Case {
  Contacts contacts;  // the contacts at the end of the command
  BelievedPose believed;
  Command command;

  SegmentModel Model(double scale = 1) const { return {contacts, scale * kVelocityError, kRadius}; }
};

// A sampled motion, in coordinates about the end of the command.
struct SampledMotion {
  GeneralizedPoint start;
  GeneralizedPoint velocity;

  GeneralizedPoint At(double time) const { return start + time * velocity; }
};

// The hand turns the part about the believed tip, so that errors turn with it.
SampledMotion SampleMotion(const Case& given, const Eigen::MatrixXd& tangent,
                           RandomStream& random) {
  const GeneralizedPoint& displacement = given.command.displacement;
  const Eigen::Matrix3d turn = Displaced(Pose::Identity(), displacement).linear();
  Eigen::VectorXd factors(given.believed.errors.cols());
  for (double& factor : factors) factor = RandomFactor(random);
  GeneralizedPoint error = given.believed.errors * factors;
  error.head<3>() = turn * error.head<3>();
  error.tail<3>() = turn * error.tail<3>();
  const Eigen::VectorXd& widths = given.believed.tolerances;
  const Eigen::VectorXd model = widths.cwiseProduct(factors.head(widths.size()));
  const GeneralizedPoint closed = ClosedBy(RowsOf(given.contacts, given.command.kept),
                                           OpenedBy(model, given.contacts, given.command.kept));
  const GeneralizedPoint drifts = VelocityErrors(displacement, kVelocityError);
  const GeneralizedPoint drift = Sample(drifts.asDiagonal(), random);
  return {With(tangent * error + closed - displacement, model),
          With(displacement + tangent * drift, Eigen::VectorXd::Zero(model.size()))};
}

double LimitsLeft(const PrimitiveContact& contact, const GeneralizedPoint& z) {
  double left = 1;
  for (const HalfSpace& limit : contact.limits) left = std::min(left, -limit.Excess(z));
  return left;
}

bool IsClearlyOutside(const PrimitiveContact& contact, const GeneralizedPoint& z) {
  return std::ranges::any_of(contact.limits, [&](const HalfSpace& limit) {
    return limit.Excess(z) > (limit.a.head<3>().isZero(0) ? kClearTurn : kClear);
  });
}

struct Touch {
  ContactKey key;
  double time = 0;
  double limits_left = 0;  // metres
};

// Returns the contacts that become closed, by rising time. Contacts that are closed at the start
// are left out.
std::vector<Touch> Touches(const Case& given, const SampledMotion& motion, double longest) {
  std::vector<Touch> touches;
  for (const PrimitiveContact& contact : given.contacts) {
    if (Holds(given.believed.kept, KeyOf(contact))) continue;
    const double gap = contact.Gap(motion.start);
    const double speed = -contact.row.dot(motion.velocity);
    if (gap <= 0 || speed <= 0 || gap > longest * speed + kRounding) continue;
    const double left = LimitsLeft(contact, motion.At(gap / speed));
    if (left >= (KeyOf(contact) == given.command.until ? -kSeam : 0))
      touches.push_back({KeyOf(contact), gap / speed, left});
  }
  std::ranges::sort(touches, {}, &Touch::time);
  return touches;
}

// Returns whether the motion leads beyond the end of a kept contact. Faces have regions, and a
// contact may go from one region to the next.
bool Loses(const Case& given, const SampledMotion& motion, double end) {
  const auto is_lost_at = [&](const ContactKey& key, const GeneralizedPoint& z) {
    return std::ranges::all_of(given.contacts, [&](const PrimitiveContact& contact) {
      return KeyOf(contact) != key || IsClearlyOutside(contact, z);
    });
  };
  return std::ranges::any_of(given.command.kept, [&](const ContactKey& key) {
    return is_lost_at(key, motion.start) || is_lost_at(key, motion.At(end));
  });
}

// --- Cases.

// The least amount of the displacement at which something is touched without errors.
struct FirstContact {
  double amount = 1;
  ContactKey key;
};

std::optional<FirstContact> FirstOnTheWay(const Contacts& contacts, const GeneralizedPoint& q,
                                          const std::vector<ContactKey>& but) {
  std::optional<FirstContact> first;
  for (const PrimitiveContact& contact : contacts) {
    if (Holds(but, KeyOf(contact))) continue;
    const double speed = -contact.row.head<kPoseDimensions>().dot(q);
    if (speed <= 1e-9 || contact.offset + speed <= 0) continue;
    const double amount = 1 + contact.offset / speed;
    if (LimitsLeft(contact, Padded((amount - 1) * q, contact)) < 0) continue;
    if (!first || amount < first->amount) first = FirstContact{amount, KeyOf(contact)};
  }
  return first;
}

// Returns the change q after the kept contacts have been closed.
GeneralizedPoint Closed(const BelievedPose& believed, GeneralizedPoint q,
                        const std::vector<ContactKey>& kept) {
  const Contacts contacts = ContactsFor(believed, Displaced(believed.X_StationaryMoving, q));
  const Eigen::MatrixXd rows = RowsOf(contacts, kept);
  if (rows.rows() == 0) return q;
  Eigen::VectorXd gaps(rows.rows());
  Eigen::Index row = 0;
  for (const ContactKey& key : kept) {
    const PrimitiveContact* contact = Find(contacts, key);
    if (contact != nullptr) gaps[row++] = contact->offset;
  }
  return q - rows.completeOrthogonalDecomposition().pseudoInverse() * gaps;
}

// Returns a command along q that ends at a contact or, if no contact is near enough, without one.
std::optional<Case> Commanded(const BelievedPose& believed, GeneralizedPoint q,
                              const std::vector<ContactKey>& kept, bool to_contact) {
  std::optional<FirstContact> first;
  for (int round = 0; round < 8; ++round) {
    q = Closed(believed, q, kept);
    first = FirstOnTheWay(ContactsFor(believed, Displaced(believed.X_StationaryMoving, q)), q,
                          believed.kept);
    if (!to_contact) continue;
    if (!first || first->amount < 0.05 || first->amount > 4) return std::nullopt;
    q *= first->amount;
  }
  if (to_contact && std::abs(first->amount - 1) * q.norm() > 1e-8) return std::nullopt;
  Case made{ContactsFor(believed, Displaced(believed.X_StationaryMoving, q)), believed, {q, kept}};
  if (to_contact) made.command.until = first->key;
  for (const ContactKey& key : kept) {
    if (Find(made.contacts, key) == nullptr) return std::nullopt;
  }
  return made;
}

Eigen::MatrixXd RandomErrors(RandomStream& random) {
  const double size = std::array{0.05, 0.2, 0.5, 1.0}[static_cast<std::size_t>(random.Index(4))];
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(kPoseDimensions, kPoseDimensions);
  for (int i = 0; i < kPoseDimensions; ++i) {
    errors(i, i) = size * random.Uniform(0.5, 1.2) * (i < 3 ? 1e-3 : 0.5 * kDegree);
  }
  return errors;
}

// Returns the believed pose with errors of the model, whose columns come first.
BelievedPose WithTolerances(BelievedPose believed, double width) {
  believed.tolerances.setConstant(std::ssize(Tolerances()), width);
  const Eigen::Index t = believed.tolerances.size();
  PoseChanges errors = PoseChanges::Zero(kPoseDimensions, t + believed.errors.cols());
  errors.rightCols(believed.errors.cols()) = believed.errors;
  believed.errors = errors;
  return believed;
}

enum class Model { kExact, kWithTolerances };

std::optional<Case> RandomFirst(RandomStream& random, Model model = Model::kExact) {
  BelievedPose believed{RandomTilted(random), RandomErrors(random)};
  if (model == Model::kWithTolerances) {
    believed = WithTolerances(believed, random.Uniform(0.01e-3, 0.2e-3));
  }
  const Vector3 d(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), -1);
  const Vector3 w = random.Index(2) * oracle::RandomVector(random, 2);
  const double length = random.Uniform(0.001, 0.008);
  return Commanded(believed, length * Motion(d, w), {}, random.Index(4) != 0);
}

// Returns a random next motion, along some of the contacts.
std::optional<Case> RandomNext(const BelievedPose& believed, RandomStream& random) {
  std::vector<ContactKey> kept = believed.kept;
  GeneralizedPoint q = Motion(oracle::RandomVector(random, 0.004),
                              random.Index(2) * oracle::RandomVector(random, 0.02));
  const Contacts contacts = ContactsFor(believed, believed.X_StationaryMoving);
  if (random.Index(4) == 0) {
    const PrimitiveContact* left = Find(contacts, kept[0]);
    if (left == nullptr) return std::nullopt;
    kept.erase(kept.begin());
    q.head<3>() = 0.003 * left->normal + 0.1 * q.head<3>();
    q.tail<3>() *= 0.1;
  }
  q = TangentProjection(RowsOf(contacts, kept)) * q;
  return Commanded(believed, q, kept, random.Index(3) != 0);
}

// --- Verdicts compared with sampled motions.

struct Counted {
  int certain = 0;
  int uncertain = 0;
  int touching_wrongly = 0;  // cases in which a sample does so
  int kept = 0;              // certain cases with kept contacts
};

struct Ends {
  bool as_commanded = true;
  bool clearly_not = false;
  double time = 1;
};

Ends EndOf(const Case& given, const SampledMotion& motion, double longest) {
  const auto touches = Touches(given, motion, given.command.until ? longest : 1);
  const auto is_end = [&](const Touch& touch) { return touch.key == given.command.until; };
  const auto end = std::ranges::find_if(touches, is_end);
  Ends ends;
  if (end != touches.end()) ends.time = end->time;
  ends.as_commanded = !given.command.until || end != touches.end();
  const double speed = motion.velocity.head<3>().norm();
  for (const Touch& touch : touches) {
    if (is_end(touch)) continue;
    const double before = given.command.until ? speed * (ends.time - touch.time) : 1;
    if (touch.limits_left > kClear && (before > kClear || end == touches.end())) {
      ends.clearly_not = true;
    }
  }
  ends.clearly_not |= Loses(given, motion, ends.time);
  return ends;
}

void ExpectHolds(const BelievedPose& after, const Pose& X_about, const GeneralizedPoint& z,
                 RandomStream& random) {
  const Eigen::Index t = after.tolerances.size();
  const GeneralizedPoint inside =
      z.head<kPoseDimensions>() - Between(X_about, after.X_StationaryMoving);
  for (int i = 0; i < 8; ++i) {
    GeneralizedPoint a =
        Motion(oracle::RandomVector(random, 1), kRadius * oracle::RandomVector(random, 1));
    a /= a.head<3>().norm();
    Eigen::VectorXd of_model(t);
    for (double& slope : of_model) slope = random.Uniform(-1, 1);
    Eigen::VectorXd parts = after.errors.transpose() * a;
    parts.head(t) += of_model.cwiseProduct(after.tolerances);
    EXPECT_LE(a.dot(inside) + of_model.dot(z.tail(t)), parts.lpNorm<1>() + 1e-8);
  }
}

// Compares a case with samples. Returns the result of Check.
SegmentCheck Compare(const Case& given, RandomStream& random, Counted& counted) {
  constexpr int kSamples = 300;
  SegmentCheck check = Check(given.Model(), given.believed, given.command);
  const Pose X_about = Displaced(given.believed.X_StationaryMoving, given.command.displacement);
  const Eigen::MatrixXd tangent = TangentProjection(RowsOf(given.contacts, given.command.kept));
  bool wrong = false;
  for (int i = 0; i < kSamples; ++i) {
    const SampledMotion motion = SampleMotion(given, tangent, random);
    const Ends ends = EndOf(given, motion, check.certain ? check.longest : 1);
    wrong |= ends.clearly_not;
    if (!check.certain) continue;
    EXPECT_FALSE(ends.clearly_not);
    EXPECT_TRUE(ends.as_commanded);
    ExpectHolds(check.after, X_about, motion.At(ends.time), random);
  }
  ++(check.certain ? counted.certain : counted.uncertain);
  if (wrong) ++counted.touching_wrongly;
  if (check.certain && !given.command.kept.empty()) ++counted.kept;
  return check;
}

Counted CompareRandom(Model model, int trials) {
  RandomStream random(kSeed, "motions");
  Counted counted;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(trial);
    std::optional<Case> given = RandomFirst(random, model);
    for (int segment = 0; given && segment < 4; ++segment) {
      SCOPED_TRACE(segment);
      const SegmentCheck check = Compare(*given, random, counted);
      if (!check.certain) break;
      if (testing::Test::HasFailure()) return counted;
      std::vector<ContactKey> expected = given->command.kept;
      if (given->command.until) expected.push_back(*given->command.until);
      std::vector<ContactKey> kept = check.after.kept;
      std::ranges::sort(expected);
      std::ranges::sort(kept);
      EXPECT_EQ(kept, expected);
      if (kept.empty()) break;
      given.reset();
      for (int i = 0; i < 30 && !given; ++i) given = RandomNext(check.after, random);
    }
  }
  return counted;
}

TEST(Check, IsCertainOnlyWhereNoSampledMotionGoesWrong) {
  const Counted counted = CompareRandom(Model::kExact, 500);
  EXPECT_GT(counted.certain, 100);
  EXPECT_GT(counted.kept, 20);
  EXPECT_GT(counted.touching_wrongly, 100);
  // The check is not much too conservative: in more than half of the cases that it calls uncertain,
  // some sampled motion really goes wrong.
  EXPECT_GT(counted.touching_wrongly, counted.uncertain / 2);
}

// A certain motion does not fail for parts with errors up to their tolerances, either.
TEST(Check, IsCertainOnlyWhereNoSampledPartGoesWrong) {
  const Counted counted = CompareRandom(Model::kWithTolerances, 250);
  EXPECT_GT(counted.certain, 50);
  EXPECT_GT(counted.kept, 10);
  EXPECT_GT(counted.touching_wrongly, counted.uncertain / 2);
}

TEST(Check, ThePapersTestIsComparedWhereItIsApplicable) {
  RandomStream random(kSeed, "compared");
  TestComparison comparison;
  for (int trial = 0; trial < 60; ++trial) {
    const std::optional<Case> given = RandomFirst(random);
    if (!given) continue;
    SegmentModel model = given->Model();
    const bool certain = Check(model, given->believed, given->command).certain;
    model.test = MeetingTest::kCompare;
    const SegmentCheck compared = Check(model, given->believed, given->command);
    EXPECT_EQ(compared.certain, certain);
    comparison += compared.comparison;
    model.test = MeetingTest::kEdges;
    const SegmentCheck by_edges = Check(model, given->believed, given->command);
    EXPECT_LE(certain, by_edges.certain);  // it never finds a meeting that does not exist
    if (compared.comparison.missed == 0) {
      EXPECT_EQ(certain, by_edges.certain);
    }
  }
  EXPECT_GT(comparison.compared, 30);
  EXPECT_LE(comparison.compared, comparison.tests);
  EXPECT_LE(comparison.missed, comparison.compared);
}

// --- Unwanted contacts, and the scales at which they occur.

BelievedPose Scaled(BelievedPose believed, double factor) {
  believed.errors *= factor;
  return believed;
}

std::set<std::pair<ContactKey, bool>> UnwantedIn(const SegmentCheck& check) {
  std::set<std::pair<ContactKey, bool>> keys;
  for (const Unwanted& unwanted : check.unwanted) keys.insert({unwanted.contact, unwanted.is_loss});
  return keys;
}

TEST(Check, LargerErrorsDoAllThatSmallerOnesDo) {
  RandomStream random(kSeed, "scales");
  int told = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const std::optional<Case> given = RandomFirst(random);
    if (!given) continue;
    SCOPED_TRACE(trial);
    std::set<std::pair<ContactKey, bool>> with_less;
    for (const double scale : kLadder) {
      const SegmentCheck check =
          Check(given->Model(scale), Scaled(given->believed, scale), given->command, Telling::kAll);
      if (check.unwanted.empty()) continue;  // also for motions that may never end
      const auto with_more = UnwantedIn(check);
      EXPECT_TRUE(std::ranges::includes(with_more, with_less)) << scale;
      with_less = with_more;
    }
    told += static_cast<int>(with_less.size());
  }
  EXPECT_GT(told, 100);
}

TEST(Check, TheFirstThatIsToldIsOneOfAll) {
  RandomStream random(kSeed, "first");
  for (int trial = 0; trial < 100; ++trial) {
    const std::optional<Case> given = RandomFirst(random);
    if (!given) continue;
    const SegmentCheck all = Check(given->Model(), given->believed, given->command, Telling::kAll);
    const SegmentCheck first = Check(given->Model(), given->believed, given->command);
    EXPECT_EQ(first.certain, all.certain);
    EXPECT_EQ(first.unwanted.size(), std::min<std::size_t>(1, all.unwanted.size()));
    EXPECT_TRUE(std::ranges::includes(UnwantedIn(all), UnwantedIn(first)));
  }
}

TEST(Check, WithLessErrorsItIsCertainToo) {
  RandomStream random(kSeed, "less");
  int certain = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::optional<Case> given = RandomFirst(random);
    if (!given) continue;
    if (!Check(given->Model(), given->believed, given->command).certain) continue;
    const double less = random.Uniform();
    const BelievedPose believed = Scaled(given->believed, less);
    EXPECT_TRUE(Check(given->Model(less), believed, given->command).certain) << trial;
    ++certain;
  }
  EXPECT_GT(certain, 20);
}

// --- Above a floor.

const Polyhedron& Floor() {
  static const Polyhedron floor = BoxShape({-1, -1, -1}, {1, 1, 0});
  return floor;
}

// The peg comes down onto its corner (-x, -y), which is vertex 0, by the errorless amount. The top
// of the floor is face 5.
constexpr ContactKey kCorner{ContactKind::kVertexFace, 0, 5};
constexpr double kHigh = 0.01;

BelievedPose Above(const Vector3& w, const Eigen::MatrixXd& errors) {
  Pose X = Turned(w);
  X.pretranslate(Vector3(0, 0, kHigh - (X * Peg().vertices[0].p).z()));
  return {X, errors};
}

SegmentCheck ComeDown(const BelievedPose& believed, double velocity_error = kVelocityError) {
  const Command down{kHigh * Motion(-Vector3::UnitZ(), Vector3::Zero()), {}, kCorner};
  const Contacts contacts =
      ContactsAt(Displaced(believed.X_StationaryMoving, down.displacement), Floor(), 0.15);
  return Check({contacts, velocity_error, kRadius}, believed, down, Telling::kAll);
}

Eigen::MatrixXd ErrorsOf(double length, double angle) {
  GeneralizedPoint widths(kPoseDimensions);
  widths << Vector3::Constant(length), Vector3::Constant(angle);
  return widths.asDiagonal();
}

TEST(Check, ComingDownOnTheLowestCornerIsCertain) {
  const SegmentCheck check = ComeDown(Above({0.15, -0.12, 0}, ErrorsOf(1e-3, kDegree)));
  EXPECT_TRUE(check.certain);
  EXPECT_EQ(check.after.kept, std::vector<ContactKey>{kCorner});
  EXPECT_GT(check.longest, 1.1);  // more than one millimetre of ten
  EXPECT_LT(check.longest, 1.3);
  const PrimitiveContact* corner =
      Find(ContactsAt(check.after.X_StationaryMoving, Floor()), kCorner);
  ASSERT_NE(corner, nullptr);
  EXPECT_NEAR(corner->offset, 0, kClear);
}

TEST(Check, ComingDownUprightIsNot) {
  const SegmentCheck check = ComeDown(Above(Vector3::Zero(), ErrorsOf(1e-3, kDegree)));
  EXPECT_FALSE(check.certain);
  for (const int other : {1, 2, 3}) {
    const ContactKey key{ContactKind::kVertexFace, other, 5};
    EXPECT_TRUE(UnwantedIn(check).contains({key, false})) << other;
  }
}

// The corner may come down beside the floor, where there is nothing.
TEST(Check, ComingDownNearTheFloorsEndIsNot) {
  for (const bool may_miss : {false, true}) {
    BelievedPose believed = Above({0.15, -0.12, 0}, ErrorsOf(1e-3, 0));
    const double inside = may_miss ? 0.5e-3 : 1.5e-3;
    const Vector3 corner = believed.X_StationaryMoving * Peg().vertices[0].p;
    believed.X_StationaryMoving.pretranslate(Vector3(1 - inside - corner.x(), 0, 0));
    EXPECT_EQ(ComeDown(believed, 0).certain, !may_miss);
  }
}

// --- Contacts for turned poses.

bool MayBeParallel(const PrimitiveContact& contact, const Pose& X, double turn) {
  if (contact.kind != ContactKind::kEdgeEdge) return false;
  const Vector3 u = X.linear() * Peg().edges[static_cast<std::size_t>(contact.moving)].direction();
  const Vector3 v = Hole().edges[static_cast<std::size_t>(contact.stationary)].direction();
  return u.cross(v).norm() <= std::sin(turn);
}

TEST(PrimitiveContactsOfTurned, AreAmongThoseWithThatTurn) {
  RandomStream random(kSeed, "turned");
  int found = 0;
  int only_turned = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Pose X = RandomTilted(random);
    if (trial % 3 == 0) X.linear().setIdentity();
    const double turn = random.Uniform(0, 0.05);
    Vector3 w = oracle::RandomVector(random, turn);
    if (w.norm() > turn) w *= turn / w.norm();
    X.translation().z() = random.Uniform(-0.01, 0.01);
    // The pose is shifted so that one of the contacts is closed.
    Pose X_turned = Displaced(X, Motion(Vector3::Zero(), w));
    const Contacts near = PrimitiveContacts(Peg(), Hole(), X_turned, 0.01);
    if (near.empty()) continue;
    const PrimitiveContact& one =
        near[static_cast<std::size_t>(random.Index(static_cast<int>(near.size())))];
    const Vector3 shift = -one.offset * one.normal;
    X.pretranslate(shift);
    X_turned.pretranslate(shift);
    const Contacts unturned = PrimitiveContacts(Peg(), Hole(), X, kReach, {}, turn);
    const Contacts plain = PrimitiveContacts(Peg(), Hole(), X, kReach);
    for (const PrimitiveContact& contact : PrimitiveContacts(Peg(), Hole(), X_turned, 0.01)) {
      if (std::abs(contact.offset) > 1e-6 || LimitsLeft(contact, GeneralizedPoint::Zero(6)) < 0)
        continue;
      if (MayBeParallel(contact, X, turn)) continue;
      EXPECT_NE(Find(unturned, KeyOf(contact)), nullptr)
          << trial << " " << Name(contact) << " " << w.transpose() << " turn " << turn << "\n"
          << X.matrix();
      ++found;
      if (Find(plain, KeyOf(contact)) == nullptr) ++only_turned;
    }
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(only_turned, 3);
}

TEST(Between, IsWhatDisplaces) {
  RandomStream random(kSeed, "between");
  for (int i = 0; i < 100; ++i) {
    const Pose from = oracle::RandomPose(random, 1);
    const Pose to = oracle::RandomPose(random, 1);
    EXPECT_TRUE(Displaced(from, Between(from, to)).isApprox(to, kRounding));
  }
}

}  // namespace
}  // namespace assay::finemotion::segment_test
