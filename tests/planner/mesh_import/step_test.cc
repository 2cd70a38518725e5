#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/base/input_files/input_error.h"
#include "planner/mesh_import/files/library_mesh.h"
#include "planner/mesh_import/repair/mesh_repair.h"

namespace assay::mesh_import::step_test {
namespace {

#ifdef ASSAY_STEP
// A cylinder of radius 10 and height 30 about the line from (5, 6, 7) upward, in the given unit of
// length, whose face is closed by one seam (ISO 10303-42).
std::string StepCylinder(const std::string& unit) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
         "FILE_NAME('','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
         "#1=APPLICATION_CONTEXT('mechanical design');\n"
         "#2=PRODUCT_CONTEXT('',#1,'mechanical');\n#3=PRODUCT('pin','pin','',(#2));\n"
         "#4=PRODUCT_DEFINITION_FORMATION('','',#3);\n"
         "#5=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');\n"
         "#6=PRODUCT_DEFINITION('','',#4,#5);\n#7=PRODUCT_DEFINITION_SHAPE('','',#6);\n"
         "#8=SHAPE_DEFINITION_REPRESENTATION(#7,#9);\n"
         "#9=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#20),#10);\n"
         "#10=(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#14)) "
         "GLOBAL_UNIT_ASSIGNED_CONTEXT((#11,#12,#13)) REPRESENTATION_CONTEXT('',''));\n#11=" +
         unit +
         ";\n#12=(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.));\n"
         "#13=(NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT());\n"
         "#14=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#11,'','');\n"
         "#15=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
         "#16=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#17);\n"
         "#17=(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.));\n"
         "#20=MANIFOLD_SOLID_BREP('',#21);\n#21=CLOSED_SHELL('',(#22,#23,#24));\n"
         "#22=ADVANCED_FACE('',(#25),#30,.T.);\n#23=ADVANCED_FACE('',(#26),#31,.F.);\n"
         "#24=ADVANCED_FACE('',(#27),#32,.T.);\n#25=FACE_OUTER_BOUND('',#33,.T.);\n"
         "#26=FACE_OUTER_BOUND('',#34,.T.);\n#27=FACE_OUTER_BOUND('',#35,.T.);\n"
         "#30=CYLINDRICAL_SURFACE('',#60,10.);\n#31=PLANE('',#60);\n#32=PLANE('',#61);\n"
         "#33=EDGE_LOOP('',(#40,#41,#42,#43));\n#34=EDGE_LOOP('',(#44));\n"
         "#35=EDGE_LOOP('',(#45));\n#40=ORIENTED_EDGE('',*,*,#50,.T.);\n"
         "#41=ORIENTED_EDGE('',*,*,#52,.T.);\n#42=ORIENTED_EDGE('',*,*,#51,.F.);\n"
         "#43=ORIENTED_EDGE('',*,*,#52,.F.);\n#44=ORIENTED_EDGE('',*,*,#50,.F.);\n"
         "#45=ORIENTED_EDGE('',*,*,#51,.T.);\n#50=EDGE_CURVE('',#53,#53,#55,.T.);\n"
         "#51=EDGE_CURVE('',#54,#54,#56,.T.);\n#52=EDGE_CURVE('',#53,#54,#57,.T.);\n"
         "#53=VERTEX_POINT('',#64);\n#54=VERTEX_POINT('',#65);\n#55=CIRCLE('',#60,10.);\n"
         "#56=CIRCLE('',#61,10.);\n#57=LINE('',#64,#58);\n#58=VECTOR('',#66,1.);\n"
         "#60=AXIS2_PLACEMENT_3D('',#62,#66,#67);\n#61=AXIS2_PLACEMENT_3D('',#63,#66,#67);\n"
         "#62=CARTESIAN_POINT('',(5.,6.,7.));\n#63=CARTESIAN_POINT('',(5.,6.,37.));\n"
         "#64=CARTESIAN_POINT('',(15.,6.,7.));\n#65=CARTESIAN_POINT('',(15.,6.,37.));\n"
         "#66=DIRECTION('',(0.,0.,1.));\n#67=DIRECTION('',(1.,0.,0.));\n"
         "ENDSEC;\nEND-ISO-10303-21;\n";
}

constexpr char kMillimetres[] = "(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.))";
constexpr char kMetres[] = "(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.))";
constexpr char kInches[] = "(CONVERSION_BASED_UNIT('INCH',#16) LENGTH_UNIT() NAMED_UNIT(#15))";

TEST(Step, HasTheUnitOfTheFile) {
  for (const auto& [unit, metres] :
       {std::pair(kMillimetres, 0.001), {kInches, 0.0254}, {kMetres, 1.0}}) {
    const TriangleMesh mesh = ReadLibraryMesh(StepCylinder(unit), "pin.step", ".step");
    EXPECT_LT((mesh.Bounds().min() - metres * Vector3(-5, -4, 7)).norm(), 1e-6 * metres) << unit;
    EXPECT_LT((mesh.Bounds().max() - metres * Vector3(15, 16, 37)).norm(), 1e-6 * metres) << unit;
  }
}

// A regular polygon with n sides has the area n / 2 sin(2 pi / n) of its circle's squared radius.
TEST(Step, CirclesArePolygonsWithCornersOnTheCircle) {
  RepairedMesh repaired = Repair(ReadLibraryMesh(StepCylinder(kMillimetres), "pin.stp", ".stp"));
  EXPECT_THAT(repaired.repairs, ::testing::IsEmpty());
  ASSERT_EQ(repaired.bodies.size(), 1U);
  const TriangleMesh& mesh = repaired.bodies.front();
  for (const Vector3& vertex : mesh.vertices) {
    const Vector3 beside = vertex - Vector3(0.005, 0.006, vertex.z());
    EXPECT_NEAR(beside.norm(), 0.01, 1e-9);
  }
  constexpr int kSides = 64;
  const double area = kSides / 2.0 * std::sin(2 * std::numbers::pi / kSides) * 1e-4;
  EXPECT_NEAR(mesh.Volume(), 0.03 * area, 1e-6 * mesh.Volume());
}

TEST(Step, SaysThatAFileIsWrong) {
  const std::string text = StepCylinder(kMillimetres);
  for (const std::string& wrong : {std::string("solid"), std::string(), text.substr(0, 700),
                                   text.substr(0, text.find("#20="))})
    EXPECT_THAT(
        [&] { ReadLibraryMesh(wrong, "wrong.step", ".step"); },
        ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("wrong.step: is no STEP file")));
}
#else
TEST(Step, NamesThePackagesThatItNeeds) {
  EXPECT_THROW(ReadLibraryMesh("", "pin.step", ".step"), EnvironmentError);
}
#endif

}  // namespace
}  // namespace assay::mesh_import::step_test
