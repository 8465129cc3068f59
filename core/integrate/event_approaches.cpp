// Where in a step a function may come near to zero (approaches.hpp).

#include <algorithm>
#include <cmath>

#include "core/integrate/events.hpp"

namespace qdot {
namespace {

constexpr double well_known = 1e-9;  ///< of g: what it is off there does not move the places where it turns
constexpr double shortest_piece = 0x1p-6;   ///< of what is looked at in pieces
constexpr double shortest_sharp = 0x1p-36;  ///< the same where g is a step
constexpr double much_of_change = 0.05;
constexpr std::size_t most_looks_nearby = 256;
constexpr double shortest_slope = 0x1p-20;  ///< of a piece
constexpr double hidden_share = 0.25;       ///< of a piece, in which slopes have no sign

}  // namespace

void EventSearch::look_for_approaches(const Stepper& stepper, const Found& found) {
  const double begin = polynomial_.whole().t, h = polynomial_.whole().h;
  const double end = found.terminal ? found.events.back().t : stepper.t();
  const auto ends_run = [&](const EventOccurrence& event) { return event.t == end && event.hidden == 0; };
  const bool is_last =
      (found.terminal && std::ranges::any_of(found.events, ends_run)) || end >= request_.t_end;
  for (const std::size_t i : near_) {
    const bool is_met = std::ranges::any_of(
        found.events, [&](const EventOccurrence& event) { return event.event == i && ends_run(event); });
    look_along(i, h > 0 ? end - begin : h, is_last, is_met);
    const int sign = sign_before(i, is_met);
    if (!is_met || !request_.events[i].terminal || sign == 0) continue;
    const double beyond = begin + h - end + beyond_step * h;
    const auto [past, length] = told_series(i, end - begin, beyond, beyond * shortest_piece);
    approaches_.pass(along(i, end - begin, length, sign, past), polynomial_);
  }
}

void EventSearch::look_along(std::size_t event, double until, bool is_last, bool is_met) {
  const int sign = sign_before(event, is_met);
  if (request_.events[event].terminal && sign == 0) return;
  looks_ = 0;
  look_in_pieces({event, sign, until, is_last && !is_met}, 0, until);
}

/// In halves until coefficients tell where g turns.
void EventSearch::look_in_pieces(const Way& way, double from, double length) {
  const UnitSeries series = finite_series(way.event, polynomial_.piece(from, length));
  if (is_worth_halving(way, length, series)) {
    look_in_pieces(way, from, length / 2);
    return look_in_pieces(way, from + length / 2, length / 2);
  }
  const bool nearly_ends = way.nearly_ends && from + length == way.until;
  const ApproachSearch::Along g = along(way.event, from, length, way.sign, series);
  if (series.is_nowhere)
    approaches_.leave(way.event);
  else if (request_.events[way.event].terminal)
    approaches_.look(g, polynomial_, nearly_ends);
  else
    approaches_.look_at_both_sides(g, polynomial_, nearly_ends);
}

/// Where g may come near to zero and is not seen it may be a step such as tanh has, however short.
bool EventSearch::is_worth_halving(const Way& way, double length, const UnitSeries& series) {
  if (is_told(series) || !(length > way.until * shortest_sharp)) return false;
  if (length > way.until * shortest_piece) return true;
  double lower = series.c[0] - series.off, upper = series.c[0] + series.off;
  for (std::size_t k = 1; k < series.end; ++k) {
    lower += std::min(0.0, series.c[k]);
    upper += std::max(0.0, series.c[k]);
  }
  const bool is_seen = series.off <= much_of_change * (upper - lower);
  return !is_seen && approaches_.may_come_near(way.event, lower, upper) && ++looks_ <= most_looks_nearby;
}

/// g from there on, in the unit of a length that is halved until coefficients tell where g turns.
std::pair<EventSearch::UnitSeries, double> EventSearch::told_series(std::size_t event, double from,
                                                                    double length, double shortest) {
  for (;; length /= 2) {
    UnitSeries series = finite_series(event, polynomial_.piece(from, length));
    if (is_told(series) || !(length > shortest)) return {std::move(series), length};
  }
}

bool EventSearch::is_told(const UnitSeries& series) {
  double size = 0;
  for (const double c : series.in_whole()) size += std::abs(c);
  return series.off <= well_known * size;
}

/// That g has had before the step's event, which it has met there or not.
int EventSearch::sign_before(std::size_t event, bool is_met) const {
  const Crossing direction = request_.events[event].direction;
  if (direction != Crossing::either) return direction == Crossing::falling ? 1 : -1;
  return is_met ? -signs_[event] : signs_[event];
}

ApproachSearch::Along EventSearch::along(std::size_t event, double from, double length, int sign,
                                         const UnitSeries& series) {
  ApproachSearch::Along g{event, from, length, sign, series.in_whole(), series.off, is_told(series)};
  g.is_rounding = !g.is_told && is_rounding(event, polynomial_.piece(from, length), series);
  if (request_.events[event].sharp_signs && series.is_finite())
    g.sharp_slopes = sharp_slopes(event, from, length);
  g.known_sign = [=, this](double place) { return known_sign(event, from + place * length); };
  return g;
}

/// That the search has seen so long after the step's beginning.
int EventSearch::known_sign(std::size_t event, double time) const {
  for (const Piece& piece : pieces_[event])
    if (piece.from <= time && time <= piece.to) return piece.sign;
  return 0;
}

/// Of a piece, in its unit.
decltype(ApproachSearch::Along::sharp_slopes) EventSearch::sharp_slopes(std::size_t event, double begin,
                                                                        double length) {
  return [=, this](double from, double to) -> std::vector<SignPiece> {
    // The state at t_start is not known to more digits than doubles, and that is near to zero already.
    const bool is_start = polynomial_.whole().t == request_.t_start && begin + from * length == 0;
    if (is_start || !can_look_sharply(event)) return {};
    std::vector<SignPiece> slopes =
        request_.events[event].sharp_signs({polynomial_.whole(), begin + from * length, begin + to * length,
                                            shortest_slope * (to - from) * length, true});
    double doubt = 0;
    for (SignPiece& piece : slopes) {
      piece.from = (piece.from - begin) / length;
      piece.to = (piece.to - begin) / length;
      if (piece.sign == 0) doubt += piece.to - piece.from;
    }
    return doubt <= hidden_share * (to - from) ? slopes : std::vector<SignPiece>();
  };
}

}  // namespace qdot
