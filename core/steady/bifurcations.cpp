#include "core/steady/bifurcations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/steady/critical_growth.hpp"
#include "core/steady/critical_problem.hpp"
#include "core/steady/critical_sentences.hpp"
#include "core/steady/mirrors.hpp"
#include "core/steady/normal_form.hpp"
#include "core/steady/region_ends.hpp"

namespace qdot {
namespace {

/// Of a value of the parameter, as a part of its range.
constexpr double rounding_of_range = 1e-12;

class CriticalSearch {
 public:
  CriticalSearch(const Dynamics& dynamics, const Reals& parameters, const Reals& y, std::size_t index,
                 double from, double to)
      : dynamics_(dynamics),
        y_(y.begin(), y.end()),
        index_(index),
        from_(from),
        to_(to),
        all_(dynamics, parameters, y, index, {from, to}) {
    use(all_.charts().front());
  }

  Bifurcations run() {
    const std::string& name = dynamics_.model().scene.parameters[index_].name;
    if (!std::ranges::all_of(all_.charts(), has_points)) {
      result_.reason =
          "The equilibria of this system are not isolated points, so none of them can appear or vanish.";
      result_.complete = false;
      return std::move(result_);
    }
    const auto depends = [](const CriticalChart& c) {
      return c.systems->depends || !c.systems->growth.empty();
    };
    if (std::ranges::none_of(all_.charts(), depends)) {
      result_.reason = "No force at rest depends on " + name + ", so the equilibria stay as they are.";
    } else {
      search();
    }
    trace();
    if (!result_.complete && !gave_up_ && add_missed()) trace();
    if (result_.complete && changes_between(result_.branches, result_.critical, result_.degenerate)) {
      incomplete(growth_not_found);
    }
    return std::move(result_);
  }

 private:
  static bool has_points(const CriticalChart& chart) {
    const SteadyForces& forces = *chart.problem.forces;
    return !forces.unknowns.empty() && forces.unknowns.size() == forces.equations.size();
  }

  void use(const CriticalChart& chart) {
    chart_ = &chart;
    problem_ = chart.problem;
    systems_ = chart.systems;
  }

  void incomplete(const std::string& reason) {
    result_.complete = false;
    if (result_.reason.find(reason) != std::string::npos) return;
    result_.reason += (result_.reason.empty() ? "" : " ") + reason;
  }

  void search() {
    for (const CriticalChart& chart : all_.charts()) {
      use(chart);
      search_chart();
    }
    std::ranges::sort(result_.critical, [](const CriticalValue& a, const CriticalValue& b) {
      return a.value != b.value ? a.value < b.value : a.y < b.y;
    });
    if (result_.critical.empty() && result_.reason.empty()) {
      result_.reason =
          result_.degenerate.empty()
              ? "No equilibrium appears, vanishes or meets another in this range."
              : "No equilibrium appears, vanishes or meets another but at the values in 'degenerate'.";
    }
  }

  void search_chart() {
    if (problem_.forces->smooth.kinks() > 0) {
      return incomplete(
          "The forces have kinks (abs or sign), at which equilibria appear and vanish, too: critical values are "
          "not looked for, and the branches show what there is.");
    }
    std::optional<SymmetryAxes> axes;
    if (unknowns().size() == 1) axes.emplace(problem_, *systems_, Interval(from_, to_));
    CriticalZeros found =
        critical_zeros(dynamics_.model(), problem_, *systems_, systems_->systems, {from_, to_},
                       [&](std::span<const Interval> box) { return axes && axes->explain(box); });
    leave_to_other_charts(found);
    result_.degenerate = found.degenerate;
    if (!found.complete) {
      incomplete("The search was given up before it was finished, so critical values may be missing.");
    }
    if (found.undecided) {
      incomplete("Far out, or at a singularity, the forces are too small to tell whether any are critical.");
    }
    if (axes) {
      classify_by_normal_form(found.zeros, *axes);
    } else {
      classify_by_families(found);
    }
    watch_ends();
    search_growth();
  }

  void search_growth() {
    const CriticalGrowth found =
        critical_growth(dynamics_, problem_, *systems_, index_, {from_, to_},
                        [&](const CriticalZero& zero) { return all_.place_of(*chart_, zero); });
    for (const GrowthZero& growth : found.zeros)
      add(growth.kind, growth.zero, degenerate_growth, growth.omega);
    if (!found.complete) incomplete(more_growth);
  }

