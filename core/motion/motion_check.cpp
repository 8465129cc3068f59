#include "core/motion/motion_check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/compile/extended/expansion.hpp"
#include "core/integrate/methods.hpp"
#include "core/integrate/own_errors.hpp"
#include "core/motion/accumulation.hpp"
#include "core/motion/extended_impacts.hpp"
#include "core/motion/extended_kinks.hpp"
#include "core/motion/hidden_impacts.hpp"
#include "core/motion/rounded_forces.hpp"
#include "core/motion/typed_start.hpp"
#include "core/numerics/pairs.hpp"
#include "core/numerics/random_bits.hpp"

namespace qdot {
namespace {

constexpr double tightest_check = 1e-17;
constexpr double rung = 1e-2;  ///< a check's tolerance over that of the run it checks
constexpr double check_of_others = 1e-3;
constexpr double tightest_stiff_check = 1e-14;
constexpr double rung_of_same = 10;  ///< of which one is the tighter, where both are by one method
constexpr unsigned order_of_checks = 22;
constexpr unsigned order_of_loose_checks = 20;  ///< of runs that have order 16
constexpr double drift_of_rounding = 1e-14;     ///< relative
/// A check that is off by r of what the motion is, is off by r/(1 - r) of their difference: twice that is in
/// the error stated (row_errors.hpp) up to a third.
constexpr double in_error_stated = 1.0 / 3;
constexpr double farther_than_samples = 50;  ///< one sample of rounding in fifty is as small by chance
constexpr double many_roundings = 10;        ///< than rounding of which a sample is known
constexpr double at_an_end = 1e-9;           ///< of the span: there an event may be a rounding away
/// Of what a component passed on the way: as much the coefficients that stay doubles may have in common with
/// those of the motion. A component that is small again after a pulse has it still.
constexpr double common_rounding = 0x1p-53;
constexpr double much_less = 0.9;  ///< is an atol that is chosen for a small motion, than that of any other
constexpr std::uint64_t cost_of_digits = 3;  ///< of an evaluation in double-doubles
constexpr std::uint64_t cost_of_all_digits = 12;

/// Every number by some units in the last place, up and down in turn and each of four in a row by another
/// amount, so that the difference and the ratio of two that are near each other move as well: what rounding
/// does to the motion, the rounding that all runs have in common included. It is nothing beside any other
/// error. `least`: units of the first two; other numbers that are nudged beside these have others.
void nudge(Reals& numbers, double direction, int least) {
  double towards = direction * infinity;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    double x = numbers[i];
    if (x == 0) continue;
    const int units = least + (moved++ % 4 >= 2 ? 1 : 0);
    for (int k = 0; k < units; ++k) x = std::nextafter(x, towards);
    numbers.set(i, x);
    towards = -towards;
  }
}

/// Every number somewhere else, so far away as OwnErrors wants it, by random numbers that it begins itself.
Reals rounded_otherwise(Reals numbers) {
  constexpr double unit = 2 * std::numeric_limits<double>::epsilon() * OwnErrors::enlarged;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    RandomBits random(std::bit_cast<std::uint64_t>(numbers[i]) + i);
    const double side = random() % 2 == 0 ? 1 : -1;
    numbers.set(i, numbers[i] * (1 + side * unit * (0.25 + random.fraction())));
  }
  return numbers;
}

bool has_lost_digits(const Reals& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers.exact(i).has_lost_digits()) return true;
  }
  return false;
}

/// Numbers of which few digits are known, as far away as they may be.
Reals farthest(Reals numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Real& x = numbers.exact(i);
    if (!x.has_lost_digits()) continue;
    const DoubleDouble moved = x.double_double() + DoubleDouble(x.error);
    numbers.set(i, {moved.high, moved.low, x.error});
  }
  return numbers;
}

