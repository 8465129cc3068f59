#include "core/steady/rolling_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/steady/rolling_state.hpp"
#include "core/steady/small_motions.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {
namespace {

std::vector<double> by_rows_of(const SquareMatrix<Ball>& a, int sign) {
  std::vector<double> values;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) {
      const Ball entry = sign == 0 ? a(i, j) : Ball(0.5) * (sign > 0 ? a(i, j) + a(j, i) : a(i, j) - a(j, i));
      values.push_back(entry.contains_zero() ? 0.0 : entry.value());
    }
  }
  return values;
}

/// The mode of s, which lies within `radius` of its middle. In a reversible motion -s is an eigenvalue with
/// s, so that one that is `single` near the imaginary axis is on it.
Mode mode_of_exponent(const ComplexBall& s, double radius, bool reversible, bool single) {
  const bool on_axis = reversible && single && Ball(s.re.middle, radius).contains_zero();
  const Ball rate(on_axis ? DoubleDouble{} : s.re.middle, on_axis ? 0 : radius);
  const Ball omega(s.im.middle, radius);
  const bool steady = rate.contains_zero(), swings = !omega.contains_zero();
  Mode mode;
  if (steady && !swings) {
    mode.kind = ModeKind::neutral;
    mode.omega_error = magnitude(s) + radius;
    return mode;
  }
  mode.kind = steady ? ModeKind::oscillation : rate.middle.high > 0 ? ModeKind::growth : ModeKind::decay;
  mode.omega = swings ? omega.value() : 0;
  if (swings) mode.omega_error = omega.error();
  mode.rate = steady ? 0 : std::abs(rate.value());
  if (!on_axis) mode.rate_error = steady ? rate.magnitude() : rate.error();
  if (on_axis) mode.lambda = mode.omega * mode.omega;
  if (reversible && !swings) mode.lambda = -mode.rate * mode.rate;
  return mode;
}

class RollingAnalysis {
 public:
  explicit RollingAnalysis(const SteadyRolling& motion) : motion_(motion), state_(motion) {}

  Modes run() {
    write_place();
    add_rigid_modes();
    add_eigenvalues();
    std::ranges::stable_sort(result_.modes, [](const Mode& a, const Mode& b) {
      return std::pair(a.omega, a.kind) < std::pair(b.omega, b.kind);
    });
    write_stability();
    return std::move(result_);
  }

 private:
  void write_place() {
    for (const Ball& y : motion_.y) {
      result_.y.push_back(y.value());
      result_.y_error.emplace_back(y.error());
    }
    result_.mass = by_rows_of(motion_.mass, 0);
    result_.stiffness = by_rows_of(motion_.stiffness, 0);
    result_.gyroscopic = by_rows_of(motion_.rates, -1);
    result_.damping = by_rows_of(motion_.rates, 1);
    if (std::ranges::all_of(result_.damping, [](double v) { return v == 0; })) result_.damping.clear();
  }

  void add_rigid_modes() {
    const std::vector<std::vector<ComplexBall>> shapes = state_.free_displacements();
    for (const auto& shape : shapes) {
      Mode rigid;
      rigid.kind = ModeKind::rigid;
      rigid.omega_error = rigid.lambda = 0.0;
      rigid.multiplicity = shapes.size();
      for (const ComplexBall& entry : shape) rigid.shape.emplace_back(entry.re.value(), entry.im.value());
      result_.modes.push_back(std::move(rigid));
    }
  }

  void add_eigenvalues() {
    const Eigensystem<ComplexBall> found = state_.eigenvalues();
    for (std::size_t first = 0; first < found.values.size(); ++first) {
      if (!std::isfinite(found.radii[first]))
        undetermined_on_surface("no bound of the eigenvalues could be proven.");
      std::vector<std::size_t> members;
      for (std::size_t i = 0; i < found.values.size(); ++i) {
        if (found.group[i] == found.group[first]) members.push_back(i);
      }
      if (members.front() == first) add_group(found, members);
    }
  }

  /// Of eigenvalues that cannot be told apart all combinations of shapes are shapes.
  void add_group(const Eigensystem<ComplexBall>& found, const std::vector<std::size_t>& members) {
    std::vector<std::vector<ComplexBall>> shapes;
    for (const std::size_t i : members) shapes.push_back(state_.shape(found, i));
    shapes = echelon_form(std::move(shapes));
    for (std::size_t k = 0; k < members.size(); ++k) {
      const ComplexBall& s = found.values[members[k]];
      const double radius = found.radii[members[k]];
      Mode mode = mode_of_exponent(s, radius, state_.is_reversible(), members.size() == 1);
      const bool is_conjugate = mode.omega < 0;
      const bool is_mirror = state_.is_reversible() && mode.kind == ModeKind::decay;
      if (is_conjugate || is_mirror) continue;
      mode.multiplicity = members.size();
      write_shape(mode, shapes[k]);
      const bool moves = std::ranges::any_of(mode.shape, [](const auto& c) { return c != 0.0; });
      if (moves || mode.kind != ModeKind::neutral) result_.modes.push_back(std::move(mode));
    }
  }

  static void write_shape(Mode& mode, const std::vector<ComplexBall>& shape) {
    for (const ComplexBall& entry : shape) {
      mode.shape.emplace_back(entry.re.value(), entry.im.value());
      mode.shape_error.push_back(entry.re.error() + entry.im.error());
    }
    const bool enclosed = std::ranges::all_of(mode.shape_error, [](double e) { return std::isfinite(e); });
    if (!enclosed || mode.multiplicity > 1 || mode.kind == ModeKind::neutral) mode.shape_error.clear();
  }

  void write_stability() {
    const bool grows =
        std::ranges::any_of(result_.modes, [](const Mode& m) { return m.kind == ModeKind::growth; });
    result_.stability = grows ? Stability::unstable : Stability::neutral;
    if (!grows)
      result_.undecided =
          "No small motion grows to first order. That does not decide: under constraints in the velocities "
          "other steady motions stand beside this one.";
  }

  const SteadyRolling& motion_;
  RollingState state_;
  Modes result_;
};

}  // namespace

Modes rolling_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                    const std::optional<std::vector<double>>& guess) {
  return RollingAnalysis(steady_rolling(dynamics, parameters, initial, guess)).run();
}

}  // namespace qdot
