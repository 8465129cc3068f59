#pragma once
// The gaits of a scene while one parameter p changes: R(u, T; p) = 0 (core/gait/shooting.hpp) as a curve in
// (u, T, p), for core/numerics/path_following.hpp.
//
// Derivatives by the state are exact as everywhere; those by p, which only decide how quickly Newton's method
// converges, are differences over 1e-5 of the range. Steps are in (u/|u|, log T, (p - from)/(to - from)).

#include <span>
#include <vector>

#include "core/gait/shooting.hpp"
#include "core/numerics/path_following.hpp"

namespace qdot {

class GaitFamily {
 public:
  struct Place {
    Recurrence at;
    double p{};
  };
  struct Linearization {
    Eigen::MatrixXd derivative;  ///< (k + 1) x (k + 2), over |u|
    Eigen::VectorXd residual;    ///< over |u|
    Flow flow;
    Eigen::MatrixXd section;  ///< D = dP/du
  };

  /// Parameter number `index` in [from, to], the others as given; each step of the motion has an error below
  /// rtol. `map` must outlive this; its parameters are set to those of the last place looked at.
  GaitFamily(SectionMap& map, std::span<const double> parameters, std::size_t index, double from, double to,
             double rtol);

  [[nodiscard]] std::optional<Linearization> linearized(const Place& place);
  [[nodiscard]] std::optional<Place> moved(const Place& place, const Eigen::VectorXd& step) const;
  /// The point at `place` or next to it across `direction`,
  /// where Newton's method leaves no more than rounding.
  [[nodiscard]] std::optional<CurvePoint<GaitFamily>> point(const Place& place,
                                                            const Eigen::VectorXd& direction);
  /// The point at distance `advance` from another one.
  [[nodiscard]] std::optional<CurvePoint<GaitFamily>> ahead(const CurvePoint<GaitFamily>& from,
                                                            double advance);

  [[nodiscard]] Eigen::VectorXd along_parameter() const;
  [[nodiscard]] Corrections corrections() const;
  /// `of` in the steps of `at`.
  [[nodiscard]] Eigen::VectorXd step_to(const Place& of, const Place& at) const;
  void set(double p);
  [[nodiscard]] const std::vector<double>& parameters() const { return parameters_; }

 private:
  SectionMap& map_;
  std::vector<double> parameters_;
  std::size_t index_;
  double from_, to_, rtol_;
};

using GaitOnCurve = CurvePoint<GaitFamily>;

/// What Newton's method may leave of a correction, in units of rtol.
inline constexpr double left_by_newton = 10;

}  // namespace qdot
