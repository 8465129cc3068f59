#include "core/integrate/step_polynomial.hpp"

#include <algorithm>
#include <array>

#include "core/numerics/constants.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

constexpr std::size_t nodes = 9;

/// Chebyshev points of [0, 1], both ends among them.
const std::array<double, nodes>& places() {
  static const std::array<double, nodes> places = [] {
    std::array<double, nodes> x{};
    for (std::size_t i = 0; i < nodes; ++i) {
      x[i] = 0.5 - 0.5 * evaluate(Function::cos, pi * static_cast<double>(i) / (nodes - 1));
    }
    return x;
  }();
  return places;
}

/// Coefficients of the polynomial through (x_i, y_i): divided differences, then Horner's rule.
void through(const std::array<double, nodes>& x, std::array<double, nodes>& y) {
  for (std::size_t k = 1; k < nodes; ++k) {
    for (std::size_t i = nodes - 1; i >= k; --i) y[i] = (y[i] - y[i - 1]) / (x[i] - x[i - k]);
  }
  for (std::size_t k = nodes - 1; k-- > 0;) {
    for (std::size_t i = k; i + 1 < nodes; ++i) y[i] -= x[k] * y[i + 1];
  }
}

}  // namespace

void shift_rows(std::span<double> rows, unsigned order, double by) {
  for (double* c = rows.data(); c != rows.data() + rows.size(); c += order + 1) {
    for (unsigned k = 0; k < order; ++k) {
      for (unsigned i = order; i-- > k;) c[i] += by * c[i + 1];
    }
  }
}

std::optional<Ending> StepPolynomial::take(Stepper& stepper, Look look) {
  const std::optional<MotionPiece> own = stepper.polynomials();
  is_exact_ = own || look == Look::exact;
  if (!own) return interpolate(stepper, look);
  whole_ = *own;
  return std::nullopt;
}

std::optional<Ending> StepPolynomial::interpolate(Stepper& stepper, Look look) {
  const std::size_t n = stepper.y().size();
  const double begin = stepper.t_previous(), h = stepper.t() - begin;
  rows_.assign(n * nodes, 0);
  std::vector<double> y(n), values(n * nodes);
  for (std::size_t k = 0; k < nodes; ++k) {
    const double t = k + 1 == nodes ? stepper.t() : begin + h * places()[k];
    const auto failed = look == Look::rough ? stepper.sketch(t, y) : stepper.interpolate(t, y);
    if (failed) return failed;
    for (std::size_t i = 0; i < n; ++i) values[i * nodes + k] = y[i];
  }
  std::array<double, nodes> c{};
  for (std::size_t i = 0; i < n; ++i) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * nodes), nodes, c.begin());
    through(places(), c);
    rows_[i * nodes] = c[0];
    double power = h;
    for (std::size_t k = 1; k < nodes && h > 0; ++k, power *= h) rows_[i * nodes + k] = c[k] / power;
  }
  whole_ = {begin, h, rows_, nodes - 1, {}};
  return std::nullopt;
}

MotionPiece StepPolynomial::piece(double from, double length) {
  if (from == 0) return {whole_.t, length, whole_.rows, whole_.order, {}};
  shifted_.assign(whole_.rows.begin(), whole_.rows.end());
  shift_rows(shifted_, whole_.order, from);
  return {whole_.t + from, length, shifted_, whole_.order, {}};
}

}  // namespace qdot