  void leave_to_other_charts(CriticalZeros& found) {
    std::erase_if(found.zeros, [&](const CriticalZero& zero) {
      const auto place = all_.place_in(*chart_, zero);
      if (place == CriticalProblem::Place::singular)
        incomplete(
            "Somewhere in this range the constraints depend on each other: what happens there is not known.");
      return place != CriticalProblem::Place::here;
    });
  }

  /// Equilibria that come from an end of the region or leave it there.
  void watch_ends() {
    const std::string& parameter = dynamics_.model().scene.parameters[index_].name;
    for (const EndCrossing& crossing : end_crossings(dynamics_.model(), problem_, *systems_, {from_, to_})) {
      const auto is_there = [&](double p) { return crossing.p.is_finite() && crossing.p.contains(p); };
      if (std::ranges::any_of(result_.degenerate, is_there)) continue;
      const std::string& x = dynamics_.model().scene.coordinates[kept()[unknowns()[crossing.unknown]]].name;
      incomplete(sentence(crossing, x, parameter, {from_, to_}));
    }
  }

  void trace() {
    result_.branches = branches([&](double p) { return column(p); }, from_, to_, result_.critical, turns());
  }

  /// Where a curve's stability changes and the search for critical points was given up: found by bisection.
  bool add_missed() {
    const std::size_t before = result_.critical.size();
    for (const EquilibriumBranch& branch : result_.branches) {
      for (std::size_t i = 0; i + 1 < branch.parameter.size(); ++i) {
        const bool changes = branch.stability[i] != branch.stability[i + 1] &&
                             branch.stability[i] != Stability::neutral &&
                             branch.stability[i + 1] != Stability::neutral;
        if (changes && !has_critical(branch.parameter[i], branch.parameter[i + 1])) add_between(branch, i);
      }
    }
    std::ranges::sort(result_.critical, {}, &CriticalValue::value);
    return result_.critical.size() > before;
  }

  [[nodiscard]] bool has_critical(double low, double high) const {
    return std::ranges::any_of(result_.critical, [&](const CriticalValue& c) {
      return c.value + c.error >= low && c.value - c.error <= high;
    });
  }

  void add_between(const EquilibriumBranch& branch, std::size_t i) {
    double low = branch.parameter[i];
    double high = branch.parameter[i + 1];
    std::vector<double> x = branch.x[i];
    std::optional<SteadyState> at_low = nearest(branch.x[i], low), at_high = nearest(branch.x[i + 1], high);
    constexpr int most_halvings = 50;
    for (int k = 0; k < most_halvings; ++k) {
      const double middle = low + (high - low) / 2;
      const auto state = nearest(x, middle);
      if (!state || !state->simple || state->stability.stability == Stability::neutral) break;
      const bool before = state->stability.stability == branch.stability[i];
      (before ? low : high) = middle;
      (before ? at_low : at_high) = state;
      x.assign(state->y.begin(), state->y.begin() + static_cast<std::ptrdiff_t>(x.size()));
    }
    if (!at_low || !at_high || !continues(*at_low, low, *at_high, high)) return;
    CriticalZero found{BifurcationSystem::Kind::meeting, {}, {low, high}, false};
    for (const std::size_t j : unknowns())
      found.x.push_back(hull(at_low->enclosure[j], at_high->enclosure[j]));
    add(kind_seen(found), found, change_of_stability);
  }

  /// Whether the two are one curve, and not two that run beside each other: near each of them there are two
  /// others or none, or what rounding does not tell apart.
  bool continues(const SteadyState& a, double p_of_a, const SteadyState& b, double p_of_b) {
    constexpr double reach = 1e-5;
    CriticalZero place{};
    for (const std::size_t j : unknowns()) {
      place.x.push_back(hull(a.enclosure[j], b.enclosure[j]));
      if (!(place.x.back().width() < reach / 10)) return false;
    }
    return simple_near(place, p_of_a, reach) % 2 == 1 && simple_near(place, p_of_b, reach) % 2 == 1;
  }

