#include "bench/workloads/projections.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "planner/base/check.h"

namespace assay::workloads {

using finemotion::ForwardProjection;
using finemotion::HalfSpace;
using finemotion::kPoseDimensions;
using finemotion::PrimitiveContact;
using geometry::Zonotope;

namespace {

Eigen::VectorXd ReadVector(std::istream& text, int size) {
  Eigen::VectorXd v(size);
  for (double& entry : v) text >> entry;
  return v;
}

HalfSpace ReadRow(std::istream& text, int dimension) {
  HalfSpace row{.a = ReadVector(text, dimension)};
  text >> row.b;
  return row;
}

Eigen::VectorXd RandomVector(int size, double reach, RandomStream& random) {
  Eigen::VectorXd v(size);
  for (double& entry : v) entry = random.Uniform(-reach, reach);
  return v;
}

geometry::Zonotope AtRest(Eigen::Index dimension) {
  return {Eigen::VectorXd::Zero(dimension), Eigen::MatrixXd(dimension, 0)};
}

geometry::Zonotope RandomStart(StartShape shape, int dimension, RandomStream& random) {
  const Eigen::VectorXd center = RandomVector(dimension, 1, random);
  if (shape == StartShape::kBox) {
    Eigen::VectorXd half(dimension);
    for (double& entry : half) entry = random.Uniform(0.05, 1);
    return geometry::Zonotope::Box(center - half, center + half);
  }
  geometry::Zonotope start{center, Eigen::MatrixXd(dimension, dimension + 2)};
  for (auto generator : start.generators.colwise()) {
    generator = RandomVector(dimension, 0.4, random);
  }
  return start;
}

// Returns a random velocity. Tolerances do not move.
geometry::Zonotope RandomVelocity(int errors, int dimension, RandomStream& random) {
  geometry::Zonotope velocity = AtRest(dimension);
  velocity.center.head<kPoseDimensions>() = RandomVector(kPoseDimensions, 1, random);
  velocity.generators.setZero(dimension, errors);
  for (auto generator : velocity.generators.colwise()) {
    generator.head<kPoseDimensions>() = RandomVector(kPoseDimensions, 0.3, random);
  }
  return velocity;
}

// Returns a value of a . z. This value lies at the fraction `part` of the way from the middle of
// the range of a . z over the projection to the end of the range.
double ValueAt(double part, const Eigen::VectorXd& a, const ForwardProjection& projection) {
  const double most = projection.Support(a);
  const double least = -projection.Support(-a);
  return (least + most) / 2 + part * (most - least) / 2;
}

Eigen::VectorXd RandomRow(const ProjectionModel& model, RandomStream& random) {
  Eigen::VectorXd row = RandomVector(kPoseDimensions + model.tolerances, 1, random);
  row.tail(std::max(0, model.tolerances - model.tolerances_read)).setZero();
  return row.normalized();
}

PrimitiveContact RandomContact(const ProjectionModel& model, const ForwardProjection& projection,
                               RandomStream& random) {
  PrimitiveContact contact;
  contact.row = RandomRow(model, random);
  contact.offset = -ValueAt(random.Uniform(-1.5, 1.5), contact.row, projection);
  for (int i = 0; i < model.limits; ++i) {
    HalfSpace limit{.a = RandomRow(model, random)};
    limit.b = ValueAt(random.Uniform(-1, 0.5), limit.a, projection);
    contact.limits.push_back(limit);
  }
  return contact;
}

}  // namespace

std::vector<JudgedProjection> ReadProjections(const std::filesystem::path& file) {
  std::ifstream text(file);
  std::vector<JudgedProjection> all;
  for (std::string word; text >> word;) {
    if (word != "case") {
      text.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
      continue;
    }
    JudgedProjection& judged = all.emplace_back();
    int dimension = 0;
    int limits = 0;
    text >> dimension >> limits >> judged.meets_at_an_edge >> judged.meets;
    const HalfSpace equality = ReadRow(text, dimension);
    judged.given.contact.row = equality.a;
    judged.given.contact.offset = -equality.b;
    for (int i = 0; i < limits; ++i) {
      judged.given.contact.limits.push_back(ReadRow(text, dimension));
    }
    const Eigen::VectorXd low = ReadVector(text, dimension);
    judged.given.projection = {geometry::Zonotope::Box(low, ReadVector(text, dimension)),
                               AtRest(dimension)};
    ASSAY_CHECK(text, "{} ends early", file.string());
  }
  return all;
}

ProjectionAndContact RandomProjection(const ProjectionModel& model, RandomStream& random) {
  const int dimension = kPoseDimensions + model.tolerances;
  ProjectionAndContact made;
  made.projection.start = RandomStart(model.start, dimension, random);
  made.projection.velocity = RandomVelocity(model.velocity_errors, dimension, random);
  made.projection.time = model.time;
  made.contact = RandomContact(model, made.projection, random);
  return made;
}

}  // namespace assay::workloads
