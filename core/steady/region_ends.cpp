#include "core/steady/region_ends.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_boxes_of_end = 5'000;

/// The equations in the form that has values in the box; else the numerators as they are.
BifurcationSystems::Nested finite_form(const SteadyProblem& problem, const BifurcationSystems& systems,
                                       const Box& box) {
  std::vector<BifurcationSystems::Nested> forms{{systems.numerators, systems.slopes}};
  forms.insert(forms.end(), systems.nested.begin(), systems.nested.end());
  for (const BifurcationSystems::Nested& form : forms) {
    Box values(form.values.outputs());
    TapeEvaluator<Interval>(form.values, problem.constants)(box, values);
    if (std::ranges::all_of(values, &Interval::is_finite)) return form;
  }
  return forms.front();
}

/// The zeros with the unknown number `fixed` at `end`, the others and p in `region`.
Isolation zeros_at_end(const SteadyProblem& problem, const BifurcationSystems& systems, const Box& region,
                       std::size_t fixed, double end) {
  const std::size_t n = region.size() - 1;
  const auto whole = [=](std::span<const Interval> others) {
    Box all(others.begin(), others.end());
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(fixed), Interval(end));
    return all;
  };
  Box there = region;
  there[fixed] = end;
  const BifurcationSystems::Nested form = finite_form(problem, systems, there);
  TapeEvaluator<Interval> values(form.values, problem.constants), slopes(form.slopes, problem.constants);
  const SquareSystem system{n, [&](auto others, auto out) { values(whole(others), out); },
                            [&](auto others, auto out) {
                              Box all(n * (n + 1));
                              slopes(whole(others), all);
                              std::size_t next = 0;
                              for (std::size_t k = 0; k < all.size(); ++k) {
                                if (k % (n + 1) != fixed) out[next++] = all[k];
                              }
                            }};
  Box others = region;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(fixed));
  return isolate_zeros(system, others, {}, most_boxes_of_end);
}

/// N(x, p) = 0 goes on inwards to where N_x dx + N_p dp = 0.
int side_of(const SteadyProblem& problem, const BifurcationSystems& systems, double end, const Interval& p) {
  const Box there{Interval(end), p};
  Box slopes(2);
  TapeEvaluator<Interval>(finite_form(problem, systems, there).slopes, problem.constants)(there, slopes);
  if (slopes[0].contains(0.0) || slopes[1].contains(0.0)) return 0;
  const bool is_alike = (slopes[0].lower > 0) == (slopes[1].lower > 0);
  return is_alike == (end > 0) ? 1 : -1;
}

}  // namespace

std::vector<EndCrossing> end_crossings(const Model& model, const SteadyProblem& problem,
                                       const BifurcationSystems& systems, const Interval& range) {
  std::vector<EndCrossing> result;
  Box region = search_region(model, problem, systems.unknowns);
  region.push_back(range);
  for (std::size_t k = 0; k + 1 < region.size(); ++k) {
    if (problem.forces->turns[systems.unknowns[k]]) continue;
    for (const double end : {region[k].lower, region[k].upper}) {
      const Isolation found = zeros_at_end(problem, systems, region, k, end);
      for (const IsolatedZero& zero : found.zeros) {
        const Interval& p = zero.enclosure.back();
        if (is_empty(intersection(p, range))) continue;
        const bool is_one = zero.simple && region.size() == 2;
        result.push_back({k, end, p, is_one ? side_of(problem, systems, end, p) : 0});
      }
      if (!found.complete || !found.undecided.empty() || !found.poles.empty())
        result.push_back({k, end, Interval::whole(), 0});
    }
  }
  return result;
}

std::string sentence(const EndCrossing& crossing, const std::string& coordinate, const std::string& parameter,
                     const Interval& range) {
  constexpr double nearly_zero = 1e-12;
  constexpr int digits = 10;
  const bool is_far = std::abs(crossing.end) >= largest_length;
  const std::string far = crossing.end < 0 ? "-infinity" : "infinity";
  const std::string end = coordinate + " = " + (is_far ? far : short_number(crossing.end, digits));
  if (!crossing.p.is_finite())
    return "Whether equilibria appear from or vanish to " + end + " could not be told.";
  const double p = crossing.p.middle();
  const bool is_zero = is_far && std::abs(p) <= nearly_zero * range.magnitude();
  return "At " + parameter + " = " + short_number(is_zero ? 0 : p, digits) +
         " an equilibrium appears from or vanishes to " + end + ".";
}

}  // namespace qdot