  std::optional<SteadyState> nearest(const std::vector<double>& x, double p) {
    std::optional<SteadyState> best;
    double least = 0.2;
    for (SteadyState& state : all_.at(p).states) {
      double distance = 0;
      for (const std::size_t i : kept()) distance = std::max(distance, std::abs(state.y[i] - x[i]));
      if (distance < least) {
        least = distance;
        best = std::move(state);
      }
    }
    return best;
  }

  [[nodiscard]] const std::vector<std::size_t>& unknowns() const { return systems_->unknowns; }
  [[nodiscard]] const std::vector<std::size_t>& kept() const { return all_.kept(); }

  [[nodiscard]] std::vector<bool> turns() const {
    std::vector<bool> result(y_.size() / 2);
    for (std::size_t j = 0; j < kept().size(); ++j) result[kept()[j]] = problem_.forces->turns[j];
    return result;
  }

  /// Where a force vanishes everywhere, equilibria are no points of a curve; where not all can be found,
  /// there are no curves from there on.
  [[nodiscard]] std::vector<SteadyState> column(double p) {
    const auto is_there = [&](double value) {
      return std::abs(value - p) <= rounding_of_range * (to_ - from_);
    };
    if (gave_up_ || std::ranges::any_of(result_.degenerate, is_there)) return {};
    try {
      Equilibria found = all_.at(p);
      if (!found.complete) end_branches(p, "where not all equilibria are found: " + found.reason);
      return std::move(found.states);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::too_large) throw;
      end_branches(p, "as to follow them further would cost more than one answer may.");
      return {};
    }
  }

  void end_branches(double p, const std::string& why) {
    gave_up_ = true;
    incomplete("The branches end at " + dynamics_.model().scene.parameters[index_].name + " = " +
               short_number(p, 10) + ", " + why);
  }

  void classify_by_normal_form(const std::vector<CriticalZero>& zeros, SymmetryAxes& axes) {
    if (!axes.is_complete()) incomplete("On an axis of symmetry, critical values may be missing.");
    std::vector<CriticalZero> rest;
    for (const CriticalZero& zero : zeros) {
      if (!axes.explain(Box{zero.x[0], zero.p})) join(rest, zero);
    }
    for (const NormalForm& form : axes.found()) {
      const auto is_there = [&](double p) { return form.p.contains(p); };
      if (std::ranges::any_of(result_.degenerate, is_there)) continue;
      CriticalZero place{BifurcationSystem::Kind::meeting, {form.x}, form.p, form.proven};
      if (form.kind == BifurcationKind::pitchfork) {
        add(form.kind, place);
      } else {
        place.simple = false;
        join(rest, place);
      }
    }
    for (const CriticalZero& zero : rest) {
      const bool single = zero.simple;
      const bool fold = zero.kind == BifurcationSystem::Kind::fold;
      if (single && (fold || is_transcritical(problem_, *systems_, zero))) {
        add(fold ? BifurcationKind::saddle_node : BifurcationKind::transcritical, zero);
      } else {
        add(BifurcationKind::unresolved, zero, reason_of(zero));
      }
    }
  }

  static const char* reason_of(const CriticalZero& zero) {
    if (!zero.simple) return several_events;
    return zero.kind == BifurcationSystem::Kind::meeting ? degenerate_crossing : degenerate_fold;
  }

  /// A fold alone is a saddle-node: its system is regular only where it is one. Two families that cross, and
  /// neither folds, are a transcritical point; one that folds on the mirror of a symmetry, a pitchfork.
  void classify_by_families(const CriticalZeros& found) {
    for (const CriticalZero& here : found.zeros) {
      const bool fold = here.kind == BifurcationSystem::Kind::fold;
      const bool is_degenerate = here.kind == BifurcationSystem::Kind::degenerate_fold;
      std::vector<const CriticalZero*> others;
      for (const CriticalZero& other : found.zeros) {
        if (&other != &here && overlap(other, here)) others.push_back(&other);
      }
      if (here.simple && others.empty() && is_degenerate) {
        add(BifurcationKind::unresolved, here, degenerate_fold);
        continue;
      }
      if (here.simple && others.empty() && (fold || found.complete)) {
        add(fold ? BifurcationKind::saddle_node : BifurcationKind::transcritical, here);
        continue;
      }
      const bool pair = here.simple && !is_degenerate && others.size() == 1 && others[0]->simple &&
                        others[0]->kind != here.kind &&
                        others[0]->kind != BifurcationSystem::Kind::degenerate_fold;
      if (pair && is_on_mirror(problem_, *systems_, here)) {
        if (!fold) add(BifurcationKind::pitchfork, here);
        continue;
      }
      const bool told = std::ranges::any_of(others, [&](const CriticalZero* other) { return other < &here; });
      if (!told) add(BifurcationKind::unresolved, here, several_events);
    }
  }

