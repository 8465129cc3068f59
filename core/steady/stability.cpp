#include "core/steady/stability.hpp"

#include <algorithm>
#include <cmath>

#include "core/expr/simplify.hpp"
#include "core/numerics/same_bits.hpp"
#include "core/steady/spectrum.hpp"

namespace qdot {
namespace {

bool vanishes(const std::vector<Interval>& matrix) {
  return std::all_of(matrix.begin(), matrix.end(), [](const Interval& x) { return is_zero(x); });
}

SquareMatrix<Ball> balls(const std::vector<Interval>& matrix, std::size_t n) {
  SquareMatrix<Ball> result(n);
  for (std::size_t i = 0; i < n * n; ++i) result(i / n, i % n) = Ball::of(matrix[i]);
  return result;
}

bool is_finite(const std::vector<Interval>& matrix) {
  return std::ranges::all_of(matrix, &Interval::is_finite);
}

using Eigenvalue = SteadyStability::Eigenvalue;

void sort(std::vector<Eigenvalue>& eigenvalues) {
  std::ranges::sort(eigenvalues, [](const Eigenvalue& a, const Eigenvalue& b) {
    return a.s.real() != b.s.real() ? a.s.real() < b.s.real() : a.s.imag() < b.s.imag();
  });
}

std::vector<Eigenvalue> eigenvalues_of(const std::vector<Exponent>& exponents) {
  std::vector<Eigenvalue> result;
  for (const Exponent& e : exponents) {
    const std::complex<double> s(e.undamped ? 0 : e.middle.re.value(), e.middle.im.value());
    const double rounding = hypotenuse(e.middle.re.error(), e.middle.im.error());
    if (!std::isfinite(s.real()) || !std::isfinite(s.imag())) return {};
    result.push_back({s, (e.radius + rounding) * (1 + 0x1p-50)});
  }
  sort(result);
  return result;
}

/// +-sqrt(-rate2).
std::vector<Eigenvalue> eigenvalues_of(const Interval& rate2) {
  const double middle = rate2.middle();
  const double s = std::sqrt(std::abs(middle));
  if (!std::isfinite(s)) return {};
  const Interval root = sqrt(Interval(rate2.contains(0.0) ? 0 : rate2.least_magnitude(), rate2.magnitude()));
  const double error = rate2.contains(0.0) ? s + root.upper : std::max(root.upper - s, s - root.lower);
  const std::complex<double> last = middle < 0 ? std::complex(s, 0.0) : std::complex(0.0, s);
  const double bound = error == 0 ? 0 : error * (1 + 0x1p-50);
  return {{-last, bound}, {last, bound}};
}

Stability by_eigenvalues(const std::vector<Exponent>& exponents) {
  switch (damping_of(exponents)) {
    case Damping::all_decay:
      return Stability::stable;
    case Damping::one_grows:
      return Stability::unstable;
    case Damping::undecided:
      break;
  }
  return Stability::neutral;
}

/// A + A^T.
std::vector<Interval> symmetric_part(const std::vector<Interval>& a, std::size_t n) {
  std::vector<Interval> result;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) result.push_back(a[i * n + j] + a[j * n + i]);
  }
  return result;
}

std::optional<Stability> by_potential(const Inertia& inertia, bool gyroscopic) {
  if (inertia.negative == 0 && inertia.undecided == 0) return Stability::stable;
  const bool odd = inertia.negative % 2 == 1 && inertia.undecided == 0;
  if (odd || (inertia.negative > 0 && !gyroscopic)) return Stability::unstable;
  return std::nullopt;
}

constexpr const char* several =
    "An eigenvalue of the linearized equations is zero or imaginary to within rounding, and with several "
    "degrees of freedom the terms beyond are not looked at.";

constexpr const char* no_potential =
    "The eigenvalues of the linearized equations are imaginary, and without a potential the terms beyond "
    "decide, which are not looked at.";

constexpr const char* no_inertia =
    "The mass matrix has no inverse here, as where a coordinate fails: no acceleration follows from the "
    "equations, and whether anything can rest here they do not tell.";

}  // namespace

StabilityAnalysis::StabilityAnalysis(const Dynamics& dynamics, const SteadyProblem& problem)
    : dynamics_(dynamics),
      problem_(problem),
      n_(problem_.statics->reduction.degrees_of_freedom()),
      inertia_(problem_.statics->inertia, problem_.constants),
      damping_(problem_.statics->damping, problem_.constants),
      stiffness_(problem_.forces->stiffness, problem_.constants) {}

StabilityAnalysis::Matrix StabilityAnalysis::values(TapeEvaluator<Interval>& function,
                                                    std::span<const Interval> x) const {
  Matrix result(n_ * n_);
  function(x, result);
  return result;
}

