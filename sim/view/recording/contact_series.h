#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/execution/trace/trace.h"
#include "sim/mujoco/data.h"
#include "sim/view/stage.h"

namespace assay::view {

// The units of the whole numbers of contact points.
inline constexpr double kContactQuantum = 1e-4;     // metres
inline constexpr double kNormalQuantum = 1.0 / 64;  // of each number of a unit vector
inline constexpr double kForceQuantum = 1e-2;       // newtons; newton metres

// Two bodies that touch at some time.
struct TouchingPair {
  std::pair<std::string, std::string> bodies;
  std::size_t most = 0;  // greatest number of points at one sample
};

// The contact points of an execution, as series of whole numbers that EncodedSeries has encoded,
// one after the other. page/data.md lists the series.
struct ContactSeries {
  std::vector<TouchingPair> pairs;
  std::string bytes;
};

// Collects the contact points of a trace, sample by sample. Points are stored in the frame of the
// pair's first body, or in the world frame if this body is not drawn. Where bodies rest against
// each other, their points then stay the same.
class ContactCollector {
 public:
  explicit ContactCollector(const std::vector<Body>& bodies);

  // `data` must show the sample. If the sample's contact points are unknown, each pair that still
  // touches keeps its last points.
  void Add(const execution::Sample& sample, const mujoco::Data& data);

  ContactSeries Take() const;

 private:
  using Numbers = std::array<std::int64_t, 9>;  // position, normal, force
  using Points = std::vector<Numbers>;          // of one pair at one sample

  Pose PoseOf(const std::string& body, const mujoco::Data& data) const;

  std::map<std::string, mujoco::BodyId> drawn_;
  std::map<std::pair<std::string, std::string>, std::vector<Points>> pairs_;
  std::size_t samples_ = 0;
};

}  // namespace assay::view