/// By one method and with about one tolerance errors of truncation would be alike. Where a check cannot be
/// tighter it is looser: then the difference is no less than the motion's own.
Tolerances tolerances_of_check(const ComputedMotion& motion) {
  const double least = motion.is_stiff ? tightest_stiff_check : tightest_check;
  const bool is_same = motion.is_stiff && motion.simulation.method == Method::bdf;
  if (is_same && motion.tolerances.rtol < rung_of_same * least)
    return {rung_of_same * motion.tolerances.rtol, rung_of_same * motion.tolerances.atol};
  const MethodRecord& first = record_of(motion.simulation.method);
  // What a fixed step comes to is not known before: its check is as tight as can be.
  const double factor = first.has_fixed_step() ? 0 : first.expands() ? rung : check_of_others;
  const double rtol = std::max(least, motion.tolerances.rtol * factor);
  const double least_atol = least * 1e-3;
  if (motion.tolerances.atol < least_atol)  // of a motion that is small itself
    return {rtol, motion.tolerances.atol * (rtol / motion.tolerances.rtol)};
  return {rtol, std::max(motion.tolerances.atol * factor, least_atol)};
}

/// Whether the check keeps what is conserved so much better than the motion does that what it is off by
/// itself is in the error stated. Where rounding, and not the length of the steps, is what changes it, one
/// run is as good as the other. None is judged whose change is round-off in the motion as well.
bool keeps_better(const Simulation& motion, const Simulation& check) {
  const ConservedRecord* most = nullptr;
  for (const ConservedRecord& record : motion.conserved) {
    if (record.max_rel_drift.value_or(0) <= drift_of_rounding) continue;
    if (most == nullptr || *record.max_rel_drift > *most->max_rel_drift) most = &record;
  }
  if (most == nullptr) return true;
  const auto same = std::ranges::find(check.conserved, most->name, &ConservedRecord::name);
  return same == check.conserved.end() || same->max_abs_drift <= in_error_stated * most->max_abs_drift;
}

/// What rounding of the accelerations does to the velocities in a step, as some rows show. Where a motion
/// begins all runs have it in common, and in few steps they may have it by chance.
std::vector<double> rounding_of_a_step(const ComputedMotion& motion) {
  if (motion.simulation.rows == 0 || motion.simulation.steps == 0)
    return std::vector<double>(motion.width() / 2);
  std::vector<double> rounding = rounding_of_forces(motion);
  const double duration = motion.simulation.t - motion.request.t_start;
  for (double& x : rounding) x *= duration / static_cast<double>(motion.simulation.steps);
  return rounding;
}

/// Which columns do; empty where the difference of one of them is round-off.
std::vector<bool> columns_that_vary(const ComputedMotion& motion, const Simulation& check,
                                    std::span<const double> differences) {
  const std::size_t width = motion.width();
  const std::size_t count = std::min(motion.simulation.states.size(), check.states.size());
  const double* states = motion.simulation.states.data();
  std::vector<bool> varies(width);
  for (std::size_t k = 0; k < width; ++k) {
    double size = 0;
    bool is_other = false;
    for (std::size_t i = k; i < count; i += width) {
      size = std::max(size, std::abs(states[i]));
      is_other = is_other || states[i] != states[k];
    }
    if (is_other && differences[k] <= near_round_off * size) return {};
    varies[k] = is_other;
  }
  return varies;
}

/// None where the equations or what happens on the way cannot be followed in double-doubles.
std::optional<ExtendedRun> extended_states_of(const Simulation& motion, const Dynamics& dynamics,
                                              const ExtendedMotionRequest& request) {
  const bool has_kinks = dynamics.kinks() != nullptr, has_impacts = !motion.sections.empty();
  if (has_kinks) {
    if (has_impacts) return std::nullopt;
    return extended_states_along(motion.pieces, dynamics, request);
  }
  if (!has_extended_expansion(dynamics.accelerations())) return std::nullopt;
  return has_impacts ? extended_states_through(motion.sections, dynamics, request)
                     : extended_states(dynamics, request);
}

/// What the coefficients that stay doubles may have in common with those of the motion, for each row. That of
/// a velocity moves its coordinate on ever after.
std::vector<double> rounding_in_common(const ComputedMotion& motion, std::span<const double> instants,
                                       std::span<const double> passed) {
  const std::size_t width = motion.width(), n = width / 2;
  std::vector<double> rounding(passed.size()), moved(n);
  double before = motion.request.t_start;
  for (std::size_t row = 0; row < passed.size() / width; ++row) {
    const double span = instants[row] - std::exchange(before, instants[row]);
    const std::size_t at = row * width;
    for (std::size_t k = 0; k < width; ++k) rounding[at + k] = common_rounding * passed[at + k];
    for (std::size_t i = 0; i < n; ++i) {
      moved[i] += span * rounding[at + n + i];
      rounding[at + i] += moved[i];
    }
  }
  return rounding;
}

