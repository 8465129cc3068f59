#include "core/steady/linear_stability.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/same_bits.hpp"
#include "core/steady/inertia.hpp"
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

/// Without the rows and columns at these places.
std::vector<Interval> without(const std::vector<Interval>& a, std::size_t n,
                              const std::vector<std::size_t>& left_out) {
  const auto stays = [&](std::size_t i) { return std::ranges::find(left_out, i) == left_out.end(); };
  std::vector<Interval> result;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (stays(i) && stays(j)) result.push_back(a[i * n + j]);
    }
  }
  return result;
}

/// K of the coordinates that are not free, or of all where none would be left.
std::vector<Interval> held_stiffness(const LinearizedForces& at) {
  return at.free.size() == at.n ? at.stiffness : without(at.stiffness, at.n, at.free);
}

std::optional<Stability> by_potential(const LinearizedForces& at, bool gyroscopic) {
  const std::vector<Interval> stiffness = held_stiffness(at);
  const bool has_free = stiffness.size() != at.stiffness.size();
  const Inertia inertia = inertia_of(stiffness, has_free ? at.n - at.free.size() : at.n);
  if (inertia.negative == 0 && inertia.undecided == 0) return Stability::stable;
  const bool odd = inertia.negative % 2 == 1 && inertia.undecided == 0 && !has_free;
  if (odd || (inertia.negative > 0 && !gyroscopic)) return Stability::unstable;
  return std::nullopt;
}

constexpr const char* several =
    "An eigenvalue of the linearized equations is zero or imaginary to within rounding, and with several "
    "degrees of freedom the terms beyond are not looked at.";

constexpr const char* zero_of_one =
    "The linearized equations have the eigenvalue 0 to within rounding, and the terms beyond decide, which are "
    "not looked at where a force depends on the velocity.";

constexpr const char* no_potential =
    "The eigenvalues of the linearized equations are imaginary, and without a potential the terms beyond "
    "decide, which are not looked at.";

constexpr const char* no_inertia =
    "The mass matrix has no inverse here, as where a coordinate fails: no acceleration follows from the "
    "equations, and they do not tell whether anything can rest here.";

constexpr const char* negative_mass =
    "The mass is negative, and the eigenvalues of the linearized equations are zero: the terms beyond are not looked "
    "at.";

/// The same equations with all signs turned, for those of a negative mass.
LinearizedForces turned(LinearizedForces at) {
  for (auto* matrix : {&at.mass, &at.rates, &at.stiffness}) {
    for (Interval& entry : *matrix) entry = -entry;
  }
  return at;
}

/// M and K positive definite, g = dU/dx: the energy 1/2 x'.M x' + U has a minimum at rest.
bool has_least_energy(const LinearizedForces& at) {
  return at.symmetric && inertia_of(at.mass, at.n).positive == at.n &&
         inertia_of(at.stiffness, at.n).positive == at.n;
}

bool loses_energy(const LinearizedForces& at) {
  return has_least_energy(at) && inertia_of(symmetric_part(at.rates, at.n), at.n).positive == at.n;
}

std::string why_undecided(const LinearizedForces& at, bool potential, const NextTerms& next_terms) {
  const Inertia mass = inertia_of(at.mass, at.n);
  if (at.has_potential && mass.positive > 0 && mass.negative > 0) return two_signs;
  if (at.n > 1) return several;
  if (at.mass[0].contains(0.0)) return no_inertia;
  if (potential) return next_terms();
  return at.stiffness[0].contains(0.0) ? zero_of_one : no_potential;
}

/// What the eigenvalues say where neither the potential nor its loss decides.
Stability by_linear_terms(const LinearizedForces& at, bool potential, const SteadyStability& found,
                          const std::vector<Exponent>& exponents) {
  const bool gyroscopic = !vanishes(at.rates);
  if (at.n == 1 && !gyroscopic)
    return !potential && found.rate2->upper < 0 ? Stability::unstable : Stability::neutral;
  return (gyroscopic || !potential) && !exponents.empty() ? by_eigenvalues(exponents) : Stability::neutral;
}

}  // namespace

bool has_potential(const LinearizedForces& at) {
  if (!at.has_potential) return false;
  for (std::size_t i = 0; i < at.n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (is_empty(intersection(at.rates[i * at.n + j], -at.rates[j * at.n + i]))) return false;
    }
  }
  return inertia_of(at.mass, at.n).positive == at.n;
}

bool never_gains_energy(const LinearizedForces& at) {
  if (!has_least_energy(at)) return false;
  const std::vector<Interval> damping = symmetric_part(at.rates, at.n);
  std::vector<std::size_t> undamped;
  for (std::size_t i = 0; i < at.n; ++i) {
    const std::span<const Interval> row = std::span(damping).subspan(i * at.n, at.n);
    if (std::ranges::all_of(row, is_zero)) undamped.push_back(i);
  }
  const std::size_t damped = at.n - undamped.size();
  return inertia_of(without(damping, at.n, undamped), damped).positive == damped;
}

SteadyStability linear_stability(const LinearizedForces& at, const NextTerms& next_terms) {
  if (at.n > 0 && inertia_of(at.mass, at.n).negative == at.n)
    return linear_stability(turned(at), [] { return negative_mass; });
  const bool gyroscopic = !vanishes(at.rates);
  const bool potential = has_potential(at);
  SteadyStability result;
  std::vector<Exponent> exponents;
  if (at.n == 1 && !gyroscopic) {
    result.rate2 = at.stiffness[0] / at.mass[0];
    result.eigenvalues = eigenvalues_of(*result.rate2);
  } else if (at.n > 0 && is_finite(at.mass) && is_finite(at.rates) && is_finite(at.stiffness)) {
    exponents = spectrum({balls(at.mass, at.n), balls(at.stiffness, at.n), balls(at.rates, at.n)});
    result.eigenvalues = eigenvalues_of(exponents);
  }
  if (potential) {
    if (const auto decided = by_potential(at, gyroscopic)) {
      result.stability = *decided;
      if (*decided == Stability::stable) {  // the energy stays: nothing grows or decays
        for (Eigenvalue& e : result.eigenvalues) e.s.real(0);
      }
      return result;
    }
  }
  result.stability = loses_energy(at) ? Stability::stable : by_linear_terms(at, potential, result, exponents);
  if (result.stability == Stability::neutral) result.undecided = why_undecided(at, potential, next_terms);
  return result;
}

}  // namespace qdot
