#include "core/expr/expression.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/bracket_memory.hpp"

namespace qdot {
namespace {

constexpr int largest_folded_exponent = 64;
constexpr std::size_t most_folded_bits = Number::most_bits / 2;

std::size_t mix(std::size_t seed, std::size_t value) {
  return seed ^ (value + 0x9e3779b97f4a7c15ULL + (seed << 6) + (seed >> 2));
}

std::size_t hash_of(const std::vector<NodeId>& ids, std::size_t seed) {
  for (const NodeId id : ids) seed = mix(seed, id);
  return seed;
}

std::size_t hash_of(const Node& node) {
  return std::visit(
      overloaded{[](const Literal& x) { return mix(1, x.value.hash()); },
                 [](const Symbol& x) { return mix(2, std::hash<std::string>{}(x.name)); },
                 [](const Sum& x) { return hash_of(x.terms, 3); },
                 [](const Product& x) { return hash_of(x.factors, mix(4, x.coefficient.hash())); },
                 [](const Power& x) { return mix(mix(5, x.base), x.exponent.hash()); },
                 [](const Call& x) { return mix(mix(6, static_cast<std::size_t>(x.function)), x.argument); }},
      node);
}

/// Numbers by node, in node order: the coefficients of terms, or the exponents of bases. There are few of
/// them most of the time, and they come in order.
class Collected {
 public:
  explicit Collected(std::size_t expected) { entries_.reserve(expected); }
  void add(NodeId id, const Number& number) { entries_.emplace_back(id, number); }

  /// Each node once, with the sum of its numbers.
  const std::vector<std::pair<NodeId, Number>>& together() {
    const auto earlier = [](const auto& a, const auto& b) { return a.first < b.first; };
    if (!std::ranges::is_sorted(entries_, earlier)) std::ranges::sort(entries_, earlier);
    std::size_t kept = 0;
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      if (entries_[i].first == entries_[kept].first) {
        entries_[kept].second = entries_[kept].second + entries_[i].second;
      } else if (++kept != i) {
        entries_[kept] = std::move(entries_[i]);
      }
    }
    if (!entries_.empty()) entries_.resize(kept + 1);
    return entries_;
  }

 private:
  std::vector<std::pair<NodeId, Number>> entries_;
};

void collect_terms(const Expression& e, Collected& terms) {
  if (const auto* sum = std::get_if<Sum>(&e.node())) {
    for (const NodeId id : sum->terms) collect_terms({e.graph(), id}, terms);
    return;
  }
  const auto [coefficient, rest] = split_coefficient(e);
  terms.add(rest.id(), coefficient);
}

void collect_factors(const Expression& e, Number& coefficient, Collected& factors) {
  if (const Number* number = e.number()) {
    coefficient = coefficient * *number;
  } else if (const auto* product = std::get_if<Product>(&e.node())) {
    coefficient = coefficient * product->coefficient;
    for (const NodeId id : product->factors) collect_factors({e.graph(), id}, coefficient, factors);
  } else {
    const auto [base, exponent] = split_power(e);
    factors.add(base.id(), exponent);
  }
}

bool leads_with_minus(const Expression& e) {
  if (const auto* sum = std::get_if<Sum>(&e.node())) {
    // A constant comes first in node order; the sign is that of the first term that varies.
    const std::size_t first = Expression(e.graph(), sum->terms[0]).number() != nullptr ? 1 : 0;
    return split_coefficient({e.graph(), sum->terms[first]}).coefficient.is_negative();
  }
  return split_coefficient(e).coefficient.is_negative();
}

/// The whole exponent to which a number is raised at once: not 0^-1, and nothing with too many digits.
std::optional<int> folded_exponent(const Number& base, const Number& exponent) {
  const auto whole = exponent.whole(largest_folded_exponent);
  if (!whole || (base.is_zero() && *whole < 0)) return std::nullopt;
  const auto size = static_cast<int>(std::abs(*whole));
  if (size > 1 && base.bits() * static_cast<std::size_t>(size) > most_folded_bits) return std::nullopt;
  return static_cast<int>(*whole);
}

}  // namespace

