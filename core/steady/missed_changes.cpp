#include "core/steady/missed_changes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/critical_sentences.hpp"
#include "core/steady/mirrors.hpp"

namespace qdot {
namespace {

/// A state of a curve, and the parameter there.
struct CurvePoint {
  SteadyState state;
  double p{};
};

/// What changes at a critical value: where a curve is unstable on both sides, the determinant still tells.
struct Mark {
  Stability stability{};
  int sign{};  ///< of det dg/dx; 0 where it is not known
};

bool changes(const Mark& a, const Mark& b) {
  const bool of_stability =
      a.stability != b.stability && a.stability != Stability::neutral && b.stability != Stability::neutral;
  return of_stability || a.sign * b.sign < 0;
}

/// By elimination with pivots.
int sign_of_determinant(std::vector<Interval> m, std::size_t n) {
  int sign = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (m[i * n + k].least_magnitude() > m[pivot * n + k].least_magnitude()) pivot = i;
    }
    const Interval p = m[pivot * n + k];
    if (!p.is_finite() || p.contains(0.0)) return 0;
    if (pivot != k) {
      sign = -sign;
      for (std::size_t j = 0; j < n; ++j) std::swap(m[k * n + j], m[pivot * n + j]);
    }
    if (p.upper < 0) sign = -sign;
    for (std::size_t i = k + 1; i < n; ++i) {
      const Interval factor = m[i * n + k] / p;
      for (std::size_t j = k; j < n; ++j) m[i * n + j] = m[i * n + j] - factor * m[k * n + j];
    }
  }
  return sign;
}

class ChangeOfStability {
 public:
  ChangeOfStability(CriticalProblem& problem, const CriticalChart& chart, std::size_t index,
                    const Interval& range)
      : all_(problem), chart_(chart), index_(index), range_(range) {}

  /// Of place i of the branch.
  [[nodiscard]] Mark mark(const EquilibriumBranch& branch, std::size_t i) const {
    Box x;
    for (const std::size_t k : all_.kept()) x.emplace_back(branch.x[i][k]);
    return {branch.stability[i], sign_at(x, branch.parameter[i])};
  }

  /// Between neighbours i and i + 1 of the branch.
  std::optional<KnownZero> between(const EquilibriumBranch& branch, std::size_t i) {
    if (const auto p = where_it_stays(branch, i)) return beside(branch, i, *p);
    std::optional<CurvePoint> low = nearest(branch.x[i], branch.parameter[i]);
    std::optional<CurvePoint> high = nearest(branch.x[i + 1], branch.parameter[i + 1]);
    if (!low || !high) return std::nullopt;
    constexpr int most_halvings = 50;
    std::vector<double> x = branch.x[i];
    const Mark first = mark(branch, i);
    for (int k = 0; k < most_halvings; ++k) {
      auto middle = nearest(x, low->p + (high->p - low->p) / 2);
      if (!middle || !middle->state.simple) break;
      const Mark here{middle->state.stability.stability, sign_at(middle->state.enclosure, middle->p)};
      if (here.stability == Stability::neutral || (first.sign != 0 && here.sign == 0)) break;
      x.assign(middle->state.y.begin(), middle->state.y.begin() + static_cast<std::ptrdiff_t>(x.size()));
      (changes(first, here) ? high : low) = std::move(middle);
    }
    if (!continues(*low, *high)) return std::nullopt;
    const CriticalZero zero{BifurcationSystem::Kind::meeting, hull_of(*low, *high), {low->p, high->p}, false};
    return KnownZero{zero, kind_seen(zero), change_of_stability, {}};
  }

 private:
  /// Where the determinant changes its sign, of an equilibrium that stays in its place: no other has to be
  /// found for that.
  [[nodiscard]] std::optional<Interval> where_it_stays(const EquilibriumBranch& branch, std::size_t i) const {
    constexpr double as_rounded = 1e-15;
    constexpr int most_halvings = 80;
    Box x;
    for (const std::size_t k : all_.kept()) {
      x.push_back(hull(branch.x[i][k], branch.x[i + 1][k]));
      if (x.back().width() > as_rounded * std::max(1.0, x.back().magnitude())) return std::nullopt;
    }
    double low = branch.parameter[i], high = branch.parameter[i + 1];
    const int first = sign_at(x, low);
    if (first * sign_at(x, high) >= 0) return std::nullopt;
    for (int k = 0; k < most_halvings; ++k) {
      const double middle = low + (high - low) / 2;
      const int sign = sign_at(x, middle);
      if (sign == 0 || middle == low || middle == high) break;
      (sign == first ? low : high) = middle;
    }
    return Interval(low, high);
  }

