#include "core/expr/print/layout.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"

namespace qdot {
namespace {

Number magnitude(const Number& value) { return value.is_negative() ? -value : value; }

WrittenPower as_power(const Node& node, NodeId id) {
  const auto* power = std::get_if<Power>(&node);
  return power != nullptr ? WrittenPower{power->base, power->exponent} : WrittenPower{id, Number(1)};
}

/// The number in front of a node.
Number coefficient_of(const Node& node) {
  if (const auto* literal = std::get_if<Literal>(&node)) return literal->value;
  const auto* product = std::get_if<Product>(&node);
  return product != nullptr ? product->coefficient : Number(1);
}

std::weak_ordering compare_numbers(const Number& a, const Number& b) {
  if (a < b) return std::weak_ordering::less;
  return b < a ? std::weak_ordering::greater : std::weak_ordering::equivalent;
}

std::weak_ordering descending(double a, double b) {
  if (a == b) return std::weak_ordering::equivalent;
  return a > b ? std::weak_ordering::less : std::weak_ordering::greater;
}

}  // namespace

Layout::Layout(const Expression& e, const Notation& notation) : graph_(e.graph()), notation_(notation) {
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph_, root)) traits_.emplace(id, traits(id));
}

Layout::Traits Layout::traits(NodeId id) const {
  return std::visit(overloaded{[](const Literal&) { return Traits{}; },
                               [&](const Symbol& x) {
                                 Traits result;
                                 result.is_number = false;
                                 result.place = place_of(x.name, notation_);
                                 result.acceleration = result.place.role == Role::acceleration ? 1 : 0;
                                 result.velocity = result.place.role == Role::velocity ? 1 : 0;
                                 result.varies = result.place.role >= Role::coordinate;
                                 return result;
                               },
                               [&](const Sum& x) { return sum_traits(x); },
                               [&](const Product& x) { return product_traits(x); },
                               [&](const Power& x) { return power_traits(x); },
                               [&](const Call& x) {
                                 Traits result;
                                 result.is_number = traits_.at(x.argument).is_number;
                                 result.calls = true;
                                 result.varies = traits_.at(x.argument).varies;
                                 return result;
                               }},
                    graph_.node(id));
}

Layout::Traits Layout::sum_traits(const Sum& sum) const {
  Traits result;
  result.children = sum.terms;
  for (const NodeId id : sum.terms) {
    const Traits& term = traits_.at(id);
    if (std::tie(term.acceleration, term.velocity) > std::tie(result.acceleration, result.velocity)) {
      result.acceleration = term.acceleration;
      result.velocity = term.velocity;
    }
    result.is_number = result.is_number && term.is_number;
    result.calls = result.calls || term.calls;
    result.varies = result.varies || term.varies;
  }
  auto& terms = result.children;
  std::sort(terms.begin(), terms.end(), [&](NodeId a, NodeId b) { return compare_terms(a, b) < 0; });
  const auto positive =
      std::find_if_not(terms.begin(), terms.end(), [&](NodeId id) { return is_negative(id); });
  if (positive != terms.end()) std::rotate(terms.begin(), positive, positive + 1);
  return result;
}

Layout::Traits Layout::product_traits(const Product& product) const {
  Traits result;
  result.children = product.factors;
  for (const NodeId id : product.factors) {
    const Traits& factor = traits_.at(id);
    result.acceleration += factor.acceleration;
    result.velocity += factor.velocity;
    result.is_number = result.is_number && factor.is_number;
    result.calls = result.calls || factor.calls;
    result.varies = result.varies || factor.varies;
  }
  std::sort(result.children.begin(), result.children.end(),
            [&](NodeId a, NodeId b) { return compare_factors(a, b) < 0; });
  return result;
}

Layout::Traits Layout::power_traits(const Power& power) const {
  Traits result;
  const Traits& base = traits_.at(power.base);
  const double degree = std::max(power.exponent.value(), 0.0);
  result.acceleration = degree * base.acceleration;
  result.velocity = degree * base.velocity;
  result.is_number = base.is_number;
  result.calls = base.calls;
  result.varies = base.varies;
  return result;
}

/// What decides a factor's place in a product first. A bracket of numbers comes before everything, one of
/// parameters alone before the coordinates: (17 - sqrt(217))*g/l, (M + m)*x_ddot.
int Layout::rank(NodeId base) const {
  constexpr int bracket_of_parameters = 2 * static_cast<int>(Role::other) + 1;
  constexpr int after_symbols = 2 * static_cast<int>(Role::acceleration) + 1;
  const Traits& traits = traits_.at(base);
  return std::visit(
      overloaded{[](const Literal&) { return -2; },
                 [&](const Symbol&) { return 2 * static_cast<int>(traits.place.role); },
                 [](const Power&) { return after_symbols; }, [](const Call&) { return after_symbols + 1; },
                 [](const Product&) { return after_symbols + 2; },
                 [&](const Sum&) {
                   if (traits.is_number) return -1;
                   return traits.varies ? after_symbols + 3 : bracket_of_parameters;
                 }},
      graph_.node(base));
}

bool Layout::is_negative(NodeId term) const { return coefficient_of(graph_.node(term)).is_negative(); }

std::vector<NodeId> Layout::factors(NodeId id) const {
  const Node& node = graph_.node(id);
  if (std::holds_alternative<Product>(node)) return traits_.at(id).children;
  return std::holds_alternative<Literal>(node) ? std::vector<NodeId>{} : std::vector<NodeId>{id};
}

