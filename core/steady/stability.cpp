#include "core/steady/stability.hpp"

#include <algorithm>
#include <cmath>

#include "core/expr/simplify.hpp"
#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

using Eigen::MatrixXd;

/// Real parts smaller than this, relative to the largest eigenvalue, may be rounding: a double eigenvalue
/// moves by the square root of it.
constexpr double undecided_part = 3e-8;

bool vanishes(const std::vector<Interval>& matrix) {
  return std::all_of(matrix.begin(), matrix.end(), [](const Interval& x) { return is_zero(x); });
}

MatrixXd middles(const std::vector<Interval>& matrix, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  MatrixXd m(size, size);
  for (std::size_t i = 0; i < n * n; ++i) {
    m(static_cast<Eigen::Index>(i / n), static_cast<Eigen::Index>(i % n)) = matrix[i].middle();
  }
  return m;
}

/// Eigenvalues of the state form of M s^2 + D s + K, coordinates scaled so that M has ones on its diagonal.
std::vector<std::complex<double>> eigenvalues_of(const MatrixXd& m, const MatrixXd& d, const MatrixXd& k) {
  const Eigen::Index n = m.rows();
  Eigen::VectorXd scale(n);
  for (Eigen::Index i = 0; i < n; ++i) scale[i] = m(i, i) > 0 ? 1 / std::sqrt(m(i, i)) : 1;
  const auto scaled = [&](const MatrixXd& a) {
    return MatrixXd(scale.asDiagonal() * a * scale.asDiagonal());
  };
  const MatrixXd mass = scaled(m);
  std::vector<std::complex<double>> result;
  if (d.isZero(0)) {  // s^2 = -w: half the size, and s on the axes exactly
    for (const std::complex<double>& w : eigenvalues(solve_columns(mass, scaled(k)))) {
      const std::complex<double> s =
          w.imag() == 0 && w.real() >= 0 ? std::complex<double>(0, std::sqrt(w.real())) : std::sqrt(-w);
      result.push_back(s);
      result.push_back(-s);
    }
  } else {
    MatrixXd state = MatrixXd::Zero(2 * n, 2 * n);
    state.topRightCorner(n, n).setIdentity();
    state.bottomLeftCorner(n, n) = -solve_columns(mass, scaled(k));
    state.bottomRightCorner(n, n) = -solve_columns(mass, scaled(d));
    if (!state.allFinite()) return {};
    for (const std::complex<double>& s : eigenvalues(state)) result.push_back(s);
  }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
  });
  const bool finite = std::all_of(result.begin(), result.end(), [](const auto& s) {
    return std::isfinite(s.real()) && std::isfinite(s.imag());
  });
  return finite ? result : std::vector<std::complex<double>>{};
}

/// What the real parts say; a conservative system's come in pairs +-s.
Stability by_eigenvalues(const std::vector<std::complex<double>>& s) {
  double largest = 0;
  for (const auto& value : s) largest = std::max(largest, std::abs(value));
  const double limit = undecided_part * largest;
  const auto real_part = [](const auto& a, const auto& b) { return a.real() < b.real(); };
  if (s.empty()) return Stability::neutral;
  const double most = std::max_element(s.begin(), s.end(), real_part)->real();
  if (most > limit) return Stability::unstable;
  return most < -limit ? Stability::stable : Stability::neutral;
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

}  // namespace

Inertia inertia_of(std::vector<Interval> matrix, std::size_t n) {
  Inertia result;
  std::vector<std::size_t> left(n);
  for (std::size_t i = 0; i < n; ++i) left[i] = i;
  const auto entry = [&](std::size_t i, std::size_t j) -> Interval& { return matrix[i * n + j]; };
  while (!left.empty()) {
    // The pivot farthest from zero beside its own uncertainty: the units of the coordinates do not matter.
    const auto certainty = [&](std::size_t i) {
      return entry(i, i).least_magnitude() / entry(i, i).magnitude();
    };
    auto best = left.begin();
    for (auto i = left.begin(); i != left.end(); ++i) {
      if (certainty(*i) > certainty(*best) || !(certainty(*best) >= 0)) best = i;
    }
    const std::size_t p = *best;
    if (!(entry(p, p).least_magnitude() > 0)) break;
    left.erase(best);
    ++(entry(p, p).lower > 0 ? result.positive : result.negative);
    for (const std::size_t i : left) {
      for (const std::size_t j : left) {
        if (is_zero(entry(i, p)) || is_zero(entry(p, j))) continue;
        entry(i, j) = entry(i, j) -
                      (i == j ? square(entry(i, p)) / entry(p, p) : entry(i, p) * entry(p, j) / entry(p, p));
      }
    }
  }
  // Nothing certain on the diagonal: an entry beside it that is not zero means one of each sign.
  while (left.size() >= 2) {
    bool found = false;
    for (std::size_t a = 0; a < left.size() && !found; ++a) {
      for (std::size_t b = a + 1; b < left.size() && !found; ++b) {
        const Interval off = square(entry(left[a], left[b]));
        const Interval diagonal = entry(left[a], left[a]) * entry(left[b], left[b]);
        if (!(off.lower > diagonal.upper)) continue;
        ++result.positive;
        ++result.negative;
        result.undecided += left.size() - 2;
        left.clear();
        found = true;
      }
    }
    if (!found) break;
  }
  result.undecided += left.size();
  return result;
}

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

SteadyStability StabilityAnalysis::at(std::span<const Interval> x) {
  const Matrix m = values(inertia_, x);
  const Matrix d = values(damping_, x);
  const Matrix k = values(stiffness_, x);
  const bool gyroscopic = !vanishes(d);
  const bool potential = has_potential(m, d);
  SteadyStability result;
  if (n_ == 1 && !gyroscopic) {
    result.rate2 = k[0] / m[0];
    const double s = std::sqrt(std::abs(result.rate2->middle()));
    if (std::isfinite(s)) {
      const std::complex<double> last =
          result.rate2->middle() < 0 ? std::complex(s, 0.0) : std::complex(0.0, s);
      result.eigenvalues = {-last, last};
    }
  } else {
    result.eigenvalues = eigenvalues_of(middles(m, n_), middles(d, n_), middles(k, n_));
  }
  if (potential) {
    if (const auto decided = by_potential(inertia_of(k, n_), gyroscopic)) {
      result.stability = *decided;
      if (*decided == Stability::stable) {  // the energy stays: nothing grows or decays
        for (auto& s : result.eigenvalues) s.real(0);
      }
      return result;
    }
  }
  if (!potential || gyroscopic) result.stability = by_eigenvalues(result.eigenvalues);
  if (result.stability == Stability::neutral) {
    result.undecided = n_ == 1 && potential ? next_terms(x) : several;
  }
  return result;
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
