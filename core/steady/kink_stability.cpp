#include "core/steady/kink_stability.hpp"

#include <algorithm>

namespace qdot {
namespace {

constexpr const char* corner =
    "An abs() or a sign() in the forces has its kink here: small motions have no frequency.";

constexpr const char* tip =
    "A distance in the forces is 0 here, where they have no single direction: small motions have no frequency.";

class KinkStability {
 public:
  KinkStability(const SteadyProblem& problem, const Box& enclosure, const Box& sides)
      : smooth_(problem.forces->smooth), n_(enclosure.size()), kinks_(sides.size()), variables_(enclosure) {
    variables_.insert(variables_.end(), sides.begin(), sides.end());
    stiffness_ = values(smooth_.stiffness, problem.constants, n_ * (n_ + kinks_));
    slopes_ = values(smooth_.slopes, problem.constants, kinks_ * (n_ + kinks_));
    for (std::size_t k = 0; k < kinks_; ++k) {
      if (sides[k].width() > 0 || sides[k].magnitude() < 1) active_.push_back(k);
    }
  }

  /// One coordinate: what the force does on each side.
  Stability of_one(const SteadyProblem& problem) {
    const std::optional<Stability> left = on_side(problem, -1), right = on_side(problem, 1);
    if (left == Stability::unstable || right == Stability::unstable) return Stability::unstable;
    return left && right ? Stability::stable : Stability::neutral;
  }

  Stability of_several(bool gyroscopic) {
    bool convex = true;
    for (const std::size_t k : active_) {
      const Interval c = corner_height(k);
      if (c.upper < 0 && !gyroscopic) return Stability::unstable;
      convex = convex && c.lower > 0;
    }
    if (!convex || !eliminate_kinks()) return Stability::neutral;
    const Inertia along = inertia_of(stiffness_along_kinks(), rest_.size());
    if (along.negative == 0 && along.undecided == 0) return Stability::stable;
    return along.negative > 0 && !gyroscopic ? Stability::unstable : Stability::neutral;
  }

 private:
  Box values(const CompiledFunction& function, std::span<const Interval> constants, std::size_t size) const {
    Box result(size);
    TapeEvaluator<Interval>(function, constants)(variables_, result);
    return result;
  }
  [[nodiscard]] const Interval& slope(std::size_t k, std::size_t j) const {
    return slopes_[k * (n_ + kinks_) + j];
  }

  /// Stable: the force leads back from there; no value where that cannot be told.
  std::optional<Stability> on_side(const SteadyProblem& problem, int direction) {
    for (const std::size_t k : active_) {
      const Interval& du = slope(k, 0);
      if (du.contains(0.0)) return std::nullopt;
      variables_[n_ + k] = (du.lower > 0) == (direction > 0) ? 1.0 : -1.0;
    }
    const Interval force = Interval(direction) * values(smooth_.forces, problem.constants, n_)[0];
    if (force.lower > 0) return Stability::stable;
    if (force.upper < 0) return Stability::unstable;
    if (!is_zero(force)) return std::nullopt;
    const Interval rate = values(smooth_.stiffness, problem.constants, 1 + kinks_)[0];
    if (rate.contains(0.0)) return std::nullopt;
    return rate.lower > 0 ? Stability::stable : Stability::unstable;
  }

  /// c_k from dg/ds_k = c_k du_k.
  [[nodiscard]] Interval corner_height(std::size_t k) const {
    Interval c = Interval::whole();
    for (std::size_t j = 0; j < n_; ++j) {
      if (slope(k, j).contains(0.0)) continue;
      c = intersection(c, stiffness_[j * (n_ + kinks_) + n_ + k] / slope(k, j));
    }
    return is_empty(c) ? Interval::whole() : c;
  }

  /// v along the kinks in terms of some of its components, by Gauss and Jordan's elimination of v.du_k = 0.
  bool eliminate_kinks() {
    std::vector<Box> rows;
    for (const std::size_t k : active_) {
      rows.emplace_back();
      for (std::size_t j = 0; j < n_; ++j) rows.back().push_back(slope(k, j));
    }
    std::vector<std::size_t> pivots;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto pivot = std::ranges::max_element(rows[r], {}, &Interval::least_magnitude);
      const auto p = static_cast<std::size_t>(pivot - rows[r].begin());
      if (rows[r][p].contains(0.0)) return false;
      const Interval divisor = rows[r][p];
      for (Interval& entry : rows[r]) entry = entry / divisor;
      rows[r][p] = 1;
      for (std::size_t other = 0; other < rows.size(); ++other) {
        if (other == r) continue;
        const Interval factor = rows[other][p];
        for (std::size_t j = 0; j < n_; ++j) rows[other][j] = rows[other][j] - factor * rows[r][j];
        rows[other][p] = 0;
      }
      pivots.push_back(p);
    }
    for (std::size_t j = 0; j < n_; ++j) {
      if (std::ranges::find(pivots, j) == pivots.end()) rest_.push_back(j);
    }
    for (const std::size_t j : rest_) {
      along_.emplace_back(n_);
      along_.back()[j] = 1;
      for (std::size_t r = 0; r < rows.size(); ++r) along_.back()[pivots[r]] = -rows[r][j];
    }
    return true;
  }

  [[nodiscard]] std::vector<Interval> stiffness_along_kinks() const {
    std::vector<Interval> result;
    for (const Box& v : along_) {
      for (const Box& w : along_) {
        Interval sum;
        for (std::size_t i = 0; i < n_; ++i) {
          for (std::size_t j = 0; j < n_; ++j) sum = sum + v[i] * stiffness_[i * (n_ + kinks_) + j] * w[j];
        }
        result.push_back(sum);
      }
    }
    return result;
  }

  const SmoothForces& smooth_;
  std::size_t n_, kinks_;
  Box variables_, stiffness_, slopes_;
  std::vector<std::size_t> active_, rest_;
  std::vector<Box> along_;
};

}  // namespace

SteadyStability stability_at_kink(const SteadyProblem& problem, const Box& enclosure, const Box& sides,
                                  bool energy_decides, bool gyroscopic) {
  SteadyStability result;
  result.undecided = corner;
  if (energy_decides) {
    KinkStability at(problem, enclosure, sides);
    result.stability = enclosure.size() == 1 ? at.of_one(problem) : at.of_several(gyroscopic);
  }
  if (result.stability == Stability::neutral) {
    result.undecided += " Whether the place is stable is not decided by the forces on its sides.";
  }
  return result;
}

SteadyStability stability_at_cone(bool energy_decides) {
  SteadyStability result;
  result.undecided = tip;
  result.stability = energy_decides ? Stability::stable : Stability::neutral;
  if (!energy_decides) result.undecided += " Whether the place is stable is not decided by the potential.";
  return result;
}

}  // namespace qdot
