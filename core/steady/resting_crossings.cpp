#include "core/steady/resting_crossings.hpp"

#include <algorithm>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/dense_matrix.hpp"
#include "core/numerics/enclosed_system.hpp"
#include "core/steady/critical_sentences.hpp"
#include "core/steady/resting_places.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_unknowns_at_rest = 4;

/// The other curve where det g_x has a simple zero in p.
class CrossingCurve {
 public:
  CrossingCurve(const LastingPlace& place, const SteadyProblem& problem, const Interval& p)
      : place_(place), problem_(problem), p_(p), n_(place.x.size()), slopes_(n_ * n_) {
    TapeEvaluator<Interval>(place.slopes, problem.constants)(Box{p}, slopes_);
    Eigen::MatrixXd middle(n_, n_);
    for (std::size_t i = 0; i < n_ * n_; ++i)
      middle(static_cast<Eigen::Index>(i / n_), static_cast<Eigen::Index>(i % n_)) = slopes_[i].middle();
    left_ = most_shortened(middle.transpose());
    right_ = most_shortened(middle);
  }

  [[nodiscard]] BifurcationKind kind() const {
    const Box v = with_exact_zeros(bordered(Side::right, Box(n_), 1)), u = bordered(Side::left, Box(n_), 1);
    Box quadratic = along(place_.second, v, Box(n_));
    if (!product(u, quadratic).contains(0.0)) return BifurcationKind::transcritical;
    const auto is_zero = [](const Interval& q) { return q.lower == 0 && q.upper == 0; };
    if (!is_reflected(v) && !std::ranges::all_of(quadratic, is_zero)) return BifurcationKind::unresolved;
    for (Interval& q : quadratic) q = Interval(-0.5) * q;
    const Interval cubic = product(u, along(place_.third, v, bordered(Side::right, quadratic, 0)));
    return cubic.contains(0.0) ? BifurcationKind::unresolved : BifurcationKind::pitchfork;
  }

 private:
  enum class Side { left, right };

  /// x with K x + h left = b, right x = c, K = g_x or its transpose, where left and right change places. At
  /// the zero of det K, h = 0 where K x = b has a solution.
  [[nodiscard]] Box bordered(Side side, const Box& b, double c) const {
    const std::size_t size = n_ + 1;
    Box matrix(size * size), x(size);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j)
        matrix[i * size + j] = side == Side::right ? slopes_[i * n_ + j] : slopes_[j * n_ + i];
      const auto k = static_cast<Eigen::Index>(i);
      matrix[i * size + n_] = side == Side::right ? left_[k] : right_[k];
      matrix[n_ * size + i] = side == Side::right ? right_[k] : left_[k];
      x[i] = b[i];
    }
    x[n_] = c;
    solve_linear(size, matrix, x);
    x.pop_back();
    return x;
  }

  /// What may be 0 in v is, where no other part drives it and its own part of K, of at most two rows, is
  /// regular.
  [[nodiscard]] Box with_exact_zeros(Box v) const {
    std::vector<std::size_t> zeros;
    for (std::size_t k = 0; k < n_; ++k) {
      if (v[k].contains(0.0)) zeros.push_back(k);
    }
    const auto entry = [&](std::size_t i, std::size_t j) { return slopes_[zeros[i] * n_ + zeros[j]]; };
    if (zeros.empty() || zeros.size() > 2) return v;
    for (const std::size_t i : zeros) {
      for (std::size_t j = 0; j < n_; ++j) {
        if (!v[j].contains(0.0) && slopes_[i * n_ + j].magnitude() > 0) return v;
      }
    }
    const Interval regular =
        zeros.size() == 1 ? entry(0, 0) : entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
    if (regular.contains(0.0)) return v;
    for (const std::size_t k : zeros) v[k] = Interval(0);
    return v;
  }

  [[nodiscard]] Box along(const CompiledFunction& function, const Box& v, const Box& w) const {
    Box place = v, values(n_);
    place.insert(place.end(), w.begin(), w.end());
    place.push_back(p_);
    TapeEvaluator<Interval>(function, problem_.constants)(place, values);
    return values;
  }

  [[nodiscard]] static Interval product(const Box& a, const Box& b) {
    Interval sum(0);
    for (std::size_t k = 0; k < a.size(); ++k) sum = sum + a[k] * b[k];
    return sum;
  }

  /// Whether a reflection turns v into -v. It turns v into v or -v, as K has no other kernel; so one part of
  /// v that turns is enough, where those that stay may be 0.
  [[nodiscard]] bool is_reflected(const Box& v) const {
    return std::ranges::any_of(place_.reflected, [&](const std::vector<bool>& turned) {
      bool turns = false;
      for (std::size_t k = 0; k < n_; ++k) turns = turns || (turned[k] && !v[k].contains(0.0));
      return turns;
    });
  }

  const LastingPlace& place_;
  const SteadyProblem& problem_;
  Interval p_;
  std::size_t n_;
  Box slopes_;
  Eigen::VectorXd left_, right_;
};

