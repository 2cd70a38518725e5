#include "planner/finemotion/segment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace assay::finemotion {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLost = 2e-5;    // metres beyond a limit
constexpr double kTurned = 2e-3;  // radians
constexpr double kLongest = 20;   // displacements, until a contact is surely made
constexpr double kGreatestMultiplier = 1e6;
constexpr int kThirds = 30;         // that remain of an interval's two, one after another
constexpr double kParallel = 1e-9;  // coefficients of rows

// The projection with `gap` of the contact that ends it not negative.
struct Truncated {
  ForwardProjection projection;
  const PrimitiveContact* until = nullptr;

  // The least upper bound of a . z: by the Lagrangian, convex in the multiplier.
  double Support(const Eigen::VectorXd& a) const {
    const double whole = projection.Support(a);
    if (until == nullptr) return whole;
    const auto bound = [&](double multiplier) {
      return projection.Support(a + multiplier * until->row) + multiplier * until->offset;
    };
    double high = a.norm() / until->row.norm();
    while (high < kGreatestMultiplier && bound(2 * high) < bound(high)) high *= 2;
    high *= 2;
    double low = 0;
    for (int i = 0; i < kThirds; ++i) {
      const double third = (high - low) / 3;
      const bool is_left = bound(low + third) < bound(high - third);
      (is_left ? high : low) += is_left ? -third : third;
    }
    return std::min(whole, bound((low + high) / 2));
  }
};

class Checker {
 public:
  Checker(const SegmentModel& model, const Belief& belief, const Command& command)
      : model_(model), belief_(belief), command_(command) {
    const Eigen::Index n = belief.errors.rows();
    for (const ContactKey& key : command.kept) {
      if (const PrimitiveContact* contact = Find(model.contacts, key)) kept_.push_back(contact);
    }
    if (command.until) until_ = Find(model.contacts, *command.until);
    velocity_.center = command.displacement;
    const double turn = command.displacement.segment<3>(3).norm();
    const double move = command.displacement.head<3>().norm();
    velocity_.generators.setZero(n, kPoseDimensions);
    velocity_.generators.diagonal().head<3>().setConstant(model.velocity_error *
                                                          (move + model.radius * turn));
    velocity_.generators.diagonal().tail<3>().setConstant(model.velocity_error * turn);
    velocity_.generators = Tangential(velocity_.generators);
    errors_ = Tangential(Turned(belief.errors));
    swept_.resize(n, errors_.cols() + belief.errors.cols());
    swept_ << errors_, errors_ - belief.errors;
    if (turn == 0) swept_ = errors_;
  }

  SegmentCheck Run(bool whole) {
    SegmentCheck check;
    if (!KeptStay() || (command_.until && until_ == nullptr)) return check;
    const std::optional<double> time = Time(1);
    if (!time) return check;
    check.longest = *time;
    for (const PrimitiveContact& contact : model_.contacts) {
      if (IsWanted(contact)) continue;
      const double scale = ScaleOf([&](double s) { return CanMeet(contact, s); }, whole);
      if (scale < kBeyondLadder) check.unwanted.push_back({KeyOf(contact), false, scale});
      if (scale <= 1 && !whole) return check;
    }
    for (const PrimitiveContact* kept : kept_) {
      const double scale = ScaleOf([&](double s) { return CanLose(*kept, s); }, whole);
      if (scale < kBeyondLadder) check.unwanted.push_back({KeyOf(*kept), true, scale});
      if (scale <= 1 && !whole) return check;
    }
    if (until_ != nullptr) {
      const double scale = ScaleOf([&](double s) { return CanPass(s); }, whole);
      if (scale < kBeyondLadder) check.unwanted.push_back({KeyOf(*until_), true, scale});
    }
    std::ranges::stable_sort(check.unwanted, {}, &Unwanted::scale);
    check.certain = check.unwanted.empty() || check.unwanted.front().scale > 1;
    if (check.certain) check.after = After();
    return check;
  }

 private:
  // Contacts that disappear where others of one C-surface take over are none of ours.
  bool KeptStay() const { return kept_.size() == command_.kept.size(); }

