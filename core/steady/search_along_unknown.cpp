#include "core/steady/search_along_unknown.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/compile/tape_builder.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"
#include "core/numerics/root_isolation.hpp"
#include "core/steady/search_region.hpp"
#include "core/steady/values_along_unknown.hpp"

namespace qdot {
namespace {

class UnknownSearch {
 public:
  UnknownSearch(const BalanceProblem& problem, std::size_t k)
      : problem_(problem),
        polynomial_(*problem.polynomial),
        k_(k),
        graph_(*polynomial_.graph),
        u_(graph_.symbol(problem.unknown)),
        has_other_ends_(has_other_ends(problem, k)) {}

  Candidates run() {
    const Domain& domain = problem_.domain;
    Interval region{std::max(domain.lower, -largest_length), std::min(domain.upper, largest_length)};
    const std::vector<HalfLine> ends = half_lines(problem_, graph_, k_);
    const HalfLine *first = inner_end(ends, 1), *last = inner_end(ends, -1);
    if (first != nullptr) region.lower = std::max(region.lower, first->place.lower);
    if (last != nullptr) region.upper = std::min(region.upper, last->place.upper);
    if (is_empty(region)) return none();
    const bool from_both = first != nullptr && last != nullptr;
    const double middle = from_both ? region.middle() : 0;
    if (first != nullptr) search_from(*first, from_both ? middle : region.upper);
    if (last != nullptr) search_from(*last, from_both ? middle : region.lower);
    if (ends.empty()) search_line(polynomial_.u_turns ? intersection({-3.2, 3.2}, region) : region);
    if (!is_told_) return {has_other_ends_ ? Obstacle::may_end : Obstacle::not_decided, {}, "", 0};
    return found_.values.empty() ? none() : std::move(found_);
  }

 private:
  [[nodiscard]] static Candidates none() { return {Obstacle::none_in_domain, {}, "", 0}; }

  /// Of the half-lines to that side the one that holds the fewest values.
  [[nodiscard]] static const HalfLine* inner_end(std::span<const HalfLine> ends, int direction) {
    const HalfLine* inner = nullptr;
    for (const HalfLine& line : ends) {
      if (line.direction != direction) continue;
      if (inner == nullptr || direction * line.place.middle() > direction * inner->place.middle())
        inner = &line;
    }
    return inner;
  }

  [[nodiscard]] Isolation zeros(const CompiledFunction& value, const CompiledFunction& slope,
                                std::size_t output, const Interval& region) const {
    TapeEvaluator<Interval> values(value, problem_.constants), slopes(slope, problem_.constants);
    std::vector<Interval> place = problem_.x, out(value.outputs());
    place.emplace_back();
    const auto along = [&](TapeEvaluator<Interval>& function) {
      return [&](std::span<const Interval> u, std::span<Interval> result) {
        place.back() = u[0];
        function(place, out);
        result[0] = out[output];
      };
    };
    return isolate_zeros({1, along(values), along(slopes)}, {region});
  }

  /// A turn and a little more, where that is all.
  void search_line(const Interval& region) {
    const Isolation isolation = zeros(polynomial_.values, polynomial_.derivatives, k_, region);
    take(isolation, [&](const IsolatedZero& zero) {
      const Interval u = zero.enclosure[0];
      return std::optional(BalancingValue{polynomial_.u_turns ? reduced_angle(u) : u, zero.simple});
    });
  }

  void search_from(const HalfLine& line, double to) {
    const Expression s = graph_.symbol("distance from the end");
    const Expression square = Number(line.direction) * pow(s, Number(2));
    const Expression e = from_end(line, s, square);
    const CompiledFunction value = compiled(e, s), slope = compiled(simplify(differentiate(e, s)), s);
    const Interval reach = Interval(line.direction) * (Interval(to) - line.place);
    if (reach.upper < 0) return;
    const Replacement end{s, graph_.number(0)};
    const bool is_zero_at_end = simplify(substitute(e, {&end, 1})).is_zero();
    const Isolation isolation = zeros(value, slope, 0, {0, std::sqrt(reach.upper) * (1 + 1e-15)});
    take(isolation, [&](const IsolatedZero& zero) {
      const Interval at = intersection(zero.enclosure[0], {0, infinity});
      if (is_empty(at)) return std::optional<BalancingValue>();
      const bool is_told = is_zero_at_end || at.lower > 0;
      const Interval u = line.place + Interval(line.direction) * qdot::square(at);
      return std::optional(BalancingValue{u, zero.simple && is_told});
    });
  }

  [[nodiscard]] Expression from_end(const HalfLine& line, const Expression& s, const Expression& square) {
    std::vector<Replacement> replacements{{u_, line.end + square}, {line.argument, line.slope * square}};
    const Expression e = graph_.adopt(polynomial_.whole[k_]);
    const Expression rise = Number(line.direction) * line.slope;
    const NodeId root = e.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power == nullptr || power->base != line.argument.id()) continue;
      const Number exponent = power->exponent;
      replacements.emplace_back(Expression(graph_, id), pow(rise, exponent) * pow(s, Number(2) * exponent));
    }
    return simplify(substitute(e, replacements));
  }

  [[nodiscard]] CompiledFunction compiled(const Expression& e, const Expression& s) {
    const Reduction& reduction = problem_.reduction();
    std::vector<Expression> constants, variables;
    for (const Parameter& p : problem_.scene().parameters) constants.push_back(graph_.symbol(p.name));
    for (const std::size_t c : reduction.ignored)
      constants.push_back(graph_.symbol(problem_.scene().coordinates[c].name + "_dot"));
    for (const Expression& x : reduction.x) variables.push_back(graph_.adopt(x));
    variables.push_back(s);
    TapeBuilder tape(graph_, constants, graph_.symbol("t"), variables);
    tape.output(e);
    return tape.finish();
  }

  /// Where values end unseen, what has no bound may be an end with a zero.
  template <class Value>
  void take(const Isolation& isolation, const Value& value_of) {
    if (!isolation.complete || !isolation.undecided.empty()) is_told_ = false;
    if (has_other_ends_ && !isolation.poles.empty()) is_told_ = false;
    for (const IsolatedZero& zero : isolation.zeros) {
      const std::optional<BalancingValue> value = value_of(zero);
      const auto is_same = [&](const BalancingValue& other) {
        return !is_empty(intersection(other.u, value->u));
      };
      if (value && std::ranges::none_of(found_.values, is_same)) found_.values.push_back(*value);
    }
  }

  const BalanceProblem& problem_;
  const SteadyPolynomial& polynomial_;
  std::size_t k_;
  Graph graph_;
  Expression u_;
  bool has_other_ends_, is_told_{true};
  Candidates found_;
};

}  // namespace

Candidates search_along_unknown(const BalanceProblem& problem, std::size_t k) {
  return UnknownSearch(problem, k).run();
}

}  // namespace qdot
