#include "core/steady/branches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/numerics/function.hpp"

namespace qdot {
namespace {

constexpr int columns_in_all = 80;
constexpr int least_columns = 8;
/// A curve ends at a critical point that is no farther than this from its last point, for coordinates of size
/// one.
constexpr double reach = 0.5;

struct SampledState {
  std::vector<double> x;
  Stability stability{};
};

/// Between stable and unstable.
bool change_between(Stability a, Stability b) {
  return a != b && a != Stability::neutral && b != Stability::neutral;
}

class Tracer {
 public:
  Tracer(const EquilibriaAt& equilibria_at, std::span<const CriticalValue> critical,
         const std::vector<bool>& turns, std::span<const CurvePole> poles)
      : equilibria_at_(equilibria_at), critical_(critical), turns_(turns), poles_(poles) {}

  std::vector<EquilibriumBranch> run(double from, double to) {
    std::vector<double> ends{from};
    for (const CriticalValue& c : critical_) {
      if (c.value > ends.back() && c.value < to && !is_of_oscillations(c.kind)) ends.push_back(c.value);
    }
    ends.push_back(to);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double share = (ends[i + 1] - ends[i]) / (to - from);
      const int count = std::max(least_columns, static_cast<int>(std::lround(columns_in_all * share)));
      for (int k = i == 0 ? 0 : 1; k <= count; ++k) {
        const bool at_end = k == 0 || k == count;
        if (at_end && is_critical(k == 0 ? ends[i] : ends[i + 1])) continue;
        // Denser towards the ends, where curves are steep.
        const double s = (1 - evaluate(Function::cos, std::numbers::pi * k / count)) / 2;
        add_column(k == count ? ends[i + 1] : ends[i] + s * (ends[i + 1] - ends[i]));
      }
    }
    for (const std::size_t open : open_) end_at_critical(open, to);
    std::sort(result_.begin(), result_.end(), [](const EquilibriumBranch& a, const EquilibriumBranch& b) {
      return std::pair(a.parameter[0], a.x[0]) < std::pair(b.parameter[0], b.x[0]);
    });
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_critical(double value) const {
    return std::any_of(critical_.begin(), critical_.end(),
                       [&](const CriticalValue& c) { return std::abs(c.value - value) <= c.error; });
  }

  [[nodiscard]] double distance(const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double d = turns_[i] ? std::remainder(a[i] - b[i], 2 * std::numbers::pi) : a[i] - b[i];
      sum += d * d;
    }
    return std::sqrt(sum);
  }

  /// How far a point is from where the curve is heading; if the stability would change there, how far from
  /// its last point where that is more, since a steep curve may head for a point of another one.
  [[nodiscard]] double distance(const EquilibriumBranch& branch, const std::vector<double>& ahead,
                                const SampledState& point) const {
    const double d = distance(ahead, point.x);
    const bool changes = change_between(branch.stability.back(), point.stability);
    return changes ? std::max(d, distance(branch.x.back(), point.x)) : d;
  }

  /// The place at p that a curve is heading for.
  [[nodiscard]] std::vector<double> extrapolated(const EquilibriumBranch& branch, double p) const {
    const std::size_t n = branch.parameter.size();
    std::vector<double> x = branch.x.back();
    if (n < 2) return x;
    const double s = (p - branch.parameter[n - 1]) / (branch.parameter[n - 1] - branch.parameter[n - 2]);
    for (std::size_t i = 0; i < x.size(); ++i) {
      double step = branch.x[n - 1][i] - branch.x[n - 2][i];
      if (turns_[i]) step = std::remainder(step, 2 * std::numbers::pi);
      x[i] += s * step;
    }
    return x;
  }

  [[nodiscard]] bool passes_pole(const EquilibriumBranch& branch, const SampledState& point, double p) const {
    return std::ranges::any_of(poles_, [&](const CurvePole& pole) {
      const bool is_between = branch.parameter.back() <= pole.parameter && pole.parameter <= p;
      const std::size_t k = pole.coordinate;
      return is_between && (branch.x.back()[k] - pole.x) * (point.x[k] - pole.x) <= 0;
    });
  }

  struct Pair {
    double distance;
    std::size_t open, point;
  };

  /// Open branches with points they may go on to, the closest pair first.
  [[nodiscard]] std::vector<Pair> pairs(std::span<const SampledState> points, double p) const {
    std::vector<Pair> all;
    for (std::size_t b = 0; b < open_.size(); ++b) {
      const std::vector<double> ahead = extrapolated(result_[open_[b]], p);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = distance(result_[open_[b]], ahead, points[i]);
        if (std::isfinite(d) && !passes_pole(result_[open_[b]], points[i], p)) all.push_back({d, b, i});
      }
    }
    std::ranges::stable_sort(all, {}, &Pair::distance);
    return all;
  }

