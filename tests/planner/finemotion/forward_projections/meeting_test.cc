#include "planner/finemotion/forward_projections/meeting.h"

#include <fmt/format.h>
#include <glpk.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "bench/workloads/projections.h"

namespace assay::finemotion::meeting_test {
namespace {

using workloads::JudgedProjection;
using workloads::ProjectionAndContact;
using workloads::ProjectionModel;
using workloads::RandomProjection;
using workloads::StartShape;

constexpr std::uint64_t kSeed = 20;
constexpr double kTolerance = 1e-9;         // tolerance of Meet
constexpr double kSimplexTolerance = 1e-7;  // tolerance of GLPK

enum class Arithmetic { kDouble, kRational };

// A linear program over the points of a projection. Its variables are the factors of the generators
// of the start, the time s, and s times each factor of the generators of the velocity. The last
// ones are in -s .. s.
class PointsOfProjection {
 public:
  explicit PointsOfProjection(const ForwardProjection& projection)
      : projection_(projection), problem_(glp_create_prob(), &glp_delete_prob) {
    glp_term_out(GLP_OFF);
    for (int i = 0; i < starts(); ++i) AddColumn(-1, 1);
    AddColumn(0, projection.time);
    for (int i = 0; i < motions(); ++i) AddColumn(-projection.time, projection.time);
    AddColumn(0, 1e9);  // column of the excess
    glp_set_obj_coef(problem_.get(), excess(), 1);
    for (int i = 0; i < motions(); ++i) {
      AddRow({time(), time() + 1 + i}, {-1, 1}, 0);
      AddRow({time(), time() + 1 + i}, {-1, -1}, 0);
    }
  }

  // Adds the condition a . point <= b + excess.
  void Limit(const Eigen::VectorXd& a, double b) {
    std::vector<int> columns(excess());
    std::iota(columns.begin(), columns.end(), 1);
    std::vector<double> coefficients;
    const auto add = [&](const Eigen::MatrixXd& directions) {
      for (const auto direction : directions.colwise()) coefficients.push_back(a.dot(direction));
    };
    add(projection_.start.generators);
    add(projection_.velocity.center);
    add(projection_.velocity.generators);
    coefficients.push_back(-1);
    AddRow(columns, coefficients, b - a.dot(projection_.start.center));
  }

  double LeastExcess(Arithmetic arithmetic) {
    glp_smcp options;
    glp_init_smcp(&options);
    options.msg_lev = GLP_MSG_OFF;
    EXPECT_EQ(glp_simplex(problem_.get(), &options), 0);
    if (arithmetic == Arithmetic::kRational) glp_exact(problem_.get(), nullptr);
    EXPECT_EQ(glp_get_status(problem_.get()), GLP_OPT);
    return glp_get_obj_val(problem_.get());
  }

 private:
  int starts() const { return static_cast<int>(projection_.start.generators.cols()); }
  int motions() const { return static_cast<int>(projection_.velocity.generators.cols()); }
  int time() const { return starts() + 1; }
  int excess() const { return time() + motions() + 1; }

  void AddColumn(double low, double high) {
    const int column = glp_add_cols(problem_.get(), 1);
    glp_set_col_bnds(problem_.get(), column, low < high ? GLP_DB : GLP_FX, low, high);
  }

  void AddRow(std::vector<int> columns, std::vector<double> coefficients, double upper) {
    columns.insert(columns.begin(), 0);  // GLPK counts from 1
    coefficients.insert(coefficients.begin(), 0);
    const int row = glp_add_rows(problem_.get(), 1);
    glp_set_row_bnds(problem_.get(), row, GLP_UP, 0, upper);
    glp_set_mat_row(problem_.get(), row, static_cast<int>(columns.size()) - 1, columns.data(),
                    coefficients.data());
  }

