#include "sim/scene/stage_mjcf.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"
#include "planner/domain/workcell/floor.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::scene {
namespace {

using domain::Problem;
using geometry::Vector2;
using geometry::Vector3;

struct Rectangle {
  Vector2 low;
  Vector2 high;
  Vector2 center() const { return (low + high) / 2; }
  Vector2 half_extents() const { return (high - low) / 2; }
};

// Returns the rectangle around the table's polygon, which is the table in the engine. It can be
// larger than the polygon, because parts are never put outside the polygon. A box is the only table
// whose contacts are exact.
Rectangle TableRectangle(const domain::Table& table) {
  ASSAY_CHECK(table.top.size() >= 3);
  Rectangle r{table.top.front(), table.top.front()};
  for (const Vector2& corner : table.top) {
    r.low = r.low.cwiseMin(corner);
    r.high = r.high.cwiseMax(corner);
  }
  return r;
}

XmlElement& AddTableTop(const domain::Table& table, const std::string& name,
                        XmlElement& worldbody) {
  const Rectangle r = TableRectangle(table);
  const Vector2 half = r.half_extents();
  return worldbody.Add("geom")
      .Set("name", name)
      .Set("class", "table")
      .Set("size", {half.x(), half.y(), table.thickness / 2})
      .Set("pos", {r.center().x(), r.center().y(), -table.thickness / 2});
}

// The size of a plane only limits how it is drawn; its contacts have no end.
XmlElement& AddEndlessTableTop(const domain::Table& table, const std::string& name,
                               XmlElement& worldbody) {
  const Rectangle r = TableRectangle(table);
  const Vector2 half = r.half_extents();
  return worldbody.Add("geom")
      .Set("name", name)
      .Set("class", "table")
      .Set("type", "plane")
      .Set("size", {half.x(), half.y(), 1})
      .Set("pos", {r.center().x(), r.center().y(), 0});
}

void AddTable(const domain::Workcell& workcell, const domain::Table& table, XmlElement& worldbody) {
  const Rectangle r = TableRectangle(table);
  AddTableTop(table, TableGeom(table), worldbody);
  const double leg = (-table.thickness - domain::FloorHeight(workcell)) / 2;
  if (leg <= 0) return;
  constexpr double kLegHalfWidth = 0.03;
  for (const double x : {r.low.x() + 2 * kLegHalfWidth, r.high.x() - 2 * kLegHalfWidth}) {
    for (const double y : {r.low.y() + 2 * kLegHalfWidth, r.high.y() - 2 * kLegHalfWidth}) {
      worldbody.Add("geom")
          .Set("class", "visual")
          .Set("type", "box")
          .Set("size", {kLegHalfWidth, kLegHalfWidth, leg})
          .Set("pos", {x, y, -table.thickness - leg})
          .Set("rgba", {0.25, 0.26, 0.28, 1});
    }
  }
}

// A camera by its position and the point in the middle of its picture, metres, world frame.
struct View {
  const char* name;
  Vector3 eye;
  Vector3 target;
  double vertical_angle;  // degrees, the engine's unit for this angle in every file
};

// The engine's cameras look along their -z axis, and their y axis points up in the picture.
void AddCamera(const View& view, XmlElement& worldbody) {
  const Vector3 back = (view.eye - view.target).normalized();
  const bool vertical = back.cross(Vector3::UnitZ()).norm() < 1e-6;
  const Vector3 up = vertical ? Vector3(1, 0, 0) : Vector3(0, 0, 1);
  const Vector3 right = up.cross(back).normalized();
  const Vector3 y = back.cross(right);
  worldbody.Add("camera")
      .Set("name", view.name)
      .Set("pos", view.eye)
      .Set("xyaxes", {right.x(), right.y(), right.z(), y.x(), y.y(), y.z()})
      .Set("fovy", view.vertical_angle);
}

// The middle of the parts' centres of mass at the start, and their greatest distance from it,
// metres.
struct Group {
  Vector3 center = Vector3::Zero();
  double radius = 0;
};

Group PartGroup(const Problem& problem) {
  const Vector2 table = TableRectangle(problem.workcell->table()).center();
  Group group{.center = {table.x(), table.y(), 0}};
  if (problem.parts.empty()) return group;
  group.center.setZero();
  for (const domain::Part& part : problem.parts) {
    group.center += part.X_WorldPart * part.model->mass().center;
  }
  group.center /= static_cast<double>(problem.parts.size());
  for (const domain::Part& part : problem.parts) {
    const Vector3 center = part.X_WorldPart * part.model->mass().center;
    group.radius = std::max(group.radius, (center - group.center).norm());
  }
  return group;
}

void AddCameras(const Problem& problem, XmlElement& worldbody) {
  const Vector2 table = TableRectangle(problem.workcell->table()).center();
  const Vector3 cell(table.x() * 0.45, 0, 0.38);
  const Group parts = PartGroup(problem);
  // The picture shows the parts and the hand above them, even when it holds a part at safe height.
  const double reach = parts.radius + problem.workcell->rules().safe_height;
  const Vector3 middle =
      parts.center + Vector3(0.05, 0, 0.4 * problem.workcell->rules().safe_height);
  const Vector3 close = Vector3(0.8, -0.75, 0.6).normalized() * 1.8 * reach;
  // Two robots face each other, so the camera looks at them from beside the table.
  const bool is_alone = problem.workcell->robots().size() == 1;
  const Vector3 overview = is_alone ? Vector3(2.3, -2.3, 1.5) : Vector3(0.5, -3.3, 2.0);
  AddCamera({"overview", Vector3(cell.x(), 0, 0) + overview, cell, 42}, worldbody);
  AddCamera({"close", middle + close, middle, 35}, worldbody);
  AddCamera({"side", Vector3(table.x() * 0.7, -3.2, 0.7), {table.x() * 0.5, 0, 0.48}, 38},
            worldbody);
  AddCamera({"top", Vector3(table.x() - 0.05, 0, 2.6), {table.x() - 0.05, 0, 0}, 36}, worldbody);
}

// Adds the eyes of the sensor "overhead-camera" above the table's corners. Arms at their homes hide
// the table from only a few of these eyes. A single robot stands at the table's low x; two robots
// stand at its two ends. The eyes look at the table's middle until the sensor turns them.
void AddSensorEyes(const Problem& problem, XmlElement& worldbody) {
  const Vector2 table = TableRectangle(problem.workcell->table()).center();
  const Vector3 middle(table.x(), table.y(), 0);
  const auto add_eye = [&](const char* name, const Vector3& from_middle) {
    AddCamera({name, middle + from_middle, middle, 40}, worldbody);
  };
  const bool is_alone = problem.workcell->robots().size() == 1;
  const Vector3 far = is_alone ? Vector3(0.80, 0.80, 1.6) : Vector3(0.35, 1.10, 1.6);
  add_eye("overhead-eye-1", {far.x(), -far.y(), far.z()});
  add_eye("overhead-eye-2", far);
  add_eye("overhead-eye-3", {-0.35, -1.10, 1.6});
  add_eye("overhead-eye-4", {-0.35, 1.10, 1.6});
}

void AddLights(const Problem& problem, double light, XmlElement& worldbody) {
  const Vector2 table = TableRectangle(problem.workcell->table()).center();
  worldbody.Add("light")
      .Set("directional", "true")
      .Set("castshadow", "true")
      .Set("pos", {table.x() + 1.0, -1.6, 2.6})
      .Set("dir", {-0.35, 0.55, -1})
      .Set("diffuse", Vector3(light * Vector3(0.60, 0.58, 0.54)))
      .Set("specular", {0.25, 0.25, 0.25});
  worldbody.Add("light")
      .Set("directional", "true")
      .Set("castshadow", "false")
      .Set("pos", {table.x() + 1.5, 1.5, 2})
      .Set("dir", {-1, -0.6, -0.7})
      .Set("diffuse", Vector3(light * Vector3(0.16, 0.18, 0.22)))
      .Set("specular", {0.05, 0.05, 0.05});
}

}  // namespace

