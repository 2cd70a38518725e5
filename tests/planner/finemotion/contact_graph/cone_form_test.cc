#include "planner/finemotion/contact_graph/cone_form.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <optional>

#include "planner/base/random.h"

namespace assay::finemotion::cone_form_test {
namespace {

constexpr std::uint64_t kSeed = 91;
constexpr double kRounding = 1e-9;

struct PolyhedralSet {
  Eigen::MatrixXd rows;
  Eigen::VectorXd values;
  std::vector<HalfSpace> limits;
};

Eigen::VectorXd RandomDirection(RandomStream& random, Eigen::Index size) {
  Eigen::VectorXd v(size);
  for (double& x : v) x = random.Uniform(-1, 1);
  return v;
}

// Returns a set with one or two rows, up to 4 limits in the dimensions of a pose, and up to 4
// tolerances. Some rows and limits are combinations of earlier ones.
PolyhedralSet RandomSet(RandomStream& random) {
  const Eigen::Index dimensions = kPoseDimensions + random.Index(5);
  PolyhedralSet set;
  const Eigen::VectorXd inside = RandomDirection(random, dimensions);
  set.rows.resize(1 + random.Index(3), dimensions);
  for (Eigen::Index i = 0; i < set.rows.rows(); ++i) {
    set.rows.row(i) = i == 2 ? Eigen::RowVectorXd(set.rows.row(0) - 2 * set.rows.row(1))
                             : RandomDirection(random, dimensions).transpose();
  }
  set.values = set.rows * inside;
  for (int i = random.Index(5); i > 0; --i) {
    HalfSpace limit{RandomDirection(random, dimensions), random.Uniform(-1, 1)};
    if (!set.limits.empty() && random.Index(4) == 0) limit.a = -0.5 * set.limits.back().a;
    set.limits.push_back(limit);
  }
  return set;
}

bool HasRay(const ConeForm& form, int limit) { return std::ranges::count(form.limits, limit) > 0; }

// Returns by how much z violates the rows, and those limits that have rays.
double Outside(const PolyhedralSet& set, const ConeForm& form, const GeneralizedPoint& z) {
  double outside = (set.rows * z - set.values).cwiseAbs().maxCoeff();
  for (const int i : form.limits) {
    outside = std::max(outside, set.limits[static_cast<std::size_t>(i)].Excess(z));
  }
  return outside;
}

TEST(ConeFormTest, EveryPointOfTheFormIsInTheSet) {
  RandomStream random(kSeed, "form");
  for (int i = 0; i < 2000; ++i) {
    const PolyhedralSet set = RandomSet(random);
    const ConeForm form = ConeFormOf(set.rows, set.values, set.limits);
    const GeneralizedPoint z = form.characteristic_point +
                               form.rays * RandomDirection(random, form.rays.cols()).cwiseAbs() +
                               form.tangents * RandomDirection(random, form.tangents.cols());
    EXPECT_LT(Outside(set, form, z), kRounding) << "set " << i;
  }
}

// Returns a point on the rows inside the limits. Returns none if the set is so narrow or far away
// that no point is found.
std::optional<GeneralizedPoint> RandomPoint(const PolyhedralSet& set, const ConeForm& form,
                                            RandomStream& random) {
  const auto solver = set.rows.completeOrthogonalDecomposition();
  for (int tries = 0; tries < 100; ++tries) {
    GeneralizedPoint z = 3 * RandomDirection(random, set.rows.cols());
    z += solver.solve(set.values - set.rows * z);
    if (Outside(set, form, z) < kRounding) return z;
  }
  return std::nullopt;
}

TEST(ConeFormTest, EveryPointOfTheSetHasTheForm) {
  RandomStream random(kSeed, "set");
  for (int found = 0; found < 1000;) {
    const PolyhedralSet set = RandomSet(random);
    const ConeForm form = ConeFormOf(set.rows, set.values, set.limits);
    const std::optional<GeneralizedPoint> z = RandomPoint(set, form, random);
    if (!z) continue;
    ++found;
    Eigen::MatrixXd directions(set.rows.cols(), form.rays.cols() + form.tangents.cols());
    directions << form.rays, form.tangents;
    const Eigen::VectorXd multiples =
        directions.colPivHouseholderQr().solve(*z - form.characteristic_point);
    EXPECT_LT((form.characteristic_point + directions * multiples - *z).norm(), 1e-7) << found;
    if (form.rays.cols() == 0) continue;
    EXPECT_GT(multiples.head(form.rays.cols()).minCoeff(), -1e-7) << found;
  }
}

TEST(ConeFormTest, RaysAndTangentsAreAsTheHeaderSays) {
  RandomStream random(kSeed, "directions");
  for (int i = 0; i < 2000; ++i) {
    const PolyhedralSet set = RandomSet(random);
    const ConeForm form = ConeFormOf(set.rows, set.values, set.limits);
    ASSERT_EQ(form.rays.cols(), std::ssize(form.limits));
    EXPECT_TRUE((form.tangents.transpose() * form.tangents).isIdentity(kRounding));
    EXPECT_TRUE((set.rows * form.tangents).isZero(kRounding));
    EXPECT_TRUE((set.rows * form.rays).isZero(kRounding));
    EXPECT_TRUE((form.tangents.transpose() * form.rays).isZero(kRounding));
    EXPECT_TRUE((form.tangents.transpose() * form.characteristic_point).isZero(kRounding));
    for (Eigen::Index ray = 0; ray < form.rays.cols(); ++ray) {
      EXPECT_NEAR(form.rays.col(ray).norm(), 1, kRounding);
      for (Eigen::Index other = 0; other < form.rays.cols(); ++other) {
        const auto limit = static_cast<std::size_t>(form.limits[static_cast<std::size_t>(other)]);
        const double along = set.limits[limit].a.dot(form.rays.col(ray));
        if (ray == other) {
          EXPECT_LT(along, -kRounding);
        } else {
          EXPECT_NEAR(along, 0, kRounding);
        }
      }
    }
  }
}

TEST(ConeFormTest, EveryNormalIsASumOfThoseTaken) {
  // Rows, limits with rays, and tangents must span the space. Limits without a ray are then
  // dependent.
  RandomStream random(kSeed, "rank");
  for (int i = 0; i < 2000; ++i) {
    const PolyhedralSet set = RandomSet(random);
    const ConeForm form = ConeFormOf(set.rows, set.values, set.limits);
    EXPECT_EQ(form.rays.cols() + form.tangents.cols() + std::min<Eigen::Index>(2, set.rows.rows()),
              set.rows.cols());
    for (std::size_t k = 0; k < set.limits.size(); ++k) {
      EXPECT_TRUE((form.tangents.transpose() * set.limits[k].a).isZero(kRounding));
      const bool first_of_a_pair = k == 0 || set.limits[k].a != -0.5 * set.limits[k - 1].a;
      EXPECT_EQ(HasRay(form, static_cast<int>(k)), first_of_a_pair) << "set " << i;
    }
  }
}

TEST(ConeFormTest, BothEndsOfANarrowFaceHaveOneRay) {
  Eigen::MatrixXd rows(1, 6);
  rows << 0, 0, 1, 0, 0, 0;
  Eigen::VectorXd across = Eigen::VectorXd::Zero(6);
  across[0] = 1;
  const ConeForm form =
      ConeFormOf(rows, Eigen::VectorXd::Zero(1), {{across, 0.001}, {-across, 0.003}});
  EXPECT_THAT(form.limits, testing::ElementsAre(0));
  EXPECT_TRUE(form.rays.isApprox(-across));
  EXPECT_TRUE(form.characteristic_point.isApprox(0.001 * across));
  EXPECT_EQ(form.tangents.cols(), 4);
}

TEST(ConeFormTest, FreeSpaceIsAllTangents) {
  const ConeForm form = ConeFormOf(Eigen::MatrixXd(0, 6), Eigen::VectorXd(0), {});
  EXPECT_TRUE(form.characteristic_point.isZero());
  EXPECT_EQ(form.rays.cols(), 0);
  EXPECT_TRUE((form.tangents.transpose() * form.tangents).isIdentity());
}

// In figure 6 and equation 2 of the paper, 1 row and 3 limits make 3 rays and 6 - 3 - 1 tangents.
TEST(ConeFormTest, FigureSixOfThePaper) {
  Eigen::MatrixXd row(1, 6);
  row << 0, 1, 0, 0.55, 0, -1;  // vertex (-1, 0, -0.55), face y = 0
  Eigen::VectorXd b(6);
  Eigen::VectorXd c(6);
  Eigen::VectorXd d(6);
  b << 0, 0, 0, 0, 0, -1;
  c << 0, 0, 0, -1, 0, 0;
  d << 1, 0, 0, 0, -0.55, 0;  // left of the face x = -6
  const ConeForm form = ConeFormOf(row, Eigen::VectorXd::Zero(1), {{b, 0}, {c, 0}, {d, -5}});
  ASSERT_EQ(form.rays.cols(), 3);
  ASSERT_EQ(form.tangents.cols(), 2);
  // Computed by hand, the vertex is exactly at x = -6, and nothing is turned more than necessary.
  Eigen::VectorXd q(6);
  q << -5, 0, 0, 0, 2.75, 0;
  q /= 1 + 0.55 * 0.55;
  EXPECT_TRUE(form.characteristic_point.isApprox(q)) << form.characteristic_point.transpose();
  // The first ray turns by +z and goes +y as far as the vertex goes down. The second ray turns by
  // +x and goes -y as far as the vertex goes up. The third ray goes away from the end of the face.
  Eigen::MatrixXd rays(6, 3);
  rays.col(0) << 0, 1, 0, 0, 0, 1;
  rays.col(1) << 0, -0.55, 0, 1, 0, 0;
  rays.col(2) << -1, 0, 0, 0, 0.55, 0;
  EXPECT_TRUE(form.rays.isApprox(rays.colwise().normalized())) << form.rays;
  // The tangents are along z, and around the height of the vertex at the end of the face.
  Eigen::VectorXd along = Eigen::VectorXd::Unit(6, 2);
  Eigen::VectorXd around(6);
  around << 0.55, 0, 0, 0, 1, 0;
  const Eigen::MatrixXd projector = form.tangents * form.tangents.transpose();
  EXPECT_TRUE((projector * along).isApprox(along));
  EXPECT_TRUE((projector * around).isApprox(around));
}

TEST(ConeFormDeathTest, RowsThatContradictEachOther) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Ones(2, 6);
  EXPECT_DEATH(ConeFormOf(rows, Eigen::Vector2d(0, 1), {}), "row 1 of 2 contradicts");
}

}  // namespace
}  // namespace assay::finemotion::cone_form_test
