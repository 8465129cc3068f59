#include "core/motion/motion_system.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/compile/taylor/pair_expansion.hpp"
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

/// Keeps references to the functions. `expansion`: of the accelerations, where a method needs it.
RightHandSide system_of(const CompiledFunction& accelerations, const CompiledFunction* jacobian,
                        std::span<const double> parameters, std::shared_ptr<TaylorExpansion> expansion) {
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
  if (expansion) {
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

/// On the sides of kinks, where there are `sides`.
const CompiledFunction& accelerations_of(const Dynamics& dynamics, const Sides* sides) {
  return sides == nullptr ? dynamics.accelerations() : dynamics.kinked(staying_on(*sides))->accelerations;
}

const CompiledFunction* jacobian_of(const Dynamics& dynamics, const Sides* sides, Needs needs) {
  if (needs != Needs::jacobian) return nullptr;
  return sides == nullptr ? &dynamics.jacobian() : &dynamics.kinked_jacobian(staying_on(*sides));
}

std::shared_ptr<TaylorExpansion> expansion_of(const Dynamics& dynamics, const Sides* sides,
                                              std::span<const double> parameters, Needs needs) {
  if (needs != Needs::expansion) return nullptr;
  return std::make_shared<TaylorExpansion>(accelerations_of(dynamics, sides), parameters);
}

RightHandSide system_on(const Dynamics& dynamics, const Sides* sides, std::span<const double> parameters,
                        Needs needs, const std::shared_ptr<TaylorExpansion>& expansion) {
  RightHandSide system = system_of(accelerations_of(dynamics, sides), jacobian_of(dynamics, sides, needs),
                                   parameters, expansion);
  const std::size_t own =
      sides == nullptr ? parameters.size() : dynamics.model().parsed.symbols.parameters.size();
  add_projection(dynamics, parameters.first(own), system);
  return system;
}

RightHandSide system_on(const Dynamics& dynamics, const Sides* sides, std::span<const double> parameters,
                        Needs needs) {
  return system_on(dynamics, sides, parameters, needs, expansion_of(dynamics, sides, parameters, needs));
}

}  // namespace

RightHandSide motion_system(const Dynamics& dynamics, const SimulationRequest& request) {
  Needs needs = record_of(request.method).needs;
  std::optional<RightHandSide::CanonicalForm> canonical;
  if (needs == Needs::canonical_form) {
    canonical = canonical_form(dynamics, request);
    if (!canonical) needs = Needs::jacobian;  // it steps in (q, q') then
  }
  RightHandSide system = system_on(dynamics, nullptr, request.parameters, needs);
  system.canonical = std::move(canonical);
  return system;
}

RightHandSide motion_system(const Dynamics& dynamics, const Sides& sides, std::span<const double> parameters,
                            Method method) {
  return system_on(dynamics, &sides, parameters, record_of(method).needs);
}

Originals motions_stood_for(const Dynamics& dynamics, const Sides* sides, std::span<const double> asked,
                            std::span<const double> rounded, Method method) {
  const Needs needs = record_of(method).needs;
  const auto first = expansion_of(dynamics, sides, asked, needs);
  const auto second = expansion_of(dynamics, sides, rounded, needs);
  Originals originals{system_on(dynamics, sides, asked, needs, first),
                      system_on(dynamics, sides, rounded, needs, second),
                      {}};
  if (first == nullptr) return originals;
  originals.both = [both = std::make_shared<PairExpansion>(*first, *second)](
                       double t, std::span<const PairOfDoubles> y, unsigned order,
                       std::span<PairOfDoubles> c) { return both->expand(t, y, order, c); };
  return originals;
}

}  // namespace qdot
