#include "core/integrate/events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/work.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr double of_start = 64 * std::numeric_limits<double>::epsilon();  ///< of coordinates: their rounding
constexpr double of_states = 1e-6;  ///< more than they are off by where anything is concluded from them
constexpr std::size_t most_looks = 4000;
constexpr std::size_t most_sharp_looks = 2000;  ///< in a run
constexpr std::size_t looks_in_doubt = 200;     ///< once not everything was seen: the rest is worth less work
constexpr std::size_t looks_of_change = 256;    ///< more for each change of sign: as many as a pole takes
constexpr std::size_t most_looks_of_changes = 1'000'000;  ///< in a run
constexpr std::size_t looks_between_questions = 64;       ///< whether anyone still waits for the answer
constexpr double shortest_of_step = 0x1p-50;  ///< where rounding of states hides g, or a pole's place
/// A sketch is this share of a step's change off at most.
constexpr double rough = 0.125;

bool same_instant(double t, double later) { return later - t <= one_instant * time_round_off(later); }

}  // namespace

EventSearch::EventSearch(const RunRequest& request)
    : request_(request),
      approaches_(request),
      signs_(request.events.size()),
      definite_(request.events.size(), request.t_start),
      pieces_(request.events.size()),
      untold_(request.events.size()),
      left_at_start_(request.events.size()),
      rounding_(request.events.size()),
      rounding_is_wide_(request.events.size()),
      y_(request.y_start.size()) {
  for (std::size_t i = 0; i < signs_.size(); ++i) {
    const EventFunction& event = request.events[i];
    signs_[i] = event.sign_at_start;
    const double left = is_zero_at_start(i) ? event.value(request.t_start, request.y_start) : 0;
    left_at_start_[i] = std::isfinite(left) ? left : 0;
  }
  signs_of_begin_ = signs_;
}

EventSearch::Found EventSearch::search(Stepper& stepper) {
  Found found;
  if (signs_.empty()) return found;
  found.failure = polynomial_.take(stepper, StepPolynomial::Look::rough);
  std::vector<std::size_t> open;
  near_.clear();
  nowhere_from_ = infinity;
  signs_of_begin_ = signs_;
  for (auto& pieces : pieces_) pieces.clear();
  for (std::size_t i = 0; i < signs_.size() && !found.failure; ++i) {
    forget_start(i);
    if (!is_quiet(i)) open.push_back(i);
  }
  if (!(open.empty() && near_.empty()) && !polynomial_.is_exact()) {
    found.failure = polynomial_.take(stepper, StepPolynomial::Look::exact);
  }
  std::vector<Crossed> crossed;
  for (const std::size_t i : open) {
    if (!found.failure) walk(i, crossed);
  }
  std::vector<Zero> zeros;
  for (const Crossed& crossing : crossed) {
    if (found.failure) break;
    const auto t = crossing.hidden > 0 ? crossing.after : locate(stepper, crossing, found);
    if (t) zeros.push_back({*t, crossing.event, crossing.hidden, crossing.untold});
  }
  if (!found.failure) report(stepper, std::move(zeros), found);
  if (found.terminal) approaches_.forget_after(found.events.back().t);
  if (nowhere_from_ < value_is_wanted_until(found)) found.failure = Ending::nonfinite;
  if (!found.failure && !near_.empty()) look_for_approaches(stepper, found);
  return found;
}

std::vector<int> EventSearch::signs_before(double t) const {
  const double begin = polynomial_.whole().t, instant = 16 * time_round_off(t);
  std::vector<int> signs = signs_of_begin_;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    for (const Piece& piece : pieces_[i]) {
      const bool counts = piece.sign != 0 || piece.is_nowhere;
      if (counts && begin + piece.from < t - instant) signs[i] = piece.sign;
    }
  }
  return signs;
}

