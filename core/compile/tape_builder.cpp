#include "core/compile/tape_builder.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/compile/growing_factors.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/linear_system.hpp"

namespace qdot {
namespace {

/// Whole powers up to here are products; a hostile text can ask for x^(2^36).
constexpr std::int64_t most_multiplied = 1024;

bool is_product(const Number& exponent) { return exponent.whole(most_multiplied).has_value(); }

/// Groups of unknowns that the matrix couples, directly or through others.
std::vector<std::vector<std::size_t>> coupled_groups(const Matrix& m) {
  std::vector<std::size_t> group(m.size());
  for (std::size_t i = 0; i < m.size(); ++i) group[i] = i;
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (std::size_t j = 0; j < m.size(); ++j) {
      if (m[i][j].is_zero()) continue;
      const std::size_t old = std::max(group[i], group[j]);
      std::replace(group.begin(), group.end(), old, std::min(group[i], group[j]));
    }
  }
  std::vector<std::vector<std::size_t>> groups(m.size());
  for (std::size_t i = 0; i < m.size(); ++i) groups[group[i]].push_back(i);
  std::erase_if(groups, [](const auto& members) { return members.empty(); });
  return groups;
}

}  // namespace

TapeBuilder::TapeBuilder(Graph& graph, std::span<const Expression> parameters, const Expression& t,
                         std::span<const Expression> variables)
    : graph_(graph) {
  function_.parameters_ = parameters.size();
  function_.variables_ = variables.size();
  const auto declare = [this](const Expression& symbol, bool varying) {
    slots_[symbol.id()] = static_cast<Slot>(function_.slots_++);
    varies_[symbol.id()] = varying;
  };
  for (const Expression& p : parameters) declare(p, false);
  declare(t, true);
  for (const Expression& x : variables) declare(x, true);
}

Slot TapeBuilder::literal(const Real& value) {
  const auto [position, is_new] = literals_.try_emplace(value, static_cast<Slot>(function_.slots_));
  if (is_new) function_.literals_.emplace_back(static_cast<Slot>(function_.slots_++), value);
  return position->second;
}

bool TapeBuilder::varies(NodeId id) {
  const auto found = varies_.find(id);
  if (found != varies_.end()) return found->second;
  const std::span<const NodeId> below = children(graph_.node(id));
  const bool result = std::any_of(below.begin(), below.end(), [this](NodeId child) { return varies(child); });
  return varies_[id] = result;
}

Slot TapeBuilder::emit(Instruction instruction, std::span<const Slot> operands, bool varying, Slot count) {
  instruction.first = static_cast<std::uint32_t>(function_.operands_.size());
  instruction.out = static_cast<Slot>(function_.slots_);
  function_.operands_.insert(function_.operands_.end(), operands.begin(), operands.end());
  function_.slots_ += count;
  (varying ? function_.body_ : function_.prologue_).push_back(instruction);
  return instruction.out;
}

Slot TapeBuilder::slot(const Expression& e) { return emitted(e.id()); }

Slot TapeBuilder::emitted(NodeId id) {
  const auto found = slots_.find(id);
  if (found != slots_.end()) return found->second;
  const Slot slot =
      std::visit(overloaded{[&](const Literal& x) { return literal(x.value.rounded()); },
                            [&](const Symbol& x) {
                              if (x.name == "pi") return literal(exact_pi);
                              throw Error(ErrorCode::unknown_symbol, "'" + x.name + "' has no value");
                            },
                            [&](const Sum& x) { return emitted_sum(id, x); },
                            [&](const Product& x) { return emitted_product(id, x); },
                            [&](const Power& x) { return emitted_power(id, x); },
                            [&](const Call& x) { return emitted_call(id, x); }},
                 graph_.node(id));
  slots_[id] = slot;
  return slot;
}

