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

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/compile/taylor/composition.hpp"
#include "core/compile/taylor/expansion.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/integrate/run.hpp"

namespace qdot {

/// For each kink the side on which a motion is, 1 or -1, or 0 where it stays on the kink.
using Sides = std::vector<int>;
[[nodiscard]] Staying staying_on(const Sides& sides);

class KinkModes {
 public:
  /// `resolution`: what happens in so short a time is not told apart. Keeps the references; the model has
  /// kinks.
  KinkModes(const Dynamics& dynamics, std::span<const double> parameters, double resolution);
  ~KinkModes();

  struct Way {
    Sides sides;
    /// For each kink at which the way begins, how many coefficients of u are 0 there; 0 for the others.
    std::vector<unsigned> contact;
    std::vector<double> size;         ///< of the numbers that make up u there
    std::vector<std::size_t> begins;  ///< kinks on which it stays, or from which it goes without a speed
  };
  /// The way on from (t, y). `met`: kinks that count as u = 0, beside those where u is zero but for
  /// round-off; they are none any more where u is far from it. None where it is undetermined.
  [[nodiscard]] std::optional<Way> way_on(double t, std::span<const double> y, const std::vector<bool>& met);
  /// y, which is there but for a rounding error, on the kinks on which the way begins.
  void settle(const Way& way, double t, std::vector<double>& y);

  /// The sides on which (t, y) is; kinks count as their sides u > 0.
  [[nodiscard]] Sides sides_at(double t, std::span<const double> y);

  /// A motion passed from one way to another at kinks that it met a little before or after (t, y), up to
  /// where it went on by the old one.
  struct Passage {
    std::vector<double> move;  ///< what y is off by for that
    double doubt{};            ///< by how many seconds an instant may be elsewhere
    double early{};            ///< and by how many it was: rows so near to it are on the wrong side
  };
  /// Nothing is moved where an instant is farther than `farthest` [s] and not for rounding, or hardly
  /// crossed.
  [[nodiscard]] Passage passage(const Sides& before, const Way& after, double t, std::span<const double> y,
                                double farthest);

  /// The model's parameters and the sides.
  [[nodiscard]] std::vector<double> parameters(const Sides& sides) const;
  /// Null where the motion cannot stay so.
  [[nodiscard]] std::shared_ptr<const KinkedMotion> motion(const Sides& sides) const;

 private:
  static constexpr unsigned order = 8;
  struct Ahead {
    double u, explained;  ///< by rounding, and by a margin (kink_ends.cpp)
  };

  /// The motion with given sides, ready to be looked at.
  struct Mode;
  /// Coefficients 0 .. order of the kinks' u along the motion; none where there is no such motion.
  using Series = std::optional<std::vector<std::vector<double>>>;
  struct Lead {
    int sign{};
    unsigned power{};
  };
  enum class Verdict { no, neutral, yes };

  [[nodiscard]] Mode* mode(const Sides& sides);
  [[nodiscard]] const Series& series(const Sides& sides);
  [[nodiscard]] std::optional<Lead> lead(const Sides& sides, std::size_t kink);
  [[nodiscard]] bool attracts(Sides sides, std::size_t kink);
  [[nodiscard]] Verdict judge(const Sides& sides);
  [[nodiscard]] std::vector<double> geometry(const Sides& sides, double t, std::span<const double> y);
  [[nodiscard]] Sides completed(Sides sides, double t, std::span<const double> y);
  [[nodiscard]] std::vector<double> rates(const Sides& sides);
  std::optional<std::map<std::size_t, Ahead>> kinks_ahead(const Sides& before, const Way& after);
  [[nodiscard]] double exact_argument(std::size_t kink, const Sides& sides, double t,
                                      std::span<const double> y);
  [[nodiscard]] bool vanishes(std::size_t kink, const Sides& sides);
  /// At t + s the motion has passed a kink to another way.
  struct Change {
    Sides before, after;
    std::size_t kink;
    double s;
  };
  void refine(const Change& change, std::vector<double>& move);
  void put_on(std::size_t kink, const Sides& sides, double t, std::vector<double>& y);
  [[nodiscard]] std::optional<Sides> only_way();
  [[nodiscard]] bool is_same_motion(const Sides& one, const Sides& other);

  const Dynamics& dynamics_;
  const Kinks& kinks_;
  std::vector<double> parameters_;
  double resolution_;
  std::map<Sides, std::unique_ptr<Mode>> modes_;
  // Of the place that is looked at:
  double t_{};
  std::vector<double> y_;
  std::vector<std::size_t> active_;
  std::map<Sides, Series> series_;
};

}  // namespace qdot
