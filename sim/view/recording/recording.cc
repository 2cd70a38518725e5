#include "sim/view/recording/recording.h"

#include <cmath>
#include <cstdint>

#include "sim/view/recording/series.h"

namespace assay::view {
namespace {

// A table of numbers. Each sample is a row of the table, and each series is a column.
class Table {
 public:
  void BeginRow() { column_ = 0; }
  void Add(double value, double quantum) {
    if (column_ == columns_.size()) columns_.emplace_back();
    columns_[column_++].push_back(std::llround(value / quantum));
  }
  void Add(const Vector3& vector, double quantum) {
    for (const double value : vector) Add(value, quantum);
  }
  // Two quaternions stand for each rotation. The one nearer to the previous row's is stored.
  void Add(const Pose& pose) {
    Add(pose.translation(), kLengthQuantum);
    Eigen::Quaterniond turn(pose.linear());
    if (DotWithLast(turn) < 0) turn.coeffs() = -turn.coeffs();
    for (const double value : {turn.w(), turn.x(), turn.y(), turn.z()}) Add(value, kTurnQuantum);
  }

  std::string Encoded() const {
    std::string bytes;
    for (const std::vector<std::int64_t>& column : columns_) bytes += EncodedSeries(column);
    return bytes;
  }

 private:
  double DotWithLast(const Eigen::Quaterniond& turn) const {
    if (column_ + 4 > columns_.size()) return turn.w();
    const auto last = [&](std::size_t i) {
      return static_cast<double>(columns_[column_ + i].back());
    };
    return turn.w() * last(0) + turn.x() * last(1) + turn.y() * last(2) + turn.z() * last(3);
  }

  std::vector<std::vector<std::int64_t>> columns_;
  std::size_t column_ = 0;
};

std::vector<Pose> TruePoses(const execution::Snapshot& snapshot) {
  std::vector<Pose> poses;
  for (const execution::TrueAndBelieved& part : snapshot.parts) poses.push_back(part.truth);
  return poses;
}

}  // namespace

Recording Record(const scene::Scene& scene, const std::vector<Body>& bodies,
                 const execution::Trace& trace) {
  Table table;
  ContactCollector contacts(bodies);
  Recording recording;
  mujoco::Data data = scene.Start();
  for (const execution::Sample* sample : trace.All<execution::Sample>()) {
    const execution::Snapshot& snapshot = sample->snapshot;
    scene.Show(data, snapshot.arms, TruePoses(snapshot));
    table.BeginRow();
    table.Add(snapshot.time, kTimeQuantum);
    for (const Body& body : bodies) {
      if (body.id != scene.world()) table.Add(data.BodyPose(body.id));
    }
    for (const execution::TrueAndBelieved& part : snapshot.parts) table.Add(part.believed);
    table.Add(snapshot.wrist.force, kForceQuantum);
    table.Add(snapshot.wrist.torque, kForceQuantum);
    contacts.Add(*sample, data);
    ++recording.samples;
  }
  recording.contacts = contacts.Take();
  recording.bytes = table.Encoded();
  return recording;
}

}  // namespace assay::view
