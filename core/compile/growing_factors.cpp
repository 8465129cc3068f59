#include "core/compile/growing_factors.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace qdot {
namespace {

constexpr std::int64_t most = 64;  ///< of an exponent

/// One factor base^exponent of a product, for a whole exponent.
struct WholePower {
  Expression base;
  int exponent{};
};

std::vector<WholePower> whole_powers(const Expression& e) {
  std::vector<WholePower> result;
  const auto* product = std::get_if<Product>(&e.node());
  if (product == nullptr) return result;
  for (const NodeId id : product->factors) {
    const auto [base, exponent] = split_power({e.graph(), id});
    if (const auto whole = exponent.whole(most)) result.push_back({base, static_cast<int>(*whole)});
  }
  return result;
}

const Call* call_of(const Expression& e, Function function) {
  const auto* call = std::get_if<Call>(&e.node());
  return call != nullptr && call->function == function ? call : nullptr;
}

bool has_factor(const Expression& e, const Expression& factor) {
  if (e == factor) return true;
  const std::vector<WholePower> powers = whole_powers(e);
  return std::ranges::any_of(powers, [&](const WholePower& p) { return p.base == factor && p.exponent > 0; });
}

/// S e^-u: where a term has e^u it loses it.
Expression divided_by(const Expression& exponential, const Expression& sum) {
  Graph& graph = sum.graph();
  const Expression falling =
      graph.call(Function::exp, -Expression(graph, call_of(exponential, Function::exp)->argument));
  std::vector<Expression> terms;
  for (const NodeId id : std::get<Sum>(sum.node()).terms) {
    const Expression term(graph, id);
    const auto [coefficient, rest] = split_coefficient(term);
    terms.push_back(has_factor(rest, exponential) ? term / exponential : term * falling);
  }
  return graph.sum(terms);
}

/// What above/below becomes, for one power of each; nothing where neither rule applies.
std::optional<Expression> shortened(const Expression& above, const Expression& below) {
  Graph& graph = above.graph();
  const Call* sinh = call_of(above, Function::sinh);
  const Call* cosh = call_of(below, Function::cosh);
  if (sinh != nullptr && cosh != nullptr && sinh->argument == cosh->argument) {
    return graph.call(Function::tanh, {graph, sinh->argument});
  }
  const auto* sum = std::get_if<Sum>(&below.node());
  if (sum == nullptr || call_of(above, Function::exp) == nullptr) return std::nullopt;
  const bool has_it = std::ranges::any_of(sum->terms, [&](NodeId id) {
    return has_factor(split_coefficient({graph, id}).rest, above);
  });
  if (!has_it) return std::nullopt;
  return pow(divided_by(above, below), Number(-1));
}

bool is_term_of(const Expression& term, const Expression& sum) {
  const auto* other = std::get_if<Sum>(&sum.node());
  const Expression factor = split_coefficient(term).rest;
  return other != nullptr && call_of(factor, Function::exp) != nullptr &&
         std::ranges::any_of(other->terms, [&](NodeId id) {
           return has_factor(split_coefficient({sum.graph(), id}).rest, factor);
         });
}

/// (e^u - e^-u)/(e^u + e^-u)^2 term by term; nothing where no term grows as what it is divided by.
std::optional<Expression> distributed(const Expression& product, const std::vector<WholePower>& powers) {
  for (const WholePower& above : powers) {
    const auto* sum = std::get_if<Sum>(&above.base.node());
    if (sum == nullptr || above.exponent != 1) continue;
    const bool grows = std::ranges::any_of(powers, [&](const WholePower& below) {
      return below.exponent < 0 && std::ranges::any_of(sum->terms, [&](NodeId id) {
               return is_term_of({product.graph(), id}, below.base);
             });
    });
    if (!grows) continue;
    const std::vector<NodeId> ids = sum->terms;
    std::vector<Expression> terms;
    for (const NodeId id : ids) {
      terms.push_back(without_growing_quotients(product / above.base * Expression(product.graph(), id)));
    }
    return product.graph().sum(terms);
  }
  return std::nullopt;
}

}  // namespace

Expression without_growing_quotients(const Expression& product) {
  const std::vector<WholePower> powers = whole_powers(product);
  if (const auto terms = distributed(product, powers)) return *terms;
  for (const WholePower& above : powers) {
    for (const WholePower& below : powers) {
      if (above.exponent < 0 || below.exponent > 0) continue;
      const auto instead = shortened(above.base, below.base);
      if (!instead) continue;
      const int m = std::min(above.exponent, -below.exponent);
      const Expression rest = product * pow(above.base, Number(-m)) * pow(below.base, Number(m));
      return without_growing_quotients(rest * pow(*instead, Number(m)));
    }
  }
  return product;
}

}  // namespace qdot