  // What force control leaves of motions: the tangential part, in lengths at the radius.
  Eigen::MatrixXd Tangential(Eigen::MatrixXd motions) const {
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(motions.rows());
    scale.segment<3>(3).setConstant(model_.radius);
    Eigen::MatrixXd basis(kPoseDimensions, std::ssize(kept_));
    Eigen::Index count = 0;
    for (const PrimitiveContact* contact : kept_) {
      Eigen::VectorXd row =
          (contact->row.head<kPoseDimensions>().array() / scale.head<kPoseDimensions>().array());
      for (int pass = 0; pass < 2; ++pass) {
        row -= basis.leftCols(count) * (basis.leftCols(count).transpose() * row);
      }
      if (row.norm() > 1e-9) basis.col(count++) = row.normalized();
    }
    auto pose = motions.topRows<kPoseDimensions>();
    Eigen::MatrixXd scaled = scale.head<kPoseDimensions>().asDiagonal() * pose;
    scaled -= basis.leftCols(count) * (basis.leftCols(count).transpose() * scaled);
    pose = scale.head<kPoseDimensions>().cwiseInverse().asDiagonal() * scaled;
    return motions;
  }

  // The hand turns the part about where it believes the tip to be: errors turn with it.
  Eigen::MatrixXd Turned(Eigen::MatrixXd errors) const {
    const Vector3 w = command_.displacement.segment<3>(3);
    if (w.isZero(0)) return errors;
    const Eigen::Matrix3d R = Displaced(Pose::Identity(), command_.displacement).linear();
    errors.topRows<3>() = R * errors.topRows<3>();
    errors.middleRows<3>(3) = R * errors.middleRows<3>(3);
    return errors;
  }

  // Also what is let go, if it is surely left.
  bool IsWanted(const PrimitiveContact& contact) const {
    const ContactKey key = KeyOf(contact);
    if (command_.until && key == *command_.until) return true;
    if (std::ranges::find(command_.kept, key) != command_.kept.end()) return true;
    return std::ranges::find(belief_.kept, key) != belief_.kept.end() &&
           velocity_.Support(-contact.row) < 0;
  }

  // As seen from the end, and anywhere on the way there.
  Zonotope Start(double scale) const { return {-command_.displacement, scale * errors_}; }
  Zonotope Swept(double scale) const { return {-command_.displacement, scale * swept_}; }

  // Displacements until it is surely over; none: it may never be.
  std::optional<double> Time(double scale) const {
    if (until_ == nullptr) return 1;
    const double slowest = -Scaled(velocity_, scale).Support(until_->row);
    const double farthest = until_->offset + Start(scale).Support(until_->row);
    if (slowest <= 0 || farthest > kLongest * slowest) return std::nullopt;
    return std::max(0.0, farthest / slowest);
  }

  Truncated Projection(double scale) const {
    return {{Swept(scale), Scaled(velocity_, scale), *Time(scale)}, until_};
  }

  bool CanMeet(const PrimitiveContact& contact, double scale) const {
    if (!Time(scale)) return true;
    const Truncated f = Projection(scale);
    if (contact.offset - f.projection.Support(-contact.row) > 0) return false;
    PrimitiveContact before = contact;
    if (until_ != nullptr) before.limits.push_back({-until_->row, until_->offset});
    return Meet(f.projection, before).meets;
  }

  // A limit is exceeded where nothing stops the part.
  bool CanLose(const PrimitiveContact& contact, double scale) const {
    if (!Time(scale)) return true;
    const Truncated f = Projection(scale);
    return std::ranges::any_of(contact.limits, [&](const HalfSpace& limit) {
      return !Stops(limit) && f.projection.Support(limit.a) > limit.b + Slack(limit) &&
             f.Support(limit.a) > limit.b + Slack(limit);
    });
  }

  // The contact that is waited for is not where the part comes to its surface.
  bool CanPass(double scale) const {
    if (!Time(scale)) return true;
    const Zonotope region =
        RegionAtContact({Start(scale), Scaled(velocity_, scale), *Time(scale)}, *until_);
    return std::ranges::any_of(until_->limits, [&](const HalfSpace& limit) {
      return !Stops(limit) && region.Support(limit.a) > limit.b + Slack(limit);
    });
  }

