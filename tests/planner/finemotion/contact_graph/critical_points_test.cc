#include "planner/finemotion/contact_graph/critical_points.h"
#include "planner/geometry/coordinates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>


namespace assay::finemotion::critical_points_test {
namespace {

using ::testing::IsEmpty;

// Returns a box with corners in millimetres.
ConvexPiece Box(const Vector3& low, const Vector3& high) {
  ConvexPiece piece;
  for (int i = 0; i < 8; ++i) {
    piece.corners.emplace_back(1e-3 * Vector3((i & 1) != 0 ? high.x() : low.x(),
                                              (i & 2) != 0 ? high.y() : low.y(),
                                              (i & 4) != 0 ? high.z() : low.z()));
  }
  return piece;
}

// Returns a block with its top at z = 0 and its bottom at z = -40. It has a square hole of the
// given half width from `top` down to `bottom`.
std::vector<ConvexPiece> Around(double half, double top, double bottom) {
  const double out = 30;
  return {Box({half, -out, bottom}, {out, out, top}), Box({-out, -out, bottom}, {-half, out, top}),
          Box({-half, half, bottom}, {half, out, top}),
          Box({-half, -out, bottom}, {half, -half, top})};
}

std::vector<ConvexPiece> operator+(std::vector<ConvexPiece> a, const std::vector<ConvexPiece>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Returns the touching faces, found naively: a grid of points of each moving face is tested on each
// stationary face.
std::set<TouchingFaces> TouchingBySamples(const Polyhedron& moving, const Polyhedron& stationary,
                                          const Pose& X) {
  std::set<TouchingFaces> touching;
  const auto lies_on = [](const Vector3& p, const OuterFace& face) {
    if (std::abs(face.normal.dot(p) - face.height) > 1e-9) return false;
    return std::ranges::any_of(face.region, [&](const std::vector<Vector3>& outline) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector3 along = outline[(i + 1) % outline.size()] - outline[i];
        if (face.normal.dot(along.cross(p - outline[i])) < 1e-12) return false;
      }
      return true;
    });
  };
  for (std::size_t i = 0; i < moving.faces.size(); ++i) {
    for (const std::vector<Vector3>& outline : moving.faces[i].region) {
      for (int a = 0; a < 100; ++a) {
        for (int b = 0; b < 100; ++b) {
          // The outline is divided into triangles that share its first corner. The fractions 0.37
          // and 0.41 keep the points away from round numbers.
          const double u = (a + 0.37) / 100;
          const double v = (b + 0.41) / 100 * (1 - u);
          for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
            const Vector3 p = X * Vector3(outline[0] + u * (outline[k] - outline[0]) +
                                          v * (outline[k + 1] - outline[0]));
            for (std::size_t j = 0; j < stationary.faces.size(); ++j) {
              if ((X.linear() * moving.faces[i].normal).dot(stationary.faces[j].normal) < -0.999 &&
                  lies_on(p, stationary.faces[j])) {
                touching.insert({static_cast<int>(i), static_cast<int>(j)});
              }
            }
          }
        }
      }
    }
  }
  return touching;
}

struct Mating {
  std::vector<ConvexPiece> moving, stationary;
  Vector3 mating_vector;  // millimetres; the motion ends at the identity
};

class Judge {
 public:
  explicit Judge(const Mating& mating)
      : moving_(OutsideOf(mating.moving)),
        stationary_(OutsideOf(mating.stationary)),
        vector_(1e-3 * mating.mating_vector),
        points_(CriticalPoints(moving_, stationary_, Pose::Identity(), vector_)) {
    for (const CriticalPoint& point : points_) travels_.push_back(1e3 * point.travel);
  }

  const std::vector<CriticalPoint>& points() const { return points_; }

  void ExpectTravels(const std::vector<double>& millimetres) const {
    EXPECT_THAT(travels_, ::testing::Pointwise(::testing::DoubleNear(1e-6), millimetres));
  }

  // Expects that the set of touching faces changes at critical points and nowhere else.
  void ExpectSamplesAgree() const {
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
      EXPECT_EQ(points_[i].after, points_[i + 1].before);
      for (const double part : {0.21, 0.5, 0.77, 0.97}) {
        const double travel = (1 - part) * points_[i].travel + part * points_[i + 1].travel;
        Pose X = Pose::Identity();
        X.translation() = (travel / vector_.norm() - 1) * vector_;
        const std::set<TouchingFaces> sampled = TouchingBySamples(moving_, stationary_, X);
        EXPECT_EQ(std::vector<TouchingFaces>(sampled.begin(), sampled.end()), points_[i].after)
            << travel;
      }
    }
  }

 private:
  const Polyhedron moving_, stationary_;
  const Vector3 vector_;
  const std::vector<CriticalPoint> points_;
  std::vector<double> travels_;
};

