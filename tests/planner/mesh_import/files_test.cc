#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "planner/base/input_files/input_error.h"
#include "planner/mesh_import/files/mesh_file.h"
#include "planner/mesh_import/files/obj_mesh.h"
#include "planner/mesh_import/files/stl.h"
#include "tests/planner/mesh_import/made_mesh.h"

namespace assay::mesh_import {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string MessageOfReading(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// All three files describe the same surface.
TEST(MeshFile, FormatsAgree) {
  const TriangleMesh made = ChamferedPeg(8, 50, 0.5, 24);
  for (const auto& [name, text] :
       {std::pair("a.stl", StlText(made)), {"b.STL", BinaryStl(made)}, {"c.obj", ObjText(made)}}) {
    const TriangleMesh read = ReadMeshFile(Written(name, text));
    ASSERT_EQ(read.triangles.size(), made.triangles.size()) << name;
    EXPECT_NEAR(read.Volume(), made.Volume(), 1e-3) << name;
    EXPECT_EQ(read.triangles.back().number, static_cast<int>(made.triangles.size())) << name;
  }
}

TEST(MeshFile, ObjFacesMayHaveManyCornersAndNegativeIndices) {
  const std::string text =
      "# a wedge\no thing\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 0.2 0\nv 0 1 0 1 1 1\nvn 0 0 1\n"
      "f 1/1/1 2//1 3 -2 -1\n";
  const TriangleMesh mesh = ReadObjMesh(text, "w.obj");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  double area = 0;
  for (const Triangle& triangle : mesh.triangles) {
    EXPECT_GT(mesh.AreaVector(triangle).z(), 0);  // although the face is not convex
    area += mesh.AreaVector(triangle).z();
    EXPECT_EQ(triangle.line, 9);
    EXPECT_EQ(triangle.number, 1);
  }
  EXPECT_NEAR(area, 2 - 0.8, 1e-12);
}

TEST(MeshFile, ErrorsNameTheLine) {
  const auto stl = [](const std::string& text) {
    return MessageOfReading([&] { ReadStl(text, "a.stl"); });
  };
  const auto obj = [](const std::string& text) {
    return MessageOfReading([&] { ReadObjMesh(text, "a.obj"); });
  };
  EXPECT_THAT(stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n"),
              StartsWith("a.stl:4:10: 'zero' is no coordinate"));
  EXPECT_THAT(stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n"),
              StartsWith("a.stl:4:12: 'nan' is no coordinate"));
  EXPECT_THAT(stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
              HasSubstr("the file ends early"));
  EXPECT_THAT(stl("solid a\nfacette\n"), StartsWith("a.stl:2:1: 'facette' is out of place"));
  EXPECT_THAT(stl("ply"), StartsWith("a.stl: it is too short"));
  EXPECT_THAT(stl(std::string(90, 'x')), HasSubstr("its head promises 2021161080 triangles"));
  EXPECT_THAT(obj("v 0 0 0\nv 1 0 0\nf 1 2 3\n"), StartsWith("a.obj:3:7: '3' names no vertex"));
  EXPECT_THAT(obj("v 0 0 0\nf 1 1\n"), StartsWith("a.obj:2:5: the face has 2 corners"));
  EXPECT_THAT(obj("v 0 0\n"), StartsWith("a.obj:1:5: '' is no coordinate"));
  EXPECT_THAT(obj("v 0 0 1e7\n"), HasSubstr("at most a million"));
  EXPECT_THAT(obj("curv 0 1 1 2\n"), StartsWith("a.obj:1:1: 'curv' cannot be read"));
}

TEST(MeshFile, BinaryErrorsNameTheTriangle) {
  TriangleMesh made = Extruded(RectangleOf(2, 2), 2);
  made.vertices[static_cast<std::size_t>(made.triangles[4].corners[1])].x() = NAN;
  EXPECT_THAT(MessageOfReading([&] { ReadStl(BinaryStl(made), "a.stl"); }),
              HasSubstr("a coordinate is no number"));
}

TEST(MeshFile, WrongFilesAreRefused) {
  EXPECT_THAT(MessageOfReading([] { ReadMeshFile(Written("a.gltf", "x")); }),
              HasSubstr(".stl, .obj, .dae, .step or .stp"));
  EXPECT_THAT(MessageOfReading([] { ReadMeshFile(Written("empty.obj", "")); }),
              HasSubstr("it has no triangles"));
  EXPECT_THAT(MessageOfReading([] { ReadMeshFile("missing.obj"); }), HasSubstr("missing.obj"));
}

TEST(MeshFile, UnitIsFoundFromTheSize) {
  EXPECT_EQ(LikelyUnit(0.05), MeshUnit::kMetre);
  EXPECT_EQ(LikelyUnit(50), MeshUnit::kMillimetre);
  EXPECT_FALSE(LikelyUnit(0.0005));
  EXPECT_FALSE(LikelyUnit(2500));
  TriangleMesh made = Extruded(RectangleOf(2, 2), 2);
  ScaleToMetres(made, MeshUnit::kInch);
  EXPECT_NEAR(made.Volume(), 8 * std::pow(0.0254, 3), 1e-15);
  EXPECT_THAT(MessageOfReading([&] { ScaleToMetres(made, MeshUnit::kMillimetre); }),
              HasSubstr("another unit"));
}

}  // namespace
}  // namespace assay::mesh_import