  const ForwardProjection& projection_;
  std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> problem_;
};

// Returns the distance in the maximum norm.
double GreatestExcess(const ProjectionAndContact& given,
                      Arithmetic arithmetic = Arithmetic::kDouble) {
  PointsOfProjection points(given.projection);
  points.Limit(given.contact.row, -given.contact.offset);
  points.Limit(-given.contact.row, given.contact.offset);
  for (const HalfSpace& limit : given.contact.limits) points.Limit(limit.a, limit.b);
  return points.LeastExcess(arithmetic);
}

std::vector<JudgedProjection> Peers() {
  return workloads::ReadProjections(ASSAY_SOURCE_DIR
                                    "/bench/workloads/projection/box-vs-contact.txt");
}

constexpr int kQuarters = 4;  // quarters of the cases run side by side

int CaseCount() {
  const char* count = std::getenv("ASSAY_PROJECTION_CASES");
  return count == nullptr ? 100000 : std::atoi(count);
}

ProjectionModel RandomModel(RandomStream& random) {
  ProjectionModel model;
  model.tolerances = random.Index(11);
  model.tolerances_read = random.Index(2) == 0 ? model.tolerances : random.Index(4);
  model.limits = random.Index(5);
  model.start = random.Index(2) == 0 ? StartShape::kBox : StartShape::kZonotope;
  model.velocity_errors = random.Index(5);
  model.time = random.Index(4) == 0 ? 0 : random.Uniform(0, 3);
  return model;
}

// Returns a contact at height 0 of the last coordinate.
PrimitiveContact Floor(int dimension, const std::vector<HalfSpace>& limits = {}) {
  PrimitiveContact contact;
  contact.row = Eigen::VectorXd::Unit(dimension, dimension - 1);
  contact.limits = limits;
  return contact;
}

ForwardProjection Resting(const geometry::Zonotope& start) {
  const Eigen::Index n = start.center.size();
  return {start, {Eigen::VectorXd::Zero(n), Eigen::MatrixXd(n, 0)}};
}

TEST(Meet, AgreesWithThePeersExactVerdicts) {
  const auto peers = Peers();
  EXPECT_EQ(peers.size(), 240u);
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const Meeting meeting = Meet(peers[i].given.projection, peers[i].given.contact);
    EXPECT_EQ(meeting.meets, peers[i].meets) << "case " << i << ", margin " << meeting.margin;
  }
}

TEST(MeetAtAnEdge, AgreesWithThePeersVerdicts) {
  const auto peers = Peers();
  for (std::size_t i = 0; i < peers.size(); ++i) {
    EXPECT_EQ(MeetAtAnEdge(peers[i].given.projection, peers[i].given.contact),
              peers[i].meets_at_an_edge)
        << "case " << i;
  }
}

class RandomCases : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Quarters, RandomCases, testing::Range(0, kQuarters));

// The variable ASSAY_PROJECTION_CASES sets the number of cases, like 1000000, or fewer for a slow
// build.
TEST_P(RandomCases, AgreeWithALinearProgram) {
  RandomStream random(kSeed, fmt::format("meetings/{}", GetParam()));
  int meetings = 0;
  const int count = CaseCount() / kQuarters;
  for (int trial = 0; trial < count; ++trial) {
    const ProjectionAndContact given = RandomProjection(RandomModel(random), random);
    const Meeting meeting = Meet(given.projection, given.contact);
    const double excess = GreatestExcess(given);
    const double rows = 1 + static_cast<double>(given.contact.limits.size());
    ASSERT_EQ(meeting.meets, excess < kSimplexTolerance)
        << "trial " << trial << ": margin " << meeting.margin << ", excess " << excess;
    ASSERT_GE(meeting.margin, excess - kSimplexTolerance) << "trial " << trial;
    ASSERT_LE(meeting.margin, std::sqrt(rows) * excess + kSimplexTolerance) << "trial " << trial;
    meetings += meeting.meets ? 1 : 0;
  }
  EXPECT_GT(meetings, count / 4);
  EXPECT_LT(meetings, count * 3 / 4);
}