/// g = dU/dx, D skew and M positive definite; an equation divided by its vanishing mass belongs to no U.
bool StabilityAnalysis::has_potential(const Matrix& inertia, const Matrix& damping) const {
  if (!problem_.forces->has_potential) return false;
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (is_empty(intersection(damping[i * n_ + j], -damping[j * n_ + i]))) return false;
    }
  }
  return inertia_of(inertia, n_).positive == n_;
}

StabilityAnalysis::Energy StabilityAnalysis::energy(std::span<const Interval> x) {
  const Matrix m = values(inertia_, x);
  const Matrix d = values(damping_, x);
  const bool damped = n_ == 1 && d[0].lower > 0;  // one force of one coordinate always has a potential
  return {has_potential(m, d) || (damped && inertia_of(m, n_).positive == n_), !vanishes(d) && !damped};
}

SteadyStability StabilityAnalysis::at(std::span<const Interval> x) {
  const Matrix m = values(inertia_, x);
  const Matrix d = values(damping_, x);
  const Matrix k = values(stiffness_, x);
  const bool gyroscopic = !vanishes(d);
  const bool potential = has_potential(m, d);
  SteadyStability result;
  std::vector<Exponent> exponents;
  if (n_ == 1 && !gyroscopic) {
    result.rate2 = k[0] / m[0];
    result.eigenvalues = eigenvalues_of(*result.rate2);
  } else if (is_finite(m) && is_finite(d) && is_finite(k)) {
    exponents = spectrum({balls(m, n_), balls(k, n_), balls(d, n_)});
    result.eigenvalues = eigenvalues_of(exponents);
  }
  if (potential) {
    if (const auto decided = by_potential(inertia_of(k, n_), gyroscopic)) {
      result.stability = *decided;
      if (*decided == Stability::stable) {  // the energy stays: nothing grows or decays
        for (Eigenvalue& e : result.eigenvalues) e.s.real(0);
      }
      return result;
    }
  }
  if (loses_energy(m, d, k)) {
    result.stability = Stability::stable;
    return result;
  }
  if (n_ == 1 && !gyroscopic) {
    if (!potential && result.rate2->upper < 0) result.stability = Stability::unstable;
  } else if ((gyroscopic || !potential) && !exponents.empty()) {
    result.stability = by_eigenvalues(exponents);
  }
  if (result.stability == Stability::neutral) result.undecided = why_undecided(m, k, potential, x);
  return result;
}

std::string StabilityAnalysis::why_undecided(const Matrix& inertia, const Matrix& stiffness, bool potential,
                                             std::span<const Interval> x) const {
  if (n_ > 1) return several;
  if (inertia[0].contains(0.0)) return no_inertia;
  if (potential) return next_terms(x);
  return stiffness[0].contains(0.0) ? several : no_potential;
}

/// M and K positive definite, g = dU/dx: the energy 1/2 x'.M x' + U has a minimum at rest, and falls.
bool StabilityAnalysis::loses_energy(const Matrix& inertia, const Matrix& damping,
                                     const Matrix& stiffness) const {
  return problem_.forces->symmetric && inertia_of(inertia, n_).positive == n_ &&
         inertia_of(stiffness, n_).positive == n_ &&
         inertia_of(symmetric_part(damping, n_), n_).positive == n_;
}

/// The signs of U''' and U'''' where U'' = 0 to within rounding.
std::string StabilityAnalysis::next_terms(std::span<const Interval> x) const {
  const auto function = dynamics_.derived<CompiledFunction>(
      "third and fourth derivative", problem_.parameters, [](const Statics& statics) {
        const Reduction& reduction = statics.reduction;
        Graph graph(*reduction.graph);
        const Expression symbol = graph.adopt(reduction.x[0]);
        const Expression second = differentiate(graph.adopt(statics.rest[0]), symbol);
        const Expression third = simplify(differentiate(second, symbol));
        const Expression fourth = simplify(differentiate(third, symbol));
        return compiled_at_rest(reduction, graph, std::vector<Expression>{third, fourth});
      });
  const std::string start = "The second derivative of the effective potential is zero to within rounding; ";
  std::vector<Interval> values(2);
  TapeEvaluator<Interval>(*function, problem_.constants)(x, values);
  if (!values[0].contains(0.0)) {
    return start + "its third derivative is not: unstable, to one side the force leads away.";
  }
  if (is_zero(values[0]) && is_zero(values[1])) return start + "so are its third and fourth: undecided.";
  if (values[1].contains(0.0)) return start + "its third and fourth may be: undecided.";
  return start + (values[1].lower > 0 ? "so is its third, and its fourth is positive: nonlinearly stable."
                                      : "so is its third, and its fourth is negative: nonlinearly unstable.");
}

}  // namespace qdot
