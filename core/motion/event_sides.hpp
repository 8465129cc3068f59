#pragma once
// On which side of zero the function of each watch lies where a section of the motion begins, if its value
// there is too small to tell.
//
// At t_start the numbers as they were typed decide, in more digits than doubles have. Later it is the side on
// which the previous section ended, or the other one if that section ended because this function crossed
// zero. So an event just behind a wall is not met when the wall turns the motion back, and an event just
// behind a kick is met next.
//
// The side of a function that an impact has moved is the one on which the state behind it lies: the motion
// has no states between the two. So it meets no event there, be it the speed of a ball that bounces or the
// angle of a walker that changes its legs, which would stand upright once more. A condition has to hold in
// every state, and is met.

#include <optional>
#include <span>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/integrate/run.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/section_record.hpp"
#include "core/motion/simulation_request.hpp"

namespace qdot {

class EventSides {
 public:
  /// Keeps the references.
  EventSides(const Dynamics& dynamics, const SimulationRequest& request, const MotionSections& sections)
      : dynamics_(dynamics), request_(request), sections_(sections) {}

  /// The sign at t_start, where the value there is rounding; 0 where it is zero, or the value tells it.
  [[nodiscard]] int at_start(const Watch& watch) const;

  /// Whether the motion has begun at that time, where it had just passed what the watch looks for.
  [[nodiscard]] bool is_behind_start(const Watch& watch, double t) const;

  /// A section has ended.
  void take(const Run& done);
  /// The motion goes on through what it has met there.
  void go_on();
  /// The section ended by this impact.
  void pass(const SectionRecord& impact);

  /// What begins at (t, y), with an event for each watch. `impact`: that one began it.
  void mark(double t, std::span<const double> y, const SectionRecord* impact,
            std::vector<EventFunction>& events) const;

  /// Whether an impact that takes the state `before` to `after` leaves the motion on its way through the
  /// surface.
  [[nodiscard]] bool goes_through(const Watch& watch, double t, const std::vector<double>& before,
                                  const std::vector<double>& after) const;
  /// Whether beside the place of that impact digits tell on which side of its surface a state is.
  [[nodiscard]] bool is_sharp(const Watch& watch, const SectionRecord& impact) const;
  /// The instant of an impact differs from the beginning of its section by rounding alone: by how many
  /// seconds.
  [[nodiscard]] double late_at_begin(const Watch& watch, const SectionRecord& impact) const;
  /// Whether two functions are zero at the same places, as far as can be seen at (t, y).
  [[nodiscard]] bool are_same_surface(const Watch& one, const Watch& other, double t,
                                      const std::vector<double>& y) const;

  /// How fast the function of a watch changes along a straight way, so long before and after.
  struct Rate {
    double value{}, tau{};
  };
  [[nodiscard]] Rate rate(const Watch& watch, double t, const std::vector<double>& y) const;

 private:
  [[nodiscard]] std::vector<double> ahead(double t, const std::vector<double>& y, double time) const;
  [[nodiscard]] double rate_over(const Watch& watch, double t, const std::vector<double>& y,
                                 double tau) const;
  [[nodiscard]] double sharp_rate(const Watch& watch, double t, const std::vector<double>& y,
                                  double tau) const;
  [[nodiscard]] double slope(const Watch& watch, double t, const std::vector<double>& y) const;
  [[nodiscard]] std::optional<Ball> rounded_at_start(const Watch& watch) const;
  [[nodiscard]] bool is_turned_by_restitution(std::size_t watch, const SectionRecord& impact) const;
  [[nodiscard]] bool begins_on(const Watch& watch) const;
  [[nodiscard]] int sign_after_start(std::size_t watch) const;
  [[nodiscard]] bool leaves_unseen(const Watch& watch, const SectionRecord& impact, int side) const;
  [[nodiscard]] bool is_unpressed(const Watch& watch, const SectionRecord& impact) const;
  void mark_impacts(const SectionRecord& last, std::vector<EventFunction>& events) const;
  void look_sharply(const Watch& watch, double begin, EventFunction& event) const;
  [[nodiscard]] bool is_near_zero(const Watch& watch, double t, std::span<const double> y) const;

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  const MotionSections& sections_;
  std::vector<int> sides_;        ///< of each watch; 0 where it is not known
  std::vector<bool> is_crossed_;  ///< where the last section ended
};

}  // namespace qdot