/// x^exponent by products, exponent >= 1.
Slot TapeBuilder::whole_power(Slot base, int exponent, bool varying) {
  if (exponent == 1) return base;
  const Slot half = whole_power(base, exponent / 2, varying);
  std::vector<Slot> factors{half, half};
  if (exponent % 2 == 1) factors.push_back(base);
  return product_of(literal(1), factors, varying);
}

/// coefficient times the factors, two of them an instruction.
Slot TapeBuilder::product_of(Slot coefficient, std::vector<Slot> factors, bool varying) {
  while (factors.size() > 2) {
    const Slot operands[]{literal(1), factors[0], factors[1]};
    factors.erase(factors.begin(), factors.begin() + 2);
    factors.push_back(emit({.operation = Operation::sum_of_products, .products = 1}, operands, varying));
  }
  if (factors.empty()) return coefficient;
  if (factors.size() == 1) {
    const Slot operands[]{coefficient, factors[0]};
    if (coefficient == literal(1)) return factors[0];
    return emit({.operation = Operation::sum_of_products, .linear = 1}, operands, varying);
  }
  const Slot operands[]{coefficient, factors[0], factors[1]};
  return emit({.operation = Operation::sum_of_products, .products = 1}, operands, varying);
}

/// A product without varying denominators as coefficient and factors, squares as two equal factors.
std::optional<TapeBuilder::Factors> TapeBuilder::factors_of(NodeId id) {
  if (!varies(id)) return Factors{emitted(id), {}};
  const auto* product = std::get_if<Product>(&graph_.node(id));
  const std::vector<NodeId> factors = product != nullptr ? product->factors : std::vector<NodeId>{id};
  Factors result{literal(1), {}};
  std::vector<Expression> constant{graph_.number(product != nullptr ? product->coefficient : Number(1))};
  for (const NodeId factor : factors) {
    if (!varies(factor)) {
      constant.emplace_back(graph_, factor);
      continue;
    }
    const auto* power = std::get_if<Power>(&graph_.node(factor));
    if (power == nullptr || !is_product(power->exponent)) {
      result.varying.push_back(emitted(factor));
    } else if (power->exponent.is_negative()) {
      return std::nullopt;
    } else if (power->exponent == Number(2)) {
      result.varying.insert(result.varying.end(), 2, emitted(power->base));
    } else {
      result.varying.push_back(emitted(factor));
    }
  }
  result.coefficient = slot(graph_.product(constant));
  return result;
}

Slot TapeBuilder::emitted_sum(NodeId id, const Sum& sum) {
  std::vector<Slot> pairs, triples;
  for (const NodeId term : sum.terms) {
    const std::optional<Factors> factors = factors_of(term);
    if (!factors) {
      pairs.insert(pairs.end(), {literal(1), emitted(term)});
    } else if (factors->varying.empty()) {
      pairs.insert(pairs.end(), {factors->coefficient, literal(1)});
    } else if (factors->varying.size() == 1) {
      pairs.insert(pairs.end(), {factors->coefficient, factors->varying[0]});
    } else {
      const std::vector<Slot> rest(factors->varying.begin() + 1, factors->varying.end());
      triples.insert(triples.end(),
                     {factors->coefficient, factors->varying[0], product_of(literal(1), rest, true)});
    }
  }
  const Instruction instruction{.operation = Operation::sum_of_products,
                                .linear = static_cast<std::uint16_t>(pairs.size() / 2),
                                .products = static_cast<std::uint16_t>(triples.size() / 3)};
  pairs.insert(pairs.end(), triples.begin(), triples.end());
  return emit(instruction, pairs, varies(id));
}

