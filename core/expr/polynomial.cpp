#include "core/expr/polynomial.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/work.hpp"

namespace qdot {
namespace {

constexpr std::size_t largest_polynomial = 5'000;
constexpr int largest_exponent = 64;

/// Terms of e by their nodes, multiplied out bottom-up with memory.
class Expander {
 public:
  explicit Expander(Graph& graph) : graph_(graph) {}

  Polynomial whole(const Expression& e) {
    (void)(*this)(e.id());
    return std::move(done_.at(e.id()));
  }

  const Polynomial& operator()(NodeId id) {
    const auto found = done_.find(id);
    if (found != done_.end()) return found->second;
    Polynomial result = expanded(id);
    return done_.emplace(id, std::move(result)).first->second;
  }

 private:
  Polynomial expanded(NodeId id) {
    return std::visit(
        overloaded{[&](const Literal& x) { return constant(x.value); },
                   [&](const Symbol&) { return atom(id); },
                   [&](const Sum& x) {
                     Polynomial sum;
                     for (const NodeId term : x.terms) add(sum, (*this)(term));
                     return sum;
                   },
                   [&](const Product& x) { return with_roots_opened(product_of(x)); },
                   [&](const Power& x) { return raised(id, x); }, [&](const Call& x) { return called(x); }},
        graph_.node(id));
  }

  Polynomial product_of(const Product& x) {
    Monomial monomial;
    Number coefficient = x.coefficient;
    std::vector<const Polynomial*> sums;
    for (const NodeId id : x.factors) {
      const Polynomial& factor = (*this)(id);
      if (factor.size() != 1) {
        sums.push_back(&factor);
        continue;
      }
      monomial = monomial * factor.begin()->first;
      coefficient = coefficient * factor.begin()->second;
    }
    Polynomial product{{std::move(monomial), coefficient}};
    for (const Polynomial* sum : sums) product = product * *sum;
    return product;
  }

  static Polynomial constant(const Number& value) {
    return value.is_zero() ? Polynomial{} : Polynomial{{Monomial{}, value}};
  }
  static Polynomial atom(NodeId id, int p = 1, int q = 1) { return {{Monomial{{id, p, q}}, Number(1)}}; }

  /// A base that is a sum is brought to its own canonical (multiplied out) form before it becomes an atom.
  NodeId canonical(NodeId id) { return to_expression(graph_, (*this)(id)).id(); }

  Polynomial raised(NodeId id, const Power& x) {
    const auto exponent = x.exponent.small();
    if (!exponent || std::abs(exponent->numerator) > largest_exponent ||
        exponent->denominator > largest_exponent) {
      return atom(id);
    }
    const int p = static_cast<int>(exponent->numerator);
    const int q = static_cast<int>(exponent->denominator);
    if (q == 1 && p > 0) {
      const Polynomial& base = (*this)(x.base);
      Polynomial power = constant(1);
      for (int i = 0; i < p; ++i) power = power * base;
      return with_roots_opened(std::move(power));
    }
    const Expression base(graph_, canonical(x.base));
    const Expression again = graph_.power(base, x.exponent);
    if (std::holds_alternative<Power>(again.node()) && split_power(again).base == base)
      return atom(base.id(), p, q);
    return (*this)(again.id());  // the base turned out simpler: 1/(2 m) is a product
  }

  Polynomial called(const Call& x) {
    const Expression argument(graph_, canonical(x.argument));
    if (x.function == Function::tan) {
      return (*this)((sin(argument) / cos(argument)).id());
    }
    const Expression again = graph_.call(x.function, argument);
    const auto [coefficient, rest] = split_coefficient(again);
    return std::holds_alternative<Call>(rest.node()) ? scaled(atom(rest.id()), {}, coefficient)
                                                     : (*this)(again.id());
  }

