#include "core/steady/equilibria.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/listed.hpp"
#include "core/base/work.hpp"
#include "core/dynamics/missing_values.hpp"
#include "core/numerics/constants.hpp"
#include "core/steady/cones.hpp"
#include "core/steady/exact_places.hpp"
#include "core/steady/far_field.hpp"
#include "core/steady/force_system.hpp"
#include "core/steady/kink_stability.hpp"
#include "core/steady/region_sentences.hpp"
#include "core/steady/shared_shift.hpp"

namespace qdot {
namespace {

/// Some hundred do for most scenes; past this number the answer says that it is not complete.
constexpr std::size_t most_boxes(std::size_t unknowns) { return unknowns < 3 ? 20'000 : 60'000; }
constexpr std::size_t most_boxes_of_middle = 2'000, most_boxes_of_rest = 60'000;
constexpr const char* nothing_rests = "The forces vanish nowhere in the region that was searched.";
constexpr std::size_t most_kinks = 5;  ///< each multiplies the work by three

/// No value where the enclosure reaches across an end of the domain.
std::optional<bool> is_inside(const Domain& domain, const Interval& x) {
  const bool below = domain.lower_open ? x.upper <= domain.lower : x.upper < domain.lower;
  const bool above = domain.upper_open ? x.lower >= domain.upper : x.lower > domain.upper;
  if (below || above) return false;
  const bool past_lower = domain.lower_open ? x.lower > domain.lower : x.lower >= domain.lower;
  const bool past_upper = domain.upper_open ? x.upper < domain.upper : x.upper <= domain.upper;
  return past_lower && past_upper ? std::optional(true) : std::nullopt;
}

class RegionSearch {
 public:
  RegionSearch(const Dynamics& dynamics, const SteadyProblem& problem, std::span<const double> y,
               SearchEffort effort)
      : dynamics_(dynamics),
        effort_(effort),
        y_(y.begin(), y.end()),
        problem_(problem),
        reduction_(problem_.statics->reduction),
        system_(*problem_.forces, problem_.constants, given_place()),
        states_(problem_, y_),
        cones_(cones_of(problem_)) {}

  Equilibria run() {
    for (const std::size_t j : forces().free) result_.free.push_back(reduction_.kept[j]);
    for (std::size_t k = reduction_.constants.size() - reduction_.ignored.size();
         k < problem_.constants.size(); ++k) {
      result_.momenta.push_back(problem_.constants[k].middle());
    }
    if (!has_equations()) {
      mismatch();
    } else if (forces().smooth.kinks() > most_kinks) {
      incomplete("The forces have too many kinks to look on each side of all of them.");
    } else {
      find();
    }
    result_.problem = std::move(problem_);
    return std::move(result_);
  }

 private:
  [[nodiscard]] const SteadyForces& forces() const { return *problem_.forces; }
  [[nodiscard]] const Scene& scene() const { return dynamics_.model().scene; }
  [[nodiscard]] const Coordinate& coordinate(std::size_t place) const {
    return scene().coordinates[reduction_.kept[place]];
  }
  [[nodiscard]] Box given_place() const {
    Box place;
    for (const std::size_t i : reduction_.kept) place.emplace_back(y_[i]);
    return place;
  }

  void incomplete(const std::string& reason) {
    result_.complete = false;
    tell(reason);
  }
  void tell(const std::string& reason) {
    if (result_.reason.find(reason) != std::string::npos) return;
    result_.reason += (result_.reason.empty() ? "" : " ") + reason;
  }

  /// Whether there are as many equations as unknowns.
  [[nodiscard]] bool has_equations() const {
    const auto fits = [&](const std::vector<std::size_t>& equations) {
      return equations.size() == forces().unknowns.size();
    };
    if (forces().charts.empty()) return fits(forces().equations);
    return std::ranges::all_of(forces().charts, fits, &Chart::equations);
  }

