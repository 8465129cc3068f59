#include "core/steady/bifurcations.hpp"

#include <algorithm>
#include <cmath>

#include "core/steady/critical_zeros.hpp"

namespace qdot {
namespace {

class CriticalSearch {
 public:
  CriticalSearch(const Dynamics& dynamics, std::span<const double> parameters, std::span<const double> y,
                 std::size_t index, double from, double to)
      : dynamics_(dynamics), y_(y.begin(), y.end()), index_(index), from_(from), to_(to) {
    std::vector<double> present(parameters.begin(), parameters.end());
    if (present[index] == 0) present[index] = to != 0 ? to : from;  // it must not count as vanishing
    problem_ = steady_problem(dynamics, present, y);
    const std::size_t momenta = problem_.statics->reduction.ignored.size();
    std::string key = "bifurcations " + dynamics.model().scene.parameters[index].name;
    for (std::size_t k = 0; k < momenta; ++k)
      key += problem_.constants[present.size() + k].width() == 0 ? " 0" : " p";
    systems_ = dynamics.derived<BifurcationSystems>(key, present, [&](const Statics& statics) {
      return derive_bifurcation_systems(statics.reduction, *problem_.forces, index);
    });
  }

  Bifurcations run() {
    const std::string& name = dynamics_.model().scene.parameters[index_].name;
    if (problem_.forces->unknowns.size() != problem_.forces->equations.size() ||
        problem_.forces->unknowns.empty()) {
      result_.reason =
          "The equilibria of this system are not isolated points, so none of them can appear or vanish.";
      result_.complete = false;
      return std::move(result_);
    }
    if (!systems_->depends) {
      result_.reason = "No force at rest depends on " + name + ", so the equilibria stay as they are.";
    } else {
      const CriticalZeros found = critical_zeros(dynamics_.model(), problem_, *systems_, {from_, to_});
      result_.degenerate = found.degenerate;
      result_.complete = found.complete;
      if (!found.complete) {
        result_.reason = "The search was given up before it was finished, so critical values may be missing.";
      }
      classify(found.zeros);
      if (result_.critical.empty() && result_.reason.empty()) {
        result_.reason = "No equilibrium appears, vanishes or meets another in this range.";
      }
    }
    trace();
    if (!result_.complete && !gave_up_ && add_missed()) trace();
    return std::move(result_);
  }

 private:
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
    std::optional<SteadyState> last;
    constexpr int most_halvings = 50;
    for (int k = 0; k < most_halvings; ++k) {
      const double middle = low + (high - low) / 2;
      const auto state = nearest(x, middle);
      if (!state || !state->simple || state->stability.stability == Stability::neutral) break;
      (state->stability.stability == branch.stability[i] ? low : high) = middle;
      x.assign(state->y.begin(), state->y.begin() + static_cast<std::ptrdiff_t>(x.size()));
      last = state;
    }
    if (!last) return;
    CriticalZero found{BifurcationSystem::Kind::meeting, {}, {low, high}, false};
    for (const std::size_t j : unknowns()) found.x.push_back(last->enclosure[j]);
    if (const auto kind = kind_seen(found)) add(*kind, found);
  }

  std::optional<SteadyState> nearest(const std::vector<double>& x, double p) {
    std::optional<SteadyState> best;
    double least = 0.2;
    for (SteadyState& state : at(p).states) {
      double distance = 0;
      for (const std::size_t i : kept()) distance = std::max(distance, std::abs(state.y[i] - x[i]));
      if (distance < least) {
        least = distance;
        best = std::move(state);
      }
    }
    return best;
  }

  [[nodiscard]] const std::vector<std::size_t>& unknowns() const { return problem_.forces->unknowns; }
  [[nodiscard]] const std::vector<std::size_t>& kept() const { return problem_.statics->reduction.kept; }

  Equilibria at(double p) {
    SteadyProblem here = problem_;
    here.constants[index_] = p;
    here.parameters[index_] = p == 0 ? here.parameters[index_] : p;
    return equilibria(dynamics_, here, y_);
  }

  [[nodiscard]] std::vector<bool> turns() const {
    std::vector<bool> result(y_.size() / 2);
    for (std::size_t j = 0; j < kept().size(); ++j) result[kept()[j]] = problem_.forces->turns[j];
    return result;
  }

  /// Where a force vanishes everywhere, equilibria are no points of a curve; where not all can be found,
  /// there are no curves from there on.
  [[nodiscard]] std::vector<SteadyState> column(double p) {
    if (gave_up_ || std::ranges::find(result_.degenerate, p) != result_.degenerate.end()) return {};
    Equilibria found = at(p);
    if (!found.complete) {
      gave_up_ = true;
      result_.complete = false;
      result_.reason = found.reason;
    }
    return std::move(found.states);
  }

