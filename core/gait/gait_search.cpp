// search_gaits of core/gait/shooting.hpp.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/gait/shooting.hpp"
#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rtol = 1e-5;
constexpr double accuracy = 1e-3;  // of a point on the curve
constexpr std::array start_sizes{0.3, 0.03};
constexpr std::array start_durations{2.0, 1.0, 4.0};
constexpr int most_start_steps = 60, sure_start_steps = 15, most_correctors = 6, most_points = 60;
constexpr double first_advance = 0.2, least_advance = 0.02, largest_advance = 0.4;
constexpr double least_duration = 0.1, largest_duration = 6, least_size = 1e-6, largest_size = 1e3;

/// A point on the curve section(y(T)) = u: the direction along it and how g changes that way.
struct CurvePoint {
  Recurrence at;
  VectorXd tangent;  ///< in (u/|u|, log T), of length 1
  double g{}, slope{};
};

/// The k equations of the curve and g, with derivatives by (u/|u|, log T), residuals over |u|.
struct Scaled {
  MatrixXd curve;  ///< k x (k + 1)
  VectorXd residual;
  Eigen::RowVectorXd g_slope;
  double g{};
};

std::optional<Scaled> scaled(SectionMap& map, const Recurrence& at) {
  const auto shooting = shoot(map, at, rtol);
  if (!shooting) return std::nullopt;
  const Index k = map.size();
  const double size = at.u.norm();
  MatrixXd derivative = shooting->derivative / size;
  derivative.leftCols(k) *= size;
  derivative.col(k) *= at.duration;
  return Scaled{derivative.topRows(k), shooting->residual.head(k) / size, derivative.row(k),
                shooting->residual[k] / size};
}

Recurrence moved(const Recurrence& at, const VectorXd& by) {
  const Index k = at.u.size();
  return {at.u + at.u.norm() * by.head(k), at.duration * std::exp(by[k])};
}

bool in_range(const Recurrence& at) {
  return at.duration >= least_duration && at.duration <= largest_duration && at.u.norm() >= least_size &&
         at.u.norm() <= largest_size;
}

class GaitSearch {
 public:
  explicit GaitSearch(SectionMap& map) : map_(map), k_(map.size()) {}

  Search run() {
    for (const double duration : start_durations) {
      for (const double size : start_sizes) {
        if (curves_.empty() && !died_away_) try_starts(size, duration);
      }
    }
    using Outcome = Search::Outcome;
    if (!result_.candidates.empty())
      result_.outcome = Outcome::found;
    else if (!curves_.empty())
      result_.outcome = Outcome::no_impact;
    else
      result_.outcome = died_away_ ? Outcome::dies_away : Outcome::nothing_recurs;
    return std::move(result_);
  }

 private:
  void try_starts(double size, double duration) {
    for (unsigned signs = 0; signs < 1u << std::min<Index>(k_, 4); ++signs) {
      Recurrence start{VectorXd(k_), duration};
      for (Index i = 0; i < k_; ++i) start.u[i] = (signs >> std::min<Index>(i, 3) & 1u) != 0 ? size : -size;
      if (!map_.counts(map_.state(start.u))) continue;
      const auto on_curve = settled(start);
      if (!on_curve || is_known(*on_curve)) continue;
      curves_.push_back({*on_curve});
      follow(*on_curve, -1);
      std::ranges::reverse(curves_.back());
      follow(*on_curve, 1);
    }
  }

  /// Newton's method at fixed T; after some steps it goes on only while u shrinks.
  std::optional<Recurrence> settled(Recurrence at) {
    for (int i = 0; i < most_start_steps; ++i) {
      const auto equations = scaled(map_, at);
      if (!equations) return std::nullopt;
      VectorXd step = solve(equations->curve.leftCols(k_), -equations->residual);
      const double length = step.norm();
      if (!std::isfinite(length)) return std::nullopt;
      const double size = at.u.norm();
      at.u += size * std::min(1.0, 0.5 / length) * step;
      if (i >= sure_start_steps && at.u.norm() > 0.9 * size && length > 0.1) return std::nullopt;
      if (at.u.norm() < least_size) died_away_ = true;
      if (!in_range(at)) return std::nullopt;
      if (length < accuracy) return at;
    }
    return std::nullopt;
  }

