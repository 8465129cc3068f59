#include "core/integrate/approaches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

constexpr double of_coefficients = 4 * std::numeric_limits<double>::epsilon();
constexpr double unseen = 64;  ///< times what g may be away: so far past zero and back it does not count
constexpr int halvings_of_slopes = 60;
constexpr int halvings_of_turns = 16;
constexpr double part_of_depth = 0.25;  ///< of a parabola: with less below zero it is none
constexpr double first_part = 0x1p-40;  ///< of a way along which something is looked for
constexpr double part_beside = 0.125;   ///< of a piece: what is a minimum over that counts

double sum_at(double s, std::span<const double> c) {
  double sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * s + c[k];
  return sum;
}

/// Of sign g, which is positive before the event.
class Slopes {
 public:
  std::vector<SignPiece> signs;  ///< definite ones

  explicit Slopes(const ApproachSearch::Along& g) : g_(g) {
    if (g.is_rounding && g.sharp_slopes) keep_definite(g.sharp_slopes(0, 1), g.sign);
    is_sharp_ = !signs.empty();
    if (!is_sharp_) take_coefficients();
  }

  /// Whether they are known beyond the rounding of coefficients.
  [[nodiscard]] bool is_sharp() const { return is_sharp_; }

  /// Where they come to have this sign.
  [[nodiscard]] double change_between(double from, double to, int sign) const {
    if (from == to || is_sharp_) return from + (to - from) / 2;
    for (int i = 0; i < halvings_of_slopes; ++i) {
      const double middle = 0.5 * (from + to);
      (sign * sum_at(middle, c_) > 0 ? to : from) = middle;
    }
    return to;
  }

 private:
  void take_coefficients() {
    double size = 0;
    for (std::size_t k = 1; k < g_.c.size(); ++k) {
      c_.push_back(g_.sign * static_cast<double>(k) * g_.c[k]);
      size += std::abs(c_.back());
    }
    if (!c_.empty()) keep_definite(signs_of(c_, of_coefficients * size), 1);
    if (g_.sharp_slopes) sharpen();
  }

  void keep_definite(std::span<const SignPiece> pieces, int factor) {
    for (const SignPiece& piece : pieces)
      if (piece.sign != 0) signs.push_back({piece.from, piece.to, factor * piece.sign});
  }

  [[nodiscard]] bool is_hidden(double s) const { return std::abs(sum_at(s, g_.c)) <= unseen * g_.off; }

  /// Where rounding hides g, coefficients do not tell where it turns, either.
  void sharpen() {
    std::vector<double> places{0};
    for (std::size_t i = 0; i + 1 < signs.size(); ++i) {
      if (signs[i].sign != signs[i + 1].sign)
        places.push_back(change_between(signs[i].to, signs[i + 1].from, signs[i + 1].sign));
    }
    places.push_back(1);
    double since = 0;  // what lies before it is looked at
    for (const double place : places) {
      if (place < since || !is_hidden(place)) continue;
      const double from = end_of_hidden(place, since), to = end_of_hidden(place, 1);
      if (from < to) replace(from, to);
      since = to;
    }
  }

  void replace(double from, double to) {
    const std::vector<SignPiece> sharp = g_.sharp_slopes(from, to);
    if (sharp.empty()) return;
    for (const SignPiece& piece : std::exchange(signs, {})) {
      if (piece.from <= from) signs.push_back({piece.from, std::min(piece.to, from), piece.sign});
      if (piece.to >= to) signs.push_back({std::max(piece.from, to), piece.to, piece.sign});
    }
    keep_definite(sharp, g_.sign);
    std::ranges::stable_sort(signs, {}, &SignPiece::from);
  }

  /// On the way from a place to an end.
  [[nodiscard]] double end_of_hidden(double place, double end) const {
    for (double part = first_part; part < 1; part *= 2) {
      const double s = place + part * (end - place);
      if (!is_hidden(s)) return s;
    }
    return end;
  }

  const ApproachSearch::Along& g_;
  std::vector<double> c_;
  bool is_sharp_{};
};

}  // namespace

ApproachSearch::ApproachSearch(const RunRequest& request)
    : request_(request), of_events_(request.notes_approaches ? request.events.size() : 0) {}

