#include "core/motion/event_sides.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"
#include "core/motion/pressing.hpp"
#include "core/motion/typed_start.hpp"

namespace qdot {
namespace {

constexpr double beside_begin = 64;     ///< times what is one instant: as far from where a section begins
constexpr double lost_rate = 1e-9;      ///< is rounding
constexpr double of_own_rounding = 64;  ///< so much a state's own is larger than that of its numbers
constexpr double same_surface = 1e-12;  ///< relative
constexpr double unseen_by_doubles = 0x1p-80, seen_by_doubles = 0x1p-40;
constexpr double told_by_half = 0.5;
constexpr unsigned order_of_slopes = 5;    ///< the least that a series has
constexpr double longest_of_rates = 1e-2;  ///< of the motion's span
constexpr double next_of_rates = 4;

/// x + time * rate, in twice the digits: beside one that is zero a double's last digit would be all.
Real moved(double x, double time, double rate) {
  const DoubleDouble sum = DoubleDouble(x) + two_product(time, rate);
  return {sum.high, sum.low, 0};
}

int sign_of(const Ball& value) {
  if (!value.is_finite() || value.contains_zero()) return 0;
  return value.value() > 0 ? 1 : -1;
}

/// Whether some coordinate, moved by that part of the largest one, or as far as it goes in that time, leaves
/// zero to both sides: beside a multiple root all digits are rounding.
bool changes_sign_around(const Watch& watch, const Reals& parameters, const Real& t, const Reals& y,
                         double part, double time = 0) {
  const std::size_t n = y.size() / 2;
  double size = 0;
  for (std::size_t i = 0; i < n; ++i) size = std::max(size, std::abs(y[i]));
  const double step = part * (size > 0 ? size : 1);
  const auto sign_at = [&](std::size_t i, double moved_by) {
    Reals there = y;
    const DoubleDouble x = y.exact(i).double_double() + DoubleDouble(moved_by);
    there.set(i, {x.high, x.low, y.exact(i).error});
    return sign_of(watch.exact(parameters, t, there));
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double own = std::max(step, time * std::abs(y[n + i]));
    if (sign_at(i, own) * sign_at(i, -own) < 0) return true;
  }
  return false;
}

}  // namespace

int EventSides::at_start(const Watch& watch) const {
  const auto value = rounded_at_start(watch);
  return value ? sign_of(*value) : 0;
}

/// The value at t_start in twice the digits, where doubles round it away.
std::optional<Ball> EventSides::rounded_at_start(const Watch& watch) const {
  if (!watch.exact) return std::nullopt;
  const double value = watch.value(request_.t_start, request_.y_start);
  if (!(std::abs(value) <= of_own_rounding * watch.rounding(request_.t_start, request_.y_start)))
    return std::nullopt;
  const auto& [parameters, t, y] = typed_start(request_);
  return watch.exact(parameters, t, y);
}

/// Whether the motion begins on a surface that it hits from one side, as all digits have it.
bool EventSides::begins_on(const Watch& watch) const {
  if (watch.kind != Watch::Kind::impact || watch.direction == Crossing::either) return false;
  const auto value = rounded_at_start(watch);
  if (!value || !value->is_finite() || !value->contains_zero()) return false;
  const auto& [parameters, t, y] = typed_start(request_);
  return changes_sign_around(watch, parameters, t, y, unseen_by_doubles);
}

/// That of the distance's rate, however small it was typed.
int EventSides::sign_after_start(std::size_t watch) const {
  const std::vector<ParsedImpact>& all = dynamics_.model().parsed.impacts;
  const ParsedImpact& impact = all[watch - (sections_.watches().size() - all.size())];
  if (!impact.has_restitution()) return 0;
  const auto& [parameters, t, y] = typed_start(request_);
  TapeEvaluator<Ball> evaluate(*dynamics_.columns({{"rate", "", impact.contact->rate}}),
                               parameters.as<Ball>());
  evaluate.set_time(Ball::literal(t));
  Ball rate;
  evaluate(y.as<Ball>(), {&rate, 1});
  return sign_of(rate);
}

bool EventSides::is_behind_start(const Watch& watch, double t) const {
  if (t - request_.t_start > sections_.resolution() || watch.direction == Crossing::either) return false;
  return at_start(watch) == (watch.direction == Crossing::rising ? 1 : -1);
}

void EventSides::take(const Run& done) {
  const std::size_t count = sections_.watches().size();
  sides_.assign(done.signs.begin(),
                done.signs.begin() + static_cast<std::ptrdiff_t>(std::min(count, done.signs.size())));
  sides_.resize(count);
  is_crossed_.assign(count, false);
  for (const EventOccurrence& occurrence : done.events) {
    if (occurrence.event < count && occurrence.t == done.t) is_crossed_[occurrence.event] = true;
  }
}

void EventSides::go_on() {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    if (is_crossed_[i]) sides_[i] = -sides_[i];
  }
}

