#include "core/gait/gait_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/gait/strides_that_settle.hpp"
#include "core/numerics/dense_matrix.hpp"
#include "core/numerics/path_following.hpp"
#include "core/numerics/same_bits.hpp"

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rtol = 1e-5;
constexpr double accuracy = 1e-3;  // of a point on the curve
constexpr std::array start_sizes{0.3, 0.03, 2.0};
constexpr std::array start_durations{2.0, 1.0, 4.0};
constexpr std::array hastes{3.0, 10.0};  // where no gait is found otherwise
constexpr int most_start_steps = 60, sure_start_steps = 15;
constexpr Corrections corrections{.most = 6, .accuracy = accuracy};
constexpr Advances advances{
    .first = 0.2, .least = 0.02, .largest = 0.4, .least_cosine = 0.8, .most_points = 60};
constexpr double near_curve = 0.05;
constexpr double least_duration = 0.1, largest_duration = 6, least_size = 1e-6, largest_size = 1e3;

/// The curve section(y(T)) = u, its unknowns (u, T), steps in (u/|u|, log T).
class RecurrenceCurve {
 public:
  using Place = Recurrence;
  struct Linearization {
    MatrixXd derivative;  ///< k x (k + 1), over |u|
    VectorXd residual;    ///< over |u|
    double surface{};     ///< g(y(T)), over |u|: its zeros are gaits
    Eigen::RowVectorXd surface_slope;
  };

  explicit RecurrenceCurve(SectionMap& map) : map_(map) {}

  [[nodiscard]] std::optional<Linearization> linearized(const Recurrence& at) {
    const auto shooting = shoot(map_, at, rtol);
    if (!shooting) return std::nullopt;
    const Index k = map_.size();
    const double size = at.u.norm();
    MatrixXd derivative = shooting->derivative / size;
    derivative.leftCols(k) *= size;
    derivative.col(k) *= at.duration;
    return Linearization{derivative.topRows(k), shooting->residual.head(k) / size,
                         shooting->residual[k] / size, derivative.row(k)};
  }

  [[nodiscard]] static bool in_range(const Recurrence& at) {
    return at.duration >= least_duration && at.duration <= largest_duration && at.u.norm() >= least_size &&
           at.u.norm() <= largest_size;
  }

  [[nodiscard]] static std::optional<Recurrence> moved(const Recurrence& at, const VectorXd& by) {
    const Index k = at.u.size();
    Recurrence to{at.u + at.u.norm() * by.head(k), at.duration * exponential(by[k])};
    return in_range(to) ? std::optional(std::move(to)) : std::nullopt;
  }

 private:
  SectionMap& map_;
};

using CurveOfPoints = std::vector<Recurrence>;

/// u = size (+-1, ..., +-1) with the signs that the bits say; components beyond the fourth share theirs.
Recurrence start(Index k, double size, double duration, unsigned signs) {
  Recurrence at{VectorXd(k), duration};
  for (Index i = 0; i < k; ++i) at.u[i] = (signs >> std::min<Index>(i, 3) & 1u) != 0 ? size : -size;
  return at;
}

struct Settled {
  std::optional<Recurrence> at;
  bool dies_away{};  ///< u shrank to nothing
};

/// Newton's method at fixed T; after some steps it goes on only while u shrinks.
Settled search_settled(RecurrenceCurve& curve, Recurrence at) {
  const Index k = at.u.size();
  for (int i = 0; i < most_start_steps; ++i) {
    const auto here = curve.linearized(at);
    if (!here) return {};
    const VectorXd step = solve(here->derivative.leftCols(k), -here->residual);
    const double length = step.norm();
    if (!std::isfinite(length)) return {};
    const double size = at.u.norm();
    at.u += size * std::min(1.0, 0.5 / length) * step;
    if (i >= sure_start_steps && at.u.norm() > 0.9 * size && length > 0.1) return {};
    if (!RecurrenceCurve::in_range(at)) return {std::nullopt, at.u.norm() < least_size};
    if (length < accuracy) return {std::move(at), false};
  }
  return {};
}

bool is_on(const CurveOfPoints& curve, const Recurrence& at) {
  const auto place = [&](const Recurrence& p) {
    VectorXd x(at.u.size() + 1);
    x << (p.u - at.u) / at.u.norm(), logarithm(p.duration / at.duration);
    return x;
  };
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    if (distance_to_piece(place(curve[i]), place(curve[i + 1])) < near_curve) return true;
  }
  return false;
}