  void add_column(double p) {
    std::vector<SampledState> points;
    for (const SteadyState& state : equilibria_at_(p)) {
      const auto half = static_cast<std::ptrdiff_t>(state.y.size() / 2);
      points.push_back({{state.y.begin(), state.y.begin() + half}, state.stability.stability});
    }
    std::vector<std::size_t> still_open;
    std::vector<bool> used(points.size()), goes_on(open_.size());
    for (const Pair& pair : pairs(points, p)) {
      if (used[pair.point] || goes_on[pair.open]) continue;
      used[pair.point] = goes_on[pair.open] = true;
      append(result_[open_[pair.open]], p, points[pair.point]);
      still_open.push_back(open_[pair.open]);
    }
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (!goes_on[i]) end_at_critical(open_[i], p);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!used[i]) still_open.push_back(begin(p, points[i]));
    }
    last_ = p;
    open_ = std::move(still_open);
  }

  static void append(EquilibriumBranch& branch, double p, const SampledState& point) {
    branch.parameter.push_back(p);
    branch.x.push_back(point.x);
    branch.stability.push_back(point.stability);
  }

  /// The nearest critical point with a value in [low, high], if one is near.
  [[nodiscard]] const CriticalValue* critical_near(const std::vector<double>& x, double low,
                                                   double high) const {
    const CriticalValue* best = nullptr;
    double least = reach;
    for (const CriticalValue& c : critical_) {
      if (c.value + c.error < low || c.value - c.error > high || is_of_oscillations(c.kind)) continue;
      const double d = distance(x, {c.y.begin(), c.y.begin() + static_cast<std::ptrdiff_t>(x.size())});
      if (d < least) {
        least = d;
        best = &c;
      }
    }
    return best;
  }

  [[nodiscard]] static SampledState point_of(const CriticalValue& c) {
    return {{c.y.begin(), c.y.begin() + static_cast<std::ptrdiff_t>(c.y.size() / 2)}, Stability::neutral};
  }

  std::size_t begin(double p, const SampledState& point) {
    EquilibriumBranch branch;
    if (const CriticalValue* c = critical_near(point.x, last_, p); c != nullptr && c->value < p) {
      append(branch, c->value, point_of(*c));
    }
    append(branch, p, point);
    result_.push_back(std::move(branch));
    return result_.size() - 1;
  }

  void end_at_critical(std::size_t index, double p) {
    EquilibriumBranch& branch = result_[index];
    const CriticalValue* c = critical_near(branch.x.back(), branch.parameter.back(), p);
    if (c != nullptr && c->value > branch.parameter.back()) append(branch, c->value, point_of(*c));
  }

  const EquilibriaAt& equilibria_at_;
  std::span<const CriticalValue> critical_;
  const std::vector<bool>& turns_;
  std::span<const CurvePole> poles_;
  std::vector<EquilibriumBranch> result_;
  std::vector<std::size_t> open_;  ///< branches that reach the last column
  double last_{-std::numeric_limits<double>::infinity()};
};

}  // namespace

std::vector<EquilibriumBranch> branches(const EquilibriaAt& equilibria_at, double from, double to,
                                        std::span<const CriticalValue> critical,
                                        const std::vector<bool>& turns, std::span<const CurvePole> poles) {
  return Tracer(equilibria_at, critical, turns, poles).run(from, to);
}

bool changes_between(std::span<const EquilibriumBranch> branches, std::span<const CriticalValue> critical,
                     std::span<const double> degenerate) {
  return std::ranges::any_of(branches, [&](const EquilibriumBranch& branch) {
    const std::vector<double>& p = branch.parameter;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
      if (branch.stability[i] == branch.stability[i + 1]) continue;
      // Next to a critical value rounding may hide which it is.
      const auto [low, high] = std::minmax(p[i > 0 ? i - 1 : 0], p[std::min(i + 2, p.size() - 1)]);
      const auto is_near = [low = low, high = high](const CriticalValue& c) {
        return c.value + c.error >= low && c.value - c.error <= high;
      };
      const auto is_between = [low = low, high = high](double p) { return p >= low && p <= high; };
      if (std::ranges::none_of(critical, is_near) && std::ranges::none_of(degenerate, is_between))
        return true;
    }
    return false;
  });
}

}  // namespace qdot
