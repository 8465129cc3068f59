#include "core/expr/zeroness.hpp"

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// The least exponent of each base over all terms, where that is negative.
std::map<NodeId, int> denominators(const Polynomial& polynomial) {
  std::map<NodeId, int> least;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      if (atom.p >= 0) continue;
      const int whole = -((-atom.p + atom.q - 1) / atom.q);  // rounded away from 0
      int& power = least[atom.base];
      power = std::min(power, whole);
    }
  }
  return least;
}

/// Times everything below a bar, multiplied out again.
Polynomial without_denominators(Graph& graph, Polynomial polynomial) {
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round) {
    const std::map<NodeId, int> below = denominators(polynomial);
    if (below.empty()) break;
    Polynomial scaled_up;
    for (const auto& [monomial, coefficient] : polynomial) {
      Monomial product = monomial;
      for (const auto& [base, power] : below) product = times(product, base, -power);
      add(scaled_up, product, coefficient);
    }
    polynomial = multiplied_out(to_expression(graph, scaled_up));
  }
  return polynomial;
}

/// The angle of a sine or cosine when it is a symbol, with a number before it or none.
std::optional<NodeId> angle_symbol(const Graph& graph, NodeId argument) {
  const Node& node = graph.node(argument);
  if (std::holds_alternative<Symbol>(node)) return argument;
  const auto* product = std::get_if<Product>(&node);
  if (product == nullptr || product->factors.size() != 1) return std::nullopt;
  const NodeId factor = product->factors[0];
  return std::holds_alternative<Symbol>(graph.node(factor)) ? std::optional(factor) : std::nullopt;
}

/// Symbols, and sines and cosines of one angle for each symbol: nothing relates these but sin^2 + cos^2 = 1,
/// which is used up. pi is a symbol like any other here, since no rational function of it vanishes; its sine
/// would be another matter.
bool is_independent(Graph& graph, const Polynomial& polynomial) {
  std::map<NodeId, NodeId> angle_of;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      const Node& base = graph.node(atom.base);
      if (atom.p < 0) return false;
      if (std::holds_alternative<Symbol>(base)) continue;
      const auto* call = std::get_if<Call>(&base);
      const bool is_wave =
          call != nullptr && (call->function == Function::sin || call->function == Function::cos);
      const auto symbol = is_wave ? angle_symbol(graph, call->argument) : std::nullopt;
      if (!symbol || atom.q != 1 || *symbol == graph.symbol("pi").id()) return false;
      const auto [place, is_new] = angle_of.emplace(*symbol, call->argument);
      if (!is_new && place->second != call->argument) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<Expression> numerator(const Expression& e, std::uint64_t work) {
  try {
    const WorkScope scope(work);
    return to_expression(e.graph(), without_denominators(e.graph(), multiplied_out(e)));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return std::nullopt;
  }
}

std::optional<Polynomial> normal_form(const Expression& e, std::uint64_t work) {
  Graph& graph = e.graph();
  try {
    const WorkScope scope(work);
    Polynomial polynomial = without_denominators(graph, multiplied_out(e));
    if (polynomial.empty()) return polynomial;
    polynomial = with_single_angles(graph, polynomial);
    return with_single_angles(graph, without_denominators(graph, std::move(polynomial)));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return std::nullopt;
  }
}

Zeroness zeroness(const Expression& e, std::uint64_t work) {
  const std::optional<Polynomial> polynomial = normal_form(e, work);
  if (!polynomial) return Zeroness::unknown;
  if (polynomial->empty()) return Zeroness::zero;
  return is_independent(e.graph(), *polynomial) ? Zeroness::not_zero : Zeroness::unknown;
}

}  // namespace qdot
