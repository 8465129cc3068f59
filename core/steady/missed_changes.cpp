#include "core/steady/missed_changes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/steady/critical_sentences.hpp"
#include "core/steady/mirrors.hpp"

namespace qdot {
namespace {

/// A state of a curve, and the parameter there.
struct CurvePoint {
  SteadyState state;
  double p{};
};

class ChangeOfStability {
 public:
  ChangeOfStability(CriticalProblem& problem, const CriticalChart& chart, const Interval& range)
      : all_(problem), chart_(chart), range_(range) {}

  /// Between neighbours i and i + 1 of the branch.
  std::optional<KnownZero> between(const EquilibriumBranch& branch, std::size_t i) {
    std::optional<CurvePoint> low = nearest(branch.x[i], branch.parameter[i]);
    std::optional<CurvePoint> high = nearest(branch.x[i + 1], branch.parameter[i + 1]);
    if (!low || !high) return std::nullopt;
    constexpr int most_halvings = 50;
    std::vector<double> x = branch.x[i];
    for (int k = 0; k < most_halvings; ++k) {
      auto middle = nearest(x, low->p + (high->p - low->p) / 2);
      if (!middle || !middle->state.simple) break;
      const Stability stability = middle->state.stability.stability;
      if (stability == Stability::neutral) break;
      x.assign(middle->state.y.begin(), middle->state.y.begin() + static_cast<std::ptrdiff_t>(x.size()));
      (stability == branch.stability[i] ? low : high) = std::move(middle);
    }
    if (!continues(*low, *high)) return std::nullopt;
    const CriticalZero zero{BifurcationSystem::Kind::meeting, hull_of(*low, *high), {low->p, high->p}, false};
    return KnownZero{zero, kind_seen(zero), change_of_stability, {}};
  }

 private:
  [[nodiscard]] Box hull_of(const CurvePoint& a, const CurvePoint& b) const {
    Box x;
    for (const std::size_t j : chart_.systems->unknowns)
      x.push_back(hull(a.state.enclosure[j], b.state.enclosure[j]));
    return x;
  }

  /// Whether the two are one curve, and not two that run beside each other: near each of them there are two
  /// others or none, or what rounding does not tell apart.
  bool continues(const CurvePoint& a, const CurvePoint& b) {
    constexpr double reach = 1e-5;
    const Box place = hull_of(a, b);
    const bool is_narrow =
        std::ranges::all_of(place, [](const Interval& x) { return x.width() < reach / 10; });
    return is_narrow && simple_near(place, a.p, reach) % 2 == 1 && simple_near(place, b.p, reach) % 2 == 1;
  }

  BifurcationKind kind_seen(const CriticalZero& here) {
    const double aside = 1e-4 * range_.width() + 10 * here.p.width();
    constexpr double reach = 0.2;
    const std::size_t before = simple_near(here.x, here.p.lower - aside, reach);
    const std::size_t after = simple_near(here.x, here.p.upper + aside, reach);
    const bool three_and_one = std::min(before, after) == 1 && std::max(before, after) == 3;
    return three_and_one && is_on_mirror(chart_.problem, *chart_.systems, here) ? BifurcationKind::pitchfork
                                                                                : BifurcationKind::unresolved;
  }

  std::optional<CurvePoint> nearest(const std::vector<double>& x, double p) {
    std::optional<CurvePoint> best;
    double least = 0.2;
    for (SteadyState& state : all_.at(p).states) {
      double distance = 0;
      for (const std::size_t i : all_.kept()) distance = std::max(distance, std::abs(state.y[i] - x[i]));
      if (distance < least) {
        least = distance;
        best = CurvePoint{std::move(state), p};
      }
    }
    return best;
  }

  std::size_t simple_near(const Box& place, double p, double reach) {
    const auto is_near = [&](const SteadyState& state) {
      for (std::size_t k = 0; k < place.size(); ++k) {
        const std::size_t j = chart_.systems->unknowns[k];
        const double d = state.y[all_.kept()[j]] - place[k].middle();
        const double nearest_turn =
            chart_.problem.forces->turns[j] ? std::remainder(d, 2 * std::numbers::pi) : d;
        if (!(std::abs(nearest_turn) < reach)) return false;
      }
      return state.simple;
    };
    const std::vector<SteadyState> states = all_.at(p).states;
    return static_cast<std::size_t>(std::ranges::count_if(states, is_near));
  }

  CriticalProblem& all_;
  const CriticalChart& chart_;
  Interval range_;
};

bool changes(Stability a, Stability b) {
  return a != b && a != Stability::neutral && b != Stability::neutral;
}

}  // namespace

std::vector<KnownZero> missed_changes(CriticalProblem& problem, const CriticalChart& chart,
                                      std::span<const EquilibriumBranch> branches,
                                      std::span<const CriticalValue> known, const Interval& range) {
  std::vector<KnownZero> result;
  ChangeOfStability search(problem, chart, range);
  for (const EquilibriumBranch& branch : branches) {
    for (std::size_t i = 0; i + 1 < branch.parameter.size(); ++i) {
      const Interval gap(branch.parameter[i], branch.parameter[i + 1]);
      const auto is_there = [&](double value, double error) {
        return value + error >= gap.lower && value - error <= gap.upper;
      };
      if (!changes(branch.stability[i], branch.stability[i + 1]) ||
          std::ranges::any_of(known, [&](const CriticalValue& c) { return is_there(c.value, c.error); }) ||
          std::ranges::any_of(
              result, [&](const KnownZero& z) { return is_there(z.zero.p.middle(), z.zero.p.width() / 2); }))
        continue;
      if (auto found = search.between(branch, i)) result.push_back(std::move(*found));
    }
  }
  return result;
}

}  // namespace qdot
