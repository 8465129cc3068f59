#include "core/steady/bifurcations.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/dynamics/missing_values.hpp"
#include "core/mechanics/moments.hpp"
#include "core/steady/critical_growth.hpp"
#include "core/steady/critical_problem.hpp"
#include "core/steady/critical_sentences.hpp"
#include "core/steady/loose_ends.hpp"
#include "core/steady/missed_changes.hpp"
#include "core/steady/missed_growth.hpp"
#include "core/steady/region_ends.hpp"
#include "core/steady/resting_crossings.hpp"

namespace qdot {
namespace {

/// How near two values of the parameter count as one, as a part of its range.
constexpr double rounding_of_range = 1e-12;
constexpr double beside_critical = 1e-7;

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
          std::ranges::any_of(all_.charts(), has_too_many_forces)
              ? "More forces have to vanish than there are coordinates that they depend on: in general "
                "no position does it, and none is followed."
              : "The equilibria of this system are not isolated points, so none of them can appear or "
                "vanish.";
      result_.complete = false;
      return std::move(result_);
    }
    const auto depends = [](const CriticalChart& c) { return c.systems->depends || may_grow(c); };
    if (std::ranges::none_of(all_.charts(), depends))
      result_.reason = "No force at rest depends on " + name + ", so the equilibria stay as they are.";
    else
      search();
    trace();
    if (!result_.complete && !gave_up_) add_missed();
    known_elsewhere_.insert(known_elsewhere_.end(), result_.degenerate.begin(), result_.degenerate.end());
    if (result_.complete && changes_between(result_.branches, result_.critical, known_elsewhere_))
      incomplete(std::ranges::any_of(all_.charts(), may_grow) ? growth_not_found : curves_not_told_apart);
    if (one_coordinate() && has_loose_ends(result_.branches, result_.critical, known_elsewhere_))
      incomplete(curves_not_told_apart);
    return std::move(result_);
  }

 private:
  static bool has_points(const CriticalChart& chart) {
    const SteadyForces& forces = *chart.problem.forces;
    return !forces.unknowns.empty() && forces.unknowns.size() == forces.equations.size();
  }

  static bool may_grow(const CriticalChart& chart) {
    return !chart.systems->growth.empty() || chart.systems->growth_is_unknown;
  }

  static bool has_too_many_forces(const CriticalChart& chart) {
    return chart.problem.forces->unknowns.size() < chart.problem.forces->equations.size();
  }

  void use(const CriticalChart& chart) {
    chart_ = &chart;
    problem_ = chart.problem;
    systems_ = chart.systems;
  }

  void incomplete(const std::string& reason) {
    result_.complete = false;
    say(reason);
  }
  void say(const std::string& reason) {
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
    if (axes && !axes->is_complete()) incomplete("On an axis of symmetry, critical values may be missing.");
    std::vector<KnownZero> zeros =
        axes ? kinds_by_normal_form(problem_, *systems_, found.zeros, *axes, result_.degenerate)
             : kinds_by_families(problem_, *systems_, found);
    const auto is_unresolved = [](const KnownZero& z) { return z.kind == BifurcationKind::unresolved; };
    if (chart_->determinants.empty() && (!found.complete || std::ranges::any_of(zeros, is_unresolved)))
      take_crossings(zeros, resting_crossings(dynamics_.model().scene, problem_, *systems_, index_,
                                              {from_, to_}, result_.degenerate));
    add(zeros);
    search_poles();
    watch_ends();
    search_growth();
  }

  void search_poles() {
    if (systems_->poles.empty()) return;
    const CriticalZeros found = critical_zeros(dynamics_.model(), problem_, *systems_, systems_->poles,
                                               {from_, to_}, [](std::span<const Interval>) { return false; });
    constexpr std::size_t told = 3;
    std::vector<CriticalZero> nearest = found.zeros;
    std::ranges::sort(nearest, {}, [](const CriticalZero& zero) { return std::abs(zero.x[0].middle()); });
    for (std::size_t k = 0; k < nearest.size(); ++k) {
      if (k < told) tell_pole(nearest[k]);
      if (k >= told) know_pole(nearest[k]);
    }
    if (nearest.size() > told) say("Farther from 0 there are more such places.");
    if (!found.complete || found.undecided) incomplete(more_poles);
  }

  void search_growth() {
    const CriticalGrowth found =
        critical_growth(dynamics_, problem_, *systems_, index_, {from_, to_},
                        [&](const CriticalZero& zero) { return all_.place_of(*chart_, zero); });
    add(found.zeros);
    if (!found.complete || systems_->growth_is_unknown) incomplete(more_growth);
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
      if (std::ranges::any_of(result_.degenerate, is_there) || has_no_values_at(crossing)) continue;
      const std::string& x = dynamics_.model().scene.coordinates[kept()[unknowns()[crossing.unknown]]].name;
      const std::string told = sentence(crossing, x, parameter, {from_, to_});
      if (!crossing.p.is_finite()) {
        incomplete(told);
        continue;
      }
      say(told);
      result_.at_ends.push_back(told);
      result_.crossings.push_back(crossing);
      known_elsewhere_.push_back(crossing.p.middle());
    }
  }

  /// Of one unknown: what the scene is written with ends before.
  [[nodiscard]] bool has_no_values_at(const EndCrossing& crossing) {
    if (!crossing.p.is_finite() || unknowns().size() != 1) return false;
    const CriticalZero there{BifurcationSystem::Kind::pole, {Interval(crossing.end)}, crossing.p, false};
    const CriticalValue end = value_at({there, BifurcationKind::unresolved, "", {}});
    return lacks_values(dynamics_.model(), parameters_at(end.value), end.y, end.errors);
  }

  void trace() {
    left_for_columns_ = work_left() - work_left() / 8;
    const auto between = [&](double p) { return closer_look(p); };
    result_.branches = branches([&](double& p) { return column(p); }, between, from_, to_,
                                {result_.critical, turns(), poles_, one_coordinate(), result_.crossings});
  }

  [[nodiscard]] std::optional<OneCoordinate> one_coordinate() const {
    if (!result_.complete || all_.charts().size() > 1 || !chart_->determinants.empty() ||
        unknowns().size() != 1)
      return std::nullopt;
    OneCoordinate one{kept()[unknowns()[0]], known_elsewhere_};
    one.elsewhere.insert(one.elsewhere.end(), result_.degenerate.begin(), result_.degenerate.end());
    return one;
  }

  void add_missed() {
    bool has_missed = false;
    within_part(2, [&] {
      add(missed_growth(dynamics_, all_, index_, result_.branches, result_.critical));
      const auto found =
          missed_changes(all_, *chart_, index_, result_.branches, result_.critical, {from_, to_});
      add(found);
      has_missed = !found.empty();
    });
    std::ranges::sort(result_.critical, {}, &CriticalValue::value);
    if (has_missed) trace();
  }

  /// Looks for that part of the work that is left, as far as it is enough.
  static void within_part(std::uint64_t part, const std::function<void()>& look) {
    const std::uint64_t units = work_left() / part;
    std::uint64_t spent = units;
    try {
      const WorkScope bounded(units);
      look();
      spent -= work_left();
    } catch (const Error& error) {
      if (error.code() != ErrorCode::too_large) throw;
    }
    spend_work(spent);
  }

  [[nodiscard]] const std::vector<std::size_t>& unknowns() const { return systems_->unknowns; }
  [[nodiscard]] const std::vector<std::size_t>& kept() const { return all_.kept(); }

  [[nodiscard]] std::vector<bool> turns() const {
    std::vector<bool> result(y_.size() / 2);
    for (std::size_t j = 0; j < kept().size(); ++j) result[kept()[j]] = problem_.forces->turns[j];
    return result;
  }

  /// The equilibria at p. There are none to show where a force vanishes everywhere, for then they are not
  /// points of a curve; and where not all can be found, curves end.
  [[nodiscard]] std::vector<SteadyState> column(double& p) {
    const auto is_there = [&](double value) {
      return std::abs(value - p) <= rounding_of_range * (to_ - from_);
    };
    if (gave_up_ || std::ranges::any_of(result_.degenerate, is_there)) return {};
    try {
      Equilibria found = all_.at(p);
      if (!found.complete) {  // a column may stand where curves meet
        const double beside = p + (p < to_ ? beside_critical : -beside_critical) * (to_ - from_);
        if (Equilibria other = all_.at(beside); other.complete) {
          p = beside;
          found = std::move(other);
        }
      }
      spend_work(found.states.size() *
                 found.states.size());  // each is compared with those of the column before
      if (!found.complete) end_branches(p, "where not all equilibria are found: " + found.reason);
      return std::move(found.states);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::too_large) throw;
      end_branches(p, "since to follow them further would cost more than one answer may.");
      return {};
    }
  }

  /// A column that is not needed: it may cost a small part of what the others have, and ends no branch.
  [[nodiscard]] std::optional<std::vector<SteadyState>> closer_look(double p) {
    std::optional<std::vector<SteadyState>> result;
    if (gave_up_ || work_left() < left_for_columns_) return result;
    within_part(50, [&] {
      if (Equilibria found = all_.at(p); found.complete) result = std::move(found.states);
    });
    return result;
  }

  void end_branches(double p, const std::string& why) {
    gave_up_ = true;
    incomplete("The branches end at " + dynamics_.model().scene.parameters[index_].name + " = " +
               short_number(p, 10) + ", " + why);
  }

  void add(std::span<const KnownZero> zeros) {
    for (const KnownZero& zero : zeros) {
      if (is_at_pole(zero.zero)) {
        tell_pole(zero.zero);
        continue;
      }
      CriticalValue critical = value_at(zero);
      if (is_of_no_body(critical)) continue;
      if (lacks_values(dynamics_.model(), parameters_at(critical.value), critical.y, critical.errors))
        continue;
      // Where charts overlap, both may tell of it, and so may two axes of symmetry that are one on a circle.
      const auto is_same = [&](const CriticalValue& other) {
        return same_place(other, critical) && (all_.charts().size() > 1 || other.kind == critical.kind);
      };
      if (std::ranges::none_of(result_.critical, is_same)) result_.critical.push_back(std::move(critical));
    }
  }

  bool is_of_no_body(const CriticalValue& critical) {
    Reals there = problem_.parameters;
    there.set(index_, {critical.value, 0, critical.error});
    const auto impossible = impossible_moment(dynamics_.model().parsed, there);
    if (!impossible) return false;
    say("At " + dynamics_.model().scene.parameters[index_].name + " = " + short_number(critical.value) + " " +
        *impossible + ", which it is of no body: what happens there is left out.");
    known_elsewhere_.push_back(critical.value);
    return true;
  }

  [[nodiscard]] bool is_at_pole(const CriticalZero& zero) const {
    Box place = zero.x, denominators(systems_->denominators.outputs());
    place.push_back(zero.p);
    TapeEvaluator<Interval>(systems_->denominators, problem_.constants)(place, denominators);
    return std::ranges::any_of(denominators, [](const Interval& d) { return d.contains(0.0); });
  }

  void tell_pole(const CriticalZero& zero) {
    const auto told = [](const Interval& x) { return short_number(x.contains(0.0) ? 0.0 : x.middle()); };
    const Scene& scene = dynamics_.model().scene;
    std::string where = "At " + scene.parameters[index_].name + " = " + told(zero.p);
    for (std::size_t k = 0; k < zero.x.size(); ++k)
      where += " and " + scene.coordinates[kept()[unknowns()[k]]].name + " = " + told(zero.x[k]);
    say(where +
        " the forces have no value, to within rounding: curves of equilibria may run into that place.");
    know_pole(zero);
  }

  void know_pole(const CriticalZero& zero) {
    known_elsewhere_.push_back(zero.p.middle());
    if (zero.x.size() == 1)
      poles_.push_back({zero.p.middle(), kept()[unknowns()[0]], representative(zero.x[0])});
  }

  [[nodiscard]] std::vector<double> parameters_at(double p) const {
    std::vector<double> parameters = problem_.parameters;
    parameters[index_] = p;
    return parameters;
  }

  CriticalValue value_at(const KnownZero& known) {
    const CriticalZero& found = known.zero;
    CriticalValue critical;
    critical.kind = known.kind;
    critical.reason = known.reason;
    critical.value = found.p.middle();
    critical.error = distance_bound(critical.value, found.p);
    critical.proven = found.simple;
    if (known.omega) {
      critical.omega = known.omega->middle();
      critical.omega_error = distance_bound(critical.omega, *known.omega);
    }
    std::vector<Interval> constants = problem_.constants;
    constants[index_] = found.p;
    BoundedState state = bounded_state(problem_, constants, y_, all_.place_of(*chart_, found));
    critical.y = std::move(state.y);
    critical.errors = std::move(state.errors);
    return critical;
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
  std::uint64_t left_for_columns_{};     ///< of the work: no closer look takes of it
  std::vector<double> known_elsewhere_;  ///< values at which something happens that is not critical
  std::vector<CurvePole> poles_;
  Bifurcations result_;
};

}  // namespace

Bifurcations bifurcations(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                          std::size_t index, double from, double to) {
  return CriticalSearch(dynamics, parameters, y, index, from, to).run();
}

}  // namespace qdot