// Makes a difficult case. Errors have very different sizes, and some have the same direction or are
// zero. Limits are opposites of each other (a strip) or nearly the surface itself.
void MakeAwkward(ProjectionAndContact& given, RandomStream& random) {
  Eigen::MatrixXd& generators = given.projection.start.generators;
  for (auto generator : generators.colwise()) generator *= std::pow(10, random.Uniform(-7, 0));
  generators.col(0).setZero();
  generators.col(1) = -3 * generators.col(2);
  given.projection.velocity.generators *= std::pow(10, random.Uniform(-7, 0));
  PrimitiveContact& contact = given.contact;
  const double nearly = std::pow(10, random.Uniform(-10, 0));
  for (std::size_t i = 0; i < contact.limits.size(); ++i) {
    HalfSpace& limit = contact.limits[i];
    if (i == 1) limit = {-contact.limits[0].a, random.Uniform(0, 0.1) - contact.limits[0].b};
    if (i == 2) limit.a = contact.row + nearly * limit.a;
  }
}

TEST(Meet, AgreesWithALinearProgramOnAwkwardCases) {
  RandomStream random(kSeed, "awkward");
  for (int trial = 0; trial < CaseCount() / 20; ++trial) {
    ProjectionAndContact given = RandomProjection(RandomModel(random), random);
    MakeAwkward(given, random);
    const Meeting meeting = Meet(given.projection, given.contact);
    const double excess = GreatestExcess(given, Arithmetic::kRational);
    const double rows = 1 + static_cast<double>(given.contact.limits.size());
    ASSERT_GE(meeting.margin, excess - 2 * kTolerance)
        << fmt::format("trial {} {:.12g} {:.12g}", trial, meeting.margin, excess);
    ASSERT_LE(meeting.margin, std::sqrt(rows) * excess + 2 * kTolerance)
        << fmt::format("trial {} {:.12g} {:.12g}", trial, meeting.margin, excess);
  }
}

// The margin scales with the unit of length.
TEST(Meet, MarginIsHomogeneous) {
  RandomStream random(kSeed, "units");
  for (int trial = 0; trial < 1000; ++trial) {
    ProjectionAndContact given = RandomProjection(RandomModel(random), random);
    const Meeting before = Meet(given.projection, given.contact);
    constexpr double kUnit = 1e-3;
    for (geometry::Zonotope* z : {&given.projection.start, &given.projection.velocity}) {
      z->center *= kUnit;
      z->generators *= kUnit;
    }
    given.contact.offset *= kUnit;
    for (HalfSpace& limit : given.contact.limits) limit.b *= kUnit;
    const Meeting after = Meet(given.projection, given.contact, kUnit * kTolerance);
    EXPECT_EQ(after.meets, before.meets);
    EXPECT_NEAR(after.margin, kUnit * before.margin, kUnit * kTolerance);
  }
}

// Returns the image (gap, excesses) of the points that are reached at time s.
geometry::Zonotope ImageAt(double s, const ProjectionAndContact& given) {
  const auto& [projection, contact] = given;
  Eigen::MatrixXd rows(1 + contact.limits.size(), contact.row.size());
  Eigen::VectorXd offset(rows.rows());
  rows.row(0) = contact.row;
  offset[0] = contact.offset;
  for (std::size_t i = 0; i < contact.limits.size(); ++i) {
    rows.row(i + 1) = contact.limits[i].a;
    offset[i + 1] = -contact.limits[i].b;
  }
  const auto& [start, velocity, time] = projection;
  Eigen::MatrixXd errors(rows.cols(), start.generators.cols() + velocity.generators.cols());
  errors << start.generators, s * velocity.generators;
  return {rows * (start.center + s * velocity.center) + offset, rows * errors};
}

// Returns the part of (gap, excesses) that is outside the contact.
Eigen::VectorXd Outside(Eigen::VectorXd y) {
  y.tail(y.size() - 1) = y.tail(y.size() - 1).cwiseMax(0);
  return y;
}

