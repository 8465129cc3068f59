#include "core/gait/gait_continuation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/numerics/dense_matrix.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double step_rtol = 1e-9, coarse_rtol = 1e-13, fine_rtol = 1e-14;
constexpr int start_values = 9, most_correctors = 8, most_points = 400;
constexpr double first_advance = 0.02, least_advance = 1e-4, largest_advance = 0.06;
constexpr double least_size = 1e-5, least_duration = 0.05, largest_duration = 30;
constexpr double difference_share = 1e-5;  // of the range, for derivatives by the parameter
constexpr double near_curve = 0.02;
constexpr double left_by_newton = 10;  // times rtol, of the unknowns

/// A point on a curve of gaits; the tangent is in (u/|u|, log T, (p - from)/(to - from)).
struct CurvePoint {
  Recurrence at;
  double p{};
  VectorXd tangent;
  MatrixXd section;  ///< D
  Flow flow;
};

using Test = double (*)(const MatrixXd&);

double period_doubling(const MatrixXd& d) { return determinant(d + MatrixXd::Identity(d.rows(), d.cols())); }
double fold(const MatrixXd& d) { return determinant(d - MatrixXd::Identity(d.rows(), d.cols())); }
double neimark_sacker(const MatrixXd& d) {
  const Eigen::VectorXcd m = eigenvalues(d);
  std::complex<double> product = 1;
  for (Index i = 0; i < m.size(); ++i)
    for (Index j = 0; j < i; ++j) product *= m[i] * m[j] - 1.0;
  return product.real();
}

constexpr std::array<std::pair<CriticalGait::Kind, Test>, 3> tests{
    {{CriticalGait::Kind::period_doubling, period_doubling},
     {CriticalGait::Kind::fold, fold},
     {CriticalGait::Kind::neimark_sacker, neimark_sacker}}};

/// Largest first.
std::vector<std::complex<double>> sorted_eigenvalues(const MatrixXd& d) {
  const Eigen::VectorXcd values = eigenvalues(d);
  std::vector<std::complex<double>> result(values.begin(), values.end());
  std::ranges::stable_sort(result, std::ranges::greater{}, [](const auto& m) { return std::abs(m); });
  return result;
}

class GaitCurves {
 public:
  GaitCurves(const Dynamics& dynamics, std::span<const double> parameters, std::size_t index, double from,
             double to)
      : dynamics_(dynamics),
        parameters_(parameters.begin(), parameters.end()),
        index_(index),
        from_(from),
        to_(to),
        map_(dynamics) {
    set(from);
    k_ = map_.size();
  }

  GaitBifurcations run() {
    for (int i = 0; i < start_values; ++i) {
      const double p = i + 1 == start_values ? to_ : from_ + (to_ - from_) * i / (start_values - 1);
      set(p);
      const Gaits found = periodic_gaits(dynamics_, parameters_);
      if (result_.reason.empty()) result_.reason = found.reason;
      for (const Gait& gait : found.gaits) start(gait, p);
    }
    if (!result_.branches.empty()) result_.reason.clear();
    std::ranges::sort(result_.critical, {}, &CriticalGait::value);
    return std::move(result_);
  }

 private:
  void set(double p) {
    parameters_[index_] = p;
    map_.set_parameters(parameters_);
  }

  [[nodiscard]] VectorXd along_parameter() const { return VectorXd::Unit(k_ + 2, k_ + 1); }

  void start(const Gait& gait, double p) {
    set(p);
    VectorXd before(static_cast<Index>(gait.pre_impact.size()));
    for (Index i = 0; i < before.size(); ++i) before[i] = gait.pre_impact[static_cast<std::size_t>(i)].value;
    const Recurrence at{map_.section(map_.in_units(before)), gait.step_time.value / map_.time_unit()};
    if (is_known(at, p)) return;
    const auto first = corrected(at, p, along_parameter(), step_rtol);
    if (!first) return;
    curves_.emplace_back();
    result_.branches.push_back({gait.kind, {}});
    follow(*first, -1);
    std::ranges::reverse(result_.branches.back().points);
    note(*first);
    follow(*first, 1);
  }

