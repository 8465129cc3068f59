#include "core/dynamics/lost_inertia.hpp"

#include <algorithm>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"

namespace qdot {
namespace {

/// The factors of a product, or e alone.
std::vector<Expression> factors_of(const Expression& e) {
  const auto* product = std::get_if<Product>(&e.node());
  if (product == nullptr) return {e};
  std::vector<Expression> factors;
  for (const NodeId id : product->factors) factors.emplace_back(e.graph(), id);
  return factors;
}

using Varied = std::optional<std::size_t>;

bool is_zero_by(const Expression& factor, const Model& model, const Reals& parameters, Varied varied) {
  if (factor.number() != nullptr) return false;
  const Symbols& symbols = model.parsed.symbols;
  if (varied && depends_on(factor, symbols.parameters[*varied])) return false;
  std::vector<RealAssignment> values;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (depends_on(factor, symbols.parameters[i]))
      values.emplace_back(symbols.parameters[i], parameters.exact(i));
  }
  if (values.empty() || depends_on(factor, symbols.coordinates.value) || depends_on(factor, symbols.t))
    return false;
  return evaluate_exactly(factor, values).value == 0;
}

bool stands_in(const Matrix& matrix, const Expression& symbol) {
  return std::ranges::any_of(matrix, [&](const auto& row) {
    return std::ranges::any_of(row, [&](const Expression& e) { return depends_on(e, symbol); });
  });
}

Matrix with_zeros(const Model& model, const std::vector<std::size_t>& zeros, Graph& own) {
  std::vector<Replacement> replacements;
  for (const std::size_t i : zeros)
    replacements.emplace_back(own.adopt(model.parsed.symbols.parameters[i]), own.number(0));
  Matrix matrix;
  for (const auto& row : model.system.matrix) {
    matrix.emplace_back();
    for (const Expression& e : row) matrix.back().push_back(substitute(own.adopt(e), replacements));
  }
  return matrix;
}

/// A constraint may hold what has no mass, or say nothing itself with these parameters.
void leave_out_constraints(std::optional<InertiaFault>& fault, std::size_t coordinates) {
  std::erase_if(fault->coordinates, [&](std::size_t row) { return row >= coordinates; });
  if (fault->coordinates.empty()) fault.reset();
}

std::vector<std::size_t> equations_in_the_limit(const Model& model, const Reals& parameters, Varied varied) {
  std::vector<std::size_t> limits;
  for (std::size_t i = 0; i < model.equations.equations.size(); ++i) {
    const auto is_zero = [&](const Expression& factor) {
      return is_zero_by(factor, model, parameters, varied);
    };
    if (std::ranges::any_of(factors_of(model.equations.equations[i].divided_by), is_zero))
      limits.push_back(i);
  }
  return limits;
}

}  // namespace

LostInertia lost_inertia(const Model& model, const Reals& parameters, Varied varied) {
  LostInertia lost{.limits = equations_in_the_limit(model, parameters, varied), .zeros = {}, .fault = {}};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (i != varied && parameters.exact(i) == Real(0) &&
        stands_in(model.system.matrix, model.parsed.symbols.parameters[i]))
      lost.zeros.push_back(i);
  }
  if (lost.zeros.empty()) return lost;
  Graph own = *model.lagrangian.graph;
  lost.fault = inertia_fault(with_zeros(model, lost.zeros, own));
  if (lost.fault && model.has_constraints())
    leave_out_constraints(lost.fault, model.scene.coordinates.size());
  return lost;
}

}  // namespace qdot
