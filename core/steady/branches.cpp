#include "core/steady/branches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/numerics/function.hpp"
#include "core/steady/curves_at_ends.hpp"
#include "core/steady/ordered_continuation.hpp"

namespace qdot {
namespace {

constexpr int columns_in_all = 80;
constexpr int least_columns = 8;
/// A curve ends at a critical point that is no farther than this from its last point, for coordinates of size
/// one.
constexpr double reach = 0.5;
/// Of the range, between columns that are added for a closer look, and between critical values that are told
/// apart; and how many are added in all.
constexpr double least_step = 1e-9;
constexpr double rounding_of_values = 1e-7;
constexpr int most_added = 200;

struct SampledState {
  std::vector<double> x;
  Stability stability{};
};

/// Between stable and unstable.
bool change_between(Stability a, Stability b) {
  return a != b && a != Stability::neutral && b != Stability::neutral;
}

int sign_of(Stability stability) {
  return stability == Stability::stable ? 1 : stability == Stability::unstable ? -1 : 0;
}

class Tracer {
 public:
  Tracer(const EquilibriaAt& equilibria_at, const EquilibriaBetween& between, const KnownOfCurves& known)
      : equilibria_at_(equilibria_at),
        between_(between),
        critical_(known.critical),
        turns_(known.turns),
        poles_(known.poles),
        one_(known.one),
        crossings_(known.crossings) {}

  std::vector<EquilibriumBranch> run(double from, double to) {
    const std::vector<double> ends = ends_between(from, to);
    least_step_ = least_step * (to - from);
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
  /// Critical values that may be one are passed in one step: there is no column between them.
  [[nodiscard]] std::vector<double> ends_between(double from, double to) const {
    std::vector<double> ends{from};
    double last = from;  // that the value of the last end may have
    for (const CriticalValue& c : critical_) {
      if (is_of_oscillations(c.kind) || !(c.value > from && c.value < to)) continue;
      if (ends.size() == 1 || c.value - c.error > last + rounding_of_values * (to - from))
        ends.push_back(c.value);
      last = std::max(last, c.value + c.error);
    }
    ends.push_back(to);
    return ends;
  }

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

  struct Candidate {
    double distance;
    std::size_t open, point;
  };

  /// Open branches with points they may go on to, the closest pair first.
  [[nodiscard]] std::vector<Candidate> candidates(std::span<const SampledState> points, double p) const {
    std::vector<Candidate> all;
    for (std::size_t b = 0; b < open_.size(); ++b) {
      const std::vector<double> ahead = extrapolated(result_[open_[b]], p);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = distance(result_[open_[b]], ahead, points[i]);
        if (std::isfinite(d) && !passes_pole(result_[open_[b]], points[i], p)) all.push_back({d, b, i});
      }
    }
    std::ranges::stable_sort(all, {}, &Candidate::distance);
    return all;
  }

  [[nodiscard]] Continuation nearest(std::span<const SampledState> points, double p) const {
    Continuation result;
    std::vector<bool> used(points.size()), goes_on(open_.size());
    const CurvesAtEnds at_ends = at_ends_until(points, p);
    for (const std::size_t open : at_ends.gone) goes_on[open] = true;
    for (const std::size_t point : at_ends.come) used[point] = true;
    for (const Candidate& c : candidates(points, p)) {
      if (used[c.point] || goes_on[c.open]) continue;
      used[c.point] = goes_on[c.open] = true;
      result.pairs.emplace_back(c.open, c.point);
    }
    return result;
  }

  [[nodiscard]] CurvesAtEnds at_ends_until(std::span<const SampledState> points, double p) const {
    if (!one_ || turns_[one_->index]) return {};
    std::vector<double> before, after;
    for (const std::size_t open : open_) before.push_back(result_[open].x.back()[one_->index]);
    for (const SampledState& point : points) after.push_back(point.x[one_->index]);
    return curves_at_ends(crossings_, last_, p, before, after);
  }

  /// Whether a curve changes its stability that would keep it if it changed places with another, or went on
  /// as what seems to begin.
  [[nodiscard]] bool may_be_swapped(const Continuation& next, std::span<const SampledState> points) const {
    std::vector<bool> used(points.size());
    for (const auto& [open, point] : next.pairs) used[point] = true;
    const auto changes = [&](std::size_t open, std::size_t point) {
      return change_between(result_[open_[open]].stability.back(), points[point].stability);
    };
    for (const auto& [a, b] : next.pairs) {
      if (!changes(a, b)) continue;
      for (const auto& [c, d] : next.pairs) {
        if (changes(c, d) && !changes(a, d) && !changes(c, b)) return true;
      }
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!used[i] && !changes(a, i)) return true;
      }
    }
    return false;
  }

  /// Where no two curves cross as far as is known.
  [[nodiscard]] bool only_folds_until(double p) const {
    return std::ranges::all_of(
        critical_until(p), [](const CriticalValue* c) { return c->kind == BifurcationKind::saddle_node; });
  }

  /// What equilibria meet at between the last column and p.
  [[nodiscard]] std::vector<const CriticalValue*> critical_until(double p) const {
    std::vector<const CriticalValue*> result;
    for (const CriticalValue& c : critical_) {
      if (!is_of_oscillations(c.kind) && last_ <= c.value + c.error && c.value - c.error <= p)
        result.push_back(&c);
    }
    return result;
  }

