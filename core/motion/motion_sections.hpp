#pragma once
// The smooth sections of a motion, one after the other: what is integrated and watched in each. A motion
// without kinks has one only; another one begins at every kink that the motion passes, comes to stay on, or
// leaves (kink_modes.hpp).

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/motion/kink_modes.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

class MotionSections {
 public:
  /// Keeps the references.
  MotionSections(const Dynamics& dynamics, const SimulationRequest& request);

  /// A motion begins at (t, y), or goes on from there after an impact. False where the equations do not tell
  /// how. y moves by a rounding error, on to the kinks on which it stays.
  [[nodiscard]] bool begin(double t, std::vector<double>& y);
  /// The section has ended at (t, y), where it `met` these kinks.
  [[nodiscard]] bool pass(double t, std::vector<double>& y, const std::vector<bool>& met);
  /// What y may be off by at (t, y) for a kink whose side was hidden for this many seconds before.
  [[nodiscard]] std::vector<double> doubt_behind(std::size_t kink, double hidden, double t,
                                                 std::span<const double> y) {
    return modes_->doubt_behind(way_.sides, kink, hidden, t, y);
  }
  /// The motion is over.
  void finish(double t);

  [[nodiscard]] const RightHandSide& system() const { return now_->system; }
  /// y' by its equations; zeros where they have no value.
  [[nodiscard]] std::vector<double> slopes(double t, std::span<const double> y) const;
  /// Of an approach: y_i(t + s) as far as slopes tell it.
  [[nodiscard]] std::vector<double> rows(double t, std::span<const double> y) const;
  /// The same of the motions that the request stands for, where there are such.
  [[nodiscard]] const Originals& originals() const { return now_->originals; }
  [[nodiscard]] const std::vector<Watch>& watches() const { return now_->watches; }
  /// Where the section ends by itself: one event for each kink.
  [[nodiscard]] std::vector<EventFunction> ends() const;
  /// Of such an end, or of a watch before it, in the run that began then.
  [[nodiscard]] ApproachRecord approach(Approach place, double begun) const;
  /// Whether that one changes nothing: an event that is reported and no more.
  [[nodiscard]] bool only_reports(std::size_t event) const {
    return event < watches().size() && (watches()[event].kind == Watch::Kind::event || is_jump(event));
  }
  /// Whether it stands in a jump or a step of such an event.
  [[nodiscard]] bool is_jump(std::size_t event) const { return watches()[event].kind == Watch::Kind::jump; }
  [[nodiscard]] std::size_t kinks() const { return names_.size(); }
  /// Of the section.
  [[nodiscard]] const Sides& sides() const { return way_.sides; }
  [[nodiscard]] double begun() const { return t_; }
  /// What happens in so short a time is one instant.
  [[nodiscard]] double resolution() const { return resolution_; }
  /// By how many seconds rounding may have moved the instant that was passed last.
  [[nodiscard]] double doubt_of_instant() const { return doubt_of_instant_; }
  /// Whether twice the digits did not tell that instant, either.
  [[nodiscard]] bool is_instant_hidden() const { return is_instant_hidden_; }
  /// By how many it has moved it, which is taken back in the state there.
  [[nodiscard]] double moved_instant() const { return moved_instant_; }
  /// What each component may be off by soon after the motion has begun, beside a kink whose side is not known
  /// at once; empty where nothing is in doubt.
  [[nodiscard]] const std::vector<double>& doubt_of_begin() const { return doubt_of_begin_; }

  /// Whether it has begun beside a kink whose side only the typed digits tell.
  [[nodiscard]] bool begins_beside_kink() const { return way_.needs_digits; }

  /// Whether it was one of several kinks between which the way is not known.
  [[nodiscard]] bool is_unclear() const { return is_unclear_; }

  /// Functions of the state in the section; they may contain q''.
  struct Columns {
    std::shared_ptr<const CompiledFunction> function;
    Workspace workspace;
  };
  /// Sections count from 0.
  [[nodiscard]] std::size_t section() const { return history_.size() - 1; }
  [[nodiscard]] Columns& columns_in(std::size_t section);

  [[nodiscard]] std::vector<StayRecord>& stays() { return stays_; }

 private:
  struct Section {
    RightHandSide system;
    Originals originals;
    std::vector<Watch> watches;
    std::vector<double> parameters;
    Staying staying;
    Columns columns;
  };
  [[nodiscard]] bool go_on(double t, std::span<const double> y);
  void note_size(std::span<const double> y);
  [[nodiscard]] bool come_together(double t, std::vector<double>& y);
  void take_back(const Sides& before, double begun, double t, std::vector<double>& y);
  void enter(const KinkModes::Way& way, double t);

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  double resolution_;
  std::vector<std::string> names_;  ///< of the kinks
  std::unique_ptr<KinkModes> modes_;
  std::map<Sides, Section> sections_;
  Section* now_{};
  std::vector<Section*> history_;
  KinkModes::Way way_;
  double t_{};  ///< when the section began
  double doubt_of_instant_{}, moved_instant_{};
  std::vector<double> doubt_of_begin_;
  bool is_instant_hidden_{false};
  bool is_unclear_{false};
  std::vector<double> largest_;               ///< |y_i| where sections have begun
  std::vector<bool> met_;                     ///< at that instant
  std::set<Sides> tried_;                     ///< at that instant
  std::vector<std::optional<double>> since_;  ///< for each kink on which the motion stays
  std::vector<StayRecord> stays_;
};

}  // namespace qdot
