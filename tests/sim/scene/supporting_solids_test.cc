#include "sim/scene/supporting_solids.h"

#include <gtest/gtest.h>

#include "planner/domain/parts/part_file.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/sim/scene/all_parts.h"

namespace assay::scene::supporting_solids_test {
namespace {

class SupportingSolidsOf : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const domain::PartModel> part =
      domain::PartFile::Load(ModelsFolder() / "parts" / GetParam() / "part.yaml", 0.0005);
  std::vector<geometry::ConvexHull> solids = SupportingSolids(part->pieces(), part->hull());
};

TEST_P(SupportingSolidsOf, AreInsideTheHull) {
  for (const geometry::ConvexHull& solid : solids) {
    for (const geometry::Vector3& corner : solid.vertices) {
      for (const geometry::Facet& facet : part->hull().facets) {
        EXPECT_LE(facet.normal.dot(corner), facet.offset + 1e-8);
      }
    }
  }
}

TEST_P(SupportingSolidsOf, ReachEveryCornerOfTheHull) {
  for (const geometry::Vector3& vertex : part->corners()) {
    double nearest = 1;
    for (const geometry::ConvexHull& solid : solids) {
      for (const geometry::Vector3& corner : solid.vertices) {
        nearest = std::min(nearest, (corner - vertex).norm());
      }
    }
    EXPECT_LT(nearest, 1e-8);
  }
}

TEST_P(SupportingSolidsOf, AreNoMoreThanThePieces) {
  EXPECT_LE(solids.size(), part->pieces().size());
}

INSTANTIATE_TEST_SUITE_P(Parts, SupportingSolidsOf, testing::ValuesIn(AllParts()),
                         [](const auto& part) {
                           std::string name = part.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(SupportingSolids, FillTheHolesOfTheBlock) {
  const auto block = domain::PartFile::Load(ModelsFolder() / "parts/block/part.yaml", 0.0005);
  ASSERT_GT(block->pieces().size(), 4u);
  const auto solids = SupportingSolids(block->pieces(), block->hull());
  ASSERT_EQ(solids.size(), 1u);
  EXPECT_NEAR(geometry::Volume(solids[0]), 3 * 3 * 6.5 * kInch * kInch * kInch, 1e-12);
}

}  // namespace
}  // namespace assay::scene::supporting_solids_test