  /// None where the order of one coordinate tells nothing.
  [[nodiscard]] std::optional<OrderedStep> ordered_step(std::span<const SampledState> points,
                                                        double p) const {
    const auto is_passed = [&](double value) { return last_ <= value && value <= p; };
    if (!one_ || !std::isfinite(last_) || std::ranges::any_of(one_->elsewhere, is_passed))
      return std::nullopt;
    OrderedStep step{{}, {}, {}, {}, critical_until(p), one_->index, turns_[one_->index]};
    const auto is_unresolved = [](const CriticalValue* c) { return c->kind == BifurcationKind::unresolved; };
    if (std::ranges::any_of(step.critical, is_unresolved)) return std::nullopt;
    for (const std::size_t open : open_) {
      step.before.push_back(result_[open].x.back()[one_->index]);
      step.signs_before.push_back(sign_of(result_[open].stability.back()));
    }
    for (const SampledState& point : points) {
      step.after.push_back(point.x[one_->index]);
      step.signs_after.push_back(sign_of(point.stability));
    }
    return is_counted(step) ? std::optional(step) : std::nullopt;
  }

  [[nodiscard]] static std::vector<SampledState> sampled(std::span<const SteadyState> states) {
    std::vector<SampledState> points;
    for (const SteadyState& state : states) {
      const auto half = static_cast<std::ptrdiff_t>(state.y.size() / 2);
      points.push_back({{state.y.begin(), state.y.begin() + half}, state.stability.stability});
    }
    return points;
  }

  void add_column(double p) {
    const std::vector<SteadyState> states = equilibria_at_(p);
    go_on_to(p, sampled(states));
  }

  /// In shorter steps where this one does not tell which equilibrium goes on as which.
  void go_on_to(double p, const std::vector<SampledState>& points) {
    const std::optional<OrderedStep> step = ordered_step(points, p);
    std::optional<Continuation> next = step ? ordered_continuation(*step) : nearest(points, p);
    const bool is_doubtful = step ? !next : only_folds_until(p) && may_be_swapped(*next, points);
    if (is_doubtful && looks_between(p)) return go_on_to(p, points);
    if (!next) next = nearest(points, p);
    take(*next, points, p);
  }

  /// Adds a column before p, if one can be.
  bool looks_between(double p) {
    if (p - last_ < least_step_ || added_ >= most_added) return false;
    double middle = last_ + (p - last_) / 2;
    constexpr double aside = 0.37;
    if (is_critical(middle)) middle = last_ + aside * (p - last_);
    ++added_;
    const auto states = between_(middle);
    if (!states) return false;
    go_on_to(middle, sampled(*states));
    return true;
  }

  void take(const Continuation& next, std::span<const SampledState> points, double p) {
    std::vector<std::size_t> still_open;
    std::vector<bool> used(points.size()), goes_on(open_.size());
    for (const auto& [open, point] : next.pairs) {
      used[point] = goes_on[open] = true;
      append(result_[open_[open]], p, points[point]);
      still_open.push_back(open_[open]);
    }
    for (const auto& [open, c] : next.ends) {
      goes_on[open] = true;
      append(result_[open_[open]], c->value, point_of(*c));
    }
    for (const auto& [point, c] : next.begins) {
      used[point] = true;
      still_open.push_back(begin(p, points[point], c));
    }
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (!goes_on[i]) end_at_critical(open_[i], p);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!used[i]) still_open.push_back(begin(p, points[i], critical_near(points[i].x, last_, p)));
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

  std::size_t begin(double p, const SampledState& point, const CriticalValue* c) {
    EquilibriumBranch branch;
    if (c != nullptr && c->value < p) append(branch, c->value, point_of(*c));
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
  const EquilibriaBetween& between_;
  std::span<const CriticalValue> critical_;
  const std::vector<bool>& turns_;
  std::span<const CurvePole> poles_;
  const std::optional<OneCoordinate>& one_;
  std::span<const EndCrossing> crossings_;
  double least_step_{};
  int added_{};  ///< columns, for a closer look
  std::vector<EquilibriumBranch> result_;
  std::vector<std::size_t> open_;  ///< branches that reach the last column
  double last_{-std::numeric_limits<double>::infinity()};
};

}  // namespace

std::vector<EquilibriumBranch> branches(const EquilibriaAt& equilibria_at, const EquilibriaBetween& between,
                                        double from, double to, const KnownOfCurves& known) {
  return Tracer(equilibria_at, between, known).run(from, to);
}

bool is_known_between(double low, double high, std::span<const CriticalValue> critical,
                      std::span<const double> elsewhere) {
  const auto is_near = [&](const CriticalValue& c) {
    return c.value + c.error >= low && c.value - c.error <= high;
  };
  const auto is_between = [&](double value) { return value >= low && value <= high; };
  return std::ranges::any_of(critical, is_near) || std::ranges::any_of(elsewhere, is_between);
}

bool changes_between(std::span<const EquilibriumBranch> branches, std::span<const CriticalValue> critical,
                     std::span<const double> degenerate) {
  const auto changes_after = [&](const EquilibriumBranch& branch, std::size_t i) {
    const std::vector<double>& p = branch.parameter;
    if (branch.stability[i] == branch.stability[i + 1]) return false;
    // Next to a critical value rounding may hide which it is.
    std::size_t first = i, last = i + 1;
    while (first > 0 && branch.stability[first] == Stability::neutral) --first;
    while (last + 1 < p.size() && branch.stability[last] == Stability::neutral) ++last;
    const double low = p[first > 0 ? first - 1 : 0], high = p[std::min(last + 1, p.size() - 1)];
    return !is_known_between(low, high, critical, degenerate);
  };
  return std::ranges::any_of(branches, [&](const EquilibriumBranch& branch) {
    for (std::size_t i = 0; i + 1 < branch.parameter.size(); ++i) {
      if (changes_after(branch, i)) return true;
    }
    return false;
  });
}

}  // namespace qdot
