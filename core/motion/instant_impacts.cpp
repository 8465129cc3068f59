#include "core/motion/instant_impacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/short_number.hpp"
#include "core/mechanics/restitution.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_in_an_instant = 2000, most_in_order = 200;
constexpr std::size_t most_in_all_orders = 4;
constexpr double rounding_of_order = 1e-12;  ///< of the largest number
/// Of a state's numbers: their own rounding, and that of the steps that led to them.
constexpr double rounding_of_state = 16 * std::numeric_limits<double>::epsilon();

Ball rounded(double x) { return {DoubleDouble(x), rounding_of_state * std::abs(x)}; }

std::vector<Ball> rounded(std::span<const double> numbers) {
  std::vector<Ball> balls;
  for (const double x : numbers) balls.push_back(rounded(x));
  return balls;
}

std::vector<Ball> exact(std::span<const double> numbers) { return {numbers.begin(), numbers.end()}; }

/// Whether other impacts have happened, or the same to another end.
bool is_other(const InstantImpacts::Passed& one, const InstantImpacts::Passed& other,
              std::span<const double> before) {
  const auto happened = [](const InstantImpacts::Passed& passed) {
    std::vector<std::size_t> impacts;
    for (const auto& [impact, state] : passed.all) impacts.push_back(impact);
    std::ranges::sort(impacts);
    return impacts;
  };
  if (happened(one) != happened(other)) return true;
  double size = 0, apart = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    size = std::max({size, std::abs(one.after[k]), std::abs(other.after[k]), std::abs(before[k])});
    apart = std::max(apart, std::abs(one.after[k] - other.after[k]));
  }
  return apart > rounding_of_order * size;
}

}  // namespace

InstantImpacts::InstantImpacts(const Dynamics& dynamics, std::span<const double> parameters,
                               double resolution)
    : parameters_(parameters), resolution_(resolution) {
  for (const ParsedImpact& impact : dynamics.model().parsed.impacts) {
    Rule& rule = rules_.emplace_back();
    rule.event = impact.event;
    rule.map = impact_map(dynamics.model(), impact);
    rule.after = dynamics.columns(rule.map.components);
    if (!impact.has_restitution()) continue;
    rule.restitution = restitution_of(impact, dynamics.model().parsed, parameters);
    rule.enclosed_after = std::make_unique<TapeEvaluator<Ball>>(*rule.after, exact(parameters));
    rule.approach =
        dynamics.columns({{"distance", "", impact.contact->distance}, {"rate", "", impact.contact->rate}});
    rule.enclosed_approach = std::make_unique<TapeEvaluator<Ball>>(*rule.approach, rounded(parameters));
  }
}

InstantImpacts::Passed InstantImpacts::pass(double t, const std::vector<double>& y,
                                            const std::vector<bool>& met, std::span<const Watch> watches,
                                            const EventSides& sides, ImpactOrder order) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < rules_.size(); ++k) {
    if (met[k]) all.push_back(k);
  }
  if (order == ImpactOrder::reverse) std::ranges::reverse(all);
  const Instant now{t, y, watches, sides};
  Passed passed = in_order(now, all);
  if (all.size() > 1) compare_orders(now, std::move(all), passed);
  return passed;
}

/// Two orders may have two ends; where a surface is passed both ways, or where there are more orders, there
/// are others, too.
void InstantImpacts::compare_orders(const Instant& now, std::vector<std::size_t> met, Passed& passed) const {
  const bool are_many = met.size() > most_in_all_orders;
  std::vector<std::size_t> order = met;
  std::ranges::reverse(order);
  passed.order_matters = is_other(passed, in_order(now, order), now.y);
  std::ranges::sort(order);
  for (bool goes_on = met.size() > 2 && !are_many; goes_on;
       goes_on = std::ranges::next_permutation(order).found)
    passed.order_matters = passed.order_matters || is_other(passed, in_order(now, order), now.y);
  const bool turns_freely =
      std::ranges::any_of(met, [&](std::size_t k) { return now.watches[k].direction == Crossing::either; });
  passed.is_unclear = passed.order_matters && (met.size() > 2 || turns_freely);
}

