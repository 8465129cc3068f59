#include "core/closed/trial.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

constexpr int places = 4;
constexpr double sharp = 1e-20;  ///< of the terms: arithmetic of twice the digits leaves some 1e-30

/// Factors between 0.6 and 1.6, always the same: fractional parts of multiples of the golden ratio.
double factor(int place, std::size_t parameter) {
  const double x = (static_cast<double>(parameter) * 7 + place * 3 + 1) * 0.6180339887498949;
  return 0.6 + (x - std::floor(x));
}

enum class Verdict { holds, fails, unknown };

Verdict judged(const std::vector<Expression>& terms, const std::vector<RealAssignment>& values) {
  double size = 0;
  for (const Expression& term : terms) {
    const Real value = evaluate_exactly(term, values);
    if (!value.is_finite()) return Verdict::unknown;
    size = std::max(size, std::abs(value.value));
  }
  if (terms.empty()) return Verdict::holds;
  const Real sum = evaluate_exactly(terms[0].graph().sum(terms), values);
  if (!sum.is_finite()) return Verdict::unknown;
  const double bound = sharp * std::max(size, 1e-280);
  return std::abs(sum.value) <= bound || std::abs(sum.value) <= sum.error ? Verdict::holds : Verdict::fails;
}

}  // namespace

void Trial::set(const std::vector<Expression>& symbols, const std::vector<Expression>& values) {
  for (std::size_t i = 0; i < symbols.size(); ++i) others_.emplace_back(symbols[i], values[i]);
}

std::vector<RealAssignment> Trial::place(int number) const {
  std::vector<RealAssignment> assigned;
  const auto is_related = [&](const Expression& p) {
    return std::ranges::any_of(relations_.replacements, [&](const Replacement& r) { return r.first == p; });
  };
  for (std::size_t i = 0; i < values_.symbols().size(); ++i) {
    if (!is_related(values_.symbols()[i]))
      assigned.emplace_back(values_.symbols()[i], Real(values_.parameters()[i] * factor(number, i)));
  }
  for (const auto* group : {&relations_.replacements, &others_}) {
    for (const auto& [symbol, value] : *group) {
      if (value != symbol) assigned.emplace_back(symbol, evaluate_exactly(value, assigned));
    }
  }
  return assigned;
}

bool Trial::passes() const {
  int held = 0;
  for (int number = 0; number < places; ++number) {
    const std::vector<RealAssignment> values = place(number);
    bool known = true;
    for (const auto& terms : claims_) {
      const Verdict verdict = judged(terms, values);
      if (verdict == Verdict::fails) return false;
      known = known && verdict == Verdict::holds;
    }
    held += known ? 1 : 0;
  }
  return held > 0;
}

}  // namespace qdot
