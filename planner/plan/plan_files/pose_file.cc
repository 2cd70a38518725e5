#include "planner/plan/plan_files/pose_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace assay::plan {
namespace {

using geometry::Pose;
using geometry::Vector3;
using Json = nlohmann::ordered_json;

constexpr double kOrthonormal = 1e-6;  // greatest error of the products of a rotation's columns

}  // namespace

Json VectorToJson(const Vector3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json PoseToJson(const Pose& X) {
  Json columns = Json::array();
  for (int i = 0; i < 4; ++i) columns.push_back(VectorToJson(X.matrix().col(i).head<3>()));
  return columns;
}

Vector3 ReadVector(const Value& value) {
  const std::vector<double> numbers = value.Numbers(3);
  return {numbers[0], numbers[1], numbers[2]};
}

// The numbers are taken exactly as they are, so that they are written again as they were read.
Pose ReadPose(const Value& value) {
  const std::string allowed = "four columns [x, y, z, position] of three numbers each";
  const std::vector<Value> columns = value.Items();
  if (columns.size() != 4) value.Fail(fmt::format("{} columns", columns.size()), allowed);
  Pose X = Pose::Identity();
  for (int i = 0; i < 4; ++i) X.matrix().col(i).head<3>() = ReadVector(columns[i]);
  const geometry::Matrix3 R = X.linear();
  const geometry::Matrix3 error = R.transpose() * R - geometry::Matrix3::Identity();
  if (!(error.cwiseAbs().maxCoeff() <= kOrthonormal) || !(R.determinant() > 0)) {
    value.Fail("the first three columns are not the axes of a frame",
               "unit vectors, perpendicular to each other, right-handed");
  }
  return X;
}

}  // namespace assay::plan
