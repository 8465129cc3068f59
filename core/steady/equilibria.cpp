#include "core/steady/equilibria.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// Zeros like to lie at 0 and pi: the region's ends lie beside them.
constexpr double offset = 0.03;
/// Some hundred do for most scenes; past this number the answer says that it is not complete.
constexpr std::size_t most_boxes = 20'000;

Interval full_turn() { return {std::nextafter(2 * pi, 0), std::nextafter(2 * pi, 7)}; }

class RegionSearch {
 public:
  RegionSearch(const Dynamics& dynamics, const SteadyProblem& problem, std::span<const double> y)
      : dynamics_(dynamics),
        y_(y.begin(), y.end()),
        problem_(problem),
        reduction_(problem_.statics->reduction),
        numerators_(problem_.forces->numerators, problem_.constants),
        forces_(problem_.forces->forces, problem_.constants),
        stiffness_(problem_.forces->stiffness, problem_.constants),
        rates_(problem_.forces->ignored_rates, problem_.constants),
        g_(place_size()),
        k_(place_size() * place_size()) {
    for (const std::size_t i : reduction_.kept) place_.emplace_back(y_[i]);
  }

  Equilibria run() {
    for (const std::size_t j : forces().free) result_.free.push_back(reduction_.kept[j]);
    for (std::size_t k = reduction_.constants.size() - reduction_.ignored.size();
         k < problem_.constants.size(); ++k) {
      result_.momenta.push_back(problem_.constants[k].middle());
    }
    if (forces().unknowns.size() == forces().equations.size()) {
      find();
    } else {
      mismatch();
    }
    result_.problem = std::move(problem_);
    return std::move(result_);
  }

 private:
  [[nodiscard]] const SteadyForces& forces() const { return *problem_.forces; }
  [[nodiscard]] std::size_t place_size() const { return reduction_.degrees_of_freedom(); }
  [[nodiscard]] const Coordinate& coordinate(std::size_t place) const {
    return dynamics_.model().scene.coordinates[reduction_.kept[place]];
  }

  /// The place with the unknowns put in.
  std::span<const Interval> with(std::span<const Interval> unknowns) {
    for (std::size_t k = 0; k < unknowns.size(); ++k) place_[forces().unknowns[k]] = unknowns[k];
    return place_;
  }

  void find() {
    if (forces().unknowns.empty()) {
      add(place_, true);
      return;
    }
    const SquareSystem system{forces().unknowns.size(), [&](auto x, auto out) { write_forces(with(x), out); },
                              [&](auto x, auto out) { write_stiffness(with(x), out); }};
    std::vector<double> scales;
    for (const std::size_t j : forces().unknowns) {
      const double start = std::abs(y_[reduction_.kept[j]]);
      scales.push_back(forces().turns[j] || !(start > 0) || !std::isfinite(start) ? 1 : start);
    }
    const Isolation isolation =
        isolate_zeros(system, search_region(dynamics_.model(), problem_), scales, most_boxes);
    result_.complete = isolation.complete;
    if (!isolation.complete) {
      result_.reason =
          "The search was given up before it was finished, so equilibria may be missing: their number is not "
          "finite, or forces of very different sizes cancel.";
    }
    for (const IsolatedZero& zero : isolation.zeros) {
      const auto x = with(zero.enclosure);
      if (is_outside(x)) continue;
      if (!zero.simple && is_pole(x)) {
        give_up_at_pole();
        continue;
      }
      add(reduced({x.begin(), x.end()}), zero.simple);
    }
    if (result_.states.empty() && result_.complete) {
      result_.reason = "The forces vanish nowhere in the region that was searched.";
    }
    std::sort(result_.states.begin(), result_.states.end(),
              [](const auto& a, const auto& b) { return a.y < b.y; });
  }

  void mismatch() {
    result_.reason =
        forces().unknowns.size() < forces().equations.size()
            ? "More forces have to vanish than there are coordinates that they depend on: in general no "
              "position does it."
            : "The forces leave a whole family of positions in equilibrium, which is not listed.";
    result_.complete = false;
  }