InstantImpacts::Passed InstantImpacts::in_order(const Instant& now, std::span<const std::size_t> met) const {
  Passed passed{{}, now.y};
  for (const std::size_t k : met) {
    if (passed.all.empty() || still_comes(now, k, passed.after)) apply(k, now.t, passed);
  }
  if (met.size() > 1) passed.within = resolution_;
  for (;;) {
    std::optional<double> later;
    const std::size_t next = next_after(passed, now, later);
    if (next == rules_.size()) {
      doubt_rates_left(now.t, passed);
      return passed;
    }
    if (passed.all.size() >= most_in_an_instant) break;
    passed.within = std::max(passed.within, *later);
    apply(next, now.t, passed);
  }
  passed.is_over = false;
  return passed;
}

/// The first in order that follows, and when; the number of all where none does. Bodies that stick take turns
/// once there are many: each two of them would come together before the next one has a turn.
std::size_t InstantImpacts::next_after(const Passed& passed, const Instant& now,
                                       std::optional<double>& later) const {
  const std::size_t count = rules_.size(), last = passed.all.empty() ? count : passed.all.back().impact;
  const auto sticks = [&](const Happened& happened) { return rules_[happened.impact].restitution == 0.0; };
  const bool take_turns = passed.all.size() >= most_in_order && std::ranges::all_of(passed.all, sticks);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = ((take_turns ? last + 1 : 0) + i) % count;
    if (k != last && (later = follows(k, now, passed.after))) return k;
  }
  return count;
}

/// Impacts that start each other again and again take rates away until rounding hides them.
void InstantImpacts::doubt_rates_left(double t, Passed& passed) const {
  for (std::size_t k = 0; k < rules_.size(); ++k) {
    if (std::ranges::count(passed.all, k, &Happened::impact) < 2) continue;
    const std::optional<double> left = hidden_rate(k, t, passed.after);
    if (!left) continue;
    passed.rounding.resize(passed.after.size());
    for (const std::size_t place : rules_[k].map.places) passed.rounding[place] += *left;
  }
}

/// What was met, after others: where they have turned the motion away it is not reached.
bool InstantImpacts::still_comes(const Instant& now, std::size_t impact, const std::vector<double>& y) const {
  const Watch& watch = now.watches[impact];
  if (rules_[impact].approach && watch.direction != Crossing::either)
    return follows(impact, now, y).has_value();
  if (watch.value(now.t, y) != watch.value(now.t, now.y)) return true;
  return now.sides.goes_through(watch, now.t, now.y, y);
}

/// Of a rule with restitution.
InstantImpacts::Approach InstantImpacts::approach(const Rule& rule, double t, const std::vector<double>& y) {
  rule.enclosed_approach->set_time(rounded(t));
  Ball values[2];
  (*rule.enclosed_approach)(rounded(y), values);
  return {values[0], values[1]};
}

/// Where its distance is 0 there and falls, neither in doubt for its rounding: by how many seconds it may be
/// apart.
std::optional<double> InstantImpacts::follows(std::size_t impact, const Instant& now,
                                              const std::vector<double>& y) const {
  const Rule& rule = rules_[impact];
  const Watch& watch = now.watches[impact];
  if (!rule.approach || watch.direction == Crossing::either) return std::nullopt;
  if (now.sides.is_behind_start(watch, now.t)) return std::nullopt;
  const auto [distance, rate] = approach(rule, now.t, y);
  if (!distance.is_finite() || !rate.is_finite() || rate.contains_zero()) return std::nullopt;
  if ((rate.value() > 0) != (watch.direction == Crossing::rising)) return std::nullopt;
  const double speed = std::abs(rate.value()), off = std::abs(distance.value());
  if (off > distance.radius + speed * resolution_) return std::nullopt;
  if (watch.condition && !(watch.condition(now.t, y) > 0)) return std::nullopt;
  return std::min((off + distance.radius) / speed, resolution_);
}

