#include "core/mechanics/exponents.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/expr/calculus.hpp"
#include "core/expr/node.hpp"
#include "core/mechanics/scene.hpp"
#include "core/mechanics/symbols.hpp"

namespace qdot {
namespace {

constexpr double largest = 64;  // as of a number that is written as an exponent

struct SymbolicPower {
  Expression base, exponent;
};

/// base^exponent, of exp(exponent log(base)).
std::optional<SymbolicPower> symbolic_power(const Expression& e) {
  Graph& graph = e.graph();
  const auto* power = std::get_if<Call>(&e.node());
  if (power == nullptr || power->function != Function::exp) return std::nullopt;
  const auto* product = std::get_if<Product>(&graph.node(power->argument));
  if (product == nullptr) return std::nullopt;
  std::optional<Expression> base;
  std::vector<Expression> others;
  for (const NodeId id : product->factors) {
    const auto* logarithm = std::get_if<Call>(&graph.node(id));
    const bool is_logarithm = logarithm != nullptr && logarithm->function == Function::log;
    if (is_logarithm && base) return std::nullopt;
    if (is_logarithm) {
      base = Expression(graph, logarithm->argument);
    } else {
      others.emplace_back(graph, id);
    }
  }
  if (!base || others.empty()) return std::nullopt;
  return SymbolicPower{*base, product->coefficient * graph.product(others)};
}

/// The names in e, or none where something else than parameters stands in it.
std::set<std::string> names_in(const Expression& e, std::span<const Expression> parameters) {
  std::set<std::string> names;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(e.graph(), root)) {
    const auto* symbol = std::get_if<Symbol>(&e.graph().node(id));
    if (symbol == nullptr) continue;
    if (!std::ranges::any_of(parameters, [id](const Expression& p) { return p.id() == id; })) return {};
    names.insert(symbol->name);
  }
  return names;
}

std::optional<Number> value_of(const Expression& exponent, const std::set<std::string>& names,
                               const ExponentValues& values) {
  Graph& graph = exponent.graph();
  std::vector<Replacement> known;
  for (const std::string& name : names) {
    const auto value = values.find(name);
    if (value == values.end()) return std::nullopt;
    known.emplace_back(graph.symbol(name), graph.number(value->second));
  }
  const Expression put_in = substitute(exponent, known);
  const Number* const number = put_in.number();
  if (number == nullptr || !(std::abs(number->value()) <= largest)) return std::nullopt;
  return *number;
}

class Positive {
 public:
  explicit Positive(const ExponentSymbols& symbols) : symbols_(symbols) {}

  [[nodiscard]] bool operator()(const Expression& e) const {
    Graph& graph = e.graph();
    const auto is = [&](NodeId id) { return (*this)({graph, id}); };
    return std::visit(
        overloaded{
            [](const Literal& x) { return x.value.value() > 0; },
            [&](const Symbol& x) { return x.name == "pi" || symbols_.positive.contains(x.name); },
            [&](const Sum& x) { return std::ranges::all_of(x.terms, is); },
            [&](const Product& x) { return x.coefficient.value() > 0 && std::ranges::all_of(x.factors, is); },
            [&](const Power& x) { return is(x.base); },
            [](const Call& x) { return x.function == Function::exp || x.function == Function::cosh; }},
        e.node());
  }

 private:
  const ExponentSymbols& symbols_;
};

}  // namespace

ExponentSymbols exponent_symbols_of(const Scene& scene, const Symbols& symbols) {
  ExponentSymbols result{symbols.parameters, {}};
  const auto take = [&](const auto& named) {
    const Domain& domain = named.domain;
    if (domain.lower > 0 || (domain.lower == 0 && domain.lower_open)) result.positive.insert(named.name);
  };
  std::ranges::for_each(scene.parameters, take);
  std::ranges::for_each(scene.coordinates, take);
  return result;
}

Expression with_exponents(const Expression& e, const ExponentSymbols& symbols, const ExponentValues& values,
                          FoundExponents& found) {
  Graph& graph = e.graph();
  const Positive is_positive(symbols);
  std::vector<Replacement> replaced;
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {  // what is inside comes first
    const auto power = symbolic_power({graph, id});
    if (!power || is_positive(power->base)) continue;
    const std::set<std::string> names = names_in(power->exponent, symbols.parameters);
    found.names.insert(names.begin(), names.end());
    const auto value = names.empty() ? std::nullopt : value_of(power->exponent, names, values);
    if (!value) continue;
    replaced.emplace_back(Expression(graph, id), pow(substitute(power->base, replaced), *value));
    for (const std::string& name : names) found.put_in[name] = values.at(name);
  }
  return replaced.empty() ? e : substitute(e, replaced);
}

}  // namespace qdot