/// Places between two points where g changes its sign; Hermite's cubic shows also two changes in one advance.
void look_between(const CurvePoint<RecurrenceCurve>& a, const CurvePoint<RecurrenceCurve>& b, double advance,
                  std::vector<Recurrence>& found) {
  constexpr int parts = 8;
  const double g_a = a.linearization.surface, slope_a = a.linearization.surface_slope.dot(a.tangent);
  const double g_b = b.linearization.surface, slope_b = b.linearization.surface_slope.dot(b.tangent);
  double before = g_a;
  for (int i = 1; i <= parts; ++i) {
    const double x = static_cast<double>(i) / parts, y = 1 - x;
    const double g = (1 + 2 * x) * y * y * g_a + x * x * (3 - 2 * x) * g_b +
                     advance * (x * y * y * slope_a - x * x * y * slope_b);
    if (before * g <= 0 && before != 0) {
      const VectorXd by = (x - 0.5 / parts) * advance * a.tangent;
      const Index k = a.at.u.size();
      found.push_back({a.at.u + a.at.u.norm() * by.head(k), a.at.duration * exponential(by[k])});
    }
    before = g;
  }
}

/// The curve through `from`, followed to both sides; candidates on it are added to `found`.
CurveOfPoints followed(RecurrenceCurve& curve, const Recurrence& from, std::vector<Recurrence>& found) {
  const Index k = from.u.size();
  CurveOfPoints points{from};
  for (const int way : {-1, 1}) {
    const auto first = corrected(curve, from, VectorXd::Unit(k + 1, k) * way, corrections);
    const auto everywhere = [](const auto&) { return true; };
    const auto visit = [&](const auto& last, const auto& next, double advance) {
      points.push_back(next.at);
      look_between(last, next, advance, found);
      return true;
    };
    if (first) follow_curve(curve, *first, corrections, advances, everywhere, visit);
    if (way < 0) std::ranges::reverse(points);
  }
  return points;
}

class SearchForGaits {
 public:
  SearchForGaits(SectionMap& map, const IgnoredByGait& gait_near)
      : map_(map), gait_near_(gait_near), curve_(map) {}

  GaitSearch run() {
    try_starts(start_sizes[0], start_durations[0]);
    settle(1);
    for (const double duration : start_durations) {
      for (const double size : start_sizes) {
        const bool is_first = size == start_sizes[0] && duration == start_durations[0];
        // Motions may recur without an impact on one curve, and with one on another; where one start leads to
        // such a curve, another that shrinks to nothing tells little.
        if (!is_first && gaits_.empty() && !(dies_away_ && curves_.empty())) try_starts(size, duration);
      }
    }
    for (const double haste : hastes)
      if (gaits_.empty()) settle(haste);
    result_.outcome = outcome();
    return std::move(result_);
  }

 private:
  void try_starts(double size, double duration) {
    const Index k = map_.size();
    for (unsigned signs = 0; signs < 1u << std::min<Index>(k, 4); ++signs) {
      const Recurrence at = start(k, size, duration, signs);
      if (!map_.counts(map_.state(at.u))) continue;
      const Settled on_curve = search_settled(curve_, at);
      dies_away_ = dies_away_ || on_curve.dies_away;
      const auto is_known = [&](const CurveOfPoints& other) { return is_on(other, *on_curve.at); };
      if (!on_curve.at || std::ranges::any_of(curves_, is_known)) continue;
      const std::size_t known = result_.candidates.size();
      curves_.push_back(followed(curve_, *on_curve.at, result_.candidates));
      for (std::size_t i = known; i < result_.candidates.size(); ++i)
        if (gait_near_(result_.candidates[i]) == 0) gaits_.push_back(result_.candidates[i]);
    }
  }

  void settle(double haste) {
    if (const auto gait = where_strides_settle(map_, haste, gaits_, gait_near_)) gaits_.push_back(*gait);
  }

  [[nodiscard]] GaitSearch::Outcome outcome() const {
    using Outcome = GaitSearch::Outcome;
    if (!result_.candidates.empty()) return Outcome::found;
    if (!curves_.empty()) return Outcome::no_impact;
    return dies_away_ ? Outcome::dies_away : Outcome::nothing_recurs;
  }

  SectionMap& map_;
  const IgnoredByGait& gait_near_;
  RecurrenceCurve curve_;
  std::vector<CurveOfPoints> curves_;
  std::vector<Recurrence> gaits_;  ///< those that end the search
  bool dies_away_{};
  GaitSearch result_;
};

}  // namespace

GaitSearch search_gaits(SectionMap& map, const IgnoredByGait& gait_near) {
  return SearchForGaits(map, gait_near).run();
}

}  // namespace qdot
