#include "core/steady/critical_kinds.hpp"

#include <algorithm>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/critical_sentences.hpp"
#include "core/steady/mirrors.hpp"

namespace qdot {
namespace {

const char* reason_of(const CriticalZero& zero) {
  if (!zero.simple || zero.kind == BifurcationSystem::Kind::fold) return several_events;
  return zero.kind == BifurcationSystem::Kind::meeting ? degenerate_crossing : degenerate_fold;
}

KnownZero kind_alone(const SteadyProblem& problem, const BifurcationSystems& systems,
                     const CriticalZero& zero) {
  const bool fold = zero.kind == BifurcationSystem::Kind::fold;
  if (!zero.simple ||
      !(fold ? is_saddle_node(problem, systems, zero) : is_transcritical(problem, systems, zero)))
    return {zero, BifurcationKind::unresolved, reason_of(zero), {}};
  return {zero, fold ? BifurcationKind::saddle_node : BifurcationKind::transcritical, "", {}};
}

/// No other factor of a force vanishes there, or all slopes of that force would: what a search that was given
/// up has not found is not there.
bool folds_alone(const SteadyProblem& problem, const BifurcationSystems& systems, const CriticalZero& fold) {
  Box place = fold.x, slopes(systems.slopes.outputs());
  place.push_back(fold.p);
  TapeEvaluator<Interval>(systems.slopes, problem.constants)(place, slopes);
  const std::size_t width = place.size();
  for (std::size_t row = 0; row < slopes.size(); row += width) {
    const auto of_force = std::span(slopes).subspan(row, width);
    if (std::ranges::all_of(of_force, [](const Interval& slope) { return slope.contains(0.0); }))
      return false;
  }
  return true;
}

/// None where another zero stands for this one, too.
std::optional<KnownZero> kind_in_families(const SteadyProblem& problem, const BifurcationSystems& systems,
                                          const CriticalZeros& found, const CriticalZero& here) {
  using Kind = BifurcationSystem::Kind;
  const bool fold = here.kind == Kind::fold;
  const bool is_degenerate = here.kind == Kind::degenerate_fold;
  std::vector<const CriticalZero*> others;
  for (const CriticalZero& other : found.zeros) {
    if (&other != &here && overlap(other, here)) others.push_back(&other);
  }
  if (here.simple && others.empty() && is_degenerate)
    return KnownZero{here, BifurcationKind::unresolved, degenerate_fold, {}};
  if (here.simple && others.empty() && fold && !found.complete && !folds_alone(problem, systems, here))
    return KnownZero{here, BifurcationKind::unresolved, several_events, {}};
  if (here.simple && others.empty() && (fold || found.complete))
    return KnownZero{here, fold ? BifurcationKind::saddle_node : BifurcationKind::transcritical, "", {}};
  const bool pair = here.simple && !is_degenerate && others.size() == 1 && others[0]->simple &&
                    others[0]->kind != here.kind && others[0]->kind != Kind::degenerate_fold;
  if (pair && is_on_mirror(problem, systems, here))
    return fold ? std::nullopt : std::optional(KnownZero{here, BifurcationKind::pitchfork, "", {}});
  if (std::ranges::any_of(others, [&](const CriticalZero* other) { return other < &here; }))
    return std::nullopt;
  return KnownZero{here, BifurcationKind::unresolved, several_events, {}};
}

/// A curve folds where it meets another, as it does in x (x^2 + x^3 - p): neither is a critical point by
/// itself. Takes both out of `zeros`; others there, or none of the two, and nothing is taken.
std::vector<KnownZero> take_folds_on_curves(const SteadyProblem& problem, const BifurcationSystems& systems,
                                            std::vector<CriticalZero>& zeros) {
  using Kind = BifurcationSystem::Kind;
  std::vector<KnownZero> result;
  for (std::size_t k = 0; k < zeros.size(); ++k) {
    const CriticalZero here = zeros[k];
    if (!here.folds || !here.simple || !is_pitchfork(problem, systems, here)) continue;
    const auto is_here = [&](const CriticalZero& other) { return overlap(other, here); };
    const auto is_fold = [&](const CriticalZero& other) {
      return is_here(other) && other.simple && other.kind == Kind::fold;
    };
    if (std::ranges::count_if(zeros, is_here) != 2 || std::ranges::count_if(zeros, is_fold) != 1) continue;
    result.push_back({here, BifurcationKind::pitchfork, "", {}});
    std::erase_if(zeros, is_here);
    k = static_cast<std::size_t>(-1);
  }
  return result;
}

}  // namespace

std::vector<KnownZero> kinds_by_normal_form(const SteadyProblem& problem, const BifurcationSystems& systems,
                                            std::span<const CriticalZero> zeros, SymmetryAxes& axes,
                                            std::span<const double> degenerate) {
  std::vector<CriticalZero> rest, elsewhere(zeros.begin(), zeros.end());
  std::erase_if(elsewhere, [&](const CriticalZero& zero) { return axes.explain(Box{zero.x[0], zero.p}); });
  std::vector<KnownZero> result = take_folds_on_curves(problem, systems, elsewhere);
  for (const CriticalZero& zero : elsewhere) join(rest, zero);
  for (const NormalForm& form : axes.found()) {
    if (std::ranges::any_of(degenerate, [&](double p) { return form.p.contains(p); })) continue;
    CriticalZero place{BifurcationSystem::Kind::meeting, {form.x}, form.p, form.proven};
    if (form.kind == BifurcationKind::pitchfork) {
      result.push_back({place, form.kind, "", {}});
    } else {
      place.simple = false;
      join(rest, place);
    }
  }
  for (const CriticalZero& zero : rest) result.push_back(kind_alone(problem, systems, zero));
  return result;
}

std::vector<KnownZero> kinds_by_families(const SteadyProblem& problem, const BifurcationSystems& systems,
                                         const CriticalZeros& found) {
  std::vector<KnownZero> result;
  for (const CriticalZero& here : found.zeros) {
    if (auto known = kind_in_families(problem, systems, found, here)) result.push_back(std::move(*known));
  }
  return result;
}

}  // namespace qdot
