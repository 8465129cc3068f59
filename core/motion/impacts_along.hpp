#pragma once
// The impacts of a motion: which have happened at the end of a section, what they leave, and whether they
// accumulate.

#include <optional>
#include <vector>

#include "core/motion/accumulation.hpp"
#include "core/motion/instant_impacts.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

class ImpactsAlong {
 public:
  /// Keeps the references.
  ImpactsAlong(const Dynamics& dynamics, const SimulationRequest& request, const MotionSections& sections);

  /// A section has ended; none of them has happened yet.
  void begin_instant();
  /// Watch number `watch` of the section tells of one.
  void meet(std::size_t watch);
  [[nodiscard]] bool has_met(std::size_t impact) const { return met_[impact]; }

  /// What all impacts of this instant leave.
  [[nodiscard]] InstantImpacts::Passed pass(double t, const std::vector<double>& y, const EventSides& sides);
  /// The same ones on another state.
  [[nodiscard]] std::vector<double> repeat(double t, const std::vector<double>& y,
                                           std::span<const InstantImpacts::Happened> all) const {
    return impacts_->repeat(t, y, all);
  }

  /// What is left of the motion, if its impacts accumulate: after the last of `sections`, which ended by
  /// `passed`.
  [[nodiscard]] std::optional<RestOfImpacts> rest(std::span<const SectionRecord> sections,
                                                  const InstantImpacts::Passed& passed,
                                                  const EventSides& sides);

  /// One for each impact.
  [[nodiscard]] std::span<const Watch> watches() const;

 private:
  [[nodiscard]] bool is_pressed_on(std::size_t impact, const SectionRecord& last,
                                   const EventSides& sides) const;
  [[nodiscard]] double unseen_time(std::size_t impact, std::span<const SectionRecord> sections,
                                   const EventSides& sides) const;
  [[nodiscard]] double unseen_flights(std::size_t impact, const SectionRecord& seen,
                                      const SectionRecord& last, const EventSides& sides) const;
  [[nodiscard]] bool leaves_contact(std::size_t impact, std::span<const SectionRecord> sections) const;
  [[nodiscard]] double lowest_flight(std::size_t impact, std::span<const SectionRecord> sections) const;

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  const MotionSections& sections_;
  std::optional<InstantImpacts> impacts_;
  std::vector<bool> met_;
  std::size_t longest_{};  ///< of the sections between impacts
};

}  // namespace qdot