void EventSides::pass(const SectionRecord& impact) {
  const std::span<const Watch> watches = sections_.watches();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Watch& watch = watches[i];
    const bool is_moved = watch.value(impact.t, impact.before) != watch.value(impact.t, impact.after);
    if (is_moved) sides_[i] = 0;
    if (!is_crossed_[i]) continue;
    if (sides_[i] == 0 && watch.direction != Crossing::either)
      sides_[i] = watch.direction == Crossing::falling ? 1 : -1;
    if (!is_turned_by_restitution(i, impact) && goes_through(watch, impact.t, impact.before, impact.after))
      sides_[i] = -sides_[i];
    else if (watch.kind != Watch::Kind::impact)
      sides_[i] = 0;  // it was met, and may have been just behind: the motion leaves it on either side
  }
}

/// However small its rate is there, and so may be all rounding.
bool EventSides::is_turned_by_restitution(std::size_t watch, const SectionRecord& impact) const {
  const std::vector<ParsedImpact>& all = dynamics_.model().parsed.impacts;
  const std::size_t first = sections_.watches().size() - all.size();
  if (watch < first || !all[watch - first].has_restitution()) return false;
  return std::ranges::find(impact.impacts, watch - first) != impact.impacts.end() &&
         is_sharp(sections_.watches()[watch], impact);
}

bool EventSides::is_sharp(const Watch& watch, const SectionRecord& impact) const {
  return watch.exact && changes_sign_around(watch, request_.parameters, impact.t, Reals(impact.before),
                                            seen_by_doubles, sections_.resolution());
}

void EventSides::mark(double t, std::span<const double> y, const SectionRecord* impact,
                      std::vector<EventFunction>& events) const {
  const std::span<const Watch> watches = sections_.watches();
  for (std::size_t i = 0; i < watches.size(); ++i) {
    if (sides_.empty()) {
      events[i].sign_at_start = at_start(watches[i]);
      if (begins_on(watches[i])) {
        events[i].is_zero_at_start = true;
        events[i].sign_after_start = sign_after_start(i);
      }
    } else if (sides_[i] != 0 && (sides_[i] * watches[i].value(t, y) > 0 || is_near_zero(watches[i], t, y))) {
      events[i].sign_at_start = sides_[i];
    }
    events[i].is_beside_zero = events[i].sign_at_start != 0;
  }
  if (impact != nullptr) mark_impacts(*impact, events);
  for (std::size_t i = 0; i < watches.size(); ++i) look_sharply(watches[i], t, events[i]);
}