  /// The zero between low and high, with the curve's points a little beside it, where they stand alone.
  std::optional<KnownZero> beside(const EquilibriumBranch& branch, std::size_t i, const Interval& p) {
    constexpr double share = 1e-7;
    const double aside = share * (branch.parameter[i + 1] - branch.parameter[i]);
    const auto low = nearest(branch.x[i], p.lower - aside), high = nearest(branch.x[i + 1], p.upper + aside);
    if (!low || !high || !continues(*low, *high)) return std::nullopt;
    const CriticalZero zero{BifurcationSystem::Kind::meeting, hull_of(*low, *high), p, false};
    return KnownZero{zero, kind_seen(zero), change_of_stability, {}};
  }

  /// Without momenta, which may follow the parameter.
  [[nodiscard]] int sign_at(const Box& x, double p) const {
    const SteadyForces& forces = *chart_.problem.forces;
    const std::size_t n = forces.unknowns.size();
    std::vector<Interval> constants = chart_.problem.constants;
    if (!chart_.problem.statics->reduction.ignored.empty() || !forces.charts.empty() || n != x.size() ||
        n != forces.equations.size())
      return 0;
    constants[index_] = Interval(p);
    std::vector<Interval> k(forces.stiffness.outputs());
    TapeEvaluator<Interval>(forces.stiffness, constants)(x, k);
    return k.size() == n * n ? sign_of_determinant(std::move(k), n) : 0;
  }

  [[nodiscard]] Box hull_of(const CurvePoint& a, const CurvePoint& b) const {
    Box x;
    for (const std::size_t j : chart_.systems->unknowns)
      x.push_back(hull(a.state.enclosure[j], b.state.enclosure[j]));
    return x;
  }

  /// Whether the two are one curve, and not two that run beside each other: near each of them there are two
  /// others or none, or what rounding does not tell apart.
  bool continues(const CurvePoint& a, const CurvePoint& b) {
    constexpr double reach = 1e-5;
    const Box place = hull_of(a, b);
    const bool is_narrow =
        std::ranges::all_of(place, [](const Interval& x) { return x.width() < reach / 10; });
    return is_narrow && simple_near(place, a.p, reach) % 2 == 1 && simple_near(place, b.p, reach) % 2 == 1;
  }

  BifurcationKind kind_seen(const CriticalZero& here) {
    const double aside = 1e-4 * range_.width() + 10 * here.p.width();
    constexpr double reach = 0.2;
    const std::size_t before = simple_near(here.x, here.p.lower - aside, reach);
    const std::size_t after = simple_near(here.x, here.p.upper + aside, reach);
    const bool three_and_one = std::min(before, after) == 1 && std::max(before, after) == 3;
    return three_and_one && is_on_mirror(chart_.problem, *chart_.systems, here) ? BifurcationKind::pitchfork
                                                                                : BifurcationKind::unresolved;
  }

  std::optional<CurvePoint> nearest(const std::vector<double>& x, double p) {
    std::optional<CurvePoint> best;
    double least = 0.2;
    for (SteadyState& state : all_.at(p).states) {
      double distance = 0;
      for (const std::size_t i : all_.kept()) distance = std::max(distance, std::abs(state.y[i] - x[i]));
      if (distance < least) {
        least = distance;
        best = CurvePoint{std::move(state), p};
      }
    }
    return best;
  }

  std::size_t simple_near(const Box& place, double p, double reach) {
    const auto is_near = [&](const SteadyState& state) {
      for (std::size_t k = 0; k < place.size(); ++k) {
        const std::size_t j = chart_.systems->unknowns[k];
        const double d = state.y[all_.kept()[j]] - place[k].middle();
        const double nearest_turn =
            chart_.problem.forces->turns[j] ? std::remainder(d, 2 * std::numbers::pi) : d;
        if (!(std::abs(nearest_turn) < reach)) return false;
      }
      return state.simple;
    };
    const std::vector<SteadyState> states = all_.at(p).states;
    return static_cast<std::size_t>(std::ranges::count_if(states, is_near));
  }

  CriticalProblem& all_;
  const CriticalChart& chart_;
  std::size_t index_;
  Interval range_;
};

}  // namespace

std::vector<KnownZero> missed_changes(CriticalProblem& problem, const CriticalChart& chart, std::size_t index,
                                      std::span<const EquilibriumBranch> branches,
                                      std::span<const CriticalValue> known, const Interval& range) {
  std::vector<KnownZero> result;
  ChangeOfStability search(problem, chart, index, range);
  for (const EquilibriumBranch& branch : branches) {
    for (std::size_t i = 0; i + 1 < branch.parameter.size(); ++i) {
      const Interval gap(branch.parameter[i], branch.parameter[i + 1]);
      const auto is_there = [&](double value, double error) {
        return value + error >= gap.lower && value - error <= gap.upper;
      };
      if (!changes(search.mark(branch, i), search.mark(branch, i + 1)) ||
          std::ranges::any_of(known, [&](const CriticalValue& c) { return is_there(c.value, c.error); }) ||
          std::ranges::any_of(
              result, [&](const KnownZero& z) { return is_there(z.zero.p.middle(), z.zero.p.width() / 2); }))
        continue;
      if (auto found = search.between(branch, i)) result.push_back(std::move(*found));
    }
  }
  return result;
}

}  // namespace qdot
