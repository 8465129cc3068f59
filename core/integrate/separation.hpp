#pragma once
// How far a computation may be from the motion that it stands for.
//
// A reference goes from parameters p and initial values y that are moved by dp and dy, and each of its steps
// adds an error d_k of its own. The motion makes of them
//
//   e' = df/dy e + df/dp dp,   e(0) = dy,   e_i += d_k,i at the end of step k.
//
// It is followed beside the steps: by the Taylor series from the place that is e away from the reference's
// own, less the reference's, of as low an order as does; where none does, as beside what rests and would
// fall, over parts of the step. Where e is twice as large as either motion has been it grows no more, unless
// the d_k alone are as large, beside which the reference tells no size. Of the d_k only the sizes are known:
// whoever adds them chooses signs. Each e_i is in the unit of y_i.
// Source of the equation: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., I.14
// (differentiability with respect to initial values and parameters).

#include <span>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/integrate/shown_scale.hpp"
#include "core/integrate/step_terms.hpp"
#include "core/numerics/pairs.hpp"

namespace qdot {

class Separation {
 public:
  /// What series in doubles differ by.
  enum class Scale {
    as_it_is,   ///< e, and the last digits that are rounded otherwise
    enlarged,   ///< e times so much that these do not count
    by_largest  ///< likewise, as the largest coordinates and velocities are, for e far below all last digits
  };
  /// Keeps a reference to the system of the motion that is stood for. `moved_by` is dy.
  Separation(const RightHandSide& original, std::vector<double> moved_by, Scale scale = Scale::as_it_is);

  /// Of a step, each to the side where `sides` are.
  struct Errors {
    std::span<const double> sizes{}, sides{};
    std::span<const double> of_series{};  ///< of them by truncation, which goes with the length as s^order
    std::span<const double> acting{};     ///< beside them what comes all through it, as by a force
    std::span<const double> hidden{};     ///< and what may have acted from its beginning on
    double longest_part{1};               ///< of the step, by which e is followed
  };
  /// The reference has taken this step, and has these terms. Where the original has no values e stays as it
  /// is.
  void follow(const MotionPiece& step, const StepTerms& terms, const Errors& made);
  void follow(const MotionPiece& step, const StepTerms& terms) { follow(step, terms, {}); }
  /// Before that: what it will expand first, for whoever does it in its place.
  struct Wanted {
    std::span<const double> place{}, apart{};
    unsigned order{};
  };
  [[nodiscard]] Wanted look_ahead(const MotionPiece& step);
  /// What has been found there by series of an order: what the step adds to e, and the order that does
  /// (series_rise.hpp).
  struct Known {
    std::vector<double> e{}, rise{};
    unsigned order{}, enough{};
  };
  /// To be filled in.
  [[nodiscard]] Known& known() {
    is_known_ = true;
    return known_;
  }

  /// Errors |d_i| that the step has made, each to the side where `sides` are; infinite where they may be
  /// anything.
  void add(std::span<const double> sizes, std::span<const double> sides);

  /// From the next step on nothing is apart.
  void begin_anew() { e_.assign(e_.size(), 0.0); }

  /// By which e was followed through the last step.
  [[nodiscard]] double shortest_part() const { return shortest_part_; }
  [[nodiscard]] const std::vector<double>& now() const { return e_; }
  /// The largest |y_i| of the reference, and where motions part as they are of the other.
  [[nodiscard]] const std::vector<double>& reached() const { return size_; }
  /// |e_i| at the two ends of the last step, the larger one.
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
  unsigned order_;    ///< of the series to be tried
  double factor_{1};  ///< e times it is what series differ by
  Errors made_;       ///< in this step
  bool has_begun_{false}, is_known_{false};
  int lost_steps_{};
  bool is_given_up_{false};  ///< e is as large as all motions, and no series tells what becomes of it
  Known known_;              ///< of this step
  double shortest_part_{1};
  double late_growth_{1};  ///< of what this step has made, in it
  double acting_left_{1};  ///< of what acts all through it, for its end
  std::vector<double> e_, largest_;
  std::vector<double> y_;      ///< of the reference where the step begins
  std::vector<double> size_;   ///< |y| up to there, of either motion
  std::vector<double> slow_;   ///< velocities that move a coordinate by no more than that in the step
  std::vector<double> added_;  ///< by steps, and where that alone takes coordinates
  std::vector<double> most_;   ///< that e_ may be where it has been pushed farther than y went
  std::vector<double> before_, added_before_;  ///< a part of a step is tried
  std::vector<double> beside_, c_, rise_;      ///< scratch
};

}  // namespace qdot
