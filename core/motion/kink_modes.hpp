#pragma once
// Which way a motion goes on from a kink u = 0 of its equations: to the side u > 0, to u < 0, or along it.
//
// On each side the equations are smooth, and the first coefficients of u along the motion there tell whether
// it leaves u = 0 to that side. It
// - passes, where it leaves on one side and the other side brings it here;
// - stays, where both sides bring it here: a block that sticks, a spring that rests on its kink. It stays as
//   long as the equivalent side s of core/dynamics/motion_builder.hpp is in [-1, 1].
// Where several kinks are met at once, all their combinations are tried. It is undetermined where no way, or
// more than one, agrees with itself. Source: Filippov, Differential Equations with Discontinuous Righthand
// Sides (1988), 4 and 19.

#include <memory>
#include <optional>
#include <vector>

#include "core/motion/kink_passage.hpp"
#include "core/motion/sided_motions.hpp"

namespace qdot {

class KinkModes {
 public:
  /// As SidedMotions.
  KinkModes(const Dynamics& dynamics, std::span<const double> parameters, double resolution);

  struct Way {
    Sides sides;
    /// For each kink at which the way begins, how many coefficients of u are 0 there; 0 for the others.
    std::vector<unsigned> contact{};
    std::vector<double> size{};         ///< of the numbers that make up u there
    std::vector<std::size_t> begins{};  ///< kinks on which it stays, or from which it goes without a speed
    bool needs_digits{false};           ///< a kink's side is known as it was typed, and not in doubles
  };
  /// The next way on is from there.
  void begin_at(SidedMotions::Typed place) { typed_ = std::move(place); }
  /// The way on from (t, y). `met`: kinks that count as u = 0, beside those where u is zero up to
  /// round-off; where u is far from zero they do not count. None where it is undetermined.
  [[nodiscard]] std::optional<Way> way_on(double t, std::span<const double> y, const std::vector<bool>& met);
  /// What y may be off by soon after that way has begun there, as its kinks are zero for a while in these
  /// digits; empty where it is nothing.
  [[nodiscard]] std::vector<double> doubt_of_begin(const Way& way);
  /// The same behind a time in which the kink's side was hidden, `hidden` seconds up to (t, y).
  [[nodiscard]] std::vector<double> doubt_behind(const Sides& sides, std::size_t kink, double hidden,
                                                 double t, std::span<const double> y);
  /// Moves y, which is there up to a rounding error, onto the kinks on which the way begins.
  void settle(const Way& way, double t, std::vector<double>& y);

  /// The sides on which (t, y) is; kinks count as their sides u > 0.
  [[nodiscard]] Sides sides_at(double t, std::span<const double> y);

  [[nodiscard]] KinkPassage passage(const Sides& before, const Way& after, double t,
                                    std::span<const double> y, double duration) {
    return kink_passage(motions_, before, after.sides, after.size, t, y, duration);
  }

  /// As those of SidedMotions.
  [[nodiscard]] std::vector<double> parameters(const Sides& sides) const {
    return motions_.parameters(sides);
  }
  [[nodiscard]] std::shared_ptr<const KinkedMotion> motion(const Sides& sides) const {
    return motions_.motion(sides);
  }

 private:
  struct Lead {
    int sign{};
    unsigned power{};
  };
  enum class Verdict { no, neutral, yes };

  void add_doubt(const Sides& sides, std::size_t kink, double late, std::vector<double>& off);
  [[nodiscard]] std::optional<Lead> lead(const Sides& sides, std::size_t kink);
  [[nodiscard]] bool attracts(Sides sides, std::size_t kink);
  [[nodiscard]] Verdict judge(const Sides& sides);
  [[nodiscard]] bool passes_now(const Sides& sides, std::size_t kink, double t, std::span<const double> y);
  [[nodiscard]] Sides completed(Sides sides, double t, std::span<const double> y);
  void put_on(std::size_t kink, const Sides& sides, double t, std::vector<double>& y);
  [[nodiscard]] std::optional<Sides> only_way();
  [[nodiscard]] bool is_same_motion(const Sides& one, const Sides& other);

  SidedMotions motions_;
  std::optional<SidedMotions::Typed> typed_;  ///< where the next way begins
  std::optional<SidedMotions::Typed> begun_;  ///< where the last one began
  std::vector<int> typed_sides_;     ///< of kinks that only the typed digits tell from the place; else 0
  std::vector<std::size_t> active_;  ///< the kinks at which the place is that is looked at
};

}  // namespace qdot