  /// Near a chord of a curve that was followed already.
  [[nodiscard]] bool is_known(const Recurrence& at) const {
    const auto place = [&](const Recurrence& p) {
      VectorXd x(k_ + 1);
      x << (p.u - at.u) / at.u.norm(), std::log(p.duration / at.duration);
      return x;
    };
    for (const std::vector<Recurrence>& curve : curves_) {
      for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const VectorXd from = place(curve[i]), chord = place(curve[i + 1]) - from;
        const double share = std::clamp(-from.dot(chord) / chord.squaredNorm(), 0.0, 1.0);
        if ((from + share * chord).norm() < 0.05) return true;
      }
    }
    return false;
  }

  /// The tangent that goes on in the direction of `before`.
  static VectorXd tangent(const Scaled& equations, const VectorXd& before) {
    const Index k = equations.curve.rows();
    MatrixXd bordered(k + 1, k + 1);
    bordered << equations.curve, before.transpose();
    return solve(bordered, VectorXd::Unit(k + 1, k)).normalized();
  }

  std::optional<CurvePoint> corrected(Recurrence at, const VectorXd& direction) {
    for (int i = 0; i < most_correctors; ++i) {
      const auto equations = scaled(map_, at);
      if (!equations) return std::nullopt;
      MatrixXd bordered(k_ + 1, k_ + 1);
      bordered << equations->curve, direction.transpose();
      VectorXd right = VectorXd::Zero(k_ + 1);
      right.head(k_) = -equations->residual;
      const VectorXd step = solve(bordered, right);
      if (!(step.norm() < 1)) return std::nullopt;
      if (step.norm() < accuracy) {
        const VectorXd along = tangent(*equations, direction);
        return CurvePoint{at, along, equations->g, equations->g_slope.dot(along)};
      }
      at = moved(at, step);
      if (!in_range(at)) return std::nullopt;
    }
    return std::nullopt;
  }

  void follow(const Recurrence& start, int way) {
    VectorXd direction = VectorXd::Zero(k_ + 1);
    direction[k_] = way;
    auto last = corrected(start, direction);
    double advance = first_advance;
    for (int points = 0; last && points < most_points;) {
      const Recurrence guess = moved(last->at, advance * last->tangent);
      if (!in_range(guess)) return;
      const auto next = corrected(guess, last->tangent);
      if (!next || next->tangent.dot(last->tangent) < 0.8) {
        advance /= 2;
        if (advance < least_advance) return;
        continue;
      }
      curves_.back().push_back(next->at);
      look_between(*last, *next, advance);
      last = next;
      advance = std::min(1.5 * advance, largest_advance);
      ++points;
    }
  }

  /// Changes of sign of g, of which Hermite's cubic shows also two in one advance.
  void look_between(const CurvePoint& a, const CurvePoint& b, double advance) {
    constexpr int parts = 8;
    double before = a.g;
    for (int i = 1; i <= parts; ++i) {
      const double x = static_cast<double>(i) / parts, y = 1 - x;
      const double g = (1 + 2 * x) * y * y * a.g + x * x * (3 - 2 * x) * b.g +
                       advance * (x * y * y * a.slope - x * x * y * b.slope);
      if (before * g <= 0 && before != 0)
        result_.candidates.push_back(moved(a.at, (x - 0.5 / parts) * advance * a.tangent));
      before = g;
    }
  }

  SectionMap& map_;
  Index k_;
  Search result_;
  std::vector<std::vector<Recurrence>> curves_;
  bool died_away_{false};
};

}  // namespace

Search search_gaits(SectionMap& map) { return GaitSearch(map).run(); }

}  // namespace qdot
