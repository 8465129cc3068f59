#include "core/mechanics/dimension_check.hpp"

#include <cstdlib>

#include "core/expr/print/print.hpp"

namespace qdot {
namespace {

std::string quoted(const Expression& e) { return "'" + print(e, Form::text) + "'"; }

class Checker {
 public:
  Checker(Graph& graph, const SymbolDimensions& symbols) : graph_(graph), symbols_(symbols) {}

  DimensionResult of(NodeId id) {
    return std::visit(
        overloaded{[](const Literal& x) { return x.value.is_zero() ? DimensionResult{} : plain(); },
                   [&](const Symbol& x) { return of_symbol(id, x); }, [&](const Sum& x) { return of_sum(x); },
                   [&](const Product& x) { return of_product(x); },
                   [&](const Power& x) { return of_power(x); }, [&](const Call& x) { return of_call(x); }},
        graph_.node(id));
  }

 private:
  static DimensionResult plain() { return {Dimension{}, ""}; }

  /// A symbol of unknown dimension fits anywhere: its unit has been complained about already.
  DimensionResult of_symbol(NodeId id, const Symbol& symbol) {
    const auto found = symbols_.find(id);
    if (found != symbols_.end()) return {found->second, ""};
    return symbol.name == "pi" ? plain() : DimensionResult{};
  }

  DimensionResult of_sum(const Sum& x) {
    DimensionResult first = of(x.terms[0]);
    for (std::size_t i = 1; i < x.terms.size() && first.mistake.empty(); ++i) {
      DimensionResult next = of(x.terms[i]);
      if (!next.mistake.empty()) return next;
      if (!first.dimension) first = next;
      if (!next.dimension || *next.dimension == *first.dimension) continue;
      return {std::nullopt, "it adds " + quoted({graph_, x.terms[0]}) + " in " + to_text(*first.dimension) +
                                " to " + quoted({graph_, x.terms[i]}) + " in " + to_text(*next.dimension)};
    }
    return first;
  }

  DimensionResult of_product(const Product& x) {
    DimensionResult product = plain();
    for (const NodeId factor : x.factors) {
      const DimensionResult next = of(factor);
      if (!next.mistake.empty()) return next;
      if (!next.dimension) product.dimension.reset();
      if (product.dimension) product.dimension = *product.dimension * *next.dimension;
    }
    return product;
  }

  DimensionResult of_power(const Power& x) {
    const DimensionResult base = of(x.base);
    if (!base.dimension || base.dimension->is_dimensionless()) return base;
    const auto exponent = x.exponent.small();
    if (!exponent || std::abs(exponent->numerator) > 64 || exponent->denominator > 64)
      return {std::nullopt, "it raises a dimension to the power " + quoted_number(x)};
    return {
        pow(*base.dimension, static_cast<int>(exponent->numerator), static_cast<int>(exponent->denominator)),
        ""};
  }

  DimensionResult of_call(const Call& x) {
    DimensionResult argument = of(x.argument);
    if (!argument.mistake.empty() || x.function == Function::abs) return argument;
    if (x.function == Function::sign || !argument.dimension || argument.dimension->is_dimensionless())
      return plain();
    return {std::nullopt, "it takes " + std::string(name(x.function)) + " of " +
                              quoted({graph_, x.argument}) + ", which is in " + to_text(*argument.dimension) +
                              " and not a pure number"};
  }

  std::string quoted_number(const Power& x) { return quoted(graph_.number(x.exponent)); }

  Graph& graph_;
  const SymbolDimensions& symbols_;
};

}  // namespace

DimensionResult dimension_of(const Expression& e, const SymbolDimensions& symbols) {
  return Checker(e.graph(), symbols).of(e.id());
}

}  // namespace qdot
