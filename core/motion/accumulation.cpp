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

/// Of what is left of the series, whose ratios are as similar as that.
constexpr double doubt_of_rest = 4 * similar;
constexpr double safety_of_unseen = 16;
constexpr double largest_ratio = 0.99;

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
std::optional<double> rest_of_series(const Rounds& rounds) {
  double least = infinity, most = 0;
  for (std::size_t i = 0; i + 1 < similar_rounds; ++i) {
    const double ratio = rounds.duration(i) / rounds.duration(i + 1);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  if (!(most < 1) || most - least > similar * (1 - most)) return std::nullopt;
  return rounds.duration(0) * most / (1 - most);
}

}  // namespace

std::optional<double> rest_of_impacts(std::span<const SectionRecord> sections, double span) {
  for (std::size_t length = 1; length <= longest_round; ++length) {
    const Rounds rounds(sections, length);
    if (!rounds.repeat(2)) continue;
    if (rounds.duration(0) <= no_time * time_round_off(sections.back().t)) return 0;
    if (!rounds.repeat(similar_rounds)) continue;
    const auto rest = rest_of_series(rounds);
    if (rest && *rest <= negligible * span) return rest;
  }
  return std::nullopt;
}

double doubt_of_accumulation(std::span<const SectionRecord> sections, double span) {
  if (const auto rest = rest_of_impacts(sections, span); rest && *rest > 0) return doubt_of_rest * *rest;
  double longest = 0;
  for (const SectionRecord& section : sections) longest = std::max(longest, section.duration);
  while (!sections.empty() && vanishes(sections.back())) sections = sections.first(sections.size() - 1);
  double ratio = 0;
  for (std::size_t length = 1; length <= longest_round && ratio == 0; ++length) {
    const Rounds rounds(sections, length);
    if (rounds.repeat(3)) ratio = rounds.duration(0) / rounds.duration(1);
  }
  const double lowest_flight = std::sqrt(time_round_off(1)) * longest;
  return safety_of_unseen * lowest_flight / (1 - std::clamp(ratio, 0.0, largest_ratio));
}

}  // namespace qdot