// Returns the least norm by coordinate descent over the factors of the generators. The square of
// the norm is convex and smooth, so that the descent reaches the global minimum.
double LeastNormByDescent(const geometry::Zonotope& image) {
  constexpr int kMostRounds = 20000;
  Eigen::VectorXd y = image.center;
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(image.generators.cols());
  double change = 1;
  for (int round = 0; round < kMostRounds && change > 1e-12; ++round) {
    change = 0;
    for (Eigen::Index i = 0; i < factors.size(); ++i) {
      const auto g = image.generators.col(i);
      if (g.isZero(0)) continue;
      const double step = -g.dot(Outside(y)) / g.squaredNorm();
      const double moved = std::clamp(factors[i] + step, -1.0, 1.0);
      y += (moved - factors[i]) * g;
      change = std::max(change, std::abs(moved - factors[i]));
      factors[i] = moved;
    }
  }
  return Outside(y).norm();
}

// Returns the least distance over time by cutting off thirds. The distance is convex in time.
double DistanceByDescent(const ProjectionAndContact& given) {
  double low = 0;
  double high = given.projection.time;
  while (high - low > 1e-8) {
    const double a = low + (high - low) / 3;
    const double b = high - (high - low) / 3;
    const bool keeps_a =
        LeastNormByDescent(ImageAt(a, given)) < LeastNormByDescent(ImageAt(b, given));
    (keeps_a ? high : low) = keeps_a ? b : a;
  }
  return LeastNormByDescent(ImageAt((low + high) / 2, given));
}

TEST(Meet, MarginIsTheDistance) {
  RandomStream random(kSeed, "margins");
  int apart = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const ProjectionAndContact given = RandomProjection(RandomModel(random), random);
    const double margin = Meet(given.projection, given.contact).margin;
    EXPECT_NEAR(margin, DistanceByDescent(given), 1e-6) << "trial " << trial;
    apart += margin > 0 ? 1 : 0;
  }
  EXPECT_GT(apart, 15);
}

TEST(Meet, MarginsByHand) {
  const geometry::Zonotope cube =
      geometry::Zonotope::Box(Eigen::Vector3d(2, -1, 4), Eigen::Vector3d(3, 1, 5));
  const HalfSpace left{.a = Eigen::Vector3d(1, 0, 0), .b = -1};  // x <= -1
  EXPECT_NEAR(Meet(Resting(cube), Floor(3)).margin, 4, kTolerance);
  EXPECT_NEAR(Meet(Resting(cube), Floor(3, {left})).margin, 5, kTolerance);  // distances of 4 and 3

  ForwardProjection falling = Resting(cube);
  falling.velocity.center = Eigen::Vector3d(-1, 0, -1);
  falling.time = 3;
  EXPECT_NEAR(Meet(falling, Floor(3)).margin, 1, kTolerance);
  EXPECT_NEAR(Meet(falling, Floor(3, {left})).margin, 1, kTolerance);
  falling.time = 4;
  EXPECT_TRUE(Meet(falling, Floor(3, {left})).meets);
  EXPECT_EQ(Meet(falling, Floor(3, {left})).margin, 0);
}

TEST(Meet, WhatIsNearerThanTheToleranceMeets) {
  for (const double gap : {0.0, 1e-12, 9e-10, -9e-10}) {
    const geometry::Zonotope cube =
        geometry::Zonotope::Box(Eigen::Vector3d(0, 0, std::min(gap, gap - 1)),
                                Eigen::Vector3d(1, 1, gap < 0 ? gap : gap - 1 + 1));
    EXPECT_TRUE(Meet(Resting(cube), Floor(3)).meets) << gap;
  }
  const geometry::Zonotope above =
      geometry::Zonotope::Box(Eigen::Vector3d(0, 0, 1e-6), Eigen::Vector3d(1, 1, 1));
  EXPECT_FALSE(Meet(Resting(above), Floor(3)).meets);
  EXPECT_TRUE(Meet(Resting(above), Floor(3), 1e-5).meets);
}