bool ApproachSearch::is_near(std::size_t event, double lower, double upper) {
  if (of_events_.empty()) return false;
  OfEvent& of_event = of_events_[event];
  of_event.reach = std::max({of_event.reach, std::abs(lower), std::abs(upper)});
  const bool is_small = !(std::min(std::abs(lower), std::abs(upper)) > near_zero * of_event.reach);
  const bool is_near = is_small || (lower < 0) != (upper < 0);
  if (!is_near) of_event.slope = 0;
  return is_near;
}

bool ApproachSearch::may_come_near(std::size_t event, double lower, double upper) const {
  const double near = near_zero * of_events_[event].reach;
  return !(lower > near) && !(upper < -near);
}

/// In a step in which g comes into its domain nothing is known of it as a whole.
void ApproachSearch::widen_reach(const Along& g) {
  double& reach = of_events_[g.event].reach;
  const auto widen = [&](double value) {
    if (std::isfinite(value)) reach = std::max(reach, std::abs(value));
  };
  widen(g.c[0]);
  if (g.is_told) widen(sum_at(1, g.c));
}

void ApproachSearch::look(const Along& g, StepPolynomial& step, bool is_last) {
  widen_reach(g);
  const Slopes slopes(g);
  constexpr double before = 1 - of_coefficients;  // what is met at the end is not nearly met
  int slope = of_events_[g.event].slope;
  double since = 0;
  for (const SignPiece& piece : slopes.signs) {
    if (slope < 0 && piece.sign > 0) {
      const double place = slopes.change_between(since, piece.from, 1);
      if (place < before) note(g, step, place, g.sign * sum_at(place, g.c), {});
    }
    slope = piece.sign;
    since = piece.to;
  }
  of_events_[g.event].slope = slope;
  if (is_last && slope < 0) note(g, step, 1, g.sign * sum_at(1, g.c), {});
}

/// Where g turns it is on the side to which it turns back, or past zero by no more than is seen.
void ApproachSearch::look_at_both_sides(Along g, StepPolynomial& step, bool is_last) {
  g.sign = 1;
  widen_reach(g);
  const Slopes slopes(g);
  const bool is_told = g.is_told || slopes.is_sharp();
  const bool was_told = std::exchange(of_events_[g.event].is_told, is_told);
  const auto note_turn = [&](double place, int sign) {
    g.sign = sign;
    if (g.known_sign && g.known_sign(place) == -sign) return;
    g.is_told = is_told && (place > 0 || was_told);
    note(g, step, place, sign * sum_at(place, g.c), {});
  };
  int slope = of_events_[g.event].slope;
  double since = 0;
  for (const SignPiece& piece : slopes.signs) {
    if (slope * piece.sign < 0) note_turn(slopes.change_between(since, piece.from, piece.sign), piece.sign);
    slope = piece.sign;
    since = piece.to;
  }
  of_events_[g.event].slope = slope;
  if (is_last && slope != 0) note_turn(1, -slope);
}

/// It would have missed where g comes back before it has gone far: the deepest place up to there tells.
void ApproachSearch::pass(const Along& g, StepPolynomial& step) {
  const Slopes slopes(g);
  const double met = step.whole().t + g.from;
  double since = 0, place = 0, deepest = 0;
  int slope = -1;
  for (const SignPiece& piece : slopes.signs) {
    if (piece.sign != slope) {
      const double turn = slopes.change_between(since, piece.from, piece.sign);
      const double value = -g.sign * sum_at(turn, g.c);
      if (piece.sign < 0 && value < -g.off) break;
      if (piece.sign > 0 && value >= deepest) {
        deepest = value;
        place = turn;
      }
    }
    slope = piece.sign;
    since = piece.to;
  }
  if (slope > 0) note(g, step, place, deepest, met);
  if (slope < 0 && since == 1) pass_slowly(g, step);
}

