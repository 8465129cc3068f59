#include "core/motion/motion_system.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/compile/taylor/expansion.hpp"
#include "core/integrate/methods.hpp"

namespace qdot {
namespace {

using Needs = MethodRecord::Needs;

/// The motion in (q, p); none where p does not determine q' in the initial state.
std::optional<RightHandSide::CanonicalForm> canonical_form(const Dynamics& dynamics,
                                                           const SimulationRequest& request) {
  const CanonicalFunctions* functions = dynamics.canonical();
  if (functions == nullptr) return std::nullopt;
  const std::size_t n = dynamics.model().degrees_of_freedom();
  RightHandSide::CanonicalForm form;
  form.variables = [functions, n, workspace = functions->momenta().bind(request.parameters)](
                       double t, std::span<const double> y, std::span<double> z) mutable {
    std::copy_n(y.begin(), n, z.begin());
    return functions->momenta().evaluate(t, y, workspace, z.subspan(n));
  };
  form.derivative = [functions, workspace = functions->derivative().bind(request.parameters)](
                        double t, std::span<const double> z, std::span<double> derivative) mutable {
    return functions->derivative().evaluate(t, z, workspace, derivative);
  };
  form.jacobian = [functions, workspace = functions->bind_jacobian(request.parameters)](
                      double t, std::span<const double> z, std::span<double> jacobian) mutable {
    return functions->jacobian(t, z, workspace, jacobian);
  };
  std::vector<double> z(2 * n), slope(2 * n);
  if (form.variables(request.t_start, request.y_start, z) != Evaluation::ok) return std::nullopt;
  if (form.derivative(request.t_start, z, slope) == Evaluation::singular_mass) return std::nullopt;
  return form;
}

/// Keeps references to the functions.
RightHandSide system_of(const CompiledFunction& accelerations, const CompiledFunction* jacobian,
                        std::span<const double> parameters, Needs needs) {
  const std::size_t n = accelerations.outputs();
  RightHandSide system;
  system.dimension = 2 * n;
  system.derivative = [&accelerations, n, workspace = accelerations.bind(parameters)](
                          double t, std::span<const double> y, std::span<double> derivative) mutable {
    std::copy_n(y.begin() + static_cast<std::ptrdiff_t>(n), n, derivative.begin());
    return accelerations.evaluate(t, y, workspace, derivative.subspan(n));
  };
  if (jacobian != nullptr) {
    system.jacobian = [jacobian, workspace = jacobian->bind(parameters)](double t, std::span<const double> y,
                                                                         std::span<double> out) mutable {
      return jacobian->evaluate(t, y, workspace, out);
    };
  }
  if (needs == Needs::expansion) {
    const auto expansion = std::make_shared<TaylorExpansion>(accelerations, parameters);
    system.expansion = [expansion](double t, std::span<const double> y, unsigned order, std::span<double> c) {
      return expansion->expand(t, y, order, c);
    };
    system.defect = [expansion](double h, std::span<const double> allowed, std::span<double> defect) {
      return expansion->bound_defect(h, allowed, defect);
    };
    system.rounding = [expansion](std::span<double> rounding) { expansion->bound_rounding(rounding); };
  }
  return system;
}

void add_projection(const Dynamics& dynamics, std::span<const double> parameters, RightHandSide& system) {
  const ConstraintSurface* surface = dynamics.constraint_surface();
  if (surface == nullptr) return;
  system.project = [states = ConstrainedStates(*surface, parameters)](double t, std::span<double> y) mutable {
    return states.project(t, y);
  };
}

RightHandSide smooth_system(const Dynamics& dynamics, std::span<const double> parameters, Needs needs) {
  RightHandSide system = system_of(
      dynamics.accelerations(), needs == Needs::jacobian ? &dynamics.jacobian() : nullptr, parameters, needs);
  add_projection(dynamics, parameters, system);
  return system;
}

}  // namespace

RightHandSide motion_system(const Dynamics& dynamics, const SimulationRequest& request) {
  Needs needs = record_of(request.method).needs;
  std::optional<RightHandSide::CanonicalForm> canonical;
  if (needs == Needs::canonical_form) {
    canonical = canonical_form(dynamics, request);
    if (!canonical) needs = Needs::jacobian;  // it steps in (q, q') then
  }
  RightHandSide system = smooth_system(dynamics, request.parameters, needs);
  system.canonical = std::move(canonical);
  return system;
}

RightHandSide motion_system(const Dynamics& dynamics, std::span<const double> parameters, Method method) {
  return smooth_system(dynamics, parameters, record_of(method).needs);
}

RightHandSide motion_system(const Dynamics& dynamics, const Sides& sides, std::span<const double> parameters,
                            Method method) {
  const Staying staying = staying_on(sides);
  const Needs needs = record_of(method).needs;
  const CompiledFunction* jacobian = needs == Needs::jacobian ? &dynamics.kinked_jacobian(staying) : nullptr;
  RightHandSide system = system_of(dynamics.kinked(staying)->accelerations, jacobian, parameters, needs);
  add_projection(dynamics, parameters.first(dynamics.model().parsed.symbols.parameters.size()), system);
  return system;
}

}  // namespace qdot