// The cases make the corral of the nearest point degenerate: a point on the edge of the contact, no
// errors, motions along the surface, and the same limit twice.
TEST(Meet, SurvivesDegenerateImages) {
  const HalfSpace right{.a = Eigen::Vector3d(-1, 0, 0), .b = 0};
  const HalfSpace twice{.a = Eigen::Vector3d(-2, 0, 0), .b = 0};
  const geometry::Zonotope point{Eigen::Vector3d::Zero(), Eigen::MatrixXd(3, 0)};
  EXPECT_TRUE(Meet(Resting(point), Floor(3, {right, twice})).meets);

  ForwardProjection sliding = Resting({Eigen::Vector3d(-1, 0, 0), Eigen::MatrixXd(3, 0)});
  sliding.velocity = {Eigen::Vector3d(1, 0, 0), Eigen::MatrixXd::Zero(3, 4)};
  sliding.time = 1;
  EXPECT_TRUE(Meet(sliding, Floor(3, {right, twice, right})).meets);
  sliding.time = 0.75;
  EXPECT_NEAR(Meet(sliding, Floor(3, {right, twice})).margin, std::sqrt(0.25 * 0.25 * 5),
              kTolerance);

  geometry::Zonotope flat{Eigen::Vector3d(0, 0, 1), Eigen::MatrixXd::Zero(3, 3)};
  flat.generators.row(0).setConstant(0.5);
  EXPECT_NEAR(Meet(Resting(flat), Floor(3, {right, twice})).margin, 1, kTolerance);
}

TEST(Meet, TakesMoreLimitsThanTheUsualFour) {
  std::vector<HalfSpace> limits;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * std::acos(-1) / 4;
    limits.push_back({.a = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0), .b = 1});
  }
  const auto at = [](double x, double y) {
    const Eigen::Vector3d p(x, y, 0);
    return Resting(geometry::Zonotope::Box(p - Eigen::Vector3d::Constant(0.5),
                                           p + Eigen::Vector3d::Constant(0.5)));
  };
  EXPECT_TRUE(Meet(at(1.49, 0), Floor(3, limits)).meets);
  EXPECT_FALSE(Meet(at(1.51, 0), Floor(3, limits)).meets);
  EXPECT_TRUE(Meet(at(1.2, 1.2), Floor(3, limits)).meets);
  EXPECT_FALSE(Meet(at(1.22, 1.22), Floor(3, limits)).meets);
}

TEST(Meet, MarginShrinksAsErrorsGrow) {
  RandomStream random(kSeed, "ladder");
  for (int trial = 0; trial < 500; ++trial) {
    ProjectionAndContact given = RandomProjection(RandomModel(random), random);
    const geometry::Zonotope start = given.projection.start;
    const geometry::Zonotope velocity = given.projection.velocity;
    double margin = Meet(given.projection, given.contact).margin;
    for (const double factor : {1.25, 1.5, 2.0, 3.0, 4.0}) {
      given.projection.start.generators = factor * start.generators;
      given.projection.velocity.generators = factor * velocity.generators;
      const double enlarged = Meet(given.projection, given.contact).margin;
      EXPECT_LE(enlarged, margin + kTolerance);
      margin = enlarged;
    }
  }
}

