#include "core/closed/period_form.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/closed/elliptic_period.hpp"
#include "core/closed/gamma_period.hpp"
#include "core/closed/taken_squares.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/notation.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr const char* elliptic_integral =
    "ellipk(m) = K(m) is the integral of 1/sqrt(1 - m*sin(u)^2) over u from 0 to pi/2";

constexpr const char* gamma_function =
    "gamma(z) is the integral of u^(z - 1)*exp(-u) over u from 0 to infinity";

/// Of a square, or of the largest square that divides a small whole number.
std::optional<Number> root_to_take(const Number& coefficient) {
  constexpr std::int64_t most = 10'000;
  if (auto whole = exact_root(coefficient)) return whole;
  const auto small = coefficient.small();
  if (!small || small->denominator != 1 || small->numerator > most) return std::nullopt;
  std::int64_t largest = 1;
  for (std::int64_t k = 2; k * k <= small->numerator; ++k)
    if (small->numerator % (k * k) == 0) largest = k;
  return Number(largest);
}

/// sqrt(4 x) as 2 sqrt(x), and sqrt(32 x) as 4 sqrt(2 x).
Expression with_squares_out(const Expression& e) {
  return with_half_powers(e, [](const Expression& base, const Number& exponent) -> std::optional<Expression> {
    const auto [coefficient, rest] = split_coefficient(base);
    const auto factor = coefficient.is_negative() ? std::nullopt : root_to_take(coefficient);
    if (!factor || *factor == Number(1)) return std::nullopt;
    return pow(base.graph().number(*factor), exponent * Number(2)) *
           pow(coefficient / (*factor * *factor) * rest, exponent);
  });
}

/// K(m) to round-off, by the arithmetic-geometric mean.
double complete_elliptic_integral(double one_less_m) {
  double a = 1, b = std::sqrt(one_less_m);
  while (std::abs(a - b) > 1e-8 * a) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return pi / (a + b);
}

std::optional<PeriodFormula> with_elliptic_integral(const EllipticPeriod& period, const ExactValues& values,
                                                    const Finding& found, const WrittenForm& written) {
  const auto& [factor, m] = period;
  const Real one_less_m = values.value(m.graph().number(1) - m);
  if (!(one_less_m.value > 0)) return std::nullopt;
  const double value = values.value(factor).value * complete_elliptic_integral(one_less_m.value);
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * value;
  if (!agrees({value, 0, rounding}, *found.value, found.error)) return std::nullopt;
  auto form = written(factor * m, {});  // for what it assumes
  if (!form) return std::nullopt;
  const Notation notation = notation_of(values.model().scene);
  form->text = print(factor, Form::text, notation) + "*ellipk(" + print(m, Form::text, notation) + ")";
  form->latex =
      print(factor, Form::latex, notation) + " K\\left(" + print(m, Form::latex, notation) + "\\right)";
  form->assumes.emplace_back(elliptic_integral);
  return PeriodFormula{.form = *std::move(form), .factor = factor, .m = m};
}

std::optional<PeriodFormula> with_elliptic_integral(const QuadratureProblem& problem,
                                                    const ExactValues& values, MotionKind motion,
                                                    const Finding& found, const WrittenForm& written) {
  for (const EllipticPeriod& period : elliptic_periods(problem, values, motion)) {
    if (auto form = with_elliptic_integral(period, values, found, written)) return form;
  }
  return std::nullopt;
}

std::optional<PeriodFormula> with_gamma_functions(const QuadratureProblem& problem, const ExactValues& values,
                                                  const Finding& found, const WrittenForm& written) {
  const auto period = gamma_period(problem, values);
  if (!period) return std::nullopt;
  const double value = values.value(period->factor).value * gamma_quotient(period->n);
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * value;
  if (!agrees({value, 0, rounding}, *found.value, found.error)) return std::nullopt;
  auto form = written(period->factor, {});
  if (!form) return std::nullopt;
  const auto fraction = [](int p, int q) {
    const int common = std::gcd(p, q);
    return std::to_string(p / common) + "/" + std::to_string(q / common);
  };
  const std::string one = fraction(1, period->n), other = fraction(period->n + 2, 2 * period->n);
  form->text += "*gamma(" + one + ")/gamma(" + other + ")";
  form->latex += " \\frac{\\Gamma\\left(" + one + "\\right)}{\\Gamma\\left(" + other + "\\right)}";
  form->assumes.emplace_back(gamma_function);
  return PeriodFormula{.form = *std::move(form), .factor = period->factor, .n = period->n};
}

/// Where no elementary form does.
std::optional<PeriodFormula> with_special_functions(const QuadratureProblem& problem,
                                                    const ExactValues& values, MotionKind motion,
                                                    const Finding& found, const WrittenForm& written) {
  auto form = with_elliptic_integral(problem, values, motion, found, written);
  return form || motion == MotionKind::rotation ? form
                                                : with_gamma_functions(problem, values, found, written);
}

}  // namespace

double PeriodFormula::value_at(const std::vector<RealAssignment>& values) const {
  const double size = evaluate_exactly(factor, values).value;
  if (n > 0) return size * gamma_quotient(n);
  if (!m) return size;
  const double one_less_m = 1 - evaluate_exactly(*m, values).value;
  return one_less_m > 0 ? size * complete_elliptic_integral(one_less_m)
                        : std::numeric_limits<double>::quiet_NaN();
}

std::optional<PeriodFormula> period_form(const QuadratureProblem& problem, const ExactValues& values,
                                         MotionKind motion, const Finding& found,
                                         const WrittenForm& written) {
  if (motion == MotionKind::rotation) return with_special_functions(problem, values, motion, found, written);
  std::optional<PeriodFormula> best;
  for (const Expression& period : elementary_periods(problem, values)) {
    if (!agrees(values.value(period), *found.value, found.error)) continue;
    for (const Relations& relations : {values.relations(), Relations{}}) {
      const Expression plain = with_squares_out(substitute(period, relations.replacements));
      const Expression simple = with_squares_out(simplify(plain));
      const Expression& e = written_length(simple) < written_length(plain) ? simple : plain;
      auto form = written(e, relations);
      if (form && (!best || form->text.size() < best->form.text.size()))
        best = {.form = *std::move(form), .factor = short_form(values, e), .relations = relations};
    }
  }
  return best ? best : with_special_functions(problem, values, motion, found, written);
}

}  // namespace qdot
