#include "core/closed/trial.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

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

using SystemRows = std::vector<std::vector<DoubleDouble>>;

double size_of(const DoubleDouble& x) { return std::abs(x.value()); }

/// Brings the largest entry from `k` on to the place k, k and clears the column below it.
void eliminate(SystemRows& a, std::size_t k) {
  std::size_t row = k, column = k;
  for (std::size_t i = k; i < a.size(); ++i) {
    for (std::size_t j = k; j < a.size(); ++j) {
      if (size_of(a[i][j]) > size_of(a[row][column])) std::tie(row, column) = std::pair(i, j);
    }
  }
  std::swap(a[k], a[row]);
  for (auto& entries : a) std::swap(entries[k], entries[column]);
  for (std::size_t i = k + 1; i < a.size() && size_of(a[k][k]) > 0; ++i) {
    const DoubleDouble factor = a[i][k] / a[k][k];
    for (std::size_t j = k; j < a.size(); ++j) a[i][j] = a[i][j] - factor * a[k][j];
  }
}

Verdict judged(const Matrix& matrix, const std::vector<RealAssignment>& values) {
  SystemRows a;
  for (const auto& row : matrix) {
    a.emplace_back();
    for (const Expression& e : row) {
      const Real value = evaluate_exactly(e, values);
      if (!value.is_finite()) return Verdict::unknown;
      a.back().push_back(value.double_double());
    }
  }
  for (std::size_t k = 0; k < a.size(); ++k) eliminate(a, k);
  return size_of(a.back().back()) <= sharp * size_of(a[0][0]) ? Verdict::holds : Verdict::fails;
}

}  // namespace

void Trial::set(const std::vector<Expression>& symbols, const std::vector<Expression>& values) {
  for (std::size_t i = 0; i < symbols.size(); ++i) others_.emplace_back(symbols[i], values[i]);
}

void Trial::set_given(const std::vector<Expression>& symbols) {
  given_.insert(given_.end(), symbols.begin(), symbols.end());
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
  for (const Expression& e : given_) assigned.emplace_back(e, values_.value(e));
  for (const auto& [symbol, value] : relations_.replacements)
    assigned.emplace_back(symbol, evaluate_exactly(value, assigned));
  return with_others(std::move(assigned));
}

std::vector<RealAssignment> Trial::with_others(std::vector<RealAssignment> assigned) const {
  for (const auto& [symbol, value] : others_) {
    if (value != symbol) assigned.emplace_back(symbol, evaluate_exactly(value, assigned));
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
    for (const Matrix& matrix : singular_) {
      const Verdict verdict = judged(matrix, values);
      if (verdict == Verdict::fails) return false;
      known = known && verdict == Verdict::holds;
    }
    held += known ? 1 : 0;
  }
  return held > 0;
}

bool Trial::holds_at(const std::vector<RealAssignment>& parameters) const {
  const std::vector<RealAssignment> there = with_others(parameters);
  const auto is_finite = [](const RealAssignment& a) { return a.second.is_finite(); };
  if (only_where_real_ && !std::ranges::all_of(there, is_finite)) return true;
  const auto holds = [&](const auto& claim) { return judged(claim, there) == Verdict::holds; };
  const auto is_positive = [&](const Expression& e) { return evaluate_exactly(e, there).value > 0; };
  return std::ranges::all_of(positive_, is_positive) && std::ranges::all_of(claims_, holds) &&
         std::ranges::all_of(singular_, holds);
}

}  // namespace qdot