// The argument of Dakin and Popplestone in section 4 fails for two limits. A triangle (a point that
// moves with an error) times a square meets the corner of the contact only with its inside.
TEST(MeetAtAnEdge, MissesWhatOnlyTheInsideMeets) {
  ForwardProjection triangle = Resting(
      geometry::Zonotope::Box(Eigen::Vector4d(-1, -1, -1, -1), Eigen::Vector4d(-1, -1, 1, 1)));
  triangle.velocity = {Eigen::Vector4d(1.25, 1.25, 0, 0), Eigen::Vector4d(0.75, -0.75, 0, 0)};
  triangle.time = 1;
  const HalfSpace right{.a = Eigen::Vector4d(-1, 0, 0, 0)};
  const HalfSpace ahead{.a = Eigen::Vector4d(0, -1, 0, 0)};
  EXPECT_TRUE(Meet(triangle, Floor(4, {right, ahead})).meets);
  EXPECT_FALSE(MeetAtAnEdge(triangle, Floor(4, {right, ahead})));
  EXPECT_TRUE(MeetAtAnEdge(triangle, Floor(4, {right})));

  const geometry::Zonotope cube =
      geometry::Zonotope::Box(-Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones());
  const HalfSpace strip_begin{.a = Eigen::Vector3d(-1, 0, 0), .b = 0.25};
  const HalfSpace strip_end{.a = Eigen::Vector3d(1, 0, 0), .b = 0.25};
  EXPECT_TRUE(Meet(Resting(cube), Floor(3, {strip_begin, strip_end})).meets);
  EXPECT_FALSE(MeetAtAnEdge(Resting(cube), Floor(3, {strip_begin, strip_end})));
  EXPECT_TRUE(MeetAtAnEdge(Resting(cube), Floor(3, {strip_end})));
}

// For at most one limit the argument of the paper holds. For more limits the test never reports a
// meeting that does not exist.
TEST(MeetAtAnEdge, IsRightForOneLimitAndNeverInventsAMeeting) {
  RandomStream random(kSeed, "edges");
  int missed = 0;
  int meetings = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    ProjectionModel model = RandomModel(random);
    model.tolerances = random.Index(3);
    model.velocity_errors = random.Index(3);
    const ProjectionAndContact given = RandomProjection(model, random);
    const bool meets = Meet(given.projection, given.contact).meets;
    const bool found = MeetAtAnEdge(given.projection, given.contact);
    EXPECT_TRUE(!found || meets) << "trial " << trial;
    EXPECT_TRUE(found || !meets || model.limits > 1) << "trial " << trial;
    meetings += meets ? 1 : 0;
    missed += meets && !found ? 1 : 0;
  }
  RecordProperty("missed", fmt::format("{} of {}", missed, meetings));
  EXPECT_GT(missed, 0);
}

TEST(MeetAtAnEdge, FindsEdgesOfEachKind) {
  ForwardProjection falling = Resting({Eigen::Vector3d(0, 0, 1), Eigen::MatrixXd(3, 0)});
  falling.velocity = {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, 0)};
  falling.time = 2;  // a triangle with two edges from the start and one far edge
  EXPECT_TRUE(MeetAtAnEdge(falling, Floor(3)));
  falling.time = 1;  // the far edge is in the surface
  EXPECT_TRUE(MeetAtAnEdge(falling, Floor(3, {{Eigen::Vector3d(1, 0, 0), -0.5}})));
  EXPECT_TRUE(MeetAtAnEdge(
      falling, Floor(3, {{Eigen::Vector3d(1, 0, 0), 0.5}, {Eigen::Vector3d(-1, 0, 0), 0.5}})));
  EXPECT_FALSE(MeetAtAnEdge(falling, Floor(3, {{Eigen::Vector3d(1, 0, 0), -1.5}})));
  falling.time = 0.99;
  EXPECT_FALSE(MeetAtAnEdge(falling, Floor(3)));
  const geometry::Zonotope point{Eigen::Vector3d::Zero(), Eigen::MatrixXd(3, 0)};
  EXPECT_TRUE(MeetAtAnEdge(Resting(point), Floor(3)));
  const geometry::Zonotope needle{Eigen::Vector3d::Zero(),
                                  Eigen::Vector3d(1, 1, 1)};  // the start is an edge
  EXPECT_TRUE(MeetAtAnEdge(Resting(needle), Floor(3)));
}

TEST(MeetDeathTest, RowsOfAnotherDimensionAreABrokenInvariant) {
  const geometry::Zonotope cube =
      geometry::Zonotope::Box(-Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones());
  EXPECT_DEATH(Meet(Resting(cube), Floor(4)), "size");
  EXPECT_DEATH(Meet(Resting(cube), Floor(3, {{Eigen::Vector4d(1, 0, 0, 0), 0}})), "size");
}

}  // namespace
}  // namespace assay::finemotion::meeting_test