/// Whether g keeps the sign it had, as few coefficients show.
bool EventSearch::is_quiet(std::size_t event) {
  const MotionPiece& piece = polynomial_.whole();
  rounding_[event] = rounding_of_values(event);
  if (signs_[event] == 0 && !request_.notes_approaches) return false;
  const UnitSeries series = unit_series(event, piece, low_order);
  if (series.is_nowhere) return false;
  const std::span<const double> c = series.coefficients();
  double lower = c[0], upper = c[0];
  for (std::size_t k = 1; k < c.size(); ++k) {
    lower += std::min(0.0, c[k]);
    upper += std::max(0.0, c[k]);
  }
  const double doubt = polynomial_.is_exact() ? series.off : series.off + rough * (upper - lower);
  if (approaches_.is_near(event, lower - doubt, upper + doubt)) near_.push_back(event);
  if (signs_[event] == 0) return false;
  const bool keeps = signs_[event] > 0 ? lower - doubt > 0 : upper + doubt < 0;
  if (keeps) {
    definite_[event] = piece.t + piece.h;
    untold_[event] = 0;
  }
  return keeps;
}

void EventSearch::walk(std::size_t event, std::vector<Crossed>& crossed) {
  const double begin = polynomial_.whole().t, h = polynomial_.whole().h;
  const Crossing direction = request_.events[event].direction;
  std::vector<Piece>& pieces = pieces_[event];
  looks_ = counted_ = changes_ = 0;
  most_changes_ = (direction == Crossing::either ? 1 : 2) * (most_occurrences + 1);
  last_sign_ = 0;
  starts_at_zero_ = false;
  explore(event, 0, h, pieces);
  look_through_rounding(event, h, pieces);
  doubt_hidden(event, pieces);
  if (signs_[event] == 0 && sign_at_start_ != 0) {
    signs_[event] = sign_at_start_;
    definite_[event] = begin;
  }
  if (takes_sign_at_start(event)) {
    signs_[event] = request_.events[event].sign_after_start;
    return crossed.push_back({event, begin, begin});
  }
  for (const Piece& piece : pieces) {
    if (piece.is_nowhere) signs_[event] = 0, starts_at_zero_ = false;
    if (piece.sign == 0) untold_[event] += piece.is_nowhere || piece.is_zero ? 0 : piece.to - piece.from;
    if (piece.sign == 0) continue;
    const double untold = std::exchange(untold_[event], 0);
    const bool is_wanted =
        direction == Crossing::either || (direction == Crossing::rising) == (piece.sign > 0);
    const bool leaves_start = signs_[event] == 0 && starts_at_zero_ && request_.events[event].counts_at_start;
    if (leaves_start && is_wanted) crossed.push_back({event, begin, begin});
    // A condition that is broken where its sign is first known was zero at t_start or has met zero since.
    const bool is_broken = signs_[event] == 0 && request_.events[event].must_have_value;
    if (is_broken && is_wanted) crossed.push_back({event, begin, begin + piece.from});
    if (signs_[event] == -piece.sign && is_wanted) {
      crossed.push_back({event, std::max(begin, definite_[event]), begin + piece.from, 0, untold});
    }
    if (const double hidden = hidden_before(event, begin + piece.from, piece.sign); hidden > 0)
      crossed.push_back({event, begin + piece.from, begin + piece.from, hidden, 0});
    signs_[event] = piece.sign;
    definite_[event] = begin + piece.to;
  }
}

/// Where a bound of rounding hides all signs, and more digits tell none, those of values are taken, if there
/// are any, from here on: then not everything is seen.
void EventSearch::look_through_rounding(std::size_t event, double h, std::vector<Piece>& pieces) {
  const auto has_no_sign = [](const Piece& piece) { return piece.sign == 0 && !piece.is_nowhere; };
  if (!(rounding_[event] > 0) || !std::ranges::all_of(pieces, has_no_sign)) return;
  const double rounding = std::exchange(rounding_[event], 0);
  std::vector<Piece> by_values;
  explore(event, 0, h, by_values);
  rounding_is_wide_[event] = !std::ranges::all_of(by_values, has_no_sign);
  if (!rounding_is_wide_[event]) {
    rounding_[event] = rounding;
    return;
  }
  saw_everything_ = false;
  pieces = std::move(by_values);
}

/// For how long until t, where g has that sign, none was seen after the same one; 0 where nobody asks.
double EventSearch::hidden_before(std::size_t event, double t, int sign) const {
  const EventFunction& function = request_.events[event];
  const bool is_begin = function.is_zero_at_start && definite_[event] <= request_.t_start;
  if (!function.ends_where_hidden || is_begin || signs_[event] != sign) return 0;
  const double hidden = t - definite_[event];
  return hidden > of_doubt * time_round_off(t) ? hidden : 0;
}

