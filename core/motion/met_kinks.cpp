#include "core/motion/met_kinks.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/numerics/constants.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

/// As many as there are where none is met.
std::size_t first_of(const std::vector<bool>& met) {
  return static_cast<std::size_t>(std::ranges::find(met, true) - met.begin());
}

}  // namespace

std::vector<bool> MetKinks::at_end(const Run& done) const {
  std::vector<bool> met(motion_.sections.kinks());
  const std::size_t first = motion_.sections.watches().size();
  for (const EventOccurrence& occurrence : done.events) {
    if (occurrence.event >= first && occurrence.t == done.t && occurrence.hidden == 0)
      met[occurrence.event - first] = true;
  }
  return met;
}

void MetKinks::doubt_hidden(const Run& done) {
  const std::size_t first = motion_.sections.watches().size();
  Simulation& result = motion_.result;
  for (const EventOccurrence& occurrence : done.events) {
    if (occurrence.event < first || occurrence.hidden == 0) continue;
    motion_.doubt_kinks(
        motion_.sections.doubt_behind(occurrence.event - first, occurrence.hidden, result.t, result.y));
    ++result.hidden_kinks;
  }
}

void MetKinks::record_piece(const std::vector<bool>& met) {
  const MotionSections& sections = motion_.sections;
  if (sections.kinks() == 0) return;
  PieceRecord& piece = motion_.result.pieces.emplace_back(
      PieceRecord{motion_.result.t, motion_.result.t - sections.begun(), sections.sides(), {}});
  for (std::size_t k = 0; k < met.size(); ++k) {
    if (met[k]) piece.ended_by.push_back(k);
  }
}

/// Kinks of a fast drive, long after 0, come so often that the digits of the time hardly tell where: what is
/// met late by some of them may hide the next one. Those of an accumulation come ever faster, by one side or
/// by both.
bool MetKinks::follow_too_fast() const {
  constexpr std::size_t several = 3;
  constexpr double thousands = 0x1p13, nearly_as_long = 0.9;
  const std::vector<PieceRecord>& pieces = motion_.result.pieces;
  if (pieces.size() < several) return false;
  const std::span last = std::span(pieces).last(several);
  const double short_time = thousands * time_round_off(motion_.result.t);
  return std::ranges::all_of(last, [=](const PieceRecord& piece) { return piece.duration < short_time; }) &&
         last.back().duration >= nearly_as_long * last.front().duration;
}

void MetKinks::begin_section(const std::vector<bool>& met) {
  Simulation& result = motion_.result;
  motion_.is_determined = motion_.sections.pass(result.t, result.y, met);
  result.kinks_in_doubt = result.kinks_in_doubt || motion_.sections.is_instant_hidden();
  if (result.unclear_from) return;
  result.has_fast_kinks = follow_too_fast();
  result.is_unclear_by_kinks = motion_.sections.is_unclear() || result.has_fast_kinks;
  if (result.is_unclear_by_kinks) motion_.note_unclear();
}

void MetKinks::pass(const std::vector<bool>& met) {
  const std::size_t first = first_of(met);
  if (!motion_.apart.is_wanted() || first == met.size()) {
    begin_section(met);
    return;
  }
  SectionEnd end = motion_.ending_by(motion_.sections.ends()[first].value);
  begin_section(met);
  if (!motion_.is_determined) return;
  motion_.complete(end);
  doubt_side(end);
  motion_.apart.pass(std::move(end));
}

void MetKinks::doubt_last_row(const std::vector<bool>& met) {
  const std::size_t first = first_of(met);
  if (!motion_.apart.is_wanted() || first == met.size()) return;
  SectionEnd end = motion_.ending_by(motion_.sections.ends()[first].value);
  end.after = motion_.result.y;
  if (!motion_.sections.pass(motion_.result.t, end.after, met)) return;
  end.slopes_after = motion_.sections.slopes(motion_.result.t, end.after);
  doubt_side(end);
}

void MetKinks::doubt_side(SectionEnd& end) {
  end.doubt = motion_.sections.doubt_of_instant();
  end.moved = motion_.sections.moved_instant();
  const double near = motion_.apart.seconds(end, motion_.unseen.so_far());
  motion_.unseen.doubt_side(end, near, motion_.request.grid);
}

}  // namespace qdot