  [[nodiscard]] bool is_opened(const Atom& a) const {
    const Node& base = graph_.node(a.base);
    const bool plain = std::holds_alternative<Symbol>(base) || std::holds_alternative<Call>(base) ||
                       (std::holds_alternative<Sum>(base) && a.p < 0);
    return a.q == 1 && !plain;
  }

  /// sqrt(x + y) sqrt(x + y) has become an atom (x + y)^1: such atoms are no atoms any more.
  Polynomial with_roots_opened(Polynomial polynomial) {
    const bool nothing_opens = std::ranges::none_of(polynomial, [&](const auto& term) {
      return std::ranges::any_of(term.first, [&](const Atom& a) { return is_opened(a); });
    });
    if (nothing_opens) return polynomial;
    Polynomial result;
    for (const auto& [monomial, coefficient] : polynomial) {
      Monomial kept;
      Polynomial opened = constant(coefficient);
      for (const Atom& a : monomial) {
        if (is_opened(a)) {
          opened = opened * (*this)(graph_.power({graph_, a.base}, Number(a.p)).id());
        } else {
          kept.push_back(a);
        }
      }
      add(result, scaled(opened, kept, 1));
    }
    return result;
  }

  Graph& graph_;
  std::map<NodeId, Polynomial> done_;
};

std::optional<Monomial> exact_root(const Monomial& square) {
  Monomial root;
  for (const Atom& a : square) {
    if (a.q != 1 || a.p % 2 != 0) return std::nullopt;
    root.push_back({a.base, a.p / 2, 1});
  }
  return root;
}

}  // namespace

void add(Polynomial& sum, const Monomial& monomial, const Number& coefficient) {
  const auto [position, is_new] = sum.try_emplace(monomial, coefficient);
  if (is_new) return;
  position->second = position->second + coefficient;
  if (position->second.is_zero()) sum.erase(position);
}

void add(Polynomial& sum, const Polynomial& other, const Number& factor) {
  spend_work(other.size());
  for (const auto& [monomial, coefficient] : other) add(sum, monomial, coefficient * factor);
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.size() * b.size() > largest_polynomial)
    throw Error(
        ErrorCode::too_large,
        "An expression of this question grows too large: it would have more terms than one answer may take.");
  spend_work(a.size() * b.size());
  Polynomial product;
  for (const auto& [x, c] : a) {
    for (const auto& [y, d] : b) add(product, x * y, c * d);
  }
  return product;
}

Polynomial scaled(const Polynomial& a, const Monomial& monomial, const Number& coefficient) {
  spend_work(a.size());
  Polynomial result;
  for (const auto& [x, c] : a) result.emplace_hint(result.end(), x * monomial, c * coefficient);
  return result;
}

Polynomial multiplied_out(const Expression& e) { return Expander(e.graph()).whole(e); }

Expression to_expression(Graph& graph, const Monomial& monomial) {
  std::vector<Expression> factors;
  for (const Atom& a : monomial) factors.push_back(graph.power({graph, a.base}, Number::ratio(a.p, a.q)));
  return graph.product(factors);
}

namespace {

std::vector<Expression> terms_of(Graph& graph, const Polynomial& polynomial) {
  std::vector<Expression> terms;
  for (const auto& [monomial, coefficient] : polynomial)
    terms.push_back(coefficient * to_expression(graph, monomial));
  return terms;
}

}  // namespace

std::vector<Expression> terms_of(const Expression& e) { return terms_of(e.graph(), multiplied_out(e)); }

Expression to_expression(Graph& graph, const Polynomial& polynomial) {
  return graph.sum(terms_of(graph, polynomial));
}

Expression expand(const Expression& e) { return to_expression(e.graph(), multiplied_out(e)); }

Monomial common_monomial(const Polynomial& polynomial) {
  Monomial common = polynomial.begin()->first;
  for (const auto& [monomial, coefficient] : polynomial) {
    std::size_t kept = 0;
    auto b = monomial.begin();
    for (const Atom& a : common) {
      while (b != monomial.end() && b->base < a.base) ++b;
      if (b == monomial.end()) break;
      if (a.base != b->base || (a.p > 0) != (b->p > 0)) continue;
      const bool a_nearer_zero =
          has_less_exponent({a.base, std::abs(a.p), a.q}, {b->base, std::abs(b->p), b->q});
      common[kept++] = a_nearer_zero ? a : *b;
    }
    common.resize(kept);
    if (common.empty()) break;
  }
  return common;
}