Graph::Graph() {
  (void)number(0);
  (void)number(1);
}

Graph::Graph(const Graph& other)
    : nodes_(other.nodes_), lengths_(other.lengths_), index_(other.index_), simplified_(other.simplified_) {}

Graph& Graph::operator=(const Graph& other) { return *this = Graph(other); }

Graph::Graph(Graph&&) noexcept = default;

Graph& Graph::operator=(Graph&&) noexcept = default;

Graph::~Graph() = default;

BracketMemory& Graph::brackets() {
  if (brackets_ == nullptr) brackets_ = std::make_unique<BracketMemory>();
  return *brackets_;
}

void Graph::forget_brackets() { brackets_.reset(); }

Expression Graph::intern(Node node) {
  const std::size_t hash = hash_of(node);
  const NodeId known = index_.find(hash, [&](NodeId id) { return nodes_[id] == node; });
  if (known != NodeIndex::none) return {*this, known};
  spend_work();
  if (nodes_.size() >= max_nodes) throw Error(ErrorCode::too_large, "the expressions grow too large");
  const auto id = static_cast<NodeId>(nodes_.size());
  lengths_.push_back(length_of(node, nodes_, lengths_));
  nodes_.push_back(std::move(node));
  index_.add(hash, id);
  return {*this, id};
}

std::optional<Expression> Graph::simplified(const Expression& e) {
  const auto found = simplified_.find(e.id());
  if (found == simplified_.end()) return std::nullopt;
  return Expression(*this, found->second);
}

Expression Graph::number(const Number& value) { return intern(Literal{value}); }

Expression Graph::symbol(std::string_view name) { return intern(Symbol{std::string(name)}); }

Expression Graph::sum(std::span<const Expression> terms) {
  Collected collected(terms.size());
  for (const Expression& term : terms) collect_terms(term, collected);
  std::vector<NodeId> ids;
  for (const auto& [rest, coefficient] : collected.together()) {
    if (!coefficient.is_zero()) ids.push_back((coefficient * Expression(*this, rest)).id());
  }
  if (ids.empty()) return number(0);
  if (ids.size() == 1) return {*this, ids[0]};
  const auto is_sum = [this](NodeId id) { return std::holds_alternative<Sum>(nodes_[id]); };
  if (std::any_of(ids.begin(), ids.end(), is_sum)) {  // 2 (x + y) - (x + y): flat again
    std::vector<Expression> again;
    for (const NodeId id : ids) again.emplace_back(*this, id);
    return sum(again);
  }
  return intern(Sum{std::move(ids)});
}

Expression Graph::product(std::span<const Expression> factors) {
  Number coefficient(1);
  Collected collected(2 * factors.size());
  for (const Expression& factor : factors) collect_factors(factor, coefficient, collected);
  std::vector<NodeId> ids;
  for (const auto& [base, exponent] : collected.together()) {
    if (exponent.is_zero()) continue;
    const Expression factor = power({*this, base}, exponent);
    if (const Number* folded = factor.number()) {  // sqrt(2) sqrt(2)
      coefficient = coefficient * *folded;
    } else {
      ids.push_back(factor.id());
    }
  }
  return scaled(coefficient, std::move(ids));
}

Expression Graph::scaled(const Number& coefficient, std::vector<NodeId> factors) {
  if (coefficient.is_zero()) return number(0);
  if (factors.empty()) return number(coefficient);
  if (factors.size() == 1 && coefficient.is_one()) return {*this, factors[0]};
  if (const auto* only = std::get_if<Sum>(&nodes_[factors[0]]);
      only != nullptr && factors.size() == 1 && coefficient == Number(-1)) {
    std::vector<Expression> terms;  // a sign goes into a sum: -(x - y) = y - x
    for (const NodeId id : only->terms) terms.push_back(-Expression(*this, id));
    return sum(terms);
  }
  return intern(Product{coefficient, std::move(factors)});
}