  /// A meeting where one of the two folds is a pitchfork; a fold alone is a saddle-node.
  void classify(const std::vector<CriticalZero>& zeros) {
    for (const CriticalZero& here : zeros) {
      const bool meets = std::ranges::any_of(
          zeros, [&](const CriticalZero& other) { return other.kind != here.kind && overlap(other, here); });
      if (meets && here.kind == BifurcationSystem::Kind::fold) continue;  // told by the meeting
      BifurcationKind kind = meets                                        ? BifurcationKind::pitchfork
                             : here.kind == BifurcationSystem::Kind::fold ? BifurcationKind::saddle_node
                                                                          : BifurcationKind::transcritical;
      if (!here.simple) {
        const auto seen = kind_seen(here);
        if (!seen) continue;
        kind = *seen;
      }
      add(kind, here);
    }
    std::sort(result_.critical.begin(), result_.critical.end(),
              [](const CriticalValue& a, const CriticalValue& b) {
                return a.value != b.value ? a.value < b.value : a.y < b.y;
              });
  }

  /// By how many equilibria are near on either side.
  std::optional<BifurcationKind> kind_seen(const CriticalZero& here) {
    const double aside = 1e-4 * (to_ - from_) + 10 * here.p.width();
    const std::size_t before = near(here, here.p.lower - aside);
    const std::size_t after = near(here, here.p.upper + aside);
    if (std::min(before, after) == 0)
      return before + after == 2 ? std::optional(BifurcationKind::saddle_node) : std::nullopt;
    if (before != after) return BifurcationKind::pitchfork;
    return before >= 2 ? std::optional(BifurcationKind::transcritical) : std::nullopt;
  }

  std::size_t near(const CriticalZero& here, double p) {
    constexpr double reach = 0.2;
    std::size_t count = 0;
    for (const SteadyState& state : at(p).states) {
      bool close = true;
      for (std::size_t k = 0; k < here.x.size(); ++k) {
        const double d = state.y[kept()[unknowns()[k]]] - here.x[k].middle();
        close = close &&
                std::abs(problem_.forces->turns[unknowns()[k]] ? std::remainder(d, 2 * 3.14159265358979323846)
                                                               : d) < reach;
      }
      count += close ? 1 : 0;
    }
    return count;
  }

  void add(BifurcationKind kind, const CriticalZero& found) {
    CriticalValue critical;
    critical.kind = kind;
    critical.value = found.p.middle();
    critical.error = distance_bound(critical.value, found.p);
    critical.proven = found.simple;
    const std::size_t n = y_.size() / 2;
    critical.y.assign(y_.begin(), y_.begin() + static_cast<std::ptrdiff_t>(n));
    critical.y.resize(2 * n, 0.0);
    critical.errors.assign(2 * n, 0.0);
    std::vector<Interval> place;
    for (const std::size_t i : kept()) place.emplace_back(y_[i]);
    for (std::size_t k = 0; k < found.x.size(); ++k) {
      const std::size_t i = kept()[unknowns()[k]];
      place[unknowns()[k]] = found.x[k];
      critical.y[i] = representative(found.x[k]);
      critical.errors[i] = distance_bound(critical.y[i], found.x[k]);
    }
    std::vector<Interval> constants = problem_.constants;
    constants[index_] = found.p;
    std::vector<Interval> rates(problem_.statics->reduction.ignored.size());
    TapeEvaluator<Interval>(problem_.forces->ignored_rates, constants)(place, rates);
    for (std::size_t k = 0; k < rates.size(); ++k) {
      const std::size_t i = n + problem_.statics->reduction.ignored[k];
      critical.y[i] = representative(rates[k]);
      critical.errors[i] = distance_bound(critical.y[i], rates[k]);
    }
    result_.critical.push_back(std::move(critical));
  }

  const Dynamics& dynamics_;
  std::vector<double> y_;
  std::size_t index_;
  double from_, to_;
  SteadyProblem problem_;
  std::shared_ptr<const BifurcationSystems> systems_;
  bool gave_up_{};
  Bifurcations result_;
};

}  // namespace

Bifurcations bifurcations(const Dynamics& dynamics, std::span<const double> parameters,
                          std::span<const double> y, std::size_t index, double from, double to) {
  return CriticalSearch(dynamics, parameters, y, index, from, to).run();
}

}  // namespace qdot
