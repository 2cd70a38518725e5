#include "planner/finemotion/strategy_checks/exact_replay.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/base/check.h"
#include "planner/finemotion/contacts/extent.h"

namespace assay::finemotion {

namespace {

constexpr int kSteps = 24;           // steps of one motion
constexpr int kClosings = 3;         // number of Newton steps, which begin near the solution
constexpr double kTouching = 1e-7;   // metres; smaller gaps touch
constexpr double kBeside = 1e-6;     // metres; edges in a concave corner touch at their ends
constexpr double kNudge = 1e-7;      // metres, for numerical derivatives
constexpr double kLonger = 1.05;     // contacts are awaited for the longest way times this factor
constexpr double kMargin = 1e-3;     // metres beyond what a motion can reach
constexpr double kRoundTurn = 2e-3;  // radians by which a round contact may be turned past its end
constexpr double kApart = std::numeric_limits<double>::infinity();  // a gap that cannot close

std::size_t At(int index) { return static_cast<std::size_t>(index); }

double GapOf(const Passage& passage, const RoundContacts& round, const ContactKey& key,
             const Pose& X) {
  switch (key.kind) {
    case ContactKind::kVertexFace: {
      const OuterFace& face = passage.stationary.faces[At(key.stationary)];
      return face.normal.dot(X * passage.moving.vertices[At(key.moving)].p) - face.height;
    }
    case ContactKind::kFaceVertex: {
      const OuterFace& face = passage.moving.faces[At(key.moving)];
      const Vector3& p = passage.stationary.vertices[At(key.stationary)].p;
      return (X.linear() * face.normal).dot(p - X.translation()) - face.height;
    }
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall: {
      const auto contact = round.At(key, X, kRoundTurn);
      return contact ? contact->gap : kApart;
    }
    case ContactKind::kEdgeEdge: {
      const OuterEdge& a = passage.moving.edges[At(key.moving)];
      const OuterEdge& b = passage.stationary.edges[At(key.stationary)];
      const Vector3 n = (X.linear() * (a.end - a.start)).cross(b.end - b.start);
      // The sign is arbitrary where the parts do not overlap.
      return n.dot(X * a.start - b.start) / n.norm();
    }
  }
  ASSAY_CHECK(false, "no such kind of contact");
}

bool IsInside(const OuterFace& face, const Vector3& p, double beside) {
  return std::ranges::any_of(face.region, [&](const std::vector<Vector3>& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector3 along = outline[(i + 1) % outline.size()] - outline[i];
      if (face.normal.cross(along).dot(p - outline[i]) < -beside * along.norm()) return false;
    }
    return true;
  });
}

// Returns whether the features have a point in common, to within `beside` metres, where their gap
// is 0.
bool Overlap(const Passage& passage, const RoundContacts& round, const ContactKey& key,
             const Pose& X, double beside) {
  switch (key.kind) {
    case ContactKind::kVertexFace:
      return IsInside(passage.stationary.faces[At(key.stationary)],
                      X * passage.moving.vertices[At(key.moving)].p, beside);
    case ContactKind::kFaceVertex:
      return IsInside(passage.moving.faces[At(key.moving)],
                      X.linear().transpose() *
                          (passage.stationary.vertices[At(key.stationary)].p - X.translation()),
                      beside);
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall: {
      const auto contact = round.At(key, X, kRoundTurn);
      if (!contact) return false;
      for (std::size_t i = 0; i < contact->inside.size(); ++i) {
        const double most = std::cmp_less(i, contact->turns) ? kRoundTurn : beside;
        if (contact->inside[i] < -most) return false;
      }
      return true;
    }
    case ContactKind::kEdgeEdge: {
      const OuterEdge& a = passage.moving.edges[At(key.moving)];
      const OuterEdge& b = passage.stationary.edges[At(key.stationary)];
      const Vector3 u = X.linear() * (a.end - a.start);
      const Vector3 v = b.end - b.start;
      const Vector3 between = b.start - X * a.start;
      const Vector3 n = u.cross(v);
      const double s = between.cross(v).dot(n) / n.squaredNorm();
      const double t = between.cross(u).dot(n) / n.squaredNorm();
      const double of_a = beside / u.norm();
      const double of_b = beside / v.norm();
      return s >= -of_a && s <= 1 + of_a && t >= -of_b && t <= 1 + of_b;
    }
  }
  ASSAY_CHECK(false, "no such kind of contact");
}

Extent ExtentOf(const OuterFace& face, const Pose& X) {
  Extent extent;
  for (const std::vector<Vector3>& outline : face.region) {
    for (const Vector3& corner : outline) extent.Add(X * corner);
  }
  return extent;
}

Extent ExtentOf(const OuterEdge& edge, const Pose& X) {
  return Extent::Of(X * edge.start, X * edge.end);
}

Extent ExtentOf(const OuterVertex& vertex, const Pose& X) {
  return Extent::Of(X * vertex.p, X * vertex.p);
}

template <class Features>
std::vector<Extent> ExtentsOf(const Features& features, const Pose& X) {
  std::vector<Extent> extents;
  extents.reserve(features.size());
  for (const auto& feature : features) extents.push_back(ExtentOf(feature, X));
  return extents;
}

// Returns the command with velocity errors of the greatest size and random signs.
Command WithVelocityErrors(Command command, const ExactReplay& replay, RandomStream& random) {
  const double turn = command.displacement.tail<3>().norm();
  const double move = command.displacement.head<3>().norm() + replay.radius * turn;
  for (int k = 0; k < kPoseDimensions; ++k) {
    const double most = replay.velocity_error * (k < 3 ? move : turn);
    command.displacement[k] += random.Uniform() < 0.5 ? most : -most;
  }
  return command;
}

}  // namespace

