#include "planner/mesh_import/files/library_mesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/input_files/input_error.h"

namespace assay::mesh_import::library_mesh_test {
namespace {

using ::testing::HasSubstr;

// A pyramid over a square of 100 x 100, 60 high, in units of `metres`, with `up` as the upward axis
// of the file. Its node is moved by (10, 20, 30). The base is one polygon.
std::string Pyramid(double metres, const std::string& up) {
  return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="unit" meter="{}"/><up_axis>{}</up_axis></asset>
 <library_geometries>
  <geometry id="pyramid" name="pyramid"><mesh>
   <source id="points">
    <float_array id="numbers" count="15">0 0 0 100 0 0 100 100 0 0 100 0 50 50 60</float_array>
    <technique_common><accessor source="#numbers" count="5" stride="3">
     <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
    </accessor></technique_common>
   </source>
   <vertices id="vertices"><input semantic="POSITION" source="#points"/></vertices>
   <polylist count="5"><input semantic="VERTEX" source="#vertices" offset="0"/>
    <vcount>4 3 3 3 3</vcount><p>0 3 2 1 0 1 4 1 2 4 2 3 4 3 0 4</p>
   </polylist>
  </mesh></geometry>
 </library_geometries>
 <library_visual_scenes><visual_scene id="scene"><node id="node">
  <translate>10 20 30</translate><instance_geometry url="#pyramid"/>
 </node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>)",
                     metres, up);
}

TEST(Collada, HasTheUnitAndTheNodesOfTheFile) {
  for (const std::string up : {"Z_UP", "Y_UP"}) {
    const TriangleMesh mesh = ReadLibraryMesh(Pyramid(0.001, up), "pyramid.dae", ".dae");
    EXPECT_EQ(mesh.file, "pyramid.dae");
    EXPECT_EQ(mesh.triangles.size(), 6U);
    EXPECT_LT((mesh.Bounds().min() - Vector3(0.01, 0.02, 0.03)).norm(), 1e-7) << up;
    EXPECT_LT((mesh.Bounds().max() - Vector3(0.11, 0.12, 0.09)).norm(), 1e-7) << up;
    EXPECT_NEAR(mesh.Volume(), 0.01 * 0.06 / 3, 1e-9) << up;
  }
  EXPECT_NEAR(ReadLibraryMesh(Pyramid(1, "Z_UP"), "pyramid.dae", ".dae").Size(), 153.6, 0.1);
}

std::string ErrorOf(const std::string& text) {
  try {
    ReadLibraryMesh(text, "wrong.dae", ".dae");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Collada, AFileWithoutSurfacesIsRefused) {
  std::string text = Pyramid(1, "Z_UP");
  const std::string instance = "<instance_geometry url=\"#pyramid\"/>";
  text.erase(text.find(instance), instance.size());
  EXPECT_THAT(ErrorOf(text), HasSubstr("wrong.dae"));
}

TEST(Collada, SaysThatAFileIsWrong) {
  const std::string text = Pyramid(1, "Z_UP");
  EXPECT_THAT(ErrorOf("solid"), HasSubstr("wrong.dae: is no COLLADA file"));
  EXPECT_THAT(ErrorOf(text.substr(0, text.size() / 2)), HasSubstr("wrong.dae"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("wrong.dae"));
}

}  // namespace
}  // namespace assay::mesh_import::library_mesh_test