Expression Graph::power(const Expression& base, const Number& exponent) {
  if (exponent.is_zero()) return number(1);
  if (exponent.is_one()) return base;
  if (const Number* value = base.number()) {
    if (const auto whole = folded_exponent(*value, exponent)) return number(qdot::power(*value, *whole));
    if (value->is_one() || (value->is_zero() && !exponent.is_negative())) return base;
  }
  if (exponent.is_integer()) {  // (xy)^n and (x^a)^n distribute for integer n only
    if (const auto* inner = std::get_if<Power>(&base.node())) {
      return power({*this, inner->base}, inner->exponent * exponent);
    }
    if (const auto* inner = std::get_if<Call>(&base.node());
        inner != nullptr && inner->function == Function::abs && (exponent / Number(2)).is_integer())
      return power({*this, inner->argument}, exponent);
    if (const auto* inner = std::get_if<Product>(&base.node())) {
      std::vector<Expression> factors{power(number(inner->coefficient), exponent)};
      for (const NodeId id : inner->factors) factors.push_back(power({*this, id}, exponent));
      return product(factors);
    }
  }
  const auto is_even = [](const Number& n) { return (n / Number(2)).is_integer(); };
  if (const auto* inner = std::get_if<Power>(&base.node());
      inner != nullptr && is_even(inner->exponent) && is_even(inner->exponent * exponent))
    return power({*this, inner->base}, inner->exponent * exponent);  // (x^4)^(1/2)
  return intern(Power{base.id(), exponent});
}

namespace {

/// Whether it is no number and never negative: |u|, u^2.
bool is_size(const Expression& e) {
  const auto* call = std::get_if<Call>(&e.node());
  const auto* power = std::get_if<Power>(&e.node());
  return (call != nullptr && call->function == Function::abs) ||
         (power != nullptr && (power->exponent / Number(2)).is_integer());
}

struct SizeFactors {
  Expression sizes, others;
};

SizeFactors size_factors(const Expression& e) {
  Graph& graph = e.graph();
  const Expression one = graph.number(1);
  if (is_size(e)) return {e, one};
  const auto* found = std::get_if<Product>(&e.node());
  if (found == nullptr) return {one, e};
  const Product product = *found;
  std::vector<Expression> sizes, others;
  for (const NodeId id : product.factors) {
    const Expression factor(graph, id);
    (is_size(factor) ? sizes : others).push_back(factor);
  }
  if (sizes.empty()) return {one, e};
  if (others.empty()) {
    sizes.push_back(
        graph.number(product.coefficient.is_negative() ? -product.coefficient : product.coefficient));
    return {graph.product(sizes), one};
  }
  others.push_back(graph.number(product.coefficient));
  return {graph.product(sizes), graph.product(others)};
}

}  // namespace

Expression Graph::call(Function function, const Expression& argument) {
  const bool odd = function != Function::cos && function != Function::cosh && function != Function::abs &&
                   function != Function::exp && function != Function::log && function != Function::acos;
  const bool even = function == Function::cos || function == Function::cosh || function == Function::abs;
  if (argument.is_zero()) {
    if (odd) return argument;
    if (function == Function::cos || function == Function::cosh || function == Function::exp)
      return number(1);
  }
  if (function == Function::log && argument.is_one()) return number(0);
  if (function == Function::abs && argument.number() != nullptr)
    return argument.number()->is_negative() ? -argument : argument;
  const auto* within = std::get_if<Call>(&argument.node());
  if (function == Function::sign && within != nullptr && within->function == function) return argument;
  if (function == Function::abs) {
    const SizeFactors parts = size_factors(argument);
    if (parts.others.is_one()) return parts.sizes;
    if (!parts.sizes.is_one()) return call(function, parts.others) * parts.sizes;
  }
  if ((odd || even) && leads_with_minus(argument)) {
    const Expression mirrored = call(function, -argument);
    return odd ? -mirrored : mirrored;
  }
  return intern(Call{function, argument.id()});
}

const Node& Expression::node() const { return graph_->node(id_); }
bool Expression::is_zero() const { return id_ == 0; }
bool Expression::is_one() const { return id_ == 1; }

const Number* Expression::number() const {
  const auto* literal = std::get_if<Literal>(&node());
  return literal != nullptr ? &literal->value : nullptr;
}