// A contact that may come, and its gap at the part's pose.
struct ExactPart::Watched {
  ContactKey key;
  double gap = 0;
};

ExactPart::ExactPart(const Passage& passage, const Pose& X_StationaryMoving, double radius)
    : passage_(passage),
      round_(passage.moving, passage.stationary),
      X_(X_StationaryMoving),
      radius_(radius) {
  for (const OuterVertex& vertex : passage.moving.vertices)
    size_ = std::max(size_, vertex.p.norm());
}

// Returns all pairs of features that are near and do not touch. Pairs of features that touch at
// first and are not kept can only separate.
std::vector<ExactPart::Watched> ExactPart::Apart(double travel) const {
  std::vector<Watched> apart;
  const auto watch = [&](ContactKind kind, const auto& moving, const auto& stationary) {
    const std::vector<Extent> of_moving = ExtentsOf(moving, X_);
    const std::vector<Extent> of_stationary = ExtentsOf(stationary, Pose::Identity());
    for (std::size_t i = 0; i < moving.size(); ++i) {
      for (std::size_t j = 0; j < stationary.size(); ++j) {
        if (moving[i].is_round || stationary[j].is_round) continue;
        if (!of_moving[i].IsNear(of_stationary[j], travel)) continue;
        const ContactKey key{kind, static_cast<int>(i), static_cast<int>(j)};
        const double gap = GapOf(passage_, round_, key, X_);
        if (!(std::abs(gap) < kTouching)) apart.push_back({key, gap});
      }
    }
  };
  const Polyhedron& moving = passage_.moving;
  const Polyhedron& stationary = passage_.stationary;
  watch(ContactKind::kVertexFace, moving.vertices, stationary.faces);
  watch(ContactKind::kFaceVertex, moving.faces, stationary.vertices);
  watch(ContactKind::kEdgeEdge, moving.edges, stationary.edges);
  for (const ContactKey& key : round_.keys()) {
    const double gap = GapOf(passage_, round_, key, X_);
    if (!(std::abs(gap) < kTouching)) apart.push_back({key, gap});
  }
  return apart;
}

std::optional<ContactKey> ExactPart::Move(const Command& command, double most, Vector3 believed) {
  const PoseChange way = most * command.displacement;
  const double travel = way.head<3>().norm() + 2 * size_ * way.tail<3>().norm() + kMargin;
  std::vector<Watched> apart = Apart(travel);
  const PoseChange step = way / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Pose before = X_;
    const auto go = [&](double part) {
      X_ = before;
      Advance(part * step, believed);
      Close(command.kept);
    };
    go(1);
    const Pose after = X_;
    const ContactKey* first = nullptr;
    double earliest = 1;
    for (Watched& watched : apart) {
      const double gap = std::exchange(watched.gap, GapOf(passage_, round_, watched.key, after));
      const bool crosses = watched.key.kind == ContactKind::kEdgeEdge
                               ? (gap > 0) != (watched.gap > 0)
                               : gap > 0 && watched.gap <= 0;
      if (!crosses) continue;
      const double part = std::isfinite(gap) ? gap / (gap - watched.gap) : 1;
      if (part > earliest) continue;
      go(part);
      if (!Overlap(passage_, round_, watched.key, X_, kBeside)) continue;
      first = &watched.key;
      earliest = part;
    }
    if (first != nullptr) {
      go(earliest);
      std::vector<ContactKey> touching = command.kept;
      touching.push_back(*first);
      Close(touching);
      return *first;
    }
    X_ = after;
    believed += step.head<3>();
  }
  return std::nullopt;
}

