#include "core/gait/gait_continuation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/gait/gait_family.hpp"
#include "core/numerics/dense_matrix.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double step_rtol = 1e-9, coarse_rtol = 1e-13, fine_rtol = 1e-14;
constexpr int start_values = 9;
constexpr Advances continuation_advances{
    .first = 0.02, .least = 1e-4, .largest = 0.06, .least_cosine = 0.95, .most_points = 400};
constexpr double continued_least_size = 1e-5, continued_least_duration = 0.05,
                 continued_largest_duration = 30;
constexpr double continued_near_curve = 0.02;

/// A function of D that changes its sign where gaits change their kind.
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
        from_(from),
        to_(to),
        map_(dynamics),
        family_(map_, parameters, index, from, to, step_rtol),
        coarse_(map_, parameters, index, from, to, coarse_rtol),
        fine_(map_, parameters, index, from, to, fine_rtol) {}

  GaitBifurcations run() {
    for (int i = 0; i < start_values; ++i) {
      const double p = i + 1 == start_values ? to_ : from_ + (to_ - from_) * i / (start_values - 1);
      family_.set(p);
      const Gaits found = periodic_gaits(dynamics_, family_.parameters());
      if (result_.reason.empty()) result_.reason = found.reason;
      for (const Gait& gait : found.gaits) start(gait, p);
    }
    if (!result_.branches.empty()) result_.reason.clear();
    std::ranges::sort(result_.critical, {}, &CriticalGait::value);
    return std::move(result_);
  }

 private:
  using Place = GaitFamily::Place;

  void start(const Gait& gait, double p) {
    family_.set(p);
    VectorXd before(static_cast<Index>(gait.pre_impact.size()));
    for (Index i = 0; i < before.size(); ++i) before[i] = gait.pre_impact[static_cast<std::size_t>(i)].value;
    const Place at{{map_.section(map_.in_units(before)), gait.step_time.value / map_.time_unit()}, p};
    if (is_known(at)) return;
    const auto first = family_.point(at, family_.along_parameter());
    if (!first) return;
    result_.branches.push_back({gait.kind, {}});
    follow(*first, -1);
    std::ranges::reverse(result_.branches.back().points);
    note(*first);
    follow(*first, 1);
  }

  [[nodiscard]] bool is_known(const Place& at) const {
    return std::ranges::any_of(pieces_, [&](const auto& piece) {
      return distance_to_piece(family_.step_to(piece.first, at), family_.step_to(piece.second, at)) <
             continued_near_curve;
    });
  }

  [[nodiscard]] bool belongs(const GaitOnCurve& point) {
    const Recurrence& at = point.at.at;
    return at.u.norm() > continued_least_size && at.duration > continued_least_duration &&
           at.duration < continued_largest_duration && map_.is_impact(point.linearization.flow);
  }

  void follow(GaitOnCurve start, int way) {
    start.tangent *= way;
    const auto belongs_here = [&](const GaitOnCurve& point) { return belongs(point); };
    const auto visit = [&](const GaitOnCurve& last, const GaitOnCurve& next, double advance) {
      look_between(last, next, advance);
      pieces_.emplace_back(last.at, next.at);
      const double inside = std::clamp(next.at.p, from_, to_);
      if (next.at.p == inside) {
        note(next);
        return true;
      }
      const auto end = family_.point({next.at.at, inside}, family_.along_parameter());
      if (end && belongs(*end)) note(*end);
      return false;
    };
    follow_curve(family_, std::move(start), family_.corrections(), continuation_advances, belongs_here,
                 visit);
  }

  [[nodiscard]] std::size_t multiplier_count(const GaitOnCurve& point) {
    return static_cast<std::size_t>(std::min(map_.dimension(point.linearization.flow), map_.size()));
  }

  void note(const GaitOnCurve& point) {
    family_.set(point.at.p);
    const auto jump = map_.jump(point.at.at.u);
    if (!jump) return;
    auto multipliers = sorted_eigenvalues(point.linearization.section);
    multipliers.resize(multiplier_count(point));
    const bool stable = std::ranges::all_of(multipliers, [](const auto& m) { return std::abs(m) < 1; });
    result_.branches.back().points.push_back({point.at.p, map_.in_si(jump->after),
                                              point.at.at.duration * map_.time_unit(), std::move(multipliers),
                                              stable});
  }

  void look_between(const GaitOnCurve& a, const GaitOnCurve& b, double advance) {
    for (const auto& [kind, test] : tests) {
      const SignChange bracket{0, test(a.linearization.section), advance, test(b.linearization.section)};
      if (bracket.value_before * bracket.value_after < 0) add_critical(kind, test, a, bracket);
    }
  }

  void add_critical(CriticalGait::Kind kind, Test test, const GaitOnCurve& a, const SignChange& bracket) {
    const auto rough = critical_point(coarse_, test, a, bracket);
    const auto point = critical_point(fine_, test, a, bracket);
    if (!rough || !point || point->at.p < from_ || point->at.p > to_) return;
    const double p = point->at.p;
    CriticalGait critical;
    critical.kind = kind;
    critical.value = p;
    critical.error =
        2 * std::abs(p - rough->at.p) + 4e-16 * std::abs(p) + 2 * left_by_newton * fine_rtol * (to_ - from_);
    critical.multipliers = sorted_eigenvalues(point->linearization.section);
    const bool on_circle = std::ranges::any_of(critical.multipliers, [](const auto& m) {
      return m.imag() != 0 && std::abs(std::abs(m) - 1) < 1e-6;
    });
    if (kind == CriticalGait::Kind::neimark_sacker && !on_circle) return;  // a saddle with m_1 m_2 = 1
    family_.set(p);
    critical.multipliers.resize(multiplier_count(*point));
    critical.state = map_.in_si(map_.jump(point->at.at.u)->after);
    critical.step_time = point->at.at.duration * map_.time_unit();
    result_.critical.push_back(std::move(critical));
  }

  /// The zero of `test` along the curve.
  static std::optional<GaitOnCurve> critical_point(GaitFamily& family, Test test, const GaitOnCurve& a,
                                                   const SignChange& bracket) {
    bool failed = false;
    const auto value = [&](double advance) {
      const auto point = family.ahead(a, advance);
      failed = failed || !point;
      return point ? test(point->linearization.section) : std::nan("");
    };
    const SignChange place = find_sign_change(value, bracket);
    if (failed) return std::nullopt;
    return family.ahead(a, place.after);
  }

  const Dynamics& dynamics_;
  double from_, to_;
  SectionMap map_;
  GaitFamily family_, coarse_,
      fine_;  ///< with the errors of steps that the search, a check and the answer take
  std::vector<std::pair<Place, Place>> pieces_;  ///< of all curves that were followed
  GaitBifurcations result_;
};

}  // namespace

GaitBifurcations critical_gaits(const Dynamics& dynamics, std::span<const double> parameters,
                                std::size_t index, double from, double to) {
  return GaitCurves(dynamics, parameters, index, from, to).run();
}

}  // namespace qdot
