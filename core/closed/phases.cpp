#include "core/closed/phases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// The argument of sines and cosines, slope x + offset, and a symbol for it.
struct Phase {
  Expression u, argument, slope, offset;
};

template <class Change>
void change_all(LinearMotions& motions, const Change& change) {
  for (auto* list : {&motions.forces, &motions.surface})
    for (Expression& e : *list) e = change(e);
  for (Matrix* matrix : {&motions.mass, &motions.stiffness, &motions.damping, &motions.following_rates,
                         &motions.following_slopes}) {
    for (auto& row : *matrix)
      for (Expression& e : row) e = change(e);
  }
}

class PhaseSearch {
 public:
  PhaseSearch(const LinearMotions& motions, std::size_t k) : x_(motions.x[k]), all_(motions.x) {
    LinearMotions copy = motions;
    change_all(copy, [&](const Expression& e) {
      roots_.push_back(e.id());
      return e;
    });
  }

  /// The slowest phase, of which all others are whole multiples.
  [[nodiscard]] std::optional<Phase> found() const {
    Graph& graph = x_.graph();
    std::optional<Phase> slowest;
    std::vector<Expression> slopes;
    for (const NodeId id : reachable(graph, roots_)) {
      const auto argument = argument_of(id);
      if (!argument) continue;
      const Expression slope = differentiate(*argument, x_), offset = at_zero(*argument);
      if (depends_on(slope, all_) || depends_on(offset, all_)) return std::nullopt;
      const auto times = slowest ? ratio(slope, slowest->slope) : std::nullopt;
      if (slowest && !times) return std::nullopt;
      slopes.push_back(slope);
      if (!slowest || std::abs(times->rounded().value) < 1)
        slowest = Phase{graph.symbol("phase of " + print(x_, Form::text)), *argument, slope, offset};
    }
    const auto is_multiple = [&](const Expression& slope) {
      const auto times = ratio(slope, slowest->slope);
      return times && times->is_integer();
    };
    return slowest && std::ranges::all_of(slopes, is_multiple) ? slowest : std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<Expression> argument_of(NodeId id) const {
    const auto* call = std::get_if<Call>(&x_.graph().node(id));
    if (call == nullptr || (call->function != Function::sin && call->function != Function::cos))
      return std::nullopt;
    const Expression argument(x_.graph(), call->argument);
    return depends_on(argument, x_) ? std::optional(argument) : std::nullopt;
  }
  [[nodiscard]] Expression at_zero(const Expression& e) const {
    const Replacement zero{x_, e.graph().number(0)};
    return substitute(e, {&zero, 1});
  }
  [[nodiscard]] static std::optional<Number> ratio(const Expression& a, const Expression& b) {
    const Expression quotient = simplify(a / b);
    return quotient.number() ? std::optional(*quotient.number()) : std::nullopt;
  }

  Expression x_;
  const std::vector<Expression>& all_;
  std::vector<NodeId> roots_;
};

/// Whether u stands outside sines and cosines.
bool stands_outside(const Expression& e, const Expression& u) {
  std::vector<Replacement> calls;
  const NodeId root = e.id();
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const auto* call = std::get_if<Call>(&e.graph().node(id));
    if (call != nullptr && (call->function == Function::sin || call->function == Function::cos))
      calls.emplace_back(Expression(e.graph(), id), e.graph().number(1));
  }
  return depends_on(substitute(e, calls), u);
}

/// What is said of places in a domain speaks of coordinates, not of phases.
bool is_anywhere(const LinearMotions& motions, const ExactValues& values, std::size_t k) {
  const auto& coordinates = values.model().scene.coordinates;
  if (k >= motions.moving.size() || motions.moving[k] >= coordinates.size()) return false;
  const Domain& domain = coordinates[motions.moving[k]].domain;
  return std::isinf(domain.lower) && std::isinf(domain.upper);
}

}  // namespace

std::optional<ByPhases> by_phases(const LinearMotions& motions, const ExactValues& values,
                                  std::span<const Interval> near) {
  ByPhases result{motions, {near.begin(), near.end()}, {}, motions.x};
  for (std::size_t k = 0; k < motions.x.size(); ++k) {
    if (motions.units[k] == "rad" || !is_anywhere(motions, values, k)) continue;
    const auto phase = PhaseSearch(result.motions, k).found();
    if (!phase) continue;
    const Replacement by_phase{motions.x[k], (phase->u - phase->offset) / phase->slope};
    LinearMotions changed = result.motions;
    bool stays = false;
    change_all(changed, [&](const Expression& e) {
      const Expression by_u = substitute(e, {&by_phase, 1});
      stays = stays || stands_outside(by_u, phase->u);
      return by_u;
    });
    const Real value = values.value(phase->argument);
    if (stays || !value.is_finite()) continue;
    const double turns = std::round(value.value / (2 * std::numbers::pi));
    const double reach = value.error + 4e-16 * (1 + std::abs(value.value));
    const double middle = value.value - turns * 2 * std::numbers::pi;
    const Expression whole_turns = Number::real(2 * turns) * phase->u.graph().symbol("pi");
    changed.x[k] = phase->u;
    changed.units[k] = "rad";
    result.motions = std::move(changed);
    result.near[k] = Interval(middle - reach, middle + reach);
    result.phases.emplace_back(phase->u, phase->argument - whole_turns);
    result.x[k] = simplify((phase->u + whole_turns - phase->offset) / phase->slope);
  }
  return result.phases.empty() ? std::nullopt : std::optional(std::move(result));
}

}  // namespace qdot