  /// Where a curve changes its stability on the mirror of a symmetry, two more equilibria on one side than on
  /// the other say what happens.
  BifurcationKind kind_seen(const CriticalZero& here) {
    const double aside = 1e-4 * (to_ - from_) + 10 * here.p.width();
    constexpr double reach = 0.2;
    const std::size_t before = simple_near(here, here.p.lower - aside, reach);
    const std::size_t after = simple_near(here, here.p.upper + aside, reach);
    const bool three_and_one = std::min(before, after) == 1 && std::max(before, after) == 3;
    return three_and_one && is_on_mirror(problem_, *systems_, here) ? BifurcationKind::pitchfork
                                                                    : BifurcationKind::unresolved;
  }

  std::size_t simple_near(const CriticalZero& here, double p, double reach) {
    std::size_t count = 0;
    for (const SteadyState& state : all_.at(p).states) {
      bool close = state.simple;
      for (std::size_t k = 0; k < here.x.size(); ++k) {
        const double d = state.y[kept()[unknowns()[k]]] - here.x[k].middle();
        close =
            close && std::abs(problem_.forces->turns[unknowns()[k]] ? std::remainder(d, 2 * std::numbers::pi)
                                                                    : d) < reach;
      }
      count += close ? 1 : 0;
    }
    return count;
  }

  void add(BifurcationKind kind, const CriticalZero& found, const char* reason = "",
           const std::optional<Interval>& omega = std::nullopt) {
    CriticalValue critical;
    critical.kind = kind;
    if (kind == BifurcationKind::unresolved) critical.reason = reason;
    critical.value = found.p.middle();
    critical.error = distance_bound(critical.value, found.p);
    critical.proven = found.simple;
    if (omega) {
      critical.omega = omega->middle();
      critical.omega_error = distance_bound(critical.omega, *omega);
    }
    const std::size_t n = y_.size() / 2;
    critical.y.assign(y_.begin(), y_.begin() + static_cast<std::ptrdiff_t>(n));
    critical.y.resize(2 * n, 0.0);
    critical.errors.assign(2 * n, 0.0);
    std::vector<Interval> constants = problem_.constants;
    constants[index_] = found.p;
    const Box place = all_.place_of(*chart_, found);
    for (const std::size_t k : problem_.forces->unknowns) {
      critical.y[kept()[k]] = representative(place[k]);
      critical.errors[kept()[k]] = distance_bound(critical.y[kept()[k]], place[k]);
    }
    std::vector<Interval> rates(problem_.statics->reduction.ignored.size());
    TapeEvaluator<Interval>(problem_.forces->ignored_rates, constants)(place, rates);
    for (std::size_t k = 0; k < rates.size(); ++k) {
      const std::size_t i = n + problem_.statics->reduction.ignored[k];
      critical.y[i] = representative(rates[k]);
      critical.errors[i] = distance_bound(critical.y[i], rates[k]);
    }
    // Where charts overlap, both may tell of it.
    const auto is_same = [&](const CriticalValue& other) { return same_place(other, critical); };
    if (all_.charts().size() == 1 || std::ranges::none_of(result_.critical, is_same))
      result_.critical.push_back(std::move(critical));
  }

  const Dynamics& dynamics_;
  std::vector<double> y_;
  std::size_t index_;
  double from_, to_;
  CriticalProblem all_;
  const CriticalChart* chart_{};
  SteadyProblem problem_;  ///< of the chart, as are its systems
  std::shared_ptr<const BifurcationSystems> systems_;
  bool gave_up_{};
  Bifurcations result_;
};

}  // namespace

Bifurcations bifurcations(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                          std::size_t index, double from, double to) {
  return CriticalSearch(dynamics, parameters, y, index, from, to).run();
}

}  // namespace qdot
