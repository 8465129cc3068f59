#include "core/steady/critical_zeros.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

/// The search in (x, p) grows quickly with the number of coordinates; where it is cut off, the answer says
/// so.
constexpr std::size_t most_boxes_of_zeros = 20'000;
/// In instructions: searches with long determinants have fewer boxes, so that work is left for the rest.
constexpr std::size_t most_work_of_zeros = 2'000'000;

/// How many boxes that work pays for: each takes values and derivatives, and once more where it contracts.
std::size_t affordable_boxes(const BifurcationSystem& system) {
  constexpr std::size_t looks = 4;
  const std::size_t cost =
      looks * (system.values.instructions().size() + system.jacobian.instructions().size());
  return std::clamp(most_work_of_zeros / std::max<std::size_t>(cost, 1), std::size_t{500},
                    most_boxes_of_zeros);
}

std::vector<double> degenerate_values(const SteadyProblem& problem, const BifurcationSystems& systems,
                                      const Interval& range) {
  std::vector<double> found;
  std::vector<Interval> place(systems.unknowns.size() + 1);
  for (std::size_t k = 0; k < systems.vanishing.outputs(); ++k) {
    const auto along = [&](const CompiledFunction& function) {
      return [&, k](std::span<const Interval> p, std::span<Interval> out) {
        std::vector<Interval> all(function.outputs());
        place.back() = p[0];
        TapeEvaluator<Interval>(function, problem.constants)(place, all);
        out[0] = all[k];
      };
    };
    const SquareSystem system{1, along(systems.vanishing), along(systems.vanishing_slopes)};
    for (const IsolatedZero& zero : isolate_zeros(system, {range}).zeros) {
      if (is_empty(intersection(zero.enclosure[0], range))) continue;
      found.push_back(representative(zero.enclosure[0]));
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool is_outside(const CriticalZero& zero, const Model& model, const SteadyProblem& problem,
                const BifurcationSystems& systems) {
  for (std::size_t k = 0; k < zero.x.size(); ++k) {
    const std::size_t i = problem.statics->reduction.kept[systems.unknowns[k]];
    const Domain& domain = model.scene.coordinates[i].domain;
    if (domain.lower_open ? zero.x[k].lower <= domain.lower : zero.x[k].upper < domain.lower) return true;
    if (domain.upper_open ? zero.x[k].upper >= domain.upper : zero.x[k].lower > domain.upper) return true;
  }
  return false;
}

/// Unresolved boxes side by side are one multiple zero.
bool joins_cluster(std::vector<CriticalZero>& zeros, const CriticalZero& zero, const Interval& range) {
  constexpr double apart = 1e-3;
  for (CriticalZero& other : zeros) {
    if (other.simple || other.kind != zero.kind) continue;
    bool close = std::abs(other.p.middle() - zero.p.middle()) < apart * (range.upper - range.lower);
    for (std::size_t k = 0; k < zero.x.size(); ++k) {
      close = close && std::abs(other.x[k].middle() - zero.x[k].middle()) < apart;
    }
    if (!close) continue;
    for (std::size_t k = 0; k < zero.x.size(); ++k) other.x[k] = hull(other.x[k], zero.x[k]);
    other.p = hull(other.p, zero.p);
    return true;
  }
  return false;
}

/// Whether for each part of the parameter's range some function has no zero, wherever x is: such as a
/// determinant of linear forces, in which x does not stand.
bool has_none_for_any_parameter(TapeEvaluator<Interval>& values, Box region) {
  constexpr std::size_t most_parts = 1000, parts_that_tell = 31;
  Box all(region.size());
  std::vector<Interval> parts{region.back()};
  bool helps = false;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k == most_parts || (k == parts_that_tell && !helps)) return false;
    const Interval part = parts[k];
    region.back() = part;
    values(region, all);
    const bool excludes = std::ranges::any_of(all, [](const Interval& v) { return !v.contains(0.0); });
    helps = helps || excludes;
    if (excludes) continue;
    const double middle = part.middle();
    if (!(part.lower < middle && middle < part.upper)) return false;
    parts.emplace_back(part.lower, middle);
    parts.emplace_back(middle, part.upper);
  }
  return true;
}

bool folds_at(const BifurcationSystem& system, const SteadyProblem& problem, const Box& place) {
  if (system.folds.outputs() == 0) return false;
  Box value(1);
  TapeEvaluator<Interval>(system.folds, problem.constants)(place, value);
  return !value[0].contains(0.0);
}

Isolation isolated(const Model& model, const SteadyProblem& problem, std::span<const std::size_t> unknowns,
                   const BifurcationSystem& system, const Interval& range,
                   const std::function<bool(std::span<const Interval>)>& known) {
  TapeEvaluator<Interval> values(system.values, problem.constants);
  TapeEvaluator<Interval> jacobian(system.jacobian, problem.constants);
  Box region = search_region(model, problem, unknowns);
  region.push_back(range);
  if (has_none_for_any_parameter(values, region)) return {};
  std::vector<double> scales(region.size(), 1.0);
  scales.back() = std::max(std::abs(range.lower), std::abs(range.upper));
  const SquareSystem square{region.size(), [&](auto x, auto out) { values(x, out); },
                            [&](auto x, auto out) { jacobian(x, out); },
                            [&](auto x, auto) { return known(x); }};
  return isolate_zeros(square, region, scales, affordable_boxes(system));
}

}  // namespace