/// Between two pieces of one sign rounding hides the sign of g, which may be either, except beside a pole.
void EventSearch::doubt_hidden(std::size_t event, std::span<const Piece> pieces) {
  const Piece* before = nullptr;
  for (const Piece& piece : pieces) {
    if (piece.is_nowhere) before = nullptr;
    if (piece.sign == 0) continue;
    const bool is_hidden = before != nullptr && before->sign == piece.sign && before->to < piece.from;
    if (is_hidden && !is_beside_start(event, piece.from) &&
        !keeps_sign(event, before->to, piece.from, piece.sign) &&
        !is_away_from_zero(event, before->to, piece.from) && !is_pole_between(event, before->to, piece.from))
      approaches_.doubt({event, before->to, piece.from - before->to, piece.sign, {}, 0}, polynomial_);
    before = &piece;
  }
}

/// Whether the motion has gone no farther from where it began than the rounding of that state.
bool EventSearch::is_beside_start(std::size_t event, double from) {
  const MotionPiece& step = polynomial_.whole();
  if (step.t != request_.t_start || !request_.events[event].rounding_at_start) return false;
  const MotionPiece there = polynomial_.piece(from, step.h);
  for (std::size_t i = 0; i < y_.size() / 2; ++i) {
    const double begin = request_.y_start[i];
    if (!(std::abs(there.rows[i * (there.order + 1)] - begin) <= of_start * std::abs(begin))) return false;
  }
  return true;
}

/// By its range over all states of the piece, as where it jumps and both sides are far from zero.
bool EventSearch::is_away_from_zero(std::size_t event, double from, double to) {
  if (!request_.events[event].range) return false;
  const MotionPiece piece = polynomial_.piece(from, to - from);
  const Interval s(0, piece.h);
  std::vector<Interval> states;
  for (std::size_t i = 0; i < piece.rows.size(); i += piece.order + 1) {
    Interval y(0);
    for (std::size_t k = piece.order + 1; k-- > 0;) y = y * s + Interval(piece.rows[i + k]);
    const double off = of_states * std::abs(piece.rows[i]);
    states.push_back(y + Interval(-off, off));
  }
  return !request_.events[event].range(Interval(piece.t) + s, states).contains(0.0);
}

/// As more digits tell.
bool EventSearch::keeps_sign(std::size_t event, double from, double to, int sign) {
  std::vector<Piece> pieces;
  look_sharply(event, from, to, pieces);
  return std::ranges::all_of(pieces, [=](const Piece& piece) { return piece.sign == sign; });
}

/// g leaves zero at t_start in its direction, where that counts.
bool EventSearch::takes_sign_at_start(std::size_t event) const {
  const EventFunction& function = request_.events[event];
  if (polynomial_.whole().t != request_.t_start || signs_[event] != 0 || !function.counts_at_start)
    return false;
  return function.sign_after_start == (function.direction == Crossing::rising ? 1 : -1);
}

/// Of pieces whose sign is known, as far as they have been looked at.
std::size_t EventSearch::changes_of_sign(std::span<const Piece> pieces) {
  for (; counted_ < pieces.size(); ++counted_) {
    const int sign = pieces[counted_].sign;
    if (sign == 0) continue;
    if (sign != last_sign_) ++changes_;
    last_sign_ = sign;
  }
  return changes_;
}

/// How many looks a step is worth that has so many changes of sign already: none once there are more than one
/// answer may hold.
std::size_t EventSearch::most_looks_after(std::size_t changes) {
  if (changes > most_changes_) return 0;
  if (looks_ > most_looks) ++looks_of_changes_;
  const std::size_t more = looks_of_changes_ <= most_looks_of_changes ? looks_of_change * changes : 0;
  return (saw_everything_ ? most_looks : looks_in_doubt) + more;
}