  static double Slack(const HalfSpace& limit) {
    return limit.a.head<3>().isZero(0) ? kTurned : kLost;
  }

  bool Stops(const HalfSpace& limit) const {
    return std::ranges::any_of(model_.contacts, [&](const PrimitiveContact& contact) {
      return std::abs(contact.offset - limit.b) < kParallel &&
             (contact.row + limit.a).cwiseAbs().maxCoeff() < kParallel;
    });
  }

  template <class Happens>
  static double ScaleOf(const Happens& happens, bool whole) {
    if (!whole) return happens(1) ? 1 : kBeyondLadder;
    if (!happens(std::ranges::max(kLadder))) return kBeyondLadder;
    return *std::ranges::find_if(kLadder, happens);
  }

  Belief After() const {
    Belief after;
    Zonotope region = Sum(Start(1), velocity_);
    if (until_ != nullptr) region = RegionAtContact({Start(1), velocity_, *Time(1)}, *until_);
    // Kept contacts drift off their surfaces in the second order.
    std::vector<const PrimitiveContact*> touching = kept_;
    if (until_ != nullptr) touching.push_back(until_);
    after.X_StationaryMoving =
        Displaced(Displaced(belief_.X_StationaryMoving, command_.displacement),
                  region.center + Closing(touching, region.center, model_.radius));
    after.errors = region.generators;
    after.kept = command_.kept;
    if (until_ != nullptr) after.kept.push_back(*command_.until);
    std::ranges::sort(after.kept);
    return after;
  }

  const SegmentModel& model_;
  const Belief& belief_;
  const Command& command_;
  std::vector<const PrimitiveContact*> kept_;
  const PrimitiveContact* until_ = nullptr;
  Zonotope velocity_;
  Eigen::MatrixXd errors_;
  Eigen::MatrixXd swept_;
};

}  // namespace

ContactKey KeyOf(const PrimitiveContact& contact) {
  return {contact.kind, contact.moving, contact.stationary};
}

std::string Name(const ContactKey& key) {
  PrimitiveContact contact;
  contact.kind = key.kind;
  contact.moving = key.moving;
  contact.stationary = key.stationary;
  return Name(contact);
}

const PrimitiveContact* Find(const std::vector<PrimitiveContact>& contacts, const ContactKey& key) {
  const PrimitiveContact* found = nullptr;
  double least = kInfinity;
  for (const PrimitiveContact& contact : contacts) {
    if (KeyOf(contact) != key) continue;
    double excess = -kInfinity;
    for (const HalfSpace& limit : contact.limits) excess = std::max(excess, -limit.b);
    if (excess >= least) continue;
    least = excess;
    found = &contact;
  }
  return found;
}

GeneralizedPoint Closing(const std::vector<const PrimitiveContact*>& contacts,
                         const GeneralizedPoint& z, double radius) {
  GeneralizedPoint closing = GeneralizedPoint::Zero(z.size());
  if (contacts.empty()) return closing;
  Eigen::MatrixXd rows(std::ssize(contacts), kPoseDimensions);
  Eigen::VectorXd gaps(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const PrimitiveContact& contact = *contacts[static_cast<std::size_t>(i)];
    rows.row(i) = contact.row.head<kPoseDimensions>();
    gaps[i] = contact.Gap(z);
  }
  rows.rightCols<3>() /= radius;
  closing.head<kPoseDimensions>() = rows.completeOrthogonalDecomposition().solve(-gaps);
  closing.segment<3>(3) /= radius;
  return closing;
}

Pose Displaced(const Pose& X_StationaryMoving, const GeneralizedPoint& z) {
  Pose X = X_StationaryMoving;
  const Vector3 w = z.segment<3>(3);
  const double angle = w.norm();
  if (angle > 0) X.linear() = Eigen::AngleAxisd(angle, w / angle) * X.linear();
  X.translation() += z.head<3>();
  return X;
}

SegmentCheck Check(const SegmentModel& model, const Belief& belief, const Command& command,
                   bool whole) {
  return Checker(model, belief, command).Run(whole);
}

}  // namespace assay::finemotion