std::optional<double> InstantImpacts::hidden_rate(std::size_t impact, double t,
                                                  const std::vector<double>& y) const {
  const Rule& rule = rules_[impact];
  if (!rule.approach) return std::nullopt;
  const auto [distance, rate] = approach(rule, t, y);
  const bool is_hidden =
      distance.is_finite() && rate.is_finite() && distance.contains_zero() && rate.contains_zero();
  return is_hidden ? std::optional(rate.magnitude()) : std::nullopt;
}

bool InstantImpacts::leaves_no_rate(std::size_t impact, double t, const std::vector<double>& y) const {
  const Rule& rule = rules_[impact];
  if (!rule.approach) return false;
  const Ball rate = approach(rule, t, y).rate;
  return rate.is_finite() && rate.contains_zero();
}

std::vector<double> InstantImpacts::repeat(double t, std::vector<double> y,
                                           std::span<const Happened> impacts) const {
  for (const Happened& happened : impacts) change(happened.impact, t, y);
  return y;
}

void InstantImpacts::apply(std::size_t impact, double t, Passed& passed) const {
  passed.all.push_back({impact, passed.after});
  change(impact, t, passed.after, &passed.rounding);
}

void InstantImpacts::change(std::size_t impact, double t, std::vector<double>& y,
                            std::vector<double>* rounding) const {
  const Rule& rule = rules_[impact];
  if (!rule.enclosed_after) return rule.map.assign(values_of(rule, t, y), y);
  const Told told = told_after(rule, t, y);
  for (std::size_t i = 0; rounding != nullptr && i < told.off.size(); ++i) {
    const std::size_t place = rule.map.places[i];
    if (!(told.off[i] > rounding_of_state * std::abs(y[place]))) continue;
    rounding->resize(y.size());
    (*rounding)[place] += told.off[i];
  }
  rule.map.assign(told.values, y);
}

std::vector<double> InstantImpacts::values_of(const Rule& rule, double t,
                                              const std::vector<double>& y) const {
  std::vector<double> values(rule.map.components.size());
  Workspace workspace = rule.after->bind(parameters_);
  if (rule.after->evaluate(t, y, workspace, values) != Evaluation::ok)
    throw Error(ErrorCode::not_applicable, "Where '" + rule.event +
                                               "' happens, at t = " + short_number(t, 6) +
                                               ", the impact's map has no finite value.");
  return values;
}

/// Near a multiple root the distance has a slope that is hardly more than the rounding of doubles, and at it
/// none.
InstantImpacts::Told InstantImpacts::told_after(const Rule& rule, double t,
                                                const std::vector<double>& y) const {
  const std::size_t count = rule.map.components.size();
  std::vector<Ball> enclosed(count);
  rule.enclosed_after->set_time(t);
  (*rule.enclosed_after)(exact(y), enclosed);
  if (!std::ranges::all_of(enclosed, &Ball::is_finite))
    throw Error(ErrorCode::invalid_state,
                "Where '" + rule.event +
                    "' happens its function has no slope that can be told from 0: in "
                    "which direction this impact turns the motion is not known.");
  Told told{std::vector<double>(count), std::vector<double>(count)};
  std::vector<double>& values = told.values;
  Workspace workspace = rule.after->bind(parameters_);
  const bool is_told = rule.after->evaluate(t, y, workspace, values) == Evaluation::ok;
  for (std::size_t i = 0; i < count; ++i) {
    const double better = enclosed[i].value(), off = std::abs(values[i] - better);
    const double size = std::max(std::abs(y[rule.map.places[i]]), std::abs(better));
    if (!is_told || (off > rounding_of_order * size && enclosed[i].radius < off)) values[i] = better;
    told.off[i] = std::abs(values[i] - better) + enclosed[i].radius;
  }
  return told;
}

}  // namespace qdot
