#include "core/closed/linear_factors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>

namespace qdot {
namespace {

constexpr std::size_t fewest_terms = 3, most_terms = 40, most_symbols = 6;

/// A polynomial of symbols alone, in whole powers.
bool is_plain(const Graph& graph, const Polynomial& a) {
  return std::ranges::all_of(a, [&](const auto& term) {
    return std::ranges::all_of(term.first, [&](const Atom& atom) {
      return atom.q == 1 && atom.p > 0 && std::holds_alternative<Symbol>(graph.node(atom.base));
    });
  });
}

std::vector<NodeId> symbols_of(const Polynomial& a) {
  std::vector<NodeId> found;
  for (const auto& [monomial, coefficient] : a) {
    for (const Atom& atom : monomial) {
      if (std::ranges::find(found, atom.base) == found.end()) found.push_back(atom.base);
    }
  }
  return found;
}

/// Whether it may vanish where x = r y, the others anything: a look, before it is divided.
bool may_vanish(const Polynomial& a, const std::vector<NodeId>& symbols, NodeId x, NodeId y, double r) {
  std::vector<double> values;
  for (std::size_t i = 0; i < symbols.size(); ++i) values.push_back(0.7 + 0.31 * static_cast<double>(i));
  const auto place = [&](NodeId id) {
    return static_cast<std::size_t>(std::ranges::find(symbols, id) - symbols.begin());
  };
  values[place(x)] = r * values[place(y)];
  double sum = 0, size = 0;
  for (const auto& [monomial, coefficient] : a) {
    double term = coefficient.value();
    for (const Atom& atom : monomial) {
      for (int k = 0; k < atom.p; ++k) term *= values[place(atom.base)];
    }
    sum += term;
    size += std::abs(term);
  }
  return std::abs(sum) <= 1e-10 * size;
}

class LinearFactors {
 public:
  LinearFactors(Graph& graph, Polynomial a) : graph_(graph), left_(std::move(a)) {}

  [[nodiscard]] std::vector<Expression> found() {
    const std::vector<NodeId> symbols = symbols_of(left_);
    if (symbols.size() > most_symbols) return {};
    for (std::size_t i = 0; i < symbols.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (int p = 1; p <= 5; ++p) {
          for (int q = 1; q <= 5; ++q) {
            if (std::gcd(p, q) == 1) take(symbols, symbols[i], symbols[j], p, q);
          }
        }
      }
    }
    return std::move(found_);
  }
  [[nodiscard]] const Polynomial& left() const { return left_; }

 private:
  /// q x - p y and q x + p y, as often as they divide.
  void take(const std::vector<NodeId>& symbols, NodeId x, NodeId y, int p, int q) {
    for (const int sign : {1, -1}) {
      while (left_.size() > 1 && may_vanish(left_, symbols, x, y, static_cast<double>(sign * p) / q)) {
        const Polynomial factor{{{{x, 1, 1}}, Number(q)}, {{{y, 1, 1}}, Number(-sign * p)}};
        auto quotient = exact_quotient(left_, factor);
        if (!quotient) break;
        left_ = *std::move(quotient);
        found_.push_back(to_expression(graph_, factor));
      }
    }
  }

  Graph& graph_;
  Polynomial left_;
  std::vector<Expression> found_;
};

/// Of two terms that are squares and their double product.
std::optional<Expression> with_complete_square(Graph& graph, const Polynomial& a) {
  const auto root_of = [&](const auto& term) -> std::optional<Polynomial> {
    const Polynomial square{{term.first, term.second}};
    return term.second.is_negative() ? std::nullopt : exact_root(square);
  };
  for (auto first = a.begin(); first != a.end(); ++first) {
    const auto x = root_of(*first);
    if (!x) continue;
    for (auto second = std::next(first); second != a.end(); ++second) {
      const auto y = root_of(*second);
      if (!y) continue;
      const Polynomial product = scaled(*x * *y, {}, Number(2));
      const auto mixed = a.find(product.begin()->first);
      if (mixed == a.end()) continue;
      const bool is_sum = mixed->second == product.begin()->second;
      if (!is_sum && !(-mixed->second == product.begin()->second)) continue;
      Polynomial rest = a, root = *x;
      for (const auto& term : {*first, *second, *mixed}) rest.erase(term.first);
      add(root, *y, Number(is_sum ? 1 : -1));
      return pow(to_expression(graph, root), Number(2)) + to_expression(graph, rest);
    }
  }
  return std::nullopt;
}

Expression factored_rational(const Expression& e) {
  constexpr std::size_t few_operations = 10;
  if (written_length(e) < few_operations) return e;
  Graph& graph = e.graph();
  const RationalFunction f = rational_function(e);
  if (f.is_zero() || (f.above.size() < fewest_terms && f.below.size() < fewest_terms)) return e;
  Expression result = graph.number(1);
  bool helps = false;
  for (const auto& [part, side] : {std::pair(&f.above, 1), std::pair(&f.below, -1)}) {
    const Monomial common = common_monomial(*part);
    const Polynomial bracket = scaled(*part, inverse(common), Number(1));
    Expression product = to_expression(graph, common) * to_expression(graph, bracket);
    if (bracket.size() >= fewest_terms && bracket.size() <= most_terms && is_plain(graph, bracket)) {
      LinearFactors factors(graph, bracket);
      const std::vector<Expression> found = factors.found();
      helps = helps || !found.empty();
      product = to_expression(graph, common) * to_expression(graph, factors.left());
      for (const Expression& factor : found) product = product * factor;
      if (const auto square = found.empty() ? with_complete_square(graph, bracket) : std::nullopt) {
        product = to_expression(graph, common) * *square;
        helps = true;
      }
    }
    result = result * pow(product, Number(side));
  }
  return helps && written_length(result) <= written_length(e) ? result : e;
}

bool is_rational(const Expression& e) {
  const NodeId root = e.id();
  const auto ids = reachable(e.graph(), {&root, 1});
  return std::ranges::all_of(ids, [&](NodeId id) {
    const Node& node = e.graph().node(id);
    const auto* power = std::get_if<Power>(&node);
    return !std::holds_alternative<Call>(node) && (power == nullptr || power->exponent.is_integer());
  });
}

}  // namespace

Expression with_linear_factors(const Expression& e) {
  if (std::holds_alternative<Literal>(e.node()) || std::holds_alternative<Symbol>(e.node()) ||
      std::holds_alternative<Call>(e.node()))
    return e;
  if (is_rational(e)) return factored_rational(e);
  Graph& graph = e.graph();
  if (const auto [base, exponent] = split_power(e); !exponent.is_one())
    return pow(with_linear_factors(base), exponent);
  if (const auto* sum = std::get_if<Sum>(&e.node())) {
    const std::vector<NodeId> terms = sum->terms;
    Expression result = graph.number(0);
    for (const NodeId id : terms) result = result + with_linear_factors({graph, id});
    return result;
  }
  const auto* product = std::get_if<Product>(&e.node());
  if (product == nullptr) return e;
  const Product parts = *product;
  Expression rational = graph.number(parts.coefficient), rest = graph.number(1);
  for (const NodeId id : parts.factors) {
    const Expression factor(graph, id);
    if (is_rational(factor))
      rational = rational * factor;
    else
      rest = rest * with_linear_factors(factor);
  }
  return (rational.number() != nullptr ? rational : factored_rational(rational)) * rest;
}

}  // namespace qdot