/// The zeros of one factor of det g_x.
std::vector<IsolatedZero> zeros_of(const LastingPlace& place, std::size_t factor,
                                   const SteadyProblem& problem, const Interval& range) {
  const auto along = [&](const CompiledFunction& function) {
    return [&, factor](std::span<const Interval> p, std::span<Interval> out) {
      Box all(function.outputs());
      TapeEvaluator<Interval>(function, problem.constants)(p, all);
      out[0] = all[factor];
    };
  };
  return isolate_zeros({1, along(place.conditions), along(place.changes)}, {range}).zeros;
}

/// Whether the slope of det g_x is not 0: no two of its factors vanish.
bool changes_sign(const LastingPlace& place, const SteadyProblem& problem, const Interval& p) {
  Box all(place.changes.outputs());
  TapeEvaluator<Interval>(place.changes, problem.constants)(Box{p}, all);
  return !all.back().contains(0.0);
}

KnownZero known_crossing(const LastingPlace& place, const SteadyProblem& problem,
                         const BifurcationSystems& systems, const Interval& p, bool is_simple) {
  const std::vector<std::size_t>& all = problem.forces->unknowns;
  CriticalZero zero{BifurcationSystem::Kind::meeting, {}, p, is_simple};
  for (const std::size_t j : systems.unknowns)
    zero.x.push_back(place.x[static_cast<std::size_t>(std::ranges::find(all, j) - all.begin())]);
  if (!is_simple) return {zero, BifurcationKind::unresolved, several_events, {}};
  const BifurcationKind kind = CrossingCurve(place, problem, p).kind();
  return {zero, kind, kind == BifurcationKind::unresolved ? degenerate_crossing : "", {}};
}

}  // namespace

std::vector<KnownZero> resting_crossings(const Scene& scene, const SteadyProblem& problem,
                                         const BifurcationSystems& systems, std::size_t place,
                                         const Interval& range, std::span<const double> degenerate) {
  std::vector<KnownZero> result;
  const std::size_t n = problem.forces->unknowns.size();
  if (n < 2 || n > most_unknowns_at_rest || n != problem.forces->equations.size()) return result;
  for (const LastingPlace& at : resting_places(scene, problem, place)) {
    for (std::size_t k = 0; k < at.conditions.outputs(); ++k) {
      for (const IsolatedZero& zero : zeros_of(at, k, problem, range)) {
        const Interval& p = zero.enclosure[0];
        const auto is_there = [&](double value) { return p.contains(value); };
        if (is_empty(intersection(p, range)) || std::ranges::any_of(degenerate, is_there)) continue;
        result.push_back(
            known_crossing(at, problem, systems, p, zero.simple && changes_sign(at, problem, p)));
      }
    }
  }
  return result;
}

void take_crossings(std::vector<KnownZero>& found, std::vector<KnownZero> crossings) {
  for (KnownZero& crossing : crossings) {
    const auto is_there = [&](const KnownZero& other) { return overlap(other.zero, crossing.zero); };
    const bool is_known = crossing.kind != BifurcationKind::unresolved;
    if (is_known) std::erase_if(found, is_there);
    if (std::ranges::none_of(found, is_there)) found.push_back(std::move(crossing));
  }
}

}  // namespace qdot
