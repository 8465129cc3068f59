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
  for (std::size_t axis = 0; axis < systems.centres.outputs(); ++axis) search(axis, range);
}

Interval SymmetryAxes::centre(std::size_t axis, const Interval& p) const {
  return evaluated_at(systems_.centres, problem_, 0, p)[axis];
}

Box SymmetryAxes::derivatives(const CompiledFunction& function, const Interval& x, const Interval& p) {
  return evaluated_at(function, problem_, x, p);
}

/// N_x = 0 on the axis x = c(p), which is an equilibrium for every p. Along it dN_x/dp = N_xp + c' N_xx, and
/// N_xx = 0 there, exactly.
void SymmetryAxes::search(std::size_t axis, const Interval& range) {
  const SquareSystem system{
      1, [&](auto p, auto out) { out[0] = derivatives(systems_.slopes, centre(axis, p[0]), p[0])[0]; },
      [&](auto p, auto out) { out[0] = derivatives(systems_.higher, centre(axis, p[0]), p[0])[xp]; }};
  const Isolation isolation = isolate_zeros(system, {range});
  complete_ = complete_ && isolation.complete && isolation.undecided.empty() && isolation.poles.empty();
  for (const IsolatedZero& zero : isolation.zeros) {
    const Interval& p = zero.enclosure[0];
    if (is_empty(intersection(p, range))) continue;
    const Interval there = centre(axis, p);
    const bool cubic = !derivatives(systems_.higher, there, p)[xxx].contains(0.0);
    const bool pitchfork = zero.simple && cubic;
    const Interval x = problem_.forces->turns[systems_.unknowns[0]] ? reduced_angle(there) : there;
    found_.push_back(
        {pitchfork ? BifurcationKind::pitchfork : BifurcationKind::unresolved, x, p, zero.simple, axis});
  }
}

/// With y = x - c(p) and N = N_x = 0 at y != 0 the expansions of the odd N demand N_xxx(a) = 3 N_xxx(b) for
/// some a and b between; and on the axis N_x vanishes once where N_xp has one sign.
bool SymmetryAxes::is_alone(const Interval& x, const Interval& p) {
  const Box d = derivatives(systems_.higher, x, p);
  return !d[xp].contains(0.0) && !d[xxx].contains(0.0) && d[xxx].magnitude() < 3 * d[xxx].least_magnitude();
}

bool SymmetryAxes::explain(std::span<const Interval> box) {
  return std::ranges::any_of(found_, [&](const NormalForm& form) {
    if (form.kind != BifurcationKind::pitchfork) return false;
    const Interval p = hull(form.p, box[1]);
    // What moves with the axis is on the same side of a whole turn as the point.
    const Interval moved = centre(form.axis, p) + (form.x - centre(form.axis, form.p));
    return is_alone(hull(hull(form.x, moved), box[0]), p);
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

bool is_pitchfork(const SteadyProblem& problem, const BifurcationSystems& systems,
                  const CriticalZero& meeting) {
  const Box d = evaluated_at(systems.higher, problem, meeting.x[0], meeting.p);
  return !d[xp].contains(0.0) && !d[xxx].contains(0.0);
}

}  // namespace qdot