bool ExactPart::Touches(const ContactKey& key, double beside) const {
  return Overlap(passage_, round_, key, X_, beside);
}

void ExactPart::Advance(const PoseChange& step, const Vector3& believed) {
  const Vector3 apart = X_.translation() - believed;
  X_ = Displaced(X_, step);
  X_.translation() += Displaced(Pose::Identity(), step).linear() * apart - apart;
}

void ExactPart::Close(std::span<const ContactKey> keys) {
  if (keys.empty()) return;
  for (int round = 0; round < kClosings; ++round) {
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kPoseDimensions, 1> gaps(std::ssize(keys));
    Eigen::Matrix<double, Eigen::Dynamic, kPoseDimensions, 0, kPoseDimensions, kPoseDimensions>
        rows(std::ssize(keys), kPoseDimensions);
    for (Eigen::Index i = 0; i < gaps.size(); ++i)
      gaps[i] = GapOf(passage_, round_, keys[At(static_cast<int>(i))], X_);
    if (!gaps.allFinite() || gaps.cwiseAbs().maxCoeff() < kTouching * 1e-3) return;
    for (int k = 0; k < kPoseDimensions; ++k) {
      const double size = k < 3 ? 1 : 1 / radius_;
      const Pose nudged = Displaced(X_, kNudge * size * PoseChange::Unit(k));
      for (Eigen::Index i = 0; i < gaps.size(); ++i) {
        rows(i, k) =
            (GapOf(passage_, round_, keys[At(static_cast<int>(i))], nudged) - gaps[i]) / kNudge;
      }
    }
    if (!rows.allFinite()) return;
    PoseChange closing = rows.completeOrthogonalDecomposition().solve(-gaps);
    closing.tail<3>() /= radius_;
    X_ = Displaced(X_, closing);
  }
}

std::optional<Deviation> DeviationOf(const ExactReplay& replay, const PoseChange& error,
                                     RandomStream& random) {
  Pose believed = replay.X_StationaryStart;
  ExactPart part(replay.passage, Displaced(believed, error), replay.radius);
  for (std::size_t i = 0; i < replay.motions.size(); ++i) {
    const CertainMotion& motion = replay.motions[i];
    const Command command = WithVelocityErrors(motion.command, replay, random);
    const double most = command.until ? kLonger * motion.check.longest : 1;
    const std::optional<ContactKey> made = part.Move(command, most, believed.translation());
    const auto deviation = [&](const ContactKey& contact, bool is_loss) {
      return Deviation{error, i, {contact, is_loss}};
    };
    if (made != command.until)
      return made ? deviation(*made, false) : deviation(*command.until, true);
    for (const ContactKey& kept : command.kept) {
      if (!part.Touches(kept, kLost)) return deviation(kept, true);
    }
    believed = motion.X_StationaryAfter;
  }
  return std::nullopt;
}

ExactReplays ReplayWithErrors(const ExactReplay& replay, const PoseChange& half_widths, int drawn,
                              std::uint64_t seed) {
  RandomStream random(seed, "errors of exact replays");
  ExactReplays replays;
  for (const PoseChange& error : TrialErrors(half_widths, drawn, random)) {
    replays.deviation = DeviationOf(replay, error, random);
    ++replays.tried;
    if (replays.deviation) break;
  }
  return replays;
}

std::vector<PoseChange> TrialErrors(const PoseChange& half_widths, int drawn,
                                    RandomStream& random) {
  std::vector<PoseChange> errors = {PoseChange::Zero()};
  for (int corner = 0; corner < 1 << kPoseDimensions; ++corner) {
    PoseChange signs;
    for (int k = 0; k < kPoseDimensions; ++k) signs[k] = (corner >> k & 1) == 0 ? 1 : -1;
    errors.emplace_back(half_widths.cwiseProduct(signs));
  }
  for (int k = 0; k < kPoseDimensions; ++k) {
    for (const double sign : {1.0, -1.0})
      errors.emplace_back(sign * half_widths[k] * PoseChange::Unit(k));
  }
  for (const double within : {1.0, 2.0}) {
    for (int i = 0; i < drawn; ++i) {
      PoseChange z;
      for (double& part : z) part = std::clamp(random.Uniform(-within, within), -1.0, 1.0);
      errors.emplace_back(half_widths.cwiseProduct(z));
    }
  }
  return errors;
}

}  // namespace assay::finemotion
