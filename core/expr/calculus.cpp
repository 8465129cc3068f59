#include "core/expr/calculus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/numerics/ball.hpp"

namespace qdot {
namespace {

/// df/du of a function of one argument u.
Expression slope(Function function, const Expression& u) {
  Graph& graph = u.graph();
  const Expression one = graph.number(1);
  switch (function) {
    case Function::sin:
      return cos(u);
    case Function::cos:
      return -sin(u);
    case Function::tan:
      return one + pow(graph.call(Function::tan, u), Number(2));
    case Function::asin:
      return pow(one - u * u, Number::ratio(-1, 2));
    case Function::acos:
      return -pow(one - u * u, Number::ratio(-1, 2));
    case Function::atan:
      return pow(one + u * u, Number(-1));
    case Function::sinh:
      return graph.call(Function::cosh, u);
    case Function::cosh:
      return graph.call(Function::sinh, u);
    case Function::tanh:
      return one - pow(graph.call(Function::tanh, u), Number(2));
    case Function::exp:
      return graph.call(Function::exp, u);
    case Function::log:
      return pow(u, Number(-1));
    case Function::abs:
      return graph.call(Function::sign, u);
    case Function::sign:
      return graph.number(0);
  }
  return one;  // not reached: the switch is complete
}

/// Rebuilds e bottom-up; `leaf` maps symbols and literals.
class Rebuilder {
 public:
  Rebuilder(Graph& graph, std::span<const Replacement> replacements) : graph_(graph) {
    for (const auto& [symbol, replacement] : replacements) done_[symbol.id()] = replacement;
  }

  Expression operator()(const Expression& e) {
    const NodeId root[]{e.id()};
    for (const NodeId id : reachable(graph_, root)) {
      if (!done_.contains(id)) done_[id] = rebuilt(id);
    }
    return done_.at(e.id());
  }

 private:
  std::vector<Expression> all(const std::vector<NodeId>& ids) {
    std::vector<Expression> result;
    for (const NodeId id : ids) result.push_back(done_.at(id));
    return result;
  }

  Expression rebuilt(NodeId id) {
    return std::visit(
        overloaded{[&](const Literal&) { return Expression(graph_, id); },
                   [&](const Symbol&) { return Expression(graph_, id); },
                   [&](const Sum& x) { return graph_.sum(all(x.terms)); },
                   [&](const Product& x) { return x.coefficient * graph_.product(all(x.factors)); },
                   [&](const Power& x) { return graph_.power(done_.at(x.base), x.exponent); },
                   [&](const Call& x) { return graph_.call(x.function, done_.at(x.argument)); }},
        graph_.node(id));
  }

  Graph& graph_;
  std::map<NodeId, Expression> done_;
};

/// Derivatives of the nodes below e, bottom-up.
class Differentiator {
 public:
  Differentiator(Graph& graph, const Expression& symbol) : graph_(graph), symbol_(symbol) {}

  Expression operator()(const Expression& e) {
    const NodeId root[]{e.id()};
    for (const NodeId id : reachable(graph_, root)) done_[id] = derivative(id);
    return done_.at(e.id());
  }

 private:
  Expression of(const Sum& x) {
    std::vector<Expression> terms;
    for (const NodeId id : x.terms) terms.push_back(done_.at(id));
    return graph_.sum(terms);
  }

  Expression of(const Product& x) {
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < x.factors.size(); ++i) {
      const Expression changed = done_.at(x.factors[i]);
      if (changed.is_zero()) continue;
      std::vector<Expression> factors{graph_.number(x.coefficient), changed};
      for (std::size_t j = 0; j < x.factors.size(); ++j) {
        if (j != i) factors.emplace_back(graph_, x.factors[j]);
      }
      terms.push_back(graph_.product(factors));
    }
    return graph_.sum(terms);
  }

  Expression of(const Power& x) {
    if (done_.at(x.base).is_zero()) return graph_.number(0);
    return x.exponent * graph_.power({graph_, x.base}, x.exponent - Number(1)) * done_.at(x.base);
  }

