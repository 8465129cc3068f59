#include "core/motion/accumulation.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr std::size_t longest_round = 4;   ///< impacts that take turns
constexpr std::size_t similar_rounds = 6;  ///< their durations show a geometric series
constexpr double similar = 1e-2;
constexpr double negligible = 1e-9;  ///< of the span: what is left of the series
constexpr double no_time = 16;       ///< round-offs of t

/// Of the last round of the series over 1 less their ratio, as similar as that.
constexpr double doubt_of_rest = 4 * similar;
constexpr double nearly_lowest = 1000;      ///< flights in which rounding may be seen, in units of the lowest
constexpr std::size_t most_by_chance = 64;  ///< impacts after the last of a series
constexpr double part_of_flight = 1e-4;     ///< in which a speed is measured
constexpr double safety_of_unseen = 16;
constexpr double largest_ratio = 0.99;

constexpr double roundings = 64;     ///< of the distance: what the search for events may not see
constexpr double poorly_seen = 1e4;  ///< of them: the duration of so low a flight is unknown
constexpr std::size_t hidden_in_a_row = 16;

/// On the cubic from y with velocities y' to the later state, half-way.
std::vector<double> halfway(const std::vector<double>& from, const std::vector<double>& to, double duration) {
  std::vector<double> y(from.size());
  const std::size_t n = y.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    y[i] = 0.5 * (from[i] + to[i]) + duration / 8 * (from[n + i] - to[n + i]);
    y[n + i] = 0.5 * (from[n + i] + to[n + i]);
  }
  return y;
}

/// Whether since that impact the distance has changed by so many of its roundings at most.
bool is_as_low_since(const Watch& watch, const SectionRecord& impact, double t, const std::vector<double>& y,
                     double times) {
  const double since = t - impact.t, at_impact = watch.value(impact.t, impact.after);
  const auto is_low = [&](double then, const std::vector<double>& there) {
    const double apart = std::abs(watch.value(then, there) - at_impact);
    return apart <= times * watch.own_rounding(then, there);
  };
  return is_low(t, y) && is_low(impact.t + since / 2, halfway(impact.after, y, since));
}

bool vanishes(const SectionRecord& section) {
  return section.duration <= no_time * time_round_off(section.t);
}

/// The last sections as rounds of `length` impacts each.
class Rounds {
 public:
  Rounds(std::span<const SectionRecord> sections, std::size_t length)
      : sections_(sections), length_(length) {}

  /// Whether the last ones consist of the same impacts.
  [[nodiscard]] bool repeat(std::size_t rounds) const {
    if (sections_.size() < rounds * length_) return false;
    for (std::size_t i = sections_.size() - (rounds - 1) * length_; i < sections_.size(); ++i) {
      if (sections_[i].impacts != sections_[i - length_].impacts) return false;
    }
    return true;
  }

  /// Of a round, the last one being number 0.
  [[nodiscard]] double duration(std::size_t round) const {
    double sum = 0;
    for (std::size_t k = 0; k < length_; ++k)
      sum += sections_[sections_.size() - 1 - round * length_ - k].duration;
    return sum;
  }

 private:
  std::span<const SectionRecord> sections_;
  std::size_t length_;
};

/// Of a series with these rounds; none where they are not one.
std::optional<RestOfImpacts> rest_of_series(const Rounds& rounds) {
  if (!rounds.repeat(similar_rounds)) return std::nullopt;
  double least = infinity, most = 0;
  for (std::size_t i = 0; i + 1 < similar_rounds; ++i) {
    const double ratio = rounds.duration(i) / rounds.duration(i + 1);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  if (!(most < 1) || most - least > similar * (1 - most)) return std::nullopt;
  const double last = rounds.duration(0) / (1 - most);
  return RestOfImpacts{most * last, doubt_of_rest * last, false};
}

/// Whether from that one on there are only impacts that the last round before it has, too: others make
/// another motion, of which that round tells nothing.
bool go_on_alike(std::span<const SectionRecord> sections, std::size_t from, std::size_t length) {
  const auto round = sections.subspan(from - length, length);
  const auto is_in_round = [&](std::size_t impact) {
    return std::ranges::any_of(round, [=](const SectionRecord& section) {
      return std::ranges::find(section.impacts, impact) != section.impacts.end();
    });
  };
  return std::ranges::all_of(sections.subspan(from), [&](const SectionRecord& section) {
    return std::ranges::all_of(section.impacts, is_in_round);
  });
}

/// What the last series before flights by chance has left, from the last of these on.
std::optional<RestOfImpacts> rest_before_chance(std::span<const SectionRecord> sections, std::size_t length) {
  const double now = sections.back().t;
  for (std::size_t i = 1; i <= most_by_chance && i < sections.size(); ++i) {
    const auto before = sections.first(sections.size() - i);
    const auto rest = rest_of_series(Rounds(before, length));
    if (!rest) continue;
    if (!go_on_alike(sections, before.size(), length)) return std::nullopt;
    const double left = before.back().t + rest->time - now;
    return RestOfImpacts{std::max(0.0, left), rest->doubt + std::max(0.0, -left), false};
  }
  return std::nullopt;
}

}  // namespace