  /// g_i; around a pole its numerator, which has the same zeros.
  void write_forces(std::span<const Interval> x, std::span<Interval> out) {
    forces_(x, g_);
    bool pole = false;
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = g_[forces().equations[k]];
      pole = pole || !out[k].is_finite();
    }
    if (!pole || !forces().has_poles) return;
    numerators_(x, g_);
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (!out[k].is_finite()) out[k] = g_[forces().equations[k]];
    }
  }

  void write_stiffness(std::span<const Interval> x, std::span<Interval> out) {
    stiffness_(x, k_);
    std::size_t k = 0;
    for (const std::size_t i : forces().equations) {
      for (const std::size_t j : forces().unknowns) out[k++] = k_[i * place_size() + j];
    }
  }

  bool is_pole(std::span<const Interval> x) {
    forces_(x, g_);
    return std::any_of(g_.begin(), g_.end(), [](const Interval& g) { return !g.is_finite(); });
  }

  void give_up_at_pole() {
    result_.complete = false;
    result_.reason =
        "Forces and their distance from a singularity of the coordinates are both too small to tell whether "
        "they vanish there.";
  }

  [[nodiscard]] bool is_outside(std::span<const Interval> x) const {
    for (std::size_t j = 0; j < x.size(); ++j) {
      const Domain& domain = coordinate(j).domain;
      const Interval inside = intersection(x[j], {domain.lower, domain.upper});
      if (is_empty(inside)) return true;
      if (domain.lower_open && x[j].lower <= domain.lower) return true;
      if (domain.upper_open && x[j].upper >= domain.upper) return true;
    }
    return false;
  }

  [[nodiscard]] Box reduced(Box x) const {
    for (const std::size_t j : forces().unknowns) {
      if (forces().turns[j]) x[j] = reduced_angle(x[j]);
    }
    return x;
  }

  [[nodiscard]] bool is_known(const Box& x) const {
    return std::any_of(result_.states.begin(), result_.states.end(), [&](const SteadyState& state) {
      for (std::size_t j = 0; j < x.size(); ++j) {
        if (is_empty(intersection(state.enclosure[j], x[j]))) return false;
      }
      return true;
    });
  }

  void add(Box x, bool simple) {
    if (is_known(x)) return;  // found at both ends of a turn
    SteadyState state;
    state.simple = simple;
    std::vector<double> place;
    for (const Interval& xi : x) place.push_back(representative(xi));
    if (!simple) place = least_residual(x, place);
    std::vector<Interval> g(x.size());
    forces_(Box(place.begin(), place.end()), g);
    for (const Interval& force : g) state.residual = std::max(state.residual, force.magnitude());
    if (simple && state.residual == 0) x.assign(place.begin(), place.end());
    fill_state(state, place, x);
    state.enclosure = std::move(x);
    result_.states.push_back(std::move(state));
  }

  /// Of many zeros too close to be told apart, or none: where the forces are least.
  std::vector<double> least_residual(const Box& x, std::vector<double> best) {
    const auto size = [&](const std::vector<double>& place) {
      std::vector<Interval> g(x.size());
      forces_(Box(place.begin(), place.end()), g);
      double largest = 0;
      for (const Interval& force : g) largest = std::max(largest, std::abs(force.middle()));
      return largest;
    };
    double least = size(best);
    constexpr int samples = 64;
    for (std::size_t j = 0; j < x.size(); ++j) {
      const std::vector<double> start = best;
      for (int i = 0; i <= samples; ++i) {
        std::vector<double> place = start;
        place[j] = x[j].lower + x[j].width() * i / samples;
        if (const double here = size(place); here < least) {
          least = here;
          best = place;
        }
      }
    }
    return best;
  }

  void fill_state(SteadyState& state, const std::vector<double>& place, const Box& x) {
    const std::size_t n = y_.size() / 2;
    state.y.assign(y_.begin(), y_.begin() + static_cast<std::ptrdiff_t>(n));
    state.y.resize(2 * n, 0.0);
    state.errors.assign(2 * n, 0.0);
    for (std::size_t j = 0; j < place.size(); ++j) {
      state.y[reduction_.kept[j]] = place[j];
      state.errors[reduction_.kept[j]] = distance_bound(place[j], x[j]);
    }
    std::vector<Interval> rates(reduction_.ignored.size());
    rates_(x, rates);
    for (std::size_t k = 0; k < rates.size(); ++k) {
      state.y[n + reduction_.ignored[k]] = representative(rates[k]);
      state.errors[n + reduction_.ignored[k]] = distance_bound(representative(rates[k]), rates[k]);
    }
  }

  const Dynamics& dynamics_;
  std::vector<double> y_;
  SteadyProblem problem_;
  const Reduction& reduction_;
  TapeEvaluator<Interval> numerators_, forces_, stiffness_, rates_;
  Box g_, k_, place_;
  Equilibria result_;
};

}  // namespace

Box search_region(const Model& model, const SteadyProblem& problem) {
  Box region;
  for (const std::size_t j : problem.forces->unknowns) {
    const Domain& domain = model.scene.coordinates[problem.statics->reduction.kept[j]].domain;
    const Interval all{std::max(domain.lower, -largest_length), std::min(domain.upper, largest_length)};
    // A little more than a turn, in which rounding may not leave a gap.
    const Interval turn{-pi - offset, pi - offset + 2e-9};
    region.push_back(problem.forces->turns[j] ? intersection(turn, all) : all);
    if (is_empty(region.back())) region.back() = all;
  }
  return region;
}

Interval reduced_angle(const Interval& angle) {
  if (angle.lower <= -pi) return angle + full_turn();
  return angle.upper > pi && !angle.contains(pi) ? angle - full_turn() : angle;
}

double representative(const Interval& x) {
  if (x.contains(0.0)) return 0;
  return x.contains(pi) ? pi : x.middle();
}

double distance_bound(double x, const Interval& enclosure) {
  if (enclosure.lower == x && enclosure.upper == x) return 0;
  return std::nextafter(std::max(x - enclosure.lower, enclosure.upper - x), infinity);
}

Equilibria equilibria(const Dynamics& dynamics, const SteadyProblem& problem, std::span<const double> y) {
  Equilibria result = RegionSearch(dynamics, problem, y).run();
  StabilityAnalysis analysis(dynamics, result.problem);
  for (SteadyState& state : result.states) state.stability = analysis.at(state.enclosure);
  return result;
}

Equilibria equilibria(const Dynamics& dynamics, std::span<const double> parameters,
                      std::span<const double> y) {
  return equilibria(dynamics, steady_problem(dynamics, parameters, y), y);
}

}  // namespace qdot