std::string TableGeom(const domain::Table& table) { return table.name; }

std::string TableGeom(const domain::Table& table, const std::string& part) {
  return table.name + "/" + part;
}

void AddMaterials(XmlElement& asset) {
  asset.Add("texture")
      .Set("name", "sky")
      .Set("type", "skybox")
      .Set("builtin", "gradient")
      .Set("rgb1", {0.93, 0.95, 0.97})
      .Set("rgb2", {0.62, 0.70, 0.78})
      .Set("width", "128")
      .Set("height", "768");
  asset.Add("texture")
      .Set("name", "tiles")
      .Set("type", "2d")
      .Set("builtin", "checker")
      .Set("rgb1", {0.66, 0.68, 0.70})
      .Set("rgb2", {0.56, 0.58, 0.61})
      .Set("width", "256")
      .Set("height", "256");
  asset.Add("material")
      .Set("name", "floor")
      .Set("texture", "tiles")
      .Set("texrepeat", {2, 2})
      .Set("texuniform", "true")
      .Set("reflectance", 0.06)
      .Set("specular", 0.1);
  asset.Add("material")
      .Set("name", "table")
      .Set("rgba", {0.84, 0.80, 0.73, 1})
      .Set("specular", 0.15);
  asset.Add("material").Set("name", "paint").Set("specular", 0.35).Set("shininess", 0.6);
  asset.Add("material").Set("name", "part").Set("specular", 0.15).Set("shininess", 0.3);
}

void AddStage(const Problem& problem, double light, XmlElement& worldbody) {
  const domain::Workcell& workcell = *problem.workcell;
  worldbody.Add("geom")
      .Set("name", "floor")
      .Set("class", "floor")
      .Set("pos", {0, 0, domain::FloorHeight(workcell)});
  for (const domain::Table& table : workcell.tables()) AddTable(workcell, table, worldbody);
  AddLights(problem, light, worldbody);
  AddCameras(problem, worldbody);
  AddSensorEyes(problem, worldbody);
}

void AddPartTables(const Problem& problem, const PartTable& own, XmlElement& worldbody) {
  for (const domain::Table& table : problem.workcell->tables()) {
    const std::string name = TableGeom(table, problem.part(own.part).name);
    XmlElement& top = own.is_endless ? AddEndlessTableTop(table, name, worldbody)
                                     : AddTableTop(table, name, worldbody);
    top.Set("contype", fmt::format("{}", own.bit)).Set("conaffinity", "0").Set("group", "3");
  }
}

void AddVisualSettings(const Problem& problem, double light, XmlElement& mujoco) {
  const Vector2 table = TableRectangle(problem.workcell->table()).center();
  // The shadow map of a directional light covers `extent` around `center`.
  mujoco.Add("statistic").Set("center", {table.x() * 0.5, 0, 0.3}).Set("extent", 1.6);
  XmlElement& visual = mujoco.Add("visual");
  visual.Add("headlight")
      .Set("ambient", Vector3(light * Vector3(0.30, 0.30, 0.31)))
      .Set("diffuse", Vector3(light * Vector3(0.14, 0.14, 0.14)))
      .Set("specular", {0.05, 0.05, 0.05});
  visual.Add("quality").Set("shadowsize", "4096").Set("offsamples", "4");
  visual.Add("map").Set("znear", 0.01).Set("zfar", 20).Set("shadowclip", 1.1);
}

}  // namespace assay::scene