Slot TapeBuilder::emitted_product(NodeId id, const Product& product) {
  const bool varying = varies(id);
  if (varying) {
    if (const auto factors = factors_of(id)) return product_of(factors->coefficient, factors->varying, true);
    const Expression written(graph_, id);
    const Expression bounded = without_growing_quotients(written);
    if (!(bounded == written)) return emitted(bounded.id());
  }
  std::vector<Slot> above, below;
  for (const NodeId factor : product.factors) {
    const auto* power = std::get_if<Power>(&graph_.node(factor));
    if (power == nullptr || !is_product(power->exponent) || !power->exponent.is_negative()) {
      above.push_back(emitted(factor));
    } else {
      const auto exponent = static_cast<int>(-*power->exponent.whole(most_multiplied));
      below.push_back(whole_power(emitted(power->base), exponent, varies(power->base)));
    }
  }
  const Slot numerator = product_of(literal(product.coefficient.rounded()), above, varying);
  if (below.empty()) return numerator;
  const Slot operands[]{numerator, product_of(literal(1), below, varying)};
  return emit({.operation = Operation::quotient}, operands, varying);
}

Slot TapeBuilder::emitted_power(NodeId id, const Power& power) {
  const bool varying = varies(id);
  const Slot base = emitted(power.base);
  const Number& exponent = power.exponent;
  const auto fraction = exponent.small();
  if (fraction && is_product(Number(2) * exponent)) {
    const auto size = static_cast<int>(std::abs(fraction->numerator));
    Slot result = base;
    if (fraction->denominator == 2) result = emit({.operation = Operation::square_root}, {&base, 1}, varying);
    result = whole_power(result, size, varying);
    if (!exponent.is_negative()) return result;
    const Slot operands[]{literal(1), result};
    return emit({.operation = Operation::quotient}, operands, varying);
  }
  const Slot operands[]{base, literal(exponent.rounded())};
  return emit({.operation = Operation::power}, operands, varying);
}

Slot TapeBuilder::emitted_call(NodeId id, const Call& call) {
  const Slot argument = emitted(call.argument);
  if (call.function != Function::sin && call.function != Function::cos) {
    return emit({.operation = Operation::call, .function = call.function}, {&argument, 1}, varies(id));
  }
  const Slot sine = emit({.operation = Operation::sine_cosine}, {&argument, 1}, varies(id), 2);
  const Expression u(graph_, call.argument);
  slots_[sin(u).id()] = sine;
  slots_[cos(u).id()] = sine + 1;
  return call.function == Function::sin ? sine : sine + 1;
}

std::vector<std::vector<Slot>> TapeBuilder::solve(const LinearSystem& system) {
  const std::size_t n = system.matrix.size();
  if (n > largest_system) {
    throw Error(ErrorCode::too_large, "There are more than " + std::to_string(largest_system) +
                                          " coordinates and constraints together.");
  }
  std::vector<std::vector<Slot>> solutions(system.right_hand_sides.size(), std::vector<Slot>(n));
  for (const std::vector<std::size_t>& group : coupled_groups(system.matrix)) {
    std::vector<Slot> operands;
    const bool with_determinant = n == 2 && group.size() == 2 && system.determinant.has_value();
    if (with_determinant) operands.push_back(slot(*system.determinant));
    for (const std::size_t i : group) {
      for (const std::size_t j : group) operands.push_back(slot(system.matrix[i][j]));
    }
    for (const auto& column : system.right_hand_sides) {
      for (const std::size_t i : group) operands.push_back(slot(column[i]));
    }
    const Instruction instruction{.operation = Operation::solve,
                                  .linear = static_cast<std::uint16_t>(group.size()),
                                  .products = static_cast<std::uint16_t>(system.right_hand_sides.size()),
                                  .has_determinant = with_determinant};
    const auto size = static_cast<Slot>(group.size());
    const Slot out =
        emit(instruction, operands, true, static_cast<Slot>(system.right_hand_sides.size()) * size);
    for (std::size_t k = 0; k < solutions.size(); ++k) {
      for (std::size_t i = 0; i < group.size(); ++i)
        solutions[k][group[i]] = out + static_cast<Slot>(k * size + i);
    }
  }
  for (std::size_t i = 0; i < system.unknowns.size(); ++i) {
    slots_[system.unknowns[i].id()] = solutions[0][i];
    varies_[system.unknowns[i].id()] = true;
  }
  return solutions;
}

CompiledFunction TapeBuilder::finish() { return std::move(function_); }

}  // namespace qdot