  void find() {
    if (forces().unknowns.empty()) return add({.x = given_place(), .simple = true});
    if (const auto shift = shared_shift(scene(), problem_); !shift.empty()) return family(shift);
    if (const auto shift = shift_in_ratio(problem_); !shift.empty()) return family(shift);
    if (forces().charts.empty()) search();
    for (const Chart& chart : forces().charts) {
      system_.use(chart, sizes_);
      search();
    }
    for (const FoundPlace& place : found_.places()) add_within_domain(place);
    for (const Cone& cone : cones_) add_cone(cone);
    if (result_.states.empty() && result_.complete) {
      tell(nothing_rests);
    }
    std::sort(result_.states.begin(), result_.states.end(),
              [](const auto& a, const auto& b) { return a.y < b.y; });
  }

  void search() {
    for (const Sides& sides : system_.patterns()) search(sides);
  }

  /// What is next to cones is known.
  [[nodiscard]] SquareSystem equations_on(const Sides& sides) {
    SquareSystem system = system_.at(sides);
    if (cones_.empty()) return system;
    system.excluded = [this, by_forces = std::move(system.excluded)](auto x, auto values) {
      const Box box(x.begin(), x.end());
      const auto is_known_about = [&](const Cone& cone) {
        return cone.what != AtCone::undecided && contains(cone.about, box);
      };
      return std::ranges::any_of(cones_, is_known_about) || by_forces(x, values);
    };
    return system;
  }

  [[nodiscard]] std::vector<double> sizes() const {
    std::vector<double> sizes;
    for (std::size_t j = 0; j < reduction_.kept.size(); ++j) {
      const double start = std::abs(y_[reduction_.kept[j]]);
      sizes.push_back(forces().turns[j] || !(start > 0) || !std::isfinite(start) ? 1 : start);
    }
    return sizes;
  }

  void search(const Sides& sides) {
    Box region = search_region(dynamics_.model(), problem_);
    std::vector<double> scales;
    for (const std::size_t j : forces().unknowns) scales.push_back(sizes_[j]);
    // A little more than the sides' values: what lies at the ends counts.
    region.resize(region.size() + static_cast<std::size_t>(std::ranges::count(sides, 0)), {-1.001, 1.001});
    scales.resize(region.size(), 1.0);
    const std::uint64_t work = work_left();
    Isolation isolation = isolate_zeros(equations_on(sides), region, scales, most_boxes(region.size()));
    if (!isolation.complete && effort_ == SearchEffort::thorough && work_left() > work / 2) {
      if (auto all = within_farthest(sides, region, scales)) isolation = std::move(*all);
    }
    if (!isolation.complete) isolation = nearer(sides, region, scales, std::move(isolation));
    for (const Box& box : isolation.undecided) {
      if (system_.holds(sides, box).value_or(true)) incomplete(undecided(scene(), problem_, box));
    }
    for (const Box& box : isolation.poles) give_up_at_pole(box);
    for (const IsolatedZero& zero : isolation.zeros) take(sides, zero);
  }

  /// Where it can be told how far away there are none, in what is left.
  [[nodiscard]] std::optional<Isolation> within_farthest(const Sides& sides, Box region,
                                                         const std::vector<double>& scales) {
    const std::optional<double> farthest = farthest_zero(problem_);
    if (!farthest) return std::nullopt;
    for (Interval& side : region) {
      side = intersection(side, {-*farthest, *farthest});
      if (!(side.lower < side.upper)) return std::nullopt;
    }
    return isolate_zeros(equations_on(sides), region, scales, most_boxes_of_rest);
  }

