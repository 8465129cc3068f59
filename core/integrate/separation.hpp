#pragma once
// How far a computation may be from the motion that it stands for.
//
// A reference goes from parameters p and initial values y that are moved by dp and dy, and each of its steps
// adds an error d_k of its own. The motion makes of them
//
//   e' = df/dy e + df/dp dp,   e(0) = dy,   e_i += d_k,i at the end of step k.
//
// A step adds to e the difference of two Taylor series, one at the reference and one at a distance e from it.
// Their order is as low as it may be. Where no order is enough, as beside an unstable rest, e is followed
// over parts of the step. At twice the size that either motion has reached, e stops growing, except where the
// d_k alone are as large: the reference then shows no size of the motion. Only the sizes of the d_k are
// known; the caller chooses the signs. Each e_i is in the unit of y_i. Source of the equation: Hairer,
// Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., I.14 (differentiability with respect
// to initial values and parameters).

#include <span>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/integrate/shown_scale.hpp"
#include "core/integrate/step_terms.hpp"
#include "core/numerics/pairs.hpp"

namespace qdot {

class Separation {
 public:
  /// The distance of the places from which the two series begin.
  enum class Scale {
    as_it_is,   ///< e; rounding changes the difference by last digits
    enlarged,   ///< e times a factor, so that last digits do not count
    by_largest  ///< likewise, by the largest coordinates and velocities: for e far below all last digits
  };
  /// Keeps a reference to the system of the true motion. `moved_by` is dy.
  Separation(const RightHandSide& original, std::vector<double> moved_by, Scale scale = Scale::as_it_is);

  /// The errors d_k of one step. Their signs are those of `sides`.
  struct Errors {
    std::span<const double> sizes{}, sides{};
    std::span<const double> of_series{};  ///< the part of `sizes` by truncation, which grows as s^order
    std::span<const double> acting{};     ///< more errors, which grow evenly in the step, as by a force
    std::span<const double> hidden{};     ///< more errors, which may be there from its beginning on
    double longest_part{1};               ///< of the step, over which e is followed at once
  };
  /// The reference has taken this step, with these terms. e stays as it is where the true system has no
  /// value.
  void follow(const MotionPiece& step, const StepTerms& terms, const Errors& made);
  void follow(const MotionPiece& step, const StepTerms& terms) { follow(step, terms, {}); }
  /// What `follow` will expand first. A caller may do so for many at once, and fill in known().
  struct Wanted {
    std::span<const double> place{}, apart{};
    unsigned order{};
  };
  [[nodiscard]] Wanted look_ahead(const MotionPiece& step);
  /// What the caller found by series of `order`: the change of e in the step, `rise`, and the order that is
  /// enough (series_rise.hpp).
  struct Known {
    std::vector<double> e{}, rise{};
    unsigned order{}, enough{};
  };
  /// To be filled in.
  [[nodiscard]] Known& known() {
    is_known_ = true;
    return known_;
  }

  /// Adds errors d_i of these sizes to e, with the signs of `sides`. A size is infinite where nothing is
  /// known.
  void add(std::span<const double> sizes, std::span<const double> sides);

  /// e is zero from the next step on.
  void begin_anew() { e_.assign(e_.size(), 0.0); }

  /// The shortest part of the last step over which e was followed.
  [[nodiscard]] double shortest_part() const { return shortest_part_; }
  [[nodiscard]] const std::vector<double>& now() const { return e_; }
  /// The largest |y_i| of the reference, and of the true motion once the two are far apart.
  [[nodiscard]] const std::vector<double>& reached() const { return size_; }
  /// The larger |e_i| at the two ends of the last step.
  [[nodiscard]] const std::vector<double>& in_last_step() const { return largest_; }

 private:
  /// Of a step, in units of its length.
  struct Part {
    double from{0}, to{1};
  };
  void begin(const MotionPiece& step);
  void advance(const MotionPiece& piece, const StepTerms& terms, const Part& part);
  void advance_by_halves(const MotionPiece& piece, const Part& part);
  void add_part(unsigned order, const Part& part);
  void take_some(unsigned order);
  [[nodiscard]] double growth() const;
  [[nodiscard]] double part_of_acting() const;
  [[nodiscard]] bool begin_with_acting(const MotionPiece& step, const StepTerms& terms);
  void note_growth(unsigned order);
  void release_what_is_pushed();
  [[nodiscard]] bool are_together() const;
  void project(double t);
  void place_beside(double t);
  void note_lost();
  [[nodiscard]] double largest_size(std::size_t begin) const;
  [[nodiscard]] bool is_lost(std::size_t i, double largest) const;
  [[nodiscard]] bool is_lost() const;
  void stay_lost();
  [[nodiscard]] double enlarging(double least) const;
  [[nodiscard]] double part_of_size(double least) const;
  [[nodiscard]] bool take_rise(const MotionPiece& step, const StepTerms& terms);
  [[nodiscard]] unsigned rise(const MotionPiece& step, const StepTerms& terms, unsigned order);
  void move_to(std::size_t i, PairOfDoubles e);

  const RightHandSide& original_;
  Scale scale_;
  ShownScale shown_;
  unsigned order_;    ///< of the series that is tried next
  double factor_{1};  ///< the two series begin factor_ e apart
  Errors made_;       ///< in this step
  bool has_begun_{false}, is_known_{false};
  int lost_steps_{};
  bool is_given_up_{false};  ///< e is as large as all motions, and no series follows it any more
  Known known_;              ///< of this step
  double shortest_part_{1};
  double late_growth_{1};  ///< factor by which errors of this step grow within it
  double acting_left_{1};  ///< the part of `acting` that is added at its end
  std::vector<double> e_, largest_;
  std::vector<double> y_;      ///< of the reference where the step begins
  std::vector<double> size_;   ///< |y| up to there, of either motion
  std::vector<double> slow_;   ///< velocities that move a coordinate by less than its size in the step
  std::vector<double> added_;  ///< sum of the errors of steps, and of what they alone make of coordinates
  std::vector<double> most_;   ///< bound of e_ where a step's own errors are large beside y
  std::vector<double> before_, added_before_;     ///< e_ and added_ before a part that may be taken back
  std::vector<double> beside_, c_, rise_, part_;  ///< scratch
};

}  // namespace qdot
