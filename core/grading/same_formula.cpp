#include "core/grading/same_formula.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/expr/polynomial.hpp"
#include "core/grading/right_motion.hpp"

namespace qdot {
namespace {

bool speaks_of_motion(const ExpectedSystem& system, const Expression& e) {
  return depends_on(e, system.unknowns());
}

/// The sum of the sizes of a formula's terms at a state.
class FormulaSize {
 public:
  FormulaSize(const Expression& formula, std::span<const SymbolDomain> symbols)
      : terms_(terms_of(formula)), symbols_(symbols), values_(terms_) {}

  double operator()(State state, RightMotion* right) {
    for (std::size_t i = 0; i < state.size(); ++i) values_.set(symbols_[i].symbol, state[i]);
    if (right != nullptr && !right->set(state, values_)) return 0;
    values_.evaluate();
    double size = 0;
    for (const Expression& term : terms_) size += std::abs(values_.of(term).value());
    return size;
  }

 private:
  std::vector<Expression> terms_;
  std::span<const SymbolDomain> symbols_;
  BallValues values_;
};

VanishingAnswer compare_on_motion(const ExpectedSystem& system, const Expression& difference,
                                  const Expression& expected, std::uint64_t seed, double tolerance) {
  const bool is_of_motion = system.has_constraints() || speaks_of_motion(system, difference);
  const std::vector<SymbolDomain> symbols = system.domains();
  std::optional<RightMotion> right;
  if (is_of_motion) right.emplace(system);
  std::optional<FormulaSize> size;
  if (tolerance > 0) size.emplace(expected, symbols);
  VanishingQuestion question{.value = difference, .symbols = symbols, .seed = seed, .tolerance = tolerance};
  question.size = [&](const State& state) { return (*size)(state, right ? &*right : nullptr); };
  if (is_of_motion) {
    question.complete = [&](State& state, BallValues& values) { return right->set(state, values); };
    question.in_symbols = [&] { return right->in_letters(difference); };
  }
  return vanishing(question);
}

/// How it is known that e is the same at every state; unknown: it is not, or that cannot be seen.
Decision constancy(const ExpectedSystem& system, const Expression& e, std::uint64_t seed) {
  const std::vector<SymbolDomain> symbols = system.domains();
  const Symbols::Varying& q = system.symbols().coordinates;
  std::vector<Expression> varying = q.value;
  varying.insert(varying.end(), q.rate.begin(), q.rate.end());
  varying.insert(varying.end(), q.second_rate.begin(), q.second_rate.end());
  const Symbols::Varying& inputs = system.symbols().inputs;
  varying.insert(varying.end(), inputs.value.begin(), inputs.value.end());
  varying.push_back(system.symbols().t);
  for (const Expression& p : system.momenta()) varying.push_back(p);
  Decision weakest = Decision::identity;
  for (const Expression& x : varying) {
    const Expression slope = differentiate(e, x);
    const Decision found = vanishing({.value = slope, .symbols = symbols, .seed = seed}).decision;
    if (found != Decision::identity && found != Decision::values) return Decision::unknown;
    if (found == Decision::values) weakest = found;
  }
  return weakest;
}

/// Whether a difference of two energies that is constant comes from the choice of the zero of V: for other
/// energies than V only with a parameter that T does not have.
bool is_free(const ExpectedSystem& system, std::string_view name, const Expression& difference) {
  constexpr std::array<std::string_view, 5> energies{"V", "L", "E", "h", "H"};
  if (std::ranges::find(energies, name) == energies.end()) return false;
  if (name == "V") return true;
  try {
    const auto kinetic = system.quantity("T");
    const auto potential = system.quantity("V");
    return std::ranges::any_of(system.symbols().parameters, [&](const Expression& parameter) {
      return depends_on(difference, parameter) && depends_on(*potential, parameter) &&
             !depends_on(*kinetic, parameter);
    });
  } catch (const Error&) {
    return false;  // a bare Lagrangian has no V
  }
}

}  // namespace

FormulaVerdict compare_formulas(const ExpectedSystem& system, std::string_view name,
                                const Expression& submitted, const Expression& expected, std::uint64_t seed,
                                double tolerance) {
  const Expression difference = submitted - expected;
  const VanishingAnswer answer = compare_on_motion(system, difference, expected, seed, tolerance);
  if (answer.decision == Decision::counterexample && is_free(system, name, difference)) {
    const Decision constant = constancy(system, difference, seed + 5);
    if (constant != Decision::unknown) return {.decision = constant, .differs_by_constant = true};
  }
  return {.decision = answer.decision, .counterexample = answer.counterexample};
}

std::optional<double> value_at(const ExpectedSystem& system, const Expression& formula, const State& state) {
  if (speaks_of_motion(system, formula)) return std::nullopt;  // they are the right ones
  const std::vector<SymbolDomain> symbols = system.domains();
  BallValues values(std::array{formula});
  for (std::size_t i = 0; i < state.size(); ++i) values.set(symbols[i].symbol, state[i]);
  values.evaluate();
  const Ball& found = values.of(formula);
  return found.is_finite() ? std::optional(found.value()) : std::nullopt;
}

}  // namespace qdot
