#pragma once
// Impacts that follow each other faster and faster: a ball that comes to rest bounces infinitely often in a
// finite time (Zeno). The time from one impact to the next, or where several take turns from one round of
// them to the next, shrinks by a factor q each; all that are left take d q/(1 - q) together.

#include <optional>
#include <span>

#include "core/dynamics/watch.hpp"
#include "core/motion/section_record.hpp"

namespace qdot {

/// The reason that a motion ends with then.
inline constexpr const char* impacts_accumulate = "impacts_accumulate";

struct RestOfImpacts {
  double time{};      ///< that all further impacts take together, from the last one on
  double doubt{};     ///< an estimate of what that may be off, the errors of the impacts apart
  bool in_contact{};  ///< none follows: what the last one brought together stays so
};

/// Once that is nothing beside the span of the motion, or once flights are about as short as
/// `lowest_flight`: as high as the distance is rounded. Then they no longer shrink by a factor, but go on by
/// chance, and those before them tell.
[[nodiscard]] std::optional<RestOfImpacts> rest_of_impacts(std::span<const SectionRecord> sections,
                                                           double span, double lowest_flight);

/// Of flights that are not seen any more: they are shorter than the lowest one, or lower than the rounding of
/// the longest one's height.
[[nodiscard]] double doubt_of_lost(std::span<const SectionRecord> sections, double lowest_flight);

/// Whether the distance, up to its rounding, is what it was at that impact, at (t, y) and half-way to there.
[[nodiscard]] bool is_hidden_since(const Watch& watch, const SectionRecord& impact, double t,
                                   const std::vector<double>& y);

/// Where the last flights, one after the other, were all so: nothing tells them from contact, and they go on
/// for ever. The doubt is how long they took.
[[nodiscard]] std::optional<RestOfImpacts> rest_of_hidden(const Watch& watch,
                                                          std::span<const SectionRecord> sections);

/// The impact before the last flights that were all nearly as low, or took no time; the last one where there
/// are none.
[[nodiscard]] const SectionRecord& last_seen(const Watch& watch, std::span<const SectionRecord> sections);

/// The duration of a flight that is as high as the distance is rounded where the last section ended. Heights
/// go with d^2: that of the longest is v d/4, with the speed that `slopes`, y' at its end, tell. 0 where the
/// distance does not fall in it.
[[nodiscard]] double lowest_flight(const Watch& watch, const SectionRecord& longest,
                                   std::span<const double> slopes, const SectionRecord& last);

}  // namespace qdot
