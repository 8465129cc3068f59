#pragma once
// The section map of a scene with an impact: from one impact to the next.
//
// Let y = (q, q') and let u be those components of the state just before an impact on which the state just
// after it, G(u), depends. The section map is
//
//   u -> P(u): the same components just before the next impact,   y(0) = G(u),   y(T) where g(y(T)) = 0,
//
// with g the scene's event, crossed in its direction and where its condition holds. Since u has fewer
// components than y, the map leaves out what an impact forgets: a compass walker's u is (theta, theta'). Its
// derivative comes from the variational equation Phi' = (df/dy) Phi, Phi(0) = dG/du, with df/dy and dG/du
// differentiated from the scene, and the change of the instant of the event,
//
//   dT/du = -(dg/dy Phi)/(dg/dy f),   dP/du = the components u of  Phi + f dT/du .
//
// Source: T. S. Parker, L. O. Chua, Practical Numerical Algorithms for Chaotic Systems, Springer 1989,
// sections 2.2 and 3.3 and appendix D; for jumps, P. C. Mueller, Chaos, Solitons and Fractals 5 (1995)
// 1671-1681. Everything here is without dimension (state_scales.hpp).

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/dynamics/watch.hpp"
#include "core/gait/impact_functions.hpp"
#include "core/gait/state_scales.hpp"

namespace qdot {

/// From just after one impact to just before the next.
struct Stride {
  Eigen::VectorXd after;   ///< G(u), 2n
  Eigen::VectorXd before;  ///< y(T), 2n
  double duration{};       ///< T
  /// Crossings of the event's surface in its direction before that, where its condition did not hold.
  int ignored_crossings{};
};

/// The motion after an impact, followed for a given time whether there is an impact in it or not.
struct Flow {
  Eigen::VectorXd after;          ///< G(u)
  Eigen::VectorXd state;          ///< y(T)
  Eigen::VectorXd rate;           ///< f = y'(T)
  Eigen::MatrixXd derivative;     ///< Phi = dy(T)/du at fixed T, 2n x size()
  double surface{};               ///< g(y(T)), in the unit that the event's expression has
  Eigen::VectorXd surface_slope;  ///< dg/dy
};

class SectionMap {
 public:
  static constexpr double longest_stride = 100;  ///< in units of time of the scene
  /// Of one stride. Where friction holds a body, all are spent, and with every such stride others may take
  /// fewer.
  static constexpr std::uint64_t most_steps = 20'000, fewest_steps = 1'000;

  /// Throws Error(not_applicable) for a scene without an impact,
  /// and where the motion depends on time explicitly.
  explicit SectionMap(const Dynamics& dynamics);

  /// Call before anything else, and again for other parameters.
  void set_parameters(std::span<const double> parameters);

  /// How many components u has.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(impact_->components.size()); }
  [[nodiscard]] Eigen::VectorXd section(const Eigen::VectorXd& state) const;
  void set_section(Eigen::VectorXd& state, const Eigen::VectorXd& u) const;
  /// A state with the components u, the others 0.
  [[nodiscard]] Eigen::VectorXd state(const Eigen::VectorXd& u) const;

  /// The stride after an impact at u, each step's error below rtol (1e-14 at least). None where the model
  /// stops holding (a fall), where no impact follows within longest_stride, and where its surface is only
  /// touched.
  [[nodiscard]] std::optional<Stride> stride(const Eigen::VectorXd& u, double rtol);
  /// The motion from the scene's own start, its velocities `haste` times as large, to its first impact.
  [[nodiscard]] std::optional<Stride> first_stride(double haste, double rtol);
  /// The flow over the time T > 0; no value where the integration fails.
  [[nodiscard]] std::optional<Flow> flow(const Eigen::VectorXd& u, double duration, double rtol);
  /// Whether the event's condition holds at a state, and whether it is crossed in its direction there.
  [[nodiscard]] bool counts(const Eigen::VectorXd& state);
  [[nodiscard]] bool is_impact(const Flow& flow);
  /// dP/du of a flow that ends on the event's surface: size() x size().
  [[nodiscard]] Eigen::MatrixXd derivative(const Flow& flow) const;

  /// The state just after the impact, and its derivative (2n x size()). No value where it is not finite.
  struct Jump {
    Eigen::VectorXd after;
    Eigen::MatrixXd derivative;
  };
  [[nodiscard]] std::optional<Jump> jump(const Eigen::VectorXd& u);
  /// How many directions a state just after an impact at `before` can differ in: the rank of dG/du on the
  /// event's surface. Multipliers beyond it are 0.
  [[nodiscard]] Eigen::Index dimension(const Flow& flow);

  [[nodiscard]] Eigen::VectorXd in_units(const Eigen::VectorXd& si) const { return scales_.in_units(si); }
  [[nodiscard]] std::vector<double> in_si(const Eigen::VectorXd& state) const { return scales_.in_si(state); }
  [[nodiscard]] double time_unit() const { return scales_.time_unit(); }

 private:
  /// 2n.
  [[nodiscard]] Eigen::Index state_size() const { return scales_.units().size(); }
  [[nodiscard]] const std::vector<Watch>& watched();
  [[nodiscard]] Evaluation rates(std::span<const double> y, std::span<double> out);
  [[nodiscard]] Evaluation variational_rates(std::span<const double> y, std::span<double> out);
  [[nodiscard]] std::optional<Stride> stride_from(const Eigen::VectorXd& after, double rtol);
  [[nodiscard]] Eigen::VectorXd on_surface(Eigen::VectorXd after);
  [[nodiscard]] bool starts_validly(const Eigen::VectorXd& after);
  [[nodiscard]] RunRequest request(const Eigen::VectorXd& start, double rtol) const;
  [[nodiscard]] Run followed(const RightHandSide& system, const RunRequest& run);
  [[nodiscard]] bool add_surface(Flow& flow);

  const Dynamics& dynamics_;
  std::shared_ptr<const ImpactFunctions> impact_;
  std::vector<double> parameters_;
  const CompiledFunction* accelerations_{};
  const CompiledFunction* jacobian_{};
  Workspace accelerations_workspace_, jacobian_workspace_, jump_workspace_, surface_workspace_;
  std::vector<Watch> watches_;  ///< the impact is the last; empty until asked for
  StateScales scales_;
  std::uint64_t steps_left_{most_steps};
  std::vector<double> si_, block_;  ///< scratch
};

}  // namespace qdot
