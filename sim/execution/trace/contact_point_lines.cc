#include "sim/execution/trace/contact_point_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace assay::execution {
namespace {

// The steps to which numbers are rounded: a micrometre, 1e-4 of a unit vector, and a millinewton.
constexpr double kPositionsPerMetre = 1e6;
constexpr double kStepsPerUnit = 1e4;
constexpr double kForcesPerNewton = 1e3;

// Adding 0 turns -0 into 0.
double RoundedTo(double steps, double value) { return std::round(steps * value) / steps + 0.0; }

ContactRow RowOf(const ContactPoint& point) {
  ContactRow row;
  for (int i = 0; i < 3; ++i) {
    row[i] = RoundedTo(kPositionsPerMetre, point.position[i]);
    row[3 + i] = RoundedTo(kStepsPerUnit, point.normal[i]);
    row[6 + i] = RoundedTo(kForcesPerNewton, point.force[i]);
  }
  return row;
}

Vector3 VectorIn(const ContactRow& row, int from) {
  return {row[from], row[from + 1], row[from + 2]};
}

}  // namespace

nlohmann::ordered_json ContactPointWriter::FieldOf(const Sample& sample) {
  RowsByPair now;
  for (const ContactPoint& point : *sample.contact_points) {
    now[sample.snapshot.contacts[point.pair]].push_back(RowOf(point));
  }
  nlohmann::ordered_json field = nlohmann::ordered_json::array();
  for (const auto& [pair, rows] : now) {
    if (const auto known = last_.find(pair); known != last_.end() && known->second == rows)
      continue;
    field.push_back({{"bodies", {pair.first, pair.second}}, {"points", rows}});
  }
  last_ = std::move(now);
  return field;
}

std::vector<ContactPoint> ContactPointReader::PointsOf(const Snapshot& snapshot,
                                                       const nlohmann::json& field) {
  for (const nlohmann::json& group : field) {
    const auto pair = group.at("bodies").get<std::pair<std::string, std::string>>();
    if (std::ranges::find(snapshot.contacts, pair) == snapshot.contacts.end()) {
      throw std::invalid_argument(
          fmt::format("contact points of {} and {}, which do not touch", pair.first, pair.second));
    }
    std::vector<ContactRow>& rows = last_[pair];
    rows.clear();
    for (const nlohmann::json& row : group.at("points")) {
      if (row.size() != ContactRow{}.size()) {
        throw std::invalid_argument("a contact point has not 9 numbers");
      }
      rows.push_back(row.get<ContactRow>());
    }
  }
  RowsByPair now;
  std::vector<ContactPoint> points;
  for (std::size_t i = 0; i < snapshot.contacts.size(); ++i) {
    const auto known = last_.find(snapshot.contacts[i]);
    if (known == last_.end()) continue;
    for (const ContactRow& row : known->second) {
      points.push_back({i, VectorIn(row, 0), VectorIn(row, 3), VectorIn(row, 6)});
    }
    now.insert(*known);
  }
  last_ = std::move(now);
  return points;
}

}  // namespace assay::execution