Expression operator+(const Expression& a, const Expression& b) {
  const Expression terms[]{a, b};
  return a.graph().sum(terms);
}
Expression operator-(const Expression& a) { return Number(-1) * a; }
Expression operator-(const Expression& a, const Expression& b) { return a + -b; }
Expression operator*(const Expression& a, const Expression& b) {
  const Expression factors[]{a, b};
  return a.graph().product(factors);
}
Expression operator/(const Expression& a, const Expression& b) { return a * pow(b, Number(-1)); }

Expression operator*(const Number& a, const Expression& b) {
  if (a.is_one()) return b;
  Graph& graph = b.graph();
  const Expression number = graph.number(a);
  const auto* product = std::get_if<Product>(&b.node());
  return product != nullptr ? graph.scaled(a * product->coefficient, product->factors) : number * b;
}

Scaled split_coefficient(const Expression& e) {
  if (const Number* number = e.number()) return {*number, e.graph().number(1)};
  const auto* product = std::get_if<Product>(&e.node());
  if (product == nullptr || product->coefficient.is_one()) return {Number(1), e};
  return {product->coefficient, e.graph().scaled(Number(1), product->factors)};
}

Raised split_power(const Expression& e) {
  if (const auto* power = std::get_if<Power>(&e.node())) return {{e.graph(), power->base}, power->exponent};
  return {e, Number(1)};
}

Expression pow(const Expression& base, const Number& exponent) { return base.graph().power(base, exponent); }

Expression pow(const Expression& base, const Expression& exponent) {
  if (const Number* number = exponent.number()) return pow(base, *number);
  return base.graph().call(Function::exp, exponent * base.graph().call(Function::log, base));
}

Expression sqrt(const Expression& e) { return pow(e, Number::ratio(1, 2)); }
Expression sin(const Expression& e) { return e.graph().call(Function::sin, e); }
Expression cos(const Expression& e) { return e.graph().call(Function::cos, e); }

std::size_t written_length(const Expression& e) {
  const Length length = e.graph().length(e.id());
  return 2 * length.operations + length.fractions;
}

std::span<const NodeId> children(const Node& node) {
  using Children = std::span<const NodeId>;
  return std::visit(
      overloaded{[](const Literal&) { return Children(); }, [](const Symbol&) { return Children(); },
                 [](const Sum& x) { return Children(x.terms); },
                 [](const Product& x) { return Children(x.factors); },
                 [](const Power& x) { return Children(&x.base, 1); },
                 [](const Call& x) { return Children(&x.argument, 1); }},
      node);
}

std::vector<NodeId> reachable(const Graph& graph, std::span<const NodeId> roots) {
  if (roots.empty()) return {};
  constexpr std::size_t bits = 64;
  std::vector<std::uint64_t> seen(*std::max_element(roots.begin(), roots.end()) / bits + 1);
  const auto mark = [&](NodeId id) { seen[id / bits] |= std::uint64_t{1} << (id % bits); };
  for (const NodeId root : roots) mark(root);
  std::vector<NodeId> found;
  for (std::size_t word = seen.size(); word-- > 0;) {  // parents before children: the marks spread downwards
    while (seen[word] != 0) {
      const auto top = static_cast<std::size_t>(std::bit_width(seen[word])) - 1;
      seen[word] ^= std::uint64_t{1} << top;
      const auto id = static_cast<NodeId>(word * bits + top);
      found.push_back(id);
      for (const NodeId child : children(graph.node(id))) mark(child);
    }
  }
  std::reverse(found.begin(), found.end());
  return found;
}

bool depends_on(const Expression& e, std::span<const Expression> symbols) {
  const NodeId root[]{e.id()};
  const auto below = reachable(e.graph(), root);
  return std::any_of(symbols.begin(), symbols.end(), [&](const Expression& symbol) {
    return std::binary_search(below.begin(), below.end(), symbol.id());
  });
}

bool depends_on(const Expression& e, const Expression& symbol) {
  return depends_on(e, std::span<const Expression>(&symbol, 1));
}

}  // namespace qdot