  /// All equilibria in the middle of the region, where there are too many in the whole of it.
  Isolation nearer(const Sides& sides, const Box& region, const std::vector<double>& scales,
                   Isolation whole) {
    Box middle = region;
    std::string where;
    for (std::size_t k = 0; k < forces().unknowns.size(); ++k) {
      const std::size_t j = forces().unknowns[k];
      if (forces().turns[j]) continue;
      const double half = coordinate(j).unit == "rad" ? 4 * pi : 10 * scales[k];
      middle[k] = intersection(region[k], {-half, half});
      if (is_empty(middle[k])) return whole;
      where += (where.empty() ? "" : " and ") + coordinate(j).name + " from " +
               short_number(middle[k].lower) + " to " + short_number(middle[k].upper);
    }
    Isolation found = isolate_zeros(equations_on(sides), middle, scales, most_boxes_of_middle);
    if (where.empty() || !found.complete || !found.undecided.empty()) {
      incomplete(given_up(scene(), problem_));
      return whole;
    }
    incomplete("The search was given up before it was finished: these are all equilibria with " + where +
               ", and beyond there may be more, even without end.");
    return found;
  }

  void take(const Sides& sides, const IsolatedZero& zero) {
    const std::optional<bool> in_chart = system_.is_in_chart(zero.enclosure);
    if (!in_chart)
      return incomplete(place_named(scene(), problem_, zero.enclosure) +
                        " the constraints depend on each other.");
    if (!*in_chart) return;
    const std::optional<bool> holds = system_.holds(sides, zero.enclosure);
    if (holds && !*holds) return;
    if (!zero.simple && is_next_to_pole(sides, zero.enclosure)) return give_up_at_pole(zero.enclosure);
    FoundPlace place{.x = system_.place_of(zero.enclosure), .simple = zero.simple && holds};
    if (place.simple) place.alone = system_.place_of(zero.alone);
    std::size_t next = forces().unknowns.size();
    for (const int side : sides) {
      place.at_kink = place.at_kink || side == 0 || !holds;
      place.sides.push_back(side == 0 ? zero.enclosure[next++] : Interval(side));
    }
    for (const std::size_t j : forces().unknowns) {
      if (forces().turns[j] && is_inside(coordinate(j).domain, reduced_angle(place.x[j])).value_or(true))
        place.turn_back(j);
    }
    found_.add(std::move(place));
  }

  /// Rounding hides the forces' signs about a pole, too, where it hides on which side of it a place is.
  [[nodiscard]] bool is_next_to_pole(const Sides& sides, const Box& zero) {
    constexpr double reach = 1e-12;
    Box around = zero;
    for (Interval& x : around) {
      const double far = x.width() + reach * std::max(1.0, x.magnitude());
      x = x + Interval(-far, far);
    }
    return system_.is_pole(sides, around);
  }

  void add_cone(const Cone& cone) {
    const Box place = system_.place_of(cone.place);
    const bool outside = std::ranges::any_of(forces().unknowns, [&](std::size_t j) {
      return !is_inside(coordinate(j).domain, place[j]).value_or(true);
    });
    if (outside || cone.what == AtCone::nothing) return;
    if (cone.what == AtCone::held)
      return add_within_domain({.x = place, .simple = true, .at_kink = true, .at_cone = true});
    const std::string where = place_named(scene(), problem_, cone.place) + " a distance is 0, and forces ";
    if (cone.what == AtCone::pushed)
      return tell(where +
                  "have no value there: about it they drive away on every side, so nothing rests there.");
    incomplete(where + "have no single direction there: it is not decided whether they hold the system.");
  }

  void family(const std::vector<std::size_t>& shift) {
    incomplete("Adding the same to " + listed(coordinate_names(scene(), problem_, shift)) + only_families);
  }
  void family(const WrittenChange& shift) {
    incomplete(small_change(scene(), problem_, shift) + only_families);
  }

  /// Whether some force has no zero anywhere, as one that depends on no coordinate.
  [[nodiscard]] bool never_rests() const {
    Box x = given_place(), values(forces().rest.size());
    const Box region = search_region(dynamics_.model(), problem_);
    for (std::size_t k = 0; k < region.size(); ++k) x[forces().unknowns[k]] = region[k];
    TapeEvaluator<Interval>(forces().forces, problem_.constants)(x, values);
    return std::ranges::any_of(forces().equations, [&](std::size_t i) { return !values[i].contains(0.0); });
  }

