#include "core/steady/normal_form.hpp"

#include <algorithm>

#include "core/compile/tape_evaluator.hpp"

namespace qdot {
namespace {

enum Higher : std::size_t { xx, xp, xxx };

Box evaluated_at(const CompiledFunction& function, const SteadyProblem& problem, const Interval& x,
                 const Interval& p) {
  Box result(function.outputs());
  TapeEvaluator<Interval>(function, problem.constants)(Box{x, p}, result);
  return result;
}

}  // namespace

SymmetryAxes::SymmetryAxes(const SteadyProblem& problem, const BifurcationSystems& systems,
                           const Interval& range)
    : problem_(problem), systems_(systems) {
  if (systems.centres.outputs() == 0) return;
  for (const Interval& centre : evaluated_at(systems.centres, problem, 0, range)) search(centre, range);
}

Box SymmetryAxes::derivatives(const CompiledFunction& function, const Interval& x, const Interval& p) {
  return evaluated_at(function, problem_, x, p);
}

/// N_x = 0 on the axis x = centre, which is an equilibrium for every p.
void SymmetryAxes::search(const Interval& centre, const Interval& range) {
  const SquareSystem system{
      1, [&](auto p, auto out) { out[0] = derivatives(systems_.slopes, centre, p[0])[0]; },
      [&](auto p, auto out) { out[0] = derivatives(systems_.higher, centre, p[0])[xp]; }};
  const Isolation isolation = isolate_zeros(system, {range});
  complete_ = complete_ && isolation.complete && isolation.undecided.empty() && isolation.poles.empty();
  for (const IsolatedZero& zero : isolation.zeros) {
    const Interval& p = zero.enclosure[0];
    if (is_empty(intersection(p, range))) continue;
    const bool cubic = !derivatives(systems_.higher, centre, p)[xxx].contains(0.0);
    const bool pitchfork = zero.simple && cubic;
    const Interval x = problem_.forces->turns[systems_.unknowns[0]] ? reduced_angle(centre) : centre;
    found_.push_back(
        {pitchfork ? BifurcationKind::pitchfork : BifurcationKind::unresolved, x, p, zero.simple});
  }
}

/// With y = x - x0 and N = N_x = 0 at y != 0 the expansions of the odd N demand N_xxx(a) = 3 N_xxx(b) for
/// some a and b between; and on the axis N_x vanishes once where N_xp has one sign.
bool SymmetryAxes::is_alone(const Interval& x, const Interval& p) {
  const Box d = derivatives(systems_.higher, x, p);
  return !d[xp].contains(0.0) && !d[xxx].contains(0.0) && d[xxx].magnitude() < 3 * d[xxx].least_magnitude();
}

bool SymmetryAxes::explain(std::span<const Interval> box) {
  return std::ranges::any_of(found_, [&](const NormalForm& form) {
    const Interval x = hull(form.x, box[0]);
    const Interval p = hull(form.p, box[1]);
    return form.kind == BifurcationKind::pitchfork && is_alone(x, p);
  });
}

bool is_saddle_node(const SteadyProblem& problem, const BifurcationSystems& systems,
                    const CriticalZero& fold) {
  if (!fold.simple || fold.kind != BifurcationSystem::Kind::fold) return false;
  return !evaluated_at(systems.higher, problem, fold.x[0], fold.p)[xx].contains(0.0);
}

bool is_transcritical(const SteadyProblem& problem, const BifurcationSystems& systems,
                      const CriticalZero& crossing) {
  if (!crossing.simple || crossing.kind != BifurcationSystem::Kind::meeting) return false;
  return !evaluated_at(systems.higher, problem, crossing.x[0], crossing.p)[xx].contains(0.0);
}

}  // namespace qdot
