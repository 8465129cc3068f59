#include "core/motion/accuracy_goal.hpp"

#include <algorithm>

#include "core/motion/motion_check.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

constexpr double loosest = 1e-2;
constexpr double aim = 0.2;  ///< of the wanted error, when the next tolerance is chosen
/// So small a part of the wanted error leaves room for a looser run; so loose that may be, of what is wanted.
constexpr double far_below = 0.02, loosest_of_wanted = 0.1;
constexpr double next_to_digits = 2 * near_round_off;  ///< the check of a tighter run takes double-doubles
/// Times the work of a loose run and its check: that of a check in double-doubles.
constexpr double work_of_digits = 12;

Tolerances with_rtol(double rtol) { return {rtol, rtol * 1e-3}; }

double rtol_to_meet(double excess, double rtol) {
  return std::max(tightest_tolerance, rtol * std::clamp(aim / excess, 1e-6, 0.1));
}

}  // namespace

Tolerances first_tolerances(const AccuracyGoal& goal) {
  if (goal.kind == AccuracyGoal::Kind::work) return with_rtol(loosest);
  // Where it would be so tight that the check takes double-doubles, a little more than that is tried first.
  const double likely = std::max(goal.value * 1e-3, std::min(goal.value * 1e-2, next_to_digits));
  return with_rtol(std::clamp(likely, tightest_tolerance, loosest));
}

Tolerances tighter_tolerances(const Tolerances& now, double excess) {
  return with_rtol(rtol_to_meet(excess, now.rtol));
}

std::optional<Tolerances> looser_tolerances(const Tolerances& now, double excess, const AccuracyGoal& goal) {
  if (!(excess <= far_below)) return std::nullopt;
  const double looser = std::min({now.rtol * aim / excess, loosest_of_wanted * goal.value, loosest});
  return looser > now.rtol ? std::optional(with_rtol(looser)) : std::nullopt;
}

std::optional<Tolerances> tolerances_for_work(const Tolerances& now, std::uint64_t evaluations,
                                              std::uint64_t left) {
  // A run and its check cost twice as much as now when the tolerance goes down by this factor.
  const double cost = static_cast<double>(evaluations) * 2.4;
  const double growth = static_cast<double>(left) / cost;
  if (growth < 1) return std::nullopt;
  const double factor = evaluate(Function::exp, -15 * evaluate(Function::log, growth));
  // Near round-off a check takes double-doubles, and several times the work.
  const double least = growth < work_of_digits ? 100 * near_round_off : tightest_tolerance;
  if (now.rtol <= least) return std::nullopt;
  return with_rtol(std::clamp(now.rtol * factor, least, std::max(least, now.rtol * 0.1)));
}

bool is_enough_to_expect(const Tolerances& now, double excess) {
  return now.rtol <= next_to_digits || rtol_to_meet(excess, now.rtol) >= next_to_digits;
}

}  // namespace qdot
