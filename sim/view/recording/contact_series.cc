#include "sim/view/recording/contact_series.h"

#include <algorithm>
#include <cmath>

#include "sim/view/recording/series.h"

namespace assay::view {

ContactCollector::ContactCollector(const std::vector<Body>& bodies) {
  for (const Body& body : bodies) drawn_[body.name] = body.id;
}

Pose ContactCollector::PoseOf(const std::string& body, const mujoco::Data& data) const {
  const auto found = drawn_.find(body);
  return found == drawn_.end() ? Pose::Identity() : data.BodyPose(found->second);
}

void ContactCollector::Add(const execution::Sample& sample, const mujoco::Data& data) {
  const auto& touching = sample.snapshot.contacts;
  for (const auto& pair : touching) {
    pairs_[pair].resize(samples_);
    const bool is_known = sample.contact_points || samples_ == 0;
    pairs_[pair].push_back(is_known ? Points() : pairs_[pair].back());
  }
  ++samples_;
  if (!sample.contact_points) return;
  for (const execution::ContactPoint& point : *sample.contact_points) {
    const auto& pair = touching[point.pair];
    const Pose X_BodyWorld = PoseOf(pair.first, data).inverse();
    const Vector3 position = X_BodyWorld * point.position;
    const Vector3 normal = X_BodyWorld.linear() * point.normal;
    const Vector3 force = X_BodyWorld.linear() * point.force;
    Numbers numbers;
    for (int i = 0; i < 3; ++i) {
      numbers[i] = std::llround(position[i] / kContactQuantum);
      numbers[3 + i] = std::llround(normal[i] / kNormalQuantum);
      numbers[6 + i] = std::llround(force[i] / kForceQuantum);
    }
    pairs_[pair].back().push_back(numbers);
  }
}

// The first series of a pair counts its points at each sample. The next nine series have the
// numbers of the first point. They have a value for each sample with at least one point. The second
// point and further points follow in the same way.
ContactSeries ContactCollector::Take() const {
  ContactSeries series;
  for (const auto& [bodies, samples] : pairs_) {
    std::vector<std::int64_t> counts;
    for (const Points& points : samples) counts.push_back(std::ssize(points));
    counts.resize(samples_);
    const auto most = static_cast<std::size_t>(std::ranges::max(counts));
    if (most == 0) continue;
    series.pairs.push_back({bodies, most});
    series.bytes += EncodedSeries(counts);
    for (std::size_t point = 0; point < most; ++point) {
      for (std::size_t number = 0; number < Numbers{}.size(); ++number) {
        std::vector<std::int64_t> values;
        for (const Points& points : samples) {
          if (point < points.size()) values.push_back(points[point][number]);
        }
        series.bytes += EncodedSeries(values);
      }
    }
  }
  return series;
}

}  // namespace assay::view