/// Twice the digits tell more of the computed motion than it is known itself. What was typed is known so;
/// where a later section begins beside zero, what lies beside it there is what the section before has left,
/// and of an impact all that follows from it.
void EventSides::look_sharply(const Watch& watch, double begin, EventFunction& event) const {
  if (!watch.sharp_signs) return;
  const bool is_typed = sides_.empty(), is_left = event.sign_at_start != 0 || event.is_zero_at_start;
  event.sharp_signs = [=, this, &watch](const SharpLook& look) -> std::vector<SignPiece> {
    const bool is_begin = look.piece.t == begin;
    const double clear = beside_begin * sections_.resolution();
    const bool is_impact = watch.kind == Watch::Kind::impact;
    if (is_begin && is_left && !is_typed && (is_impact || look.from <= clear)) {
      if (is_impact || look.to <= clear) return {};
      const SharpLook rest{look.piece, clear, look.to, look.shortest, look.is_of_slope};
      std::vector<SignPiece> signs = watch.sharp_signs(typed_start(request_).parameters, nullptr, rest);
      if (!signs.empty()) signs.insert(signs.begin(), {look.from, clear, 0});
      return signs;
    }
    if (!is_begin || !is_typed) return watch.sharp_signs(typed_start(request_).parameters, nullptr, look);
    const bool is_of_typed = is_left && request_.originals;
    const Reals start = is_of_typed ? request_.originals->asked.y_start : start_as_typed(dynamics_, request_);
    return watch.sharp_signs(typed_start(request_).parameters, &start, look);
  };
}

/// An impact that has just happened, and left its distance as it was, begins at distance zero.
void EventSides::mark_impacts(const SectionRecord& last, std::vector<EventFunction>& events) const {
  const std::size_t first = sections_.watches().size() - dynamics_.model().parsed.impacts.size();
  for (const std::size_t impact : last.impacts) {
    EventFunction& event = events[first + impact];
    const Watch& watch = sections_.watches()[first + impact];
    if (event.value(last.t, last.before) != event.value(last.t, last.after)) continue;
    const bool turns = dynamics_.model().parsed.impacts[impact].has_restitution();
    const bool is_turned = turns || !goes_through(watch, last.t, last.before, last.after);
    if (is_turned && event.direction == Crossing::either && sides_[first + impact] != 0)
      event.direction = sides_[first + impact] > 0 ? Crossing::falling : Crossing::rising;
    const bool is_off = is_turned && is_unpressed(watch, last);
    if (is_turned && !is_off && leaves_unseen(watch, last, sides_[first + impact])) {
      event.sign_at_start = sides_[first + impact];
      event.is_beside_zero = true;
      continue;
    }
    event.is_zero_at_start = event.direction != Crossing::either && is_turned;
    event.counts_at_start = event.is_zero_at_start && !is_off;
    if (event.is_zero_at_start) event.sign_at_start = 0, event.is_beside_zero = false;
  }
}

/// Whether the motion goes away from the surface to that side, and the slope there does not tell: rounding
/// hides it for a while, in which nothing is met.
bool EventSides::leaves_unseen(const Watch& watch, const SectionRecord& impact, int side) const {
  const double now = rate(watch, impact.t, impact.after).value;
  const double told = slope(watch, impact.t, impact.after);
  return side * now > 0 && std::abs(now - told) > told_by_half * std::max(std::abs(now), std::abs(told));
}

/// Whether the impact has left no rate that is more than rounding, and no forces are seen to lead back.
bool EventSides::is_unpressed(const Watch& watch, const SectionRecord& impact) const {
  const double now = std::abs(rate(watch, impact.t, impact.after).value);
  return now <= rounding_of_rate(watch, impact) &&
         pressing(watch, impact, sections_, request_.t_end - request_.t_start) <= 0;
}

/// By as much as the motion may be off there, or goes on in an instant.
bool EventSides::is_near_zero(const Watch& watch, double t, std::span<const double> y) const {
  const double value = std::abs(watch.value(t, y));
  const std::vector<double> there(y.begin(), y.end());
  return value <=
         of_own_rounding * watch.rounding(t, y) + std::abs(slope(watch, t, there)) * sections_.resolution();
}

/// Of its function in time.
double EventSides::slope(const Watch& watch, double t, const std::vector<double>& y) const {
  const std::vector<double> slopes = sections_.slopes(t, y);
  constexpr unsigned width = order_of_slopes + 1;
  std::vector<double> rows(width * y.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    rows[width * i] = y[i];
    rows[width * i + 1] = slopes[i];
  }
  double c[width] = {};
  (void)watch.series({t, 0, rows, order_of_slopes, {}}, order_of_slopes, c);
  return c[1];
}