bool overlap(const CriticalZero& a, const CriticalZero& b) {
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    if (is_empty(intersection(a.x[i], b.x[i]))) return false;
  }
  return !is_empty(intersection(a.p, b.p));
}

void join(std::vector<CriticalZero>& places, CriticalZero zero) {
  for (std::size_t k = 0; k < places.size();) {
    if (!overlap(places[k], zero)) {
      ++k;
      continue;
    }
    for (std::size_t j = 0; j < zero.x.size(); ++j) zero.x[j] = hull(zero.x[j], places[k].x[j]);
    zero.p = hull(zero.p, places[k].p);
    zero.simple = false;
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(k));
    k = 0;
  }
  places.push_back(std::move(zero));
}

CriticalZeros critical_zeros(const Model& model, const SteadyProblem& problem,
                             const BifurcationSystems& systems, std::span<const BifurcationSystem> which,
                             const Interval& range,
                             const std::function<bool(std::span<const Interval>)>& known) {
  CriticalZeros result;
  result.degenerate = degenerate_values(problem, systems, range);
  for (const BifurcationSystem& system : which) {
    const std::size_t first = result.zeros.size();
    const Isolation isolation = isolated(model, problem, systems.unknowns, system, range, known);
    result.complete = result.complete && isolation.complete;
    result.undecided = result.undecided || !isolation.undecided.empty() || !isolation.poles.empty();
    for (const IsolatedZero& found : isolation.zeros) {
      const Box& at = found.enclosure;
      CriticalZero zero{system.kind, {at.begin(), at.end() - 1}, at.back(), found.simple};
      zero.folds = folds_at(system, problem, at);
      if (is_empty(intersection(zero.p, range))) continue;
      for (std::size_t k = 0; k < zero.x.size(); ++k) {
        if (problem.forces->turns[systems.unknowns[k]]) zero.x[k] = reduced_angle(zero.x[k]);
      }
      const auto is_there = [&](double p) { return zero.p.contains(p); };
      if (std::ranges::any_of(result.degenerate, is_there) || is_outside(zero, model, problem, systems))
        continue;
      if (!zero.simple && joins_cluster(result.zeros, zero, range)) continue;
      const auto is_same = [&](const CriticalZero& o) { return o.kind == zero.kind && overlap(o, zero); };
      // What other systems have there, too, is something else that happens.
      if (std::ranges::none_of(result.zeros.begin() + static_cast<std::ptrdiff_t>(first), result.zeros.end(),
                               is_same))
        result.zeros.push_back(std::move(zero));
    }
  }
  // What a search that was given up has seen of a cluster may be a part of it.
  if (!result.complete) std::erase_if(result.zeros, [](const CriticalZero& zero) { return !zero.simple; });
  return result;
}

}  // namespace qdot