namespace {

/// How far the exponents of a base reach from term to term.
struct Span {
  NodeId base{};
  int least{}, largest{};
  bool whole{true};  ///< they are all whole numbers
  std::size_t terms{};
};

/// Of each base; a term without it has the exponent 0.
std::vector<Span> exponent_spans(const Polynomial& polynomial) {
  std::vector<Span> spans;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      auto span = std::ranges::find(spans, atom.base, &Span::base);
      if (span == spans.end()) span = spans.insert(spans.end(), Span{atom.base, atom.p, atom.p});
      span->least = std::min(span->least, atom.p);
      span->largest = std::max(span->largest, atom.p);
      span->whole = span->whole && atom.q == 1;
      ++span->terms;
    }
  }
  for (Span& span : spans) {
    if (span.terms == polynomial.size()) continue;
    span.least = std::min(span.least, 0);
    span.largest = std::max(span.largest, 0);
  }
  return spans;
}

/// The degrees of factors add up, in every base and from both ends: what reaches farther than a is no factor.
bool may_be_factor(const Polynomial& b, const Polynomial& a) {
  const std::vector<Span> of_a = exponent_spans(a);
  return std::ranges::all_of(exponent_spans(b), [&](const Span& span) {
    if (!span.whole) return true;
    const int reach = span.largest - span.least;
    const auto found = std::ranges::find(of_a, span.base, &Span::base);
    if (found == of_a.end()) return reach == 0;
    return !found->whole || reach <= found->largest - found->least;
  });
}

}  // namespace

std::optional<Polynomial> exact_quotient(const Polynomial& a, const Polynomial& b) {
  Polynomial quotient;
  if (a.empty()) return quotient;
  if (!may_be_factor(b, a)) return std::nullopt;
  Polynomial rest = a;
  const Monomial leading_inverse = inverse(b.begin()->first);
  const Monomial last = a.rbegin()->first * inverse(b.rbegin()->first);
  const std::size_t most_terms = a.size() + b.size();
  while (!rest.empty()) {
    if (quotient.size() == most_terms || rest.size() > 4 * most_terms) return std::nullopt;
    const Monomial monomial = rest.begin()->first * leading_inverse;
    if (LeadingFirst()(last, monomial)) return std::nullopt;  // the last terms multiply, too
    const Number coefficient = rest.begin()->second / b.begin()->second;
    add(quotient, monomial, coefficient);
    add(rest, scaled(b, monomial, coefficient), Number(-1));
  }
  return quotient;
}

std::optional<Polynomial> exact_root(const Polynomial& a) {
  const auto monomial = exact_root(a.begin()->first);
  if (!monomial || !exact_root(a.rbegin()->first)) return std::nullopt;  // the last terms multiply, too
  const auto coefficient = exact_root(a.begin()->second);
  if (!coefficient) return std::nullopt;
  Polynomial root{{*monomial, *coefficient}};
  Polynomial rest = a;
  add(rest, scaled(root, *monomial, *coefficient), Number(-1));
  while (!rest.empty()) {  // (s + d)^2 = s^2 + 2 s d + d^2: the leading term of what is left is 2 s_0 d
    if (root.size() == a.size()) return std::nullopt;
    const Monomial next = rest.begin()->first * inverse(*monomial);
    const Number d = rest.begin()->second / (Number(2) * *coefficient);
    add(rest, scaled(root, next, Number(2) * d), Number(-1));
    add(rest, next * next, -(d * d));
    if (root.contains(next)) return std::nullopt;
    add(root, next, d);
  }
  return root;
}

}  // namespace qdot