  /// In the coordinates of the tangents, as seen from `at`.
  [[nodiscard]] VectorXd place(const Recurrence& of, double p, const Recurrence& at) const {
    VectorXd x(k_ + 2);
    x << (of.u - at.u) / at.u.norm(), std::log(of.duration / at.duration), p / (to_ - from_);
    return x;
  }

  [[nodiscard]] bool is_known(const Recurrence& at, double p) const {
    const VectorXd here = place(at, p, at);
    return std::ranges::any_of(curves_, [&](const std::vector<std::pair<CurvePoint, CurvePoint>>& curve) {
      return std::ranges::any_of(curve, [&](const auto& piece) {
        const VectorXd begin = place(piece.first.at, piece.first.p, at) - here;
        const VectorXd chord = place(piece.second.at, piece.second.p, at) - here - begin;
        const double share = std::clamp(-begin.dot(chord) / chord.squaredNorm(), 0.0, 1.0);
        return (begin + share * chord).norm() < near_curve;
      });
    });
  }

  struct Equations {
    Shooting shooting;
    MatrixXd derivative;  ///< (k + 1) x (k + 2), by the coordinates of the tangents, over |u|
    VectorXd residual;    ///< over |u|
  };
  std::optional<Equations> equations(const Recurrence& at, double p, double rtol) {
    const double h = difference_share * (to_ - from_);
    const double ahead = std::min(p + h, std::max(to_, p)), behind = std::max(p - h, std::min(from_, p));
    set(ahead);
    const auto a = shoot(map_, at, rtol);
    set(behind);
    const auto b = shoot(map_, at, rtol);
    set(p);
    auto shooting = shoot(map_, at, rtol);
    if (!a || !b || !shooting || !(ahead > behind)) return std::nullopt;
    const double size = at.u.norm();
    MatrixXd derivative(k_ + 1, k_ + 2);
    derivative << shooting->derivative.leftCols(k_), shooting->derivative.col(k_) * (at.duration / size),
        (a->residual - b->residual) * ((to_ - from_) / (ahead - behind) / size);
    VectorXd residual = shooting->residual / size;
    return Equations{std::move(*shooting), std::move(derivative), std::move(residual)};
  }

  /// Newton's method across `direction` until the corrections are at the tolerance's level.
  std::optional<CurvePoint> corrected(Recurrence at, double p, const VectorXd& direction, double rtol) {
    double last = 1;
    for (int i = 0; i < most_correctors; ++i) {
      auto found = equations(at, p, rtol);
      if (!found) return std::nullopt;
      MatrixXd bordered(k_ + 2, k_ + 2);
      bordered << found->derivative, direction.transpose();
      VectorXd right = VectorXd::Zero(k_ + 2);
      right.head(k_ + 1) = -found->residual;
      const VectorXd step = solve(bordered, right);
      const double length = step.norm();
      if (!(length < 1)) return std::nullopt;
      if (length < left_by_newton * rtol || (length < 1e-10 && length > 0.3 * last)) {
        VectorXd tangent = solve(bordered, VectorXd::Unit(k_ + 2, k_ + 1)).normalized();
        MatrixXd section = map_.derivative(found->shooting.flow);
        return CurvePoint{at, p, std::move(tangent), std::move(section), std::move(found->shooting.flow)};
      }
      at.u += at.u.norm() * step.head(k_);
      at.duration *= std::exp(step[k_]);
      p += (to_ - from_) * step[k_ + 1];
      last = length;
    }
    return std::nullopt;
  }

  std::optional<CurvePoint> ahead_of(const CurvePoint& from, double advance, double rtol) {
    const VectorXd by = advance * from.tangent;
    const Recurrence guess{from.at.u + from.at.u.norm() * by.head(k_), from.at.duration * std::exp(by[k_])};
    return corrected(guess, from.p + (to_ - from_) * by[k_ + 1], from.tangent, rtol);
  }

  [[nodiscard]] bool belongs(const CurvePoint& point) {
    return point.at.u.norm() > least_size && point.at.duration > least_duration &&
           point.at.duration < largest_duration && map_.is_impact(point.flow);
  }