std::optional<RestOfImpacts> rest_of_impacts(std::span<const SectionRecord> sections, double span,
                                             double lowest_flight) {
  for (std::size_t length = 1; length <= longest_round; ++length) {
    const Rounds rounds(sections, length);
    if (!rounds.repeat(2)) continue;
    if (rounds.duration(0) <= no_time * time_round_off(sections.back().t))
      return RestOfImpacts{0, doubt_of_lost(sections, lowest_flight), false};
    const auto rest = rest_of_series(rounds);
    if (rest && rest->time <= negligible * span) return rest;
    if (rest || rounds.duration(0) > nearly_lowest * lowest_flight) continue;
    if (const auto before = rest_before_chance(sections, length)) return before;
  }
  return std::nullopt;
}

double doubt_of_lost(std::span<const SectionRecord> sections, double lowest_flight) {
  double longest = 0;
  for (const SectionRecord& section : sections) longest = std::max(longest, section.duration);
  while (!sections.empty() && vanishes(sections.back())) sections = sections.first(sections.size() - 1);
  double ratio = 0;
  for (std::size_t length = 1; length <= longest_round && ratio == 0; ++length) {
    const Rounds rounds(sections, length);
    if (rounds.repeat(3)) ratio = rounds.duration(0) / rounds.duration(1);
  }
  const double shortest = std::max(lowest_flight, std::sqrt(time_round_off(1)) * longest);
  return safety_of_unseen * shortest / (1 - std::clamp(ratio, 0.0, largest_ratio));
}

bool is_hidden_since(const Watch& watch, const SectionRecord& impact, double t,
                     const std::vector<double>& y) {
  return is_as_low_since(watch, impact, t, y, roundings);
}

std::optional<RestOfImpacts> rest_of_hidden(const Watch& watch, std::span<const SectionRecord> sections) {
  if (sections.size() <= hidden_in_a_row) return std::nullopt;
  const auto flights = sections.last(hidden_in_a_row + 1);
  for (std::size_t i = 0; i + 1 < flights.size(); ++i) {
    if (!is_hidden_since(watch, flights[i], flights[i + 1].t, flights[i + 1].before)) return std::nullopt;
  }
  return RestOfImpacts{0, flights.back().t - flights.front().t, false};
}

const SectionRecord& last_seen(const Watch& watch, std::span<const SectionRecord> sections) {
  std::size_t first = sections.size() - 1;
  const auto is_unseen = [&](const SectionRecord& flight, const SectionRecord& since) {
    return vanishes(flight) || is_as_low_since(watch, since, flight.t, flight.before, poorly_seen);
  };
  while (first > 0 && is_unseen(sections[first], sections[first - 1])) --first;
  return sections[first];
}

double lowest_flight(const Watch& watch, const SectionRecord& longest, std::span<const double> slopes,
                     const SectionRecord& last) {
  const double tau = part_of_flight * longest.duration;
  std::vector<double> earlier = longest.before;
  for (std::size_t i = 0; i < earlier.size(); ++i) earlier[i] -= tau * slopes[i];
  const double fall = watch.value(longest.t - tau, earlier) - watch.value(longest.t, longest.before);
  const double height = std::abs(fall) / tau * longest.duration / 4;
  if (!(height > 0)) return 0;  // it took another impact's flight
  return longest.duration * std::sqrt(watch.rounding(last.t, last.before) / height);
}

}  // namespace qdot
