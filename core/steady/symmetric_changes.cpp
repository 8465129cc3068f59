#include "core/steady/symmetric_changes.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/zeroness.hpp"
#include "core/symmetry/symmetries.hpp"

namespace qdot {
namespace {

/// L = -U, as of a system without mass, in a graph of its own.
Lagrangian massless(const Reduction& reduction) {
  auto graph = std::make_shared<Graph>(*reduction.graph);
  const auto adopted = [&](const std::vector<Expression>& symbols) {
    std::vector<Expression> result;
    for (const Expression& symbol : symbols) result.push_back(graph->adopt(symbol));
    return result;
  };
  Lagrangian result;
  result.symbols.coordinates = {adopted(reduction.x), adopted(reduction.x_dot), adopted(reduction.x_ddot)};
  result.symbols.t = graph->symbol("t");
  result.symbols.parameters = adopted(reduction.constants);
  result.lagrangian = result.varied = graph->adopt(at_rest(reduction, reduction.routhian));
  result.generalized_forces.assign(reduction.x.size(), graph->number(0));
  result.graph = std::move(graph);
  return result;
}

bool is_potential_of(const Lagrangian& massless, const std::vector<Expression>& forces) {
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Expression slope = differentiate(massless.lagrangian, massless.symbols.coordinates.value[i]);
    if (zeroness(massless.graph->adopt(forces[i]) + slope) != Zeroness::zero) return false;
  }
  return true;
}

/// With the potential of steady forces, such as balanced torques: those that are the same in all places.
Lagrangian with_steady_forces(Lagrangian own, const std::vector<Expression>& forces) {
  const std::vector<Expression>& x = own.symbols.coordinates.value;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Expression slope = differentiate(own.lagrangian, x[i]);
    const Expression steady = simplify(own.graph->adopt(forces[i]) + slope);
    if (!steady.is_zero() && !depends_on(steady, x)) own.lagrangian = own.lagrangian - steady * x[i];
  }
  own.varied = own.lagrangian;
  return own;
}

/// None where there are none that can be used.
std::optional<SymmetrySearch> searched(const Statics& statics) {
  try {
    if (statics.rest.size() < 2) return std::nullopt;
    const Lagrangian own = with_steady_forces(massless(statics.reduction), statics.rest);
    if (!is_potential_of(own, statics.rest)) return std::nullopt;
    SymmetrySearch search = symmetries_of_places(own);
    return search.found.empty() ? std::nullopt : std::optional(std::move(search));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return std::nullopt;
  }
}

enum class Moves { all_places_alike, by_place };

std::vector<WrittenChange> written_changes(const Statics& statics, Moves asked) {
  std::vector<WrittenChange> result;
  const std::optional<SymmetrySearch> search = searched(statics);
  if (!search) return result;
  const std::vector<Expression>& x = search->lagrangian.symbols.coordinates.value;
  for (const Symmetry& symmetry : search->found) {
    const std::vector<Expression>& shift = symmetry.change.shift;
    const bool by_place = std::ranges::any_of(shift, [&](const Expression& e) { return depends_on(e, x); });
    if (by_place != (asked == Moves::by_place)) continue;
    WrittenChange& written = result.emplace_back();
    for (std::size_t i = 0; i < shift.size(); ++i) {
      if (!shift[i].is_zero()) written.emplace_back(i, print(shift[i], Form::text));
    }
  }
  return result;
}

}  // namespace

std::optional<CompiledFunction> symmetric_changes(const Statics& statics) {
  const std::optional<SymmetrySearch> search = searched(statics);
  if (!search) return std::nullopt;
  std::vector<Expression> changes;
  for (const Symmetry& symmetry : search->found)
    changes.insert(changes.end(), symmetry.change.shift.begin(), symmetry.change.shift.end());
  return compiled_at_rest(statics.reduction, *search->lagrangian.graph, changes);
}

std::vector<WrittenChange> symmetric_shifts(const Statics& statics) {
  return written_changes(statics, Moves::all_places_alike);
}

std::vector<WrittenChange> symmetric_turns(const Statics& statics) {
  return written_changes(statics, Moves::by_place);
}

}  // namespace qdot