/// The pieces of [from, to], in times since the step's beginning.
void EventSearch::explore(std::size_t event, double from, double to, std::vector<Piece>& pieces) {
  const std::size_t most = most_looks_after(changes_of_sign(pieces));
  if (++looks_ > most) saw_everything_ = false;
  if (most == 0) return pieces.push_back({{from, to, 0}});
  if (looks_ % looks_between_questions == 0) check_interruption();
  const MotionPiece whole = polynomial_.piece(from, to - from);
  const UnitSeries series = finite_series(event, whole);
  const double of_state = is_seen(series) ? 0 : shortest_of_step * polynomial_.whole().h;
  const double shortest = std::max(16 * time_round_off(whole.t + whole.h), of_state);
  starts_at_zero_ = starts_at_zero_ || series.is_divided;
  if (whole.h == polynomial_.whole().h) sign_at_start_ = series.sign_at_start;
  if (series.is_nowhere && request_.events[event].must_have_value)
    nowhere_from_ = std::min(nowhere_from_, from);
  if (series.is_nowhere) return pieces.push_back({{from, to, 0}, true});
  if (series.is_zero()) return pieces.push_back({{from, to, 0}, false, true});
  if (is_in_doubt(event, whole, series)) return look_sharply(event, from, to, pieces);
  const std::vector<SignPiece> found = signs_of(series.coefficients(), series.off);
  for (const SignPiece& piece : found) {
    const double begin = from + piece.from * whole.h, end = piece.to == 1 ? to : from + piece.to * whole.h;
    const double middle = 0.5 * (begin + end);
    if (piece.sign != 0 || end - begin <= shortest || looks_ > most) {
      pieces.push_back({{begin, end, piece.sign}});
    } else if (piece.to - piece.from < 0.5) {
      explore(event, begin, end, pieces);
    } else {
      explore(event, begin, middle, pieces);
      explore(event, middle, end, pieces);
    }
  }
}

/// Where values tell nothing, in as many digits as there are.
void EventSearch::look_sharply(std::size_t event, double from, double to, std::vector<Piece>& pieces) {
  std::vector<SignPiece> found;
  const MotionPiece& step = polynomial_.whole();
  if (can_look_sharply(event))
    found = request_.events[event].sharp_signs({step, from, to, 16 * time_round_off(step.t + step.h)});
  if (found.empty()) found.push_back({from, to, 0});
  for (const SignPiece& piece : found) pieces.push_back({piece});
}

bool EventSearch::can_look_sharply(std::size_t event) {
  if (!request_.events[event].sharp_signs) return false;
  if (++sharp_looks_ > most_sharp_looks) saw_everything_ = false;
  return sharp_looks_ <= most_sharp_looks;
}

/// Where g has no value, that is for others to see.
double EventSearch::rounding_of_values(std::size_t event) {
  const EventFunction& function = request_.events[event];
  if (!function.rounding || rounding_is_wide_[event]) return 0;
  const double rounding = function.rounding(polynomial_.whole().t, state_at_begin());
  return std::isfinite(rounding) ? rounding : 0;
}

/// Of the step.
const std::vector<double>& EventSearch::state_at_begin() {
  const MotionPiece& step = polynomial_.whole();
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] = step.rows[i * (step.order + 1)];
  return y_;
}

/// And has no sign that is known to be another.
bool EventSearch::is_zero_at_start(std::size_t event) const {
  return request_.events[event].is_zero_at_start && request_.events[event].sign_at_start == 0;
}

/// Once the motion is clear of it.
void EventSearch::forget_start(std::size_t event) {
  double& left = left_at_start_[event];
  if (left == 0) return;
  const double now = request_.events[event].value(polynomial_.whole().t, state_at_begin());
  if (std::abs(now) >= 2 * std::abs(left)) left = 0;
}

void EventSearch::report(Stepper& stepper, std::vector<Zero> zeros, Found& found) {
  std::ranges::sort(zeros, {}, [](const Zero& zero) { return std::pair(zero.t, zero.event); });
  for (auto first = zeros.begin(); first != zeros.end() && !found.terminal && !found.failure;) {
    auto last = first + 1;
    while (last != zeros.end() && same_instant((last - 1)->t, last->t)) ++last;
    const double t = (last - 1)->t;
    std::sort(first, last, [](const Zero& a, const Zero& b) { return a.event < b.event; });
    found.failure = stepper.interpolate(t, y_);
    for (; first != last && !found.failure; ++first) {
      const EventFunction& event = request_.events[first->event];
      if (event.condition) {
        const double value = event.condition(t, y_);
        approaches_.ask_condition(first->event, polynomial_, t - polynomial_.whole().t, value);
        if (!(value > 0)) continue;
      }
      found.events.push_back({first->event, t, y_, first->hidden, first->untold});
      found.terminal = found.terminal || event.terminal;
    }
  }
}

}  // namespace qdot
