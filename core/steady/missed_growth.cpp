#include "core/steady/missed_growth.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/steady/characteristic_polynomial.hpp"
#include "core/steady/critical_sentences.hpp"
#include "core/steady/stability.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_coordinates_of_growth = 4;

using IntervalPowers = PowerCoefficients<Interval>;
using Rows = std::vector<std::vector<Interval>>;

/// Sylvester's matrix of b and its derivative: its determinant is the discriminant times the leading
/// coefficient and a sign.
Rows discriminant_matrix(const IntervalPowers& b) {
  const std::size_t n = b.size() - 1;
  Rows rows(2 * n - 1, std::vector<Interval>(2 * n - 1, Interval(0)));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t k = 0; k <= n; ++k) rows[i][i + k] = b[n - k];
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k)
      rows[n - 1 + i][i + k] = Interval(static_cast<double>(n - k)) * b[n - k];
  }
  return rows;
}

Interval determinant_of(const Rows& matrix) {
  PolynomialRows<Interval> rows(matrix.size());
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (const Interval& entry : matrix[i]) rows[i].push_back({entry});
  }
  return expanded_determinant(rows, Interval(0))[0];
}

/// An equilibrium that stays in x while the parameter moves through a range.
class StayingEquilibrium {
 public:
  StayingEquilibrium(const Dynamics& dynamics, const SteadyProblem& problem, std::size_t index, Box x,
                     const Interval& range)
      : dynamics_(dynamics), problem_(problem), index_(index), x_(std::move(x)) {
    stays_ = std::ranges::all_of(values(problem_.forces->forces, range), is_zero);
    is_damped_ = !std::ranges::all_of(values(problem_.statics->damping, range), is_zero);
  }

  [[nodiscard]] bool stays() const { return stays_; }
  /// Somewhere in the range. Where the damping passes zero the condition for it does, too, and tells nothing.
  [[nodiscard]] bool is_damped() const { return is_damped_; }

  [[nodiscard]] bool oscillates(double p) const {
    const SteadyStability found = StabilityAnalysis(dynamics_, at(p)).at(x_);
    return std::ranges::any_of(found.eigenvalues, [](const SteadyStability::Eigenvalue& e) {
      return e.s.real() > e.error && std::abs(e.s.imag()) > e.error;
    });
  }

  /// Of the condition at p: -1, 1, or 0 where rounding hides it.
  [[nodiscard]] int sign(double p) const {
    const std::vector<Interval> m = values(problem_.statics->inertia, p),
                                d = values(problem_.statics->damping, p),
                                k = values(problem_.forces->stiffness, p);
    const std::size_t n = x_.size();
    PolynomialRows<Interval> rows(n);
    for (std::size_t i = 0; i < n * n; ++i) rows[i / n].push_back({k[i], d[i], m[i]});
    const IntervalPowers c = expanded_determinant(rows, Interval(0));
    IntervalPowers even;
    for (std::size_t i = 0; i < c.size(); i += 2) even.push_back(c[i]);
    const Interval value =
        determinant_of(is_damped_ ? hurwitz_matrix(c, Interval(0)) : discriminant_matrix(even));
    return value.lower > 0 ? 1 : value.upper < 0 ? -1 : 0;
  }

  [[nodiscard]] const Box& x() const { return x_; }

 private:
  [[nodiscard]] SteadyProblem at(const Interval& p) const {
    SteadyProblem here = problem_;
    here.constants[index_] = p;
    return here;
  }

  [[nodiscard]] std::vector<Interval> values(const CompiledFunction& function, const Interval& p) const {
    std::vector<Interval> result(function.outputs());
    TapeEvaluator<Interval>(function, at(p).constants)(x_, result);
    return result;
  }

  const Dynamics& dynamics_;
  const SteadyProblem& problem_;
  std::size_t index_;
  Box x_;
  bool stays_{}, is_damped_{};
};

/// The part of `gap` that holds a change of sign; both ends have proven signs.
std::optional<Interval> change_of_sign(const StayingEquilibrium& equilibrium, const Interval& gap) {
  constexpr int most_halvings = 50;
  const int below = equilibrium.sign(gap.lower), above = equilibrium.sign(gap.upper);
  if (below * above >= 0) return std::nullopt;
  const auto last_with = [&](int sign, double from, double to) {
    for (int i = 0; i < most_halvings && from != to; ++i) {
      const double middle = from + (to - from) / 2;
      (equilibrium.sign(middle) == sign ? from : to) = middle;
    }
    return from;
  };
  const double low = last_with(below, gap.lower, gap.upper);
  return Interval(low, last_with(above, gap.upper, low));
}

bool holds_one(const Interval& gap, std::span<const CriticalValue> known) {
  return std::ranges::any_of(known, [&](const CriticalValue& c) {
    return c.value + c.error >= gap.lower && c.value - c.error <= gap.upper;
  });
}

}  // namespace

std::vector<KnownZero> missed_growth(const Dynamics& dynamics, const CriticalProblem& problem,
                                     std::size_t index, std::span<const EquilibriumBranch> branches,
                                     std::span<const CriticalValue> known) {
  std::vector<KnownZero> result;
  const CriticalChart& chart = problem.charts().front();
  const std::vector<std::size_t>& kept = problem.kept();
  if (!chart.determinants.empty() || kept.size() > most_coordinates_of_growth) return result;
  for (const EquilibriumBranch& branch : branches) {
    for (std::size_t i = 0; i + 1 < branch.parameter.size(); ++i) {
      const Interval gap(branch.parameter[i], branch.parameter[i + 1]);
      const bool before = branch.stability[i] == Stability::unstable,
                 after = branch.stability[i + 1] == Stability::unstable;
      if (before == after || holds_one(gap, known) || branch.x[i] != branch.x[i + 1]) continue;
      Box x;
      for (const std::size_t j : kept) x.emplace_back(branch.x[i][j]);
      const StayingEquilibrium equilibrium(dynamics, chart.problem, index, x, gap);
      if (!equilibrium.stays() || !equilibrium.oscillates(before ? gap.lower : gap.upper)) continue;
      const auto change = change_of_sign(equilibrium, gap);
      if (!change) continue;
      Box place;
      for (const std::size_t j : chart.systems->unknowns) place.push_back(x[j]);
      result.push_back({{BifurcationSystem::Kind::growth, place, *change, false},
                        equilibrium.is_damped() ? BifurcationKind::hopf : BifurcationKind::flutter,
                        growth_along_curve,
                        {}});
    }
  }
  return result;
}

}  // namespace qdot
