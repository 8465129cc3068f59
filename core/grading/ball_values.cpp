#include "core/grading/ball_values.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/work.hpp"

namespace qdot {
namespace {

constexpr double cancelled = 1e-20;  // of what cancels
constexpr double invisible = 1e-16;  // of the largest term

/// Where a function is so near to its limit that a ball cannot see its slope.
bool is_saturated(Function function, const Ball& argument) {
  const double x = argument.middle.high;
  switch (function) {
    case Function::exp:
      return x < -35 || x > 300;
    case Function::tanh:
      return std::abs(x) > 15;
    case Function::atan:
      return std::abs(x) > 1e6;
    case Function::sinh:
    case Function::cosh:
      return std::abs(x) > 300;
    default:
      return false;
  }
}

}  // namespace

BallValues::BallValues(std::span<const Expression> roots) : graph_(&roots.front().graph()) {
  std::vector<NodeId> ids;
  for (const Expression& root : roots) ids.push_back(root.id());
  order_ = reachable(*graph_, ids);
  values_.resize(order_.size(), Ball({}, infinity));
  for (std::size_t i = 0; i < order_.size(); ++i) {
    index_[order_[i]] = i;
    const auto* call = std::get_if<Call>(&graph_->node(order_[i]));
    const bool has_kink =
        call != nullptr && (call->function == Function::abs || call->function == Function::sign);
    if (has_kink) kinks_.emplace_back(*graph_, call->argument);
  }
}

void BallValues::set(const Expression& symbol, const Ball& value) {
  const auto found = index_.find(symbol.id());
  if (found != index_.end()) values_[found->second] = value;
}

void BallValues::evaluate() {
  spend_work(order_.size());
  is_evidence_ = true;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    if (!std::holds_alternative<Symbol>(graph_->node(order_[i]))) {
      values_[i] = value_of(order_[i]);
    } else if (std::get<Symbol>(graph_->node(order_[i])).name == "pi") {
      values_[i] = Ball::literal(exact_pi);
    }
  }
}

Ball BallValues::value_of(NodeId id) {
  return std::visit(
      overloaded{[&](const Literal& x) { return Ball::literal(x.value.rounded()); },
                 [&](const Symbol&) { return at(id); }, [&](const Sum& x) { return sum_of(x); },
                 [&](const Product& x) {
                   Ball product = Ball::literal(x.coefficient.rounded());
                   for (const NodeId factor : x.factors) product = product * at(factor);
                   return product;
                 },
                 [&](const Power& x) { return power_of(x); }, [&](const Call& x) { return call_of(x); }},
      graph_->node(id));
}

Ball BallValues::sum_of(const Sum& sum) {
  Ball total = at(sum.terms[0]);
  double largest = total.magnitude();
  for (std::size_t i = 1; i < sum.terms.size(); ++i) {
    total = total + at(sum.terms[i]);
    largest = std::max(largest, at(sum.terms[i]).magnitude());
  }
  for (const NodeId id : sum.terms) {
    const Ball& term = at(id);
    if (!term.contains_zero() && term.magnitude() < invisible * largest) is_evidence_ = false;
  }
  return total;
}

/// Whole powers and roots of them by products; others by the logarithm.
Ball BallValues::power_of(const Power& power) {
  const Ball& base = at(power.base);
  const auto fraction = power.exponent.small();
  const bool is_plain = fraction && fraction->denominator <= 2 && std::abs(fraction->numerator) <= 64;
  if (is_plain) {
    const double exponent =
        static_cast<double>(fraction->numerator) / static_cast<double>(fraction->denominator);
    return qdot::power(base, exponent);
  }
  if (!(base.middle.high > base.radius)) return {{}, infinity};
  return qdot::evaluate(Function::exp,
                        Ball::literal(power.exponent.rounded()) * qdot::evaluate(Function::log, base));
}

Ball BallValues::call_of(const Call& call) {
  const Ball& argument = at(call.argument);
  if (!argument.is_finite()) return argument;
  if (is_saturated(call.function, argument)) is_evidence_ = false;
  return qdot::evaluate(call.function, argument);
}

bool BallValues::vanishes(NodeId id) const {
  const Ball& value = at(id);
  if (!value.is_finite() || !value.contains_zero()) return false;
  if (value.is_zero()) return true;
  const auto vanishing = [&](NodeId child) { return vanishes(child); };
  return std::visit(overloaded{[](const Literal&) { return false; }, [](const Symbol&) { return false; },
                               [&](const Sum& x) {
                                 double size = 0;
                                 for (const NodeId term : x.terms) size += at(term).magnitude();
                                 return value.magnitude() <= cancelled * size ||
                                        std::ranges::all_of(x.terms, vanishing);
                               },
                               [&](const Product& x) { return std::ranges::any_of(x.factors, vanishing); },
                               [&](const Power& x) { return !x.exponent.is_negative() && vanishes(x.base); },
                               [&](const Call& x) { return vanishes(x.argument); }},
                    graph_->node(id));
}

}  // namespace qdot