bool accumulates(const Simulation& simulation) {
  return simulation.stop && simulation.stop->reason == impacts_accumulate;
}

/// Times of an event, but for those next to the first and the last instant.
std::vector<double> times_of(const Simulation& simulation, const std::string& name, double begin,
                             double end) {
  const double beside = at_an_end * (end - begin);
  std::vector<double> times;
  for (const EventRecord& event : simulation.events) {
    if (event.name == name && event.t - begin > beside && end - event.t > beside) times.push_back(event.t);
  }
  return times;
}

/// As far as both go. Where flights become shortest, what is left of them is known to a part only.
bool are_same(std::span<const double> one, std::span<const double> other, double begin, double end) {
  constexpr double last_flights = 1e-6, part_of_flight = 0.1;
  const double span = end - begin;
  const std::size_t count = std::min(one.size(), other.size());
  return std::ranges::equal(one.first(count), other.first(count), [=](double t, double u) {
    const double left = end - t, of_flight = left <= last_flights * span ? part_of_flight * left : 0;
    return std::abs(t - u) <= std::max(at_an_end * span, of_flight);
  });
}

/// Impacts, and where a check looks for them, events.
std::vector<std::string> events_compared(const ComputedMotion& motion) {
  std::vector<std::string> names;
  if (motion.has_events_in_doubt()) names = motion.request.events;
  if (motion.request.impacts == Impacts::ignore) return names;
  for (const ParsedImpact& impact : motion.dynamics.model().parsed.impacts) {
    if (std::ranges::find(names, impact.event) == names.end()) names.push_back(impact.event);
  }
  return names;
}

}  // namespace

SimulationRequest check_of(const ComputedMotion& motion, double direction) {
  SimulationRequest request = motion.request;
  request.grid = motion.event_rows.instants();
  request.columns.clear();
  if (!motion.has_events_in_doubt()) request.events.clear();
  request.method = motion.is_stiff ? Method::bdf : Method::taylor;
  const bool is_loose =
      !record_of(motion.simulation.method).has_fixed_step() && motion.tolerances.rtol >= loose_tolerance;
  request.taylor_order = is_loose ? order_of_loose_checks : order_of_checks;
  request.is_reference = true;
  request.notes_approaches = true;
  request.tolerances = tolerances_of_check(motion);
  request.y_start = start_as_typed(motion.dynamics, motion.request);
  if (record_of(request.method).expands())
    request.originals = {{farthest(request.parameters), farthest(request.y_start)},
                         {rounded_otherwise(request.parameters), rounded_otherwise(request.y_start)}};
  nudge(request.parameters, direction, 1);
  nudge(request.y_start, direction, 3);
  return request;
}

std::vector<double> largest_differences(const ComputedMotion& motion, const Simulation& check) {
  const std::size_t width = motion.width();
  const std::size_t count = std::min(motion.simulation.states.size(), check.states.size());
  const double *own = motion.simulation.states.data(), *other = check.states.data();
  std::vector<double> differences(width);
  double* const most = differences.data();
  for (const double* const end = own + count; own != end; own += width, other += width) {
    for (std::size_t k = 0; k < width; k += 2) {
      const PairOfDoubles difference = magnitudes(pair_at(own + k) - pair_at(other + k));
      put_pair(most + k, larger_or(difference, pair_at(most + k)));
    }
  }
  return differences;
}

bool tells_truncation(const ComputedMotion& motion, const Simulation& check) {
  const std::size_t width = motion.width(), n = width / 2;
  const std::vector<double> differences = largest_differences(motion, check);
  const std::vector<bool> varies = columns_that_vary(motion, check, differences);
  if (varies.empty()) return false;
  const std::vector<double> in_common = rounding_of_a_step(motion);
  for (std::size_t i = 0; i < n; ++i) {
    if (differences[n + i] <= many_roundings * in_common[i]) return false;
  }
  if (!keeps_better(motion.simulation, check)) return false;
  for (std::size_t k = 0; k < width; ++k) {
    if (!varies[k]) continue;
    const double difference = differences[k];
    for (std::size_t i = k; i < check.apart.size(); i += width) {
      if (many_roundings * difference <= check.apart[i]) return false;
      if (difference <= farther_than_samples * check.apart_by_rounding[i]) return false;
    }
  }
  return true;
}