  void note(const CurvePoint& point) {
    set(point.p);
    const auto jump = map_.jump(point.at.u);
    if (!jump) return;
    auto multipliers = sorted_eigenvalues(point.section);
    multipliers.resize(static_cast<std::size_t>(std::min(map_.dimension(point.flow), k_)));
    const bool stable = std::ranges::all_of(multipliers, [](const auto& m) { return std::abs(m) < 1; });
    result_.branches.back().points.push_back({point.p, map_.in_si(jump->after),
                                              point.at.duration * map_.time_unit(), std::move(multipliers),
                                              stable});
  }

  void follow(CurvePoint last, int way) {
    last.tangent *= way;
    double advance = first_advance;
    for (int points = 0; points < most_points;) {
      auto next = ahead_of(last, advance, step_rtol);
      if (!next || !belongs(*next) || next->tangent.dot(last.tangent) < 0.95) {
        advance /= 2;
        if (advance < least_advance) return;
        continue;
      }
      look_between(last, *next, advance);
      curves_.back().emplace_back(last, *next);
      if (next->p < from_ || next->p > to_) {
        const auto end = corrected(next->at, std::clamp(next->p, from_, to_), along_parameter(), step_rtol);
        if (end && belongs(*end)) note(*end);
        return;
      }
      note(*next);
      last = std::move(*next);
      advance = std::min(1.5 * advance, largest_advance);
      ++points;
    }
  }

  void look_between(const CurvePoint& a, const CurvePoint& b, double advance) {
    for (const auto& [kind, test] : tests) {
      const SignChange bracket{0, test(a.section), advance, test(b.section)};
      if (bracket.value_before * bracket.value_after < 0) add_critical(kind, test, a, bracket);
    }
  }

  void add_critical(CriticalGait::Kind kind, Test test, const CurvePoint& a, const SignChange& bracket) {
    const auto rough = critical_point(test, a, bracket, coarse_rtol);
    const auto point = critical_point(test, a, bracket, fine_rtol);
    if (!rough || !point || point->p < from_ || point->p > to_) return;
    CriticalGait critical{kind,
                          point->p,
                          2 * std::abs(point->p - rough->p) + 4e-16 * std::abs(point->p) +
                              2 * left_by_newton * fine_rtol * (to_ - from_),
                          {},
                          {},
                          {}};
    critical.multipliers = sorted_eigenvalues(point->section);
    const bool on_circle = std::ranges::any_of(critical.multipliers, [](const auto& m) {
      return m.imag() != 0 && std::abs(std::abs(m) - 1) < 1e-6;
    });
    if (kind == CriticalGait::Kind::neimark_sacker && !on_circle) return;  // a saddle with m_1 m_2 = 1
    set(point->p);
    critical.multipliers.resize(static_cast<std::size_t>(std::min(map_.dimension(point->flow), k_)));
    critical.state = map_.in_si(map_.jump(point->at.u)->after);
    critical.step_time = point->at.duration * map_.time_unit();
    result_.critical.push_back(std::move(critical));
  }

  /// The zero of `test` along the curve.
  std::optional<CurvePoint> critical_point(Test test, const CurvePoint& a, const SignChange& bracket,
                                           double rtol) {
    std::optional<CurvePoint> point;
    bool failed = false;
    const auto value = [&](double advance) {
      point = ahead_of(a, advance, rtol);
      failed = failed || !point;
      return point ? test(point->section) : std::nan("");
    };
    const SignChange place = find_sign_change(value, bracket);
    if (failed) return std::nullopt;
    return ahead_of(a, place.after, rtol);
  }

  const Dynamics& dynamics_;
  std::vector<double> parameters_;
  std::size_t index_;
  double from_, to_;
  SectionMap map_;
  Index k_{};
  GaitBifurcations result_;
  std::vector<std::vector<std::pair<CurvePoint, CurvePoint>>> curves_;
};

}  // namespace

GaitBifurcations critical_gaits(const Dynamics& dynamics, std::span<const double> parameters,
                                std::size_t index, double from, double to) {
  return GaitCurves(dynamics, parameters, index, from, to).run();
}

}  // namespace qdot
