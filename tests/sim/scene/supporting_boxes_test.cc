#include "sim/scene/supporting_boxes.h"

#include <gtest/gtest.h>

#include "planner/domain/parts/part_file.h"
#include "tests/sim/scene/all_parts.h"

namespace assay::scene::supporting_boxes_test {
namespace {

class SupportingBoxesOf : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const domain::PartModel> part =
      domain::PartFile::Load(ModelsFolder() / "parts" / GetParam() / "part.yaml", 0.0005);
  std::vector<geometry::Box> boxes = SupportingBoxes(*part);
};

TEST_P(SupportingBoxesOf, AreInsideTheHull) {
  for (const geometry::Box& box : boxes) {
    for (const geometry::Vector3& corner : box.Corners()) {
      for (const geometry::Facet& facet : part->hull().facets) {
        EXPECT_LE(facet.normal.dot(corner), facet.offset + 1e-8);
      }
    }
  }
}

TEST_P(SupportingBoxesOf, ReachEveryCornerOfTheHull) {
  for (const geometry::Vector3& vertex : part->hull().vertices) {
    double nearest = 1;
    for (const geometry::Box& box : boxes) {
      for (const geometry::Vector3& corner : box.Corners()) {
        nearest = std::min(nearest, (corner - vertex).norm());
      }
    }
    EXPECT_LT(nearest, 1e-8);
  }
}

TEST_P(SupportingBoxesOf, AreNoMoreThanTheBoxes) { EXPECT_LE(boxes.size(), part->boxes().size()); }

INSTANTIATE_TEST_SUITE_P(Parts, SupportingBoxesOf, testing::ValuesIn(AllParts()),
                         [](const auto& part) {
                           std::string name = part.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(SupportingBoxes, FillTheHolesOfTheBlock) {
  const auto block = domain::PartFile::Load(ModelsFolder() / "parts/block/part.yaml", 0.0005);
  ASSERT_GT(block->boxes().size(), 4u);
  const auto boxes = SupportingBoxes(*block);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_NEAR(boxes[0].Volume(), 3 * 3 * 6.5 * kInch * kInch * kInch, 1e-12);
}

}  // namespace
}  // namespace assay::scene::supporting_boxes_test
