#include "core/dynamics/canonical_functions.hpp"

#include <algorithm>

#include "core/compile/tape_builder.hpp"
#include "core/mechanics/canonical.hpp"

namespace qdot {
namespace {

class Compiler {
 public:
  Compiler(const Lagrangian& lagrangian, const CanonicalEquations& equations)
      : lagrangian_(lagrangian),
        equations_(equations),
        q_(lagrangian.symbols.coordinates.value),
        rates_(lagrangian.symbols.coordinates.rate),
        p_(momentum_symbols(lagrangian)) {}

  CompiledFunction momenta() {
    TapeBuilder tape = tape_of(rates_);
    for (const Expression& p : conjugate_momenta(lagrangian_)) tape.output(p);
    return tape.finish();
  }

  CompiledFunction derivative() {
    TapeBuilder tape = tape_of(p_);
    const std::vector<std::vector<Slot>> solution = tape.solve(velocities());
    for (const Slot rate : solution[0]) tape.output(rate);
    for (const Expression& force : equations_.forces) tape.output(force);
    return tape.finish();
  }

  CompiledFunction derivatives() {
    TapeBuilder tape = tape_of(p_);
    (void)tape.solve(velocities());
    TapeBuilder::LinearSystem again = velocities();
    again.unknowns.clear();
    again.right_hand_sides = columns();
    const std::vector<std::vector<Slot>> slopes = tape.solve(again);
    for (std::size_t i = 0; i < q_.size(); ++i) {
      for (const std::vector<Slot>& column : slopes) tape.output(column[i]);
    }
    for (const auto* variables : {&q_, &rates_}) {
      for (const Expression& force : equations_.forces) {
        for (const Expression& x : *variables) tape.output(differentiate(force, x));
      }
    }
    return tape.finish();
  }

 private:
  /// Of t and (q, second).
  [[nodiscard]] TapeBuilder tape_of(const std::vector<Expression>& second) const {
    std::vector<Expression> variables = q_;
    variables.insert(variables.end(), second.begin(), second.end());
    return {*lagrangian_.graph, lagrangian_.symbols.parameters, lagrangian_.symbols.t, variables};
  }

  /// A q' = p - a.
  [[nodiscard]] TapeBuilder::LinearSystem velocities() const {
    std::vector<Expression> difference;
    for (std::size_t i = 0; i < p_.size(); ++i) difference.push_back(p_[i] - equations_.linear[i]);
    return {equations_.mass, equations_.determinant, {difference}, rates_};
  }

  /// [-dG/dq, 1], by columns.
  [[nodiscard]] std::vector<std::vector<Expression>> columns() const {
    const std::vector<Expression> momenta = conjugate_momenta(lagrangian_);
    std::vector<std::vector<Expression>> result;
    for (const Expression& q : q_) {
      result.emplace_back();
      for (const Expression& momentum : momenta) result.back().push_back(-differentiate(momentum, q));
    }
    for (std::size_t k = 0; k < p_.size(); ++k) {
      result.emplace_back(p_.size(), lagrangian_.graph->number(0));
      result.back()[k] = lagrangian_.graph->number(1);
    }
    return result;
  }

  const Lagrangian& lagrangian_;
  const CanonicalEquations& equations_;
  std::vector<Expression> q_, rates_, p_;
};

}  // namespace

Evaluation CanonicalFunctions::jacobian(double t, std::span<const double> z, Workspace& workspace,
                                        std::span<double> jacobian) const {
  const std::size_t n = n_, width = 2 * n_;
  std::vector<double> parts(derivatives_.outputs());
  const Evaluation evaluation = derivatives_.evaluate(t, z, workspace, parts);
  if (evaluation != Evaluation::ok) return evaluation;
  std::copy_n(parts.begin(), n * width, jacobian.begin());
  const std::span<const double> by_q = std::span(parts).subspan(n * width, n * n);
  const std::span<const double> by_rate = std::span(parts).last(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < width; ++k) {
      double sum = k < n ? by_q[i * n + k] : 0;
      for (std::size_t j = 0; j < n; ++j) sum += by_rate[i * n + j] * parts[j * width + k];
      jacobian[(n + i) * width + k] = sum;
    }
  }
  return Evaluation::ok;
}

std::unique_ptr<const CanonicalFunctions> canonical_functions(const Lagrangian& lagrangian) {
  const auto equations = canonical_equations(lagrangian);
  if (!equations) return nullptr;
  Compiler compiler(lagrangian, *equations);
  return std::make_unique<const CanonicalFunctions>(lagrangian.symbols.coordinates.value.size(),
                                                    compiler.momenta(), compiler.derivative(),
                                                    compiler.derivatives());
}

}  // namespace qdot