const char* not_comparable(const ComputedMotion& motion, const Simulation& check) {
  const auto begin = motion.grid.wanted.begin();
  const auto from = static_cast<std::ptrdiff_t>(check.rows);
  const auto to = static_cast<std::ptrdiff_t>(motion.simulation.rows);
  if (from >= to || std::find(begin + from, begin + to, true) == begin + to) return nullptr;
  if (ended_well(check.ending)) {
    return "The second computation stopped before this one: whether the motion goes so far is no more "
           "certain than its error allows, which could not be measured.";
  }
  if (check.ending == Ending::step_limit) {
    return "The steps or evaluations allowed were spent before the second computation, which would have "
           "measured the error, came to its end.";
  }
  return "The second computation, which would have measured the error, did not come to its end.";
}

std::vector<EventDoubt> differing_events(const ComputedMotion& motion, const Simulation& check) {
  const double begin = motion.request.t_start, end = std::min(motion.simulation.t, check.t);
  const bool accumulate = accumulates(motion.simulation) && accumulates(check);
  std::vector<EventDoubt> found;
  for (const std::string& name : events_compared(motion)) {
    const std::vector<double> own = times_of(motion.simulation, name, begin, end),
                              others = times_of(check, name, begin, end);
    // The last ones before they accumulate are left out by each where it no longer sees them.
    const bool is_known = accumulate && are_same(own, others, begin, end);
    if (own.size() == others.size() || is_known) continue;
    found.push_back({name, "The second computation meets " + name + " " + std::to_string(others.size()) +
                               " times, this one " + std::to_string(own.size()) +
                               " times: how often it happens is no more certain than the errors allow."});
  }
  return found;
}

SharperMotion in_more_digits(const ComputedMotion& motion, std::uint64_t evaluations_left) {
  const Simulation& first = motion.simulation;
  const SimulationRequest& asked = motion.request;
  if (has_lost_digits(asked.parameters) || has_lost_digits(asked.y_start)) return {};
  if (motion.is_stiff || first.rows == 0 || first.kinks_in_doubt) return {};
  const std::vector<double>& all = motion.event_rows.instants();
  const auto end = std::ranges::upper_bound(all, motion.grid.t[first.rows - 1]) - all.begin();
  const std::span<const double> instants = std::span(all).first(static_cast<std::size_t>(end));
  ExtendedMotionRequest request =
      extended_request(motion.request.parameters, start_as_typed(motion.dynamics, motion.request),
                       motion.request.t_start, instants);
  request.look_for_hidden = true;
  const auto [rtol, atol] = motion.tolerances;
  if (atol < much_less * rtol * request.atol_over_rtol) request.atol_over_rtol = atol / rtol;
  request.limits.max_evaluations = evaluations_left / cost_of_digits;
  std::optional<ExtendedRun> found = extended_states_of(first, motion.dynamics, request);
  if (!found) return {};
  SharperMotion result{.simulation = {}, .evaluations = cost_of_digits * found->evaluations};
  if (found->ending == Ending::undetermined) {
    request.form = ExtendedMotionRequest::Form::full;
    request.follow_rounding = true;
    request.limits.max_evaluations = evaluations_left / cost_of_all_digits;
    found = extended_states_of(first, motion.dynamics, request);
    if (!found) return result;
    result.evaluations += cost_of_all_digits * found->evaluations;
  }
  const ExtendedRun& run = *found;
  if (run.rows == 0 || !run.bounded) return result;
  Simulation& sharper = result.simulation.emplace();
  sharper.rows = run.rows;
  for (const DoubleDouble& x : run.states) sharper.states.push_back(x.value());
  sharper.unseen = rounding_in_common(motion, instants, run.passed);
  sharper.apart = run.apart;
  add_hidden_impacts(motion, sharper);
  motion.event_rows.set_apart(sharper, motion.width());
  return result;
}

}  // namespace qdot