  void mismatch() {
    if (never_rests()) {
      result_.reason = nothing_rests;
      return;
    }
    incomplete(forces().unknowns.size() < forces().equations.size()
                   ? "More forces have to vanish than there are coordinates that they depend on: in general "
                     "no position makes all of them vanish."
                   : "The forces leave a whole family of positions in equilibrium, which is not listed.");
  }

  void give_up_at_pole(const Box& box) {
    incomplete(
        place_named(scene(), problem_, box) +
        " is a singularity: forces have no value there, and no bound of them next to it tells whether they vanish.");
  }

  void add_within_domain(FoundPlace place) {
    if (place.simple && !place.at_cone) exact_.make_exact(place);
    bool certain = true;
    for (const std::size_t j : forces().unknowns) {
      const std::optional<bool> inside = is_inside(coordinate(j).domain, place.x[j]);
      if (inside && !*inside) return;
      certain = certain && inside;
    }
    if (!certain) {
      incomplete(
          "An equilibrium lies so near the end of a coordinate's domain that rounding does not tell on which "
          "side of it.");
      place.simple = false;
    }
    add(place);
  }

  /// Where the potential has no value, such as log(x) where x < 0, its slope may have one, and vanish.
  void add(const FoundPlace& place) {
    SteadyState state = states_.at(place);
    if (!lacks_values(dynamics_.model(), problem_.parameters, state.y, state.errors))
      result_.states.push_back(std::move(state));
  }

  const Dynamics& dynamics_;
  SearchEffort effort_;
  std::vector<double> y_;
  SteadyProblem problem_;
  const Reduction& reduction_;
  ForceSystem system_;
  SteadyStates states_;
  ExactPlaces exact_{*problem_.forces, system_, states_};
  std::vector<double> sizes_ = sizes();  ///< of x
  std::vector<Cone> cones_;
  FoundPlaces found_;
  Equilibria result_;
};

/// Where the mass matrix has no inverse, as at r = 0 of polar coordinates, no acceleration follows from
/// forces that vanish: that nothing moves there is not proven.
void leave_out_without_inertia(const Scene& scene, StabilityAnalysis& analysis, Equilibria& result) {
  std::erase_if(result.states, [&](const SteadyState& state) {
    const bool is_told = state.enclosure.size() == 1;  // as what its stability leaves open
    if (is_told || analysis.has_inertia(state.enclosure)) return false;
    result.complete = false;
    result.reason +=
        (result.reason.empty() ? "" : " ") + without_inertia(scene, result.problem, state.enclosure);
    return true;
  });
}

}  // namespace

Equilibria steady_places(const Dynamics& dynamics, const SteadyProblem& problem, std::span<const double> y,
                         SearchEffort effort) {
  return RegionSearch(dynamics, problem, y, effort).run();
}

Equilibria equilibria(const Dynamics& dynamics, const SteadyProblem& problem, std::span<const double> y,
                      SearchEffort effort) {
  Equilibria result = steady_places(dynamics, problem, y, effort);
  StabilityAnalysis analysis(dynamics, result.problem);
  leave_out_without_inertia(dynamics.model().scene, analysis, result);
  for (SteadyState& state : result.states) {
    if (!state.at_kink) {
      state.stability = analysis.at(state.enclosure);
      continue;
    }
    const auto [decides, gyroscopic] = analysis.energy(state.enclosure);
    state.stability =
        state.at_cone ? stability_at_cone(decides)
                      : stability_at_kink(result.problem, state.enclosure, state.sides, decides, gyroscopic);
  }
  return result;
}

Equilibria equilibria(const Dynamics& dynamics, const Reals& parameters, const Reals& y) {
  return equilibria(dynamics, steady_problem(dynamics, parameters, y), y, SearchEffort::thorough);
}

}  // namespace qdot