  Expression of(const Call& x) {
    if (done_.at(x.argument).is_zero()) return graph_.number(0);
    return slope(x.function, {graph_, x.argument}) * done_.at(x.argument);
  }

  Expression of(const Literal&) { return graph_.number(0); }
  Expression of(const Symbol&) { return graph_.number(0); }

  Expression derivative(NodeId id) {
    if (id == symbol_.id()) return graph_.number(1);
    return std::visit([&](const auto& x) { return of(x); }, graph_.node(id));
  }

  Graph& graph_;
  Expression symbol_;
  std::map<NodeId, Expression> done_;
};

}  // namespace

Expression differentiate(const Expression& e, const Expression& symbol) {
  return Differentiator(e.graph(), symbol)(e);
}

Expression substitute(const Expression& e, std::span<const Replacement> replacements) {
  return Rebuilder(e.graph(), replacements)(e);
}

Expression total_derivative(const Expression& e, std::span<const Replacement> rates) {
  std::vector<Expression> terms;
  for (const auto& [x, rate] : rates) {
    if (depends_on(e, x)) terms.push_back(differentiate(e, x) * rate);
  }
  return e.graph().sum(terms);
}

namespace {

double literal(double, const Real& x) { return x.value; }
Ball literal(const Ball&, const Real& x) { return Ball::literal(x); }

/// In doubles or in balls: bottom-up over the nodes. `values`: of symbols, of which the last counts.
template <class T, class Value>
T evaluated(const Expression& e, std::span<const std::pair<Expression, Value>> values, const T& unknown) {
  const Graph& graph = e.graph();
  const NodeId root[]{e.id()};
  const std::vector<NodeId> nodes = reachable(graph, root);  // by their numbers
  std::vector<T> done;
  done.reserve(nodes.size());
  const auto at = [&](NodeId id) -> const T& {
    return done[static_cast<std::size_t>(std::ranges::lower_bound(nodes, id) - nodes.begin())];
  };
  const auto number = [](const Number& x) { return literal(T{}, x.rounded()); };
  const auto value_of =
      overloaded{[&](const Literal& x) { return number(x.value); },
                 [&](const Symbol& x) { return x.name == "pi" ? literal(T{}, exact_pi) : unknown; },
                 [&](const Sum& x) {
                   T sum = at(x.terms[0]);
                   for (std::size_t i = 1; i < x.terms.size(); ++i) sum = sum + at(x.terms[i]);
                   return sum;
                 },
                 [&](const Product& x) {
                   T product = number(x.coefficient);
                   for (const NodeId id : x.factors) product = product * at(id);
                   return product;
                 },
                 [&](const Power& x) { return qdot::power(at(x.base), number(x.exponent)); },
                 [&](const Call& x) { return qdot::evaluate(x.function, at(x.argument)); }};
  for (const NodeId id : nodes) {
    const auto given = std::find_if(values.rbegin(), values.rend(),
                                    [&](const auto& value) { return value.first.id() == id; });
    done.push_back(given != values.rend() ? literal(T{}, given->second)
                                          : std::visit(value_of, graph.node(id)));
  }
  return done.back();
}

}  // namespace

double evaluate(const Expression& e, std::span<const Assignment> values) {
  return evaluated(e, values, std::numeric_limits<double>::quiet_NaN());
}

namespace {

Ball enclosed(const Expression& e, std::span<const RealAssignment> values) {
  return evaluated(e, values, Ball({}, infinity));
}

}  // namespace

Real evaluate_exactly(const Expression& e, std::span<const RealAssignment> values) {
  if (const Number* number = e.number()) return number->rounded();
  const Ball result = enclosed(e, values);
  if (result.is_finite()) return result.real();
  return evaluated(e, values, std::numeric_limits<double>::quiet_NaN());
}

bool is_bounded(const Expression& e, std::span<const RealAssignment> values) {
  return enclosed(e, values).is_finite();
}

}  // namespace qdot
