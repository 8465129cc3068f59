#include "core/steady/gradient_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/same_bits.hpp"

namespace qdot {
namespace {

using Eigen::VectorXd;

constexpr int most_flow_steps = 600;
/// Of a step; where the forces are no gradient, the axes leave a part of them to D.
constexpr double gradient_tolerance = 1e-3, other_tolerance = 0.05;
/// Of the way so far, or of a coordinate's size.
constexpr double longest_part = 0.25;
/// Of the way so far, or of a coordinate's size: what is left, and where rounding ends it.
constexpr double flow_arrived = 1e-6, nearly_arrived = 1e-4;
/// A way that is so long, in units of the sizes or 1, leads to no end, and one so steep, in units of the rate
/// at its start, into a pole.
constexpr double too_far = 1e5, too_steep = 1e8;
/// Of the steepest curvature: below it an axis is flat.
constexpr double flat = 1e-9;

struct Phi {
  double first{}, second{}, third{};
};

/// phi_j(z) = sum of z^i / (i + j)!
Phi phi(double z) {
  Phi result;
  if (std::abs(z) <= 1) {
    double term = 1.0 / 6;
    for (int i = 4; i < 24; ++i) {
      result.third += term;
      term *= z / i;
    }
    result.second = 0.5 + z * result.third;
    result.first = 1 + z * result.second;
    return result;
  }
  result.first = (exponential(z) - 1) / z;
  result.second = (result.first - 1) / z;
  result.third = (result.second - 0.5) / z;
  return result;
}

class Flow {
 public:
  Flow(const Hillside& hillside, const VectorXd& start)
      : hillside_(hillside), start_(start), x_(start), farthest_(hillside.sizes) {}

  std::optional<VectorXd> lowest() {
    for (int i = 0; i < most_flow_steps; ++i) {
      auto slope = hillside_.slope(x_);
      if (!slope || !slope->force.allFinite() || !slope->curvature.allFinite()) return std::nullopt;
      slope_ = *std::move(slope);
      leave_out_rounding();
      const double left = way_left();
      if (left < flow_arrived) return x_;
      if (i == 0) first_rate_ = rate();
      if (leads_nowhere()) return std::nullopt;
      if (!step()) return left < nearly_arrived ? std::optional(x_) : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] double steepest() const { return slope_.curvature.cwiseAbs().maxCoeff(); }

  void leave_out_rounding() {
    rounding_ = 0;
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      const double ulp = std::numeric_limits<double>::epsilon() * std::abs(x_[i]);
      const double length = slope_.axes.row(i).cwiseAbs().maxCoeff();
      if (length > 0) rounding_ = std::max(rounding_, 4 * steepest() * ulp / length);
    }
    for (Eigen::Index i = 0; i < slope_.force.size(); ++i) {
      const bool is_flat = std::abs(slope_.curvature[i]) <= flat * steepest();
      if (is_flat && std::abs(slope_.force[i]) <= rounding_) slope_.force[i] = 0;
    }
  }

  /// By Newton's iteration; infinite where an axis leads on.
  [[nodiscard]] double way_left() const {
    VectorXd s = VectorXd::Zero(slope_.force.size());
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      if (slope_.force[i] == 0) continue;
      if (!(slope_.curvature[i] > 0)) return std::numeric_limits<double>::infinity();
      s[i] = slope_.force[i] / slope_.curvature[i];
    }
    return largest_part(slope_.axes * s, farthest_);
  }

  [[nodiscard]] VectorXd along_tangent(double h) const {
    VectorXd s = VectorXd::Zero(slope_.force.size());
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      if (slope_.force[i] != 0) s[i] = -h * phi(-h * slope_.curvature[i]).first * slope_.force[i];
    }
    return s;
  }

  /// D, or no value.
  [[nodiscard]] std::optional<VectorXd> departure(const VectorXd& s) const {
    const auto there = hillside_.moved(x_, slope_, s);
    if (!there) return std::nullopt;
    VectorXd result = there->force - slope_.force - slope_.curvature.cwiseProduct(s);
    for (double& d : result)
      if (std::abs(d) <= rounding_) d = 0;
    return result;
  }

  /// What a force that grows as time to the power `order` along the step adds to s, by the force at its end.
  [[nodiscard]] VectorXd added_by(const VectorXd& force, double h, int order) const {
    VectorXd s = VectorXd::Zero(force.size());
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      const Phi weights = phi(-h * slope_.curvature[i]);
      if (force[i] != 0) s[i] = -h * (order == 1 ? weights.second : 2 * weights.third) * force[i];
    }
    return s;
  }

  [[nodiscard]] bool is_short(const VectorXd& s) const {
    const VectorXd dx = slope_.axes * s;
    if (!dx.allFinite()) return false;
    return largest_part(dx, farthest_) <= longest_part;
  }

  /// Of the step in the time h: its estimated error, in parts of what is allowed; where it is below 1, x is
  /// moved.
  double tried(double h) {
    constexpr double too_much = 1e3;
    const VectorXd s = along_tangent(h);
    if (!is_short(s)) return too_much;
    const auto halfway = departure(along_tangent(h / 2));
    const auto end = departure(s);
    if (!halfway || !end) return too_much;
    const VectorXd bent = 2 * *end - 4 * *halfway;
    const VectorXd straight = added_by(*end - bent, h, 1), curved = added_by(bent, h, 2);
    const double departs = std::max(straight.norm(), curved.norm()) / s.norm();
    const double tolerance = slope_.is_gradient ? gradient_tolerance : other_tolerance;
    const double parts = std::max(departs * departs, curved.norm() / s.norm()) / tolerance;
    if (!(parts < 1)) return std::min(parts, too_much);
    const auto next = hillside_.moved(x_, slope_, s + straight + curved);
    if (!next) return too_much;
    x_ = next->x;
    farthest_ = farthest_.cwiseMax((x_ - start_).cwiseAbs());
    return parts;
  }

  [[nodiscard]] bool step() {
    if (time_ == 0) time_ = 0.1 / first_rate_;
    for (int tries = 0; tries < 60; ++tries) {
      const double parts = tried(time_);
      if (parts < 1) {
        time_ = std::min(time_ * std::clamp(0.8 / std::sqrt(parts), 0.5, 10.0), 1e300);
        return true;
      }
      time_ *= std::isnan(parts) ? 0.1 : std::clamp(0.8 / std::sqrt(parts), 0.1, 0.7);
    }
    return false;
  }

  /// Of what the flow does, per time.
  [[nodiscard]] double rate() const {
    return std::max(steepest(), largest_part(slope_.axes * slope_.force, hillside_.sizes));
  }

  [[nodiscard]] bool leads_nowhere() const {
    const VectorXd sizes = hillside_.sizes.cwiseMax(1);
    return largest_part(x_ - start_, sizes) > too_far || steepest() > too_steep * first_rate_;
  }

  const Hillside& hillside_;
  VectorXd start_, x_;
  VectorXd farthest_;  ///< way from the start so far, or the size
  Slope slope_;
  double rounding_{};  ///< of a force
  double first_rate_{}, time_{};
};

}  // namespace

double largest_part(const VectorXd& displacement, const VectorXd& sizes) {
  return displacement.cwiseQuotient(sizes).cwiseAbs().maxCoeff();
}

std::optional<VectorXd> end_of_flow(const Hillside& hillside, const VectorXd& start) {
  return Flow(hillside, start).lowest();
}

}  // namespace qdot