std::weak_ordering Layout::compare_terms(NodeId a, NodeId b) const {
  if (a == b) return std::weak_ordering::equivalent;
  const Traits& left = traits_.at(a);
  const Traits& right = traits_.at(b);
  if (const auto c = descending(left.acceleration, right.acceleration); c != 0) return c;
  if (const auto c = descending(left.velocity, right.velocity); c != 0) return c;
  const std::vector<NodeId> x = factors(a);
  const std::vector<NodeId> y = factors(b);
  if (const auto c = y.empty() <=> x.empty(); c != 0) return c;  // numbers first
  if (const auto c = left.calls <=> right.calls; c != 0) return c;
  if (const auto c = right.varies <=> left.varies; c != 0) return c;
  if (const auto c = x.size() <=> y.size(); c != 0) return c;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (const auto c = compare_factors(x[i], y[i]); c != 0) return c;
  }
  return compare_numbers(coefficient_of(graph_.node(a)), coefficient_of(graph_.node(b)));
}

std::weak_ordering Layout::compare_factors(NodeId a, NodeId b) const {
  if (a == b) return std::weak_ordering::equivalent;
  const WrittenPower x = as_power(graph_.node(a), a);
  const WrittenPower y = as_power(graph_.node(b), b);
  if (x.base != y.base) return compare_bases(x.base, y.base);
  const auto c = compare_numbers(x.exponent, y.exponent);
  return traits_.at(x.base).place.role == Role::velocity ? 0 <=> c : c;
}

// Different nodes differ, so the first pair of different children decides: this walks down one path only.
std::weak_ordering Layout::compare_bases(NodeId a, NodeId b) const {
  const Node& x = graph_.node(a);
  const Node& y = graph_.node(b);
  if (const auto c = rank(a) <=> rank(b); c != 0) return c;
  return std::visit(
      overloaded{[&](const Literal& l) { return compare_numbers(l.value, std::get<Literal>(y).value); },
                 [&](const Symbol& s) -> std::weak_ordering {
                   if (const auto c = traits_.at(a).place <=> traits_.at(b).place; c != 0) return c;
                   return s.name <=> std::get<Symbol>(y).name;
                 },
                 [&](const Sum&) -> std::weak_ordering {
                   const auto& left = traits_.at(a).children;
                   const auto& right = traits_.at(b).children;
                   for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
                     if (const auto c = compare_terms(left[i], right[i]); c != 0) return c;
                   }
                   return left.size() <=> right.size();
                 },
                 [&](const Product&) { return compare_terms(a, b); },
                 [&](const Power&) { return compare_factors(a, b); },
                 [&](const Call& call) -> std::weak_ordering {
                   const auto& other = std::get<Call>(y);
                   if (const auto c = call.function <=> other.function; c != 0) return c;
                   return compare_terms(call.argument, other.argument);
                 }},
      x);
}

bool Layout::is_compound(NodeId base) const {
  return std::visit(overloaded{[](const Literal& x) {
                                 return x.value.is_negative() ||
                                        !(x.value.is_integer() || prefers_decimal(x.value)) ||
                                        is_scientific(x.value);
                               },
                               [](const Symbol&) { return false; }, [](const Sum&) { return true; },
                               [](const Product&) { return true; }, [](const Power&) { return true; },
                               [](const Call&) { return false; }},
                    graph_.node(base));
}

WrittenTerm Layout::term(NodeId id) const {
  const Node& node = graph_.node(id);
  WrittenTerm result;
  const Number number = coefficient_of(node);
  result.negative = number.is_negative();
  result.over = magnitude(number);
  if (!prefers_decimal(result.over)) {
    result.under = result.over.denominator();
    result.over = result.over.numerator();
  }
  for (const NodeId factor : factors(id)) {
    const WrittenPower power = as_power(graph_.node(factor), factor);
    if (power.exponent.is_negative()) {
      result.below.push_back({power.base, -power.exponent});
    } else {
      result.above.push_back(power);
    }
  }
  return result;
}

std::optional<RaisedCall> Layout::raised(const Call& call) const {
  const auto is_logarithm = [&](const WrittenPower& power) {
    const auto* inner = std::get_if<Call>(&graph_.node(power.base));
    return inner != nullptr && inner->function == Function::log && power.exponent.is_one();
  };
  if (call.function != Function::exp || !std::holds_alternative<Product>(graph_.node(call.argument)))
    return std::nullopt;
  WrittenTerm exponent = term(call.argument);
  const auto logarithm = std::ranges::find_if(exponent.above, is_logarithm);
  if (logarithm == exponent.above.end()) return std::nullopt;
  const NodeId base = std::get<Call>(graph_.node(logarithm->base)).argument;
  exponent.above.erase(logarithm);
  if (exponent.above.empty() && exponent.below.empty()) return std::nullopt;  // x^2 has values for x < 0, too
  return RaisedCall{base, std::move(exponent)};
}

bool takes_inner_exponent(Function function) {
  return function != Function::exp && function != Function::log && function != Function::abs &&
         function != Function::sign;
}

bool is_bare(const Layout& layout, NodeId argument, bool bracket_follows) {
  return std::holds_alternative<Symbol>(layout.graph().node(argument)) && !bracket_follows;
}

std::string bounded(std::string written) {
  if (written.size() <= longest_print) return written;
  throw Error(ErrorCode::too_large, "the formula is too long to be written out");
}

}  // namespace qdot