/// Short steps do not tell how far it would go: a parabola does, as long as that is not far. Where g has come
/// back before that parabola turns, it turns earlier.
void ApproachSearch::pass_slowly(const Along& g, StepPolynomial& step) {
  const double near = near_zero * of_events_[g.event].reach, c1 = g.sign * g.c[1], c2 = g.sign * g.c[2];
  if (!(-g.sign * sum_at(1, g.c) <= near && c1 < 0 && c2 > 0)) return;
  double turn = -c1 / (2 * c2);
  const double met = step.whole().t + g.from, depth = c2 * turn * turn;
  if (!(depth <= near)) return;
  Approach approach{.event = g.event, .met = met, .sign = g.sign};
  const auto value_after = [&](double s) {
    approach.t = met + s * g.length;
    set_rows(approach, step);
    return g.sign * request_.events[g.event].value(approach.t, approach.state_at(0));
  };
  double value = value_after(turn), deepest = turn;
  for (int i = 0; i < halvings_of_turns && value > -part_of_depth * depth; ++i) {
    const double earlier = value_after(turn /= 2);
    if (earlier < value) deepest = turn;
    value = std::min(earlier, value);
  }
  (void)value_after(deepest);
  if (-value <= near) add(std::move(approach), step);
}

/// `s`: in the unit of the piece; `value`: of |g|, below zero by rounding at most.
void ApproachSearch::note(const Along& g, StepPolynomial& step, double s, double value,
                          std::optional<double> met) {
  if (value < -unseen * g.off) return;
  const double t = step.whole().t + g.from + s * g.length;
  Approach approach{.event = g.event, .t = t, .met = met, .sign = g.sign, .distance = std::abs(value)};
  if (!g.is_told) {
    set_rows(approach, step);
    if (!takes_own_value(approach, part_beside * g.length, s == 1)) return;
  }
  if (approach.distance <= near_zero * of_events_[g.event].reach) add(std::move(approach), step);
}

/// Where coefficients do not tell, as beside a pole, the end of a root's domain or a step of tanh, values do.
/// False where an event that is reported only has none, or is nearer to zero beside that place.
bool ApproachSearch::takes_own_value(Approach& approach, double beside, bool is_end) const {
  const EventFunction& event = request_.events[approach.event];
  const auto value_at = [&](double s) { return event.value(approach.t + s, approach.state_at(s)); };
  const double value = value_at(0);
  if (!std::isfinite(value)) return event.terminal && !event.must_have_value;  // then the run ends before
  approach.distance = std::abs(value);
  if (event.terminal) return true;
  const double before = value_at(-beside), after = is_end ? value : value_at(beside);
  const auto is_nearer = [&](double other) { return other * value > 0 && std::abs(other) < std::abs(value); };
  if (is_nearer(before) || is_nearer(after)) return false;
  if (value != 0) approach.sign = value > 0 ? 1 : -1;
  return true;
}

void ApproachSearch::doubt(const Along& g, StepPolynomial& step) {
  if (of_events_.empty()) return;
  const double t = step.whole().t + g.from + g.length / 2;
  add({.event = g.event, .t = t, .sign = g.sign, .is_hidden = true}, step);
}

void ApproachSearch::ask_condition(std::size_t event, StepPolynomial& step, double from, double value) {
  if (of_events_.empty()) return;
  const double t = step.whole().t + from;
  const std::optional<double> met = value > 0 ? std::optional(t) : std::nullopt;
  add({.event = event, .t = t, .met = met, .sign = -1, .is_condition = true, .distance = std::abs(value)},
      step);
}

void ApproachSearch::set_rows(Approach& approach, StepPolynomial& step) {
  const MotionPiece& whole = step.whole();
  approach.h = whole.h;
  approach.rows.clear();
  const double end = whole.t + (1 + beyond_step) * whole.h;
  const bool is_beyond = approach.t > end;
  const MotionPiece there = step.piece((is_beyond ? *approach.met : approach.t) - whole.t, whole.h);
  const unsigned order = std::min(is_beyond ? 2 : Approach::order, whole.order);
  for (std::size_t i = 0; i < there.rows.size(); i += whole.order + 1) {
    const auto row = there.rows.subspan(i, order + 1);
    approach.rows.insert(approach.rows.end(), row.begin(), row.end());
    approach.rows.resize(approach.rows.size() + Approach::order - order);
  }
  if (is_beyond) approach.shift(approach.t - *approach.met);
}

void ApproachSearch::add(Approach approach, StepPolynomial& step) {
  set_rows(approach, step);
  const EventFunction& event = request_.events[approach.event];
  const bool counts =
      approach.is_condition || !event.condition || event.condition(approach.t, approach.state_at(0)) > 0;
  if (counts) found_.push_back(std::move(approach));
}

}  // namespace qdot