/// Over a time in which that is more than rounding: at a multiple root, too, its sign is the way that it
/// goes.
EventSides::Rate EventSides::rate(const Watch& watch, double t, const std::vector<double>& y) const {
  const double longest = longest_of_rates * (request_.t_end - request_.t_start);
  for (const bool is_sharp : {false, true}) {
    for (double tau = sections_.resolution(); tau < next_of_rates * longest; tau *= next_of_rates) {
      const double rate = is_sharp ? sharp_rate(watch, t, y, tau) : rate_over(watch, t, y, tau);
      if (rate != 0) return {rate, tau};
    }
  }
  return {0, longest};
}

std::vector<double> EventSides::ahead(double t, const std::vector<double>& y, double time) const {
  std::vector<double> there = y;
  const std::vector<double> slopes = sections_.slopes(t, y);
  for (std::size_t i = 0; i < y.size(); ++i) there[i] += time * slopes[i];
  return there;
}

/// 0 where it is rounding.
double EventSides::rate_over(const Watch& watch, double t, const std::vector<double>& y, double tau) const {
  const double change = watch.value(t + tau, ahead(t, y, tau)) - watch.value(t - tau, ahead(t, y, -tau));
  return std::abs(change) > of_own_rounding * watch.own_rounding(t, y) ? change / (2 * tau) : 0;
}

/// The same in twice the digits.
double EventSides::sharp_rate(const Watch& watch, double t, const std::vector<double>& y, double tau) const {
  if (!watch.exact) return 0;
  const std::vector<double> slopes = sections_.slopes(t, y);
  const auto value = [&](double time) {
    Reals there;
    for (std::size_t i = 0; i < y.size(); ++i) there.push_back(moved(y[i], time, slopes[i]));
    return watch.exact(request_.parameters, moved(t, time, 1), there);
  };
  const Ball change = value(tau) - value(-tau);
  return change.is_finite() && !change.contains_zero() ? change.value() / (2 * tau) : 0;
}

/// Over one time for both: next to a multiple root a rate grows with it.
bool EventSides::goes_through(const Watch& watch, double t, const std::vector<double>& before,
                              const std::vector<double>& after) const {
  const double longest = longest_of_rates * (request_.t_end - request_.t_start);
  const auto told = [&](const std::vector<double>& y, double tau) {
    const double rate = rate_over(watch, t, y, tau);
    return rate != 0 ? rate : sharp_rate(watch, t, y, tau);
  };
  for (double tau = rate(watch, t, before).tau; tau < next_of_rates * longest; tau *= next_of_rates) {
    const double was = told(before, tau), now = told(after, tau);
    if (now != 0) return was * now > 0 && std::abs(now) > lost_rate * std::abs(was);
  }
  return false;
}

double EventSides::late_at_begin(const Watch& watch, const SectionRecord& impact) const {
  if (impact.duration > sections_.resolution()) return 0;
  const double value = std::abs(watch.value(impact.t, impact.before));
  const double off = value + of_own_rounding * watch.own_rounding(impact.t, impact.before);
  const double speed = std::abs(slope(watch, impact.t, impact.before));
  return speed * sections_.resolution() > off ? off / speed : sections_.resolution();
}

bool EventSides::are_same_surface(const Watch& one, const Watch& other, double t,
                                  const std::vector<double>& y) const {
  if (!one.exact || !other.exact) return false;
  const Reals place(y);
  const Ball a = one.exact(request_.parameters, t, place) * Ball(slope(other, t, y));
  const Ball b = other.exact(request_.parameters, t, place) * Ball(slope(one, t, y));
  const double size = same_surface * std::max(a.magnitude(), b.magnitude());
  return (a - b).is_finite() && (a - b).magnitude() <= size + a.radius + b.radius;
}

}  // namespace qdot
