#include "core/mechanics/conserved.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"
#include "core/mechanics/canonical.hpp"
#include "core/mechanics/explicit_time.hpp"
#include "core/mechanics/friction.hpp"
#include "core/mechanics/jumps.hpp"

namespace qdot {
namespace {

std::string name_of(const Expression& symbol) { return std::get<Symbol>(symbol.node()).name; }

/// The time, and inputs, which are functions of it.
bool depends_on_time(const Expression& e, const Symbols& symbols) {
  return depends_on(e, symbols.t) || depends_on(e, symbols.inputs.value) ||
         depends_on(e, symbols.inputs.rate);
}

/// But those of constraints that do no work, and those whose power vanishes whatever the velocities are, such
/// as a magnetic field's.
bool has_forces(const Lagrangian& lagrangian) {
  const std::vector<Expression> forces = working_forces(lagrangian);
  if (std::ranges::all_of(forces, &Expression::is_zero)) return false;
  std::vector<Expression> power;
  for (std::size_t i = 0; i < forces.size(); ++i)
    power.push_back(forces[i] * lagrangian.symbols.coordinates.rate[i]);
  return !simplify(lagrangian.graph->sum(power)).is_zero();
}

/// h = T + V holds when T is purely quadratic in the velocities and V has none.
bool is_energy(const Lagrangian& lagrangian) {
  if (!lagrangian.kinetic_energy) return false;
  const Expression difference =
      jacobi_integral(lagrangian) - *lagrangian.kinetic_energy - *lagrangian.potential_energy;
  return simplify(difference).is_zero();
}

/// h of what is left of L without a total derivative, where only that contains the time.
std::optional<ConservedQuantity> energy_beside_a_derivative(const Lagrangian& lagrangian,
                                                            const std::string& until) {
  const Symbols& symbols = lagrangian.symbols;
  const Symbols::Varying& q = symbols.coordinates;
  if (has_forces(lagrangian)) return std::nullopt;
  const SmoothedJumps smoothed(lagrangian.lagrangian, symbols);
  const auto left = without_explicit_time(smoothed.smooth(), q.value, q.rate, symbols.t);
  if (!left || depends_on_time(*left, symbols)) return std::nullopt;
  Lagrangian own = lagrangian;
  own.lagrangian = smoothed.with_jumps(*left);
  own.kinetic_energy = own.potential_energy = std::nullopt;
  return ConservedQuantity{
      "h", "J", jacobi_integral(own),
      "But for the total derivative of a function of the coordinates and the time, the Lagrangian does not "
      "contain the time, so h = sum of p q_dot - L of what is left is constant" +
          until};
}

/// Lagrange's equations of dL/dt vanish: the time is in L by the total derivative of some F(q, t) alone, and
/// no equation contains it.
bool time_changes_no_motion(const Lagrangian& lagrangian) {
  const Symbols& symbols = lagrangian.symbols;
  const Symbols::Varying& q = symbols.coordinates;
  if (!symbols.inputs.value.empty()) return false;
  const Expression change = differentiate(SmoothedJumps(lagrangian.lagrangian, symbols).smooth(), symbols.t);
  const std::vector<Replacement> along = symbols.rates();
  for (std::size_t i = 0; i < q.value.size(); ++i) {
    const Expression momentum = differentiate(change, q.rate[i]);
    if (!simplify(total_derivative(momentum, along) - differentiate(change, q.value[i])).is_zero())
      return false;
  }
  return true;
}

}  // namespace

std::vector<ConservedQuantity> conserved_quantities(const Lagrangian& lagrangian, const Scene& scene) {
  const bool has_impacts = scene.has_impacts();
  const std::string until = has_impacts ? " between impacts." : ".";
  const bool has_any = !std::ranges::all_of(lagrangian.generalized_forces, &Expression::is_zero);
  const std::string without_time = std::string("The Lagrangian does not contain the time") +
                                   (has_any ? ", the forces beside it do no work" : "");
  std::vector<ConservedQuantity> found;
  if (!has_forces(lagrangian) && !depends_on_time(lagrangian.lagrangian, lagrangian.symbols)) {
    if (is_energy(lagrangian)) {
      found.push_back(
          {"energy", "J", jacobi_integral(lagrangian),
           without_time +
               " and T is quadratic in the velocities, so the Jacobi integral is the energy T + V" +
               std::string(has_impacts ? ", constant between impacts." : ".")});
    } else {
      found.push_back({"h", "J", jacobi_integral(lagrangian),
                       without_time + ", so the Jacobi integral h = sum of p q_dot - L is constant" + until});
    }
  }
  if (auto h = energy_beside_a_derivative(lagrangian, until)) found.push_back(*std::move(h));
  const std::vector<Expression> momenta = conjugate_momenta(lagrangian);
  for (const std::size_t i : ignorable_coordinates(lagrangian)) {
    if (momenta[i].is_zero()) continue;  // a massless foot has none to keep
    const std::string q = name_of(lagrangian.symbols.coordinates.value[i]);
    found.push_back({momentum_names(lagrangian.symbols)[i], momentum_unit(scene, i), momenta[i],
                     q + " does not appear in the Lagrangian (it is ignorable)" +
                         (has_any ? " and no force beside it acts along " + q : "") +
                         ", so its momentum is constant" + until});
  }
  return found;
}

std::string why_energy_changes(const Lagrangian& lagrangian) {
  if (has_forces(lagrangian)) {
    return lagrangian.constraints.empty()
               ? "Forces outside the Lagrangian do work."
               : "Forces outside the Lagrangian, or a constraint that moves, do work.";
  }
  if (depends_on_time(lagrangian.lagrangian, lagrangian.symbols)) {
    if (time_changes_no_motion(lagrangian)) {
      return lagrangian.kinetic_energy
                 ? "T + V contains the time, but no equation of motion does: in the Lagrangian it is part of a "
                   "total derivative. What stays constant in its place is h of what is left without that."
                 : "The scene gives only its Lagrangian, so T and V are not known apart. The time is in it by a "
                   "total derivative only, which changes no motion: h of what is left without that is constant.";
    }
    return "The Lagrangian contains the time explicitly: what moves the system from outside does work.";
  }
  if (!lagrangian.kinetic_energy)
    return "The scene gives only its Lagrangian, so T and V are not known apart: what is constant is h = sum of p "
           "q_dot - L, which is the energy wherever T is quadratic in the velocities.";
  if (is_energy(lagrangian)) return "";
  return "T has terms that are not quadratic in the velocities: what keeps the prescribed motion does work, "
         "so h is constant and T + V is not.";
}

}  // namespace qdot