TEST(CriticalPoints, OfAPegInABlindHole) {
  const Judge judge(
      {.moving = {Box({-10, -10, -40}, {10, 10, 20})},
       .stationary = Around(10, 0, -40) + std::vector{Box({-30, -30, -50}, {30, 30, -40})},
       .mating_vector = {0, 0, -60}});
  judge.ExpectTravels({20, 60});
  judge.ExpectSamplesAgree();
  EXPECT_THAT(judge.points()[0].before, IsEmpty());
  EXPECT_EQ(judge.points()[0].after.size(), 4u);  // the sides are on the walls
  EXPECT_EQ(judge.points()[1].after.size(), 5u);  // the bottom touches, too
  EXPECT_NEAR(judge.points()[0].X_StationaryMoving.translation().z(), 0.040, 1e-12);
}

// The narrow end enters the counterbore without touching, and then its hole. Then the wide end
// enters, and then the shoulder lands.
TEST(CriticalPoints, OfASteppedPeg) {
  const Judge judge(
      {.moving = {Box({-6, -6, -35}, {6, 6, -15}), Box({-10, -10, -15}, {10, 10, 20})},
       .stationary = Around(10, 0, -15) + Around(6, -15, -40),
       .mating_vector = {0, 0, -50}});
  // Lengths are in millimetres. The peg starts 50 above its seat. Its narrow end is at -35 when
  // seated, so it reaches the narrow hole at -15 after a motion of 30. Its wide end is at -15 when
  // seated, so it reaches the wide hole at 0 after a motion of 35.
  judge.ExpectTravels({30, 35, 50});
  judge.ExpectSamplesAgree();
  EXPECT_EQ(judge.points()[0].after.size(), 4u);
  EXPECT_EQ(judge.points()[1].after.size(), 8u);
  EXPECT_EQ(judge.points()[2].after.size(), 9u);
}

// A T slides along its slot, which has a wider mouth. First the flanks touch, then the flanks of
// the narrow part, and then the stop at the end.
TEST(CriticalPoints, OfATSlot) {
  const std::vector<ConvexPiece> tee = {Box({0, -8, 0}, {40, 8, 6}), Box({0, -3, 6}, {40, 3, 15})};
  const std::vector<ConvexPiece> slot = {
      Box({-10, -20, -10}, {50, 20, 0}),                                    // floor of the slot
      Box({-10, 8, 0}, {50, 20, 6}),     Box({-10, -20, 0}, {50, -8, 6}),   // sides of the slot
      Box({-10, 3, 6}, {30, 20, 12}),    Box({-10, -20, 6}, {30, -3, 12}),  // lips, shorter
      Box({-20, -20, -10}, {0, 20, 6})};                                    // stop at the end
  const Judge judge({.moving = tee, .stationary = slot, .mating_vector = {-70, 0, 0}});
  // The front of the T comes to x = 50, to the lips at 30, and to the stop at 0.
  judge.ExpectTravels({20, 40, 70});
  judge.ExpectSamplesAgree();
  EXPECT_EQ(judge.points()[0].after.size(), 3u);  // the foot touches the bottom and both sides
  EXPECT_EQ(judge.points()[1].after.size(), 7u);  // the sides and undersides of the lips, too
}

// Seams between pieces of one face change nothing.
TEST(CriticalPoints, SeamsAreNone) {
  const Judge whole({.moving = {Box({0, 0, 0}, {10, 10, 10})},
                     .stationary = {Box({-30, -5, -10}, {30, 15, 0})},
                     .mating_vector = {50, 0, 0}});
  const Judge pieces(
      {.moving = {Box({0, 0, 0}, {4, 10, 10}), Box({4, 0, 0}, {10, 10, 10})},
       .stationary = {Box({-30, -5, -10}, {-3, 15, 0}), Box({-3, -5, -10}, {9, 15, 0}),
                      Box({9, -5, -10}, {30, 15, 0})},
       .mating_vector = {50, 0, 0}});
  whole.ExpectTravels({10});  // the front starts at -40, and the floor begins at -30
  pieces.ExpectTravels({10});
}

TEST(CriticalPoints, OfWhatTouchesNothing) {
  const Judge judge({.moving = {Box({0, 0, 0}, {10, 10, 10})},
                     .stationary = {Box({-30, -5, -10}, {30, 15, -1})},
                     .mating_vector = {50, 0, 0}});
  EXPECT_THAT(judge.points(), IsEmpty());
}

}  // namespace
}  // namespace assay::finemotion::critical_points_test
