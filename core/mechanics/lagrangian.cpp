#include "core/mechanics/lagrangian.hpp"

#include <algorithm>

#include "core/expr/factored_form.hpp"
#include "core/expr/kept_terms.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/unfold.hpp"
#include "core/mechanics/units.hpp"

namespace qdot {
namespace {

Expression dot(Graph& graph, const Vector& a, const Vector& b) {
  std::vector<Expression> terms;
  for (std::size_t i = 0; i < a.size(); ++i) terms.push_back(a[i] * b[i]);
  return graph.sum(terms);
}

class Energies {
 public:
  explicit Energies(const ParsedScene& scene) : scene_(scene), rates_(scene.symbols.rates()) {}

  [[nodiscard]] Expression kinetic() const {
    std::vector<Expression> terms;
    for (const ParsedBody& body : scene_.bodies) terms.push_back(kinetic_of(body));
    return graph().sum(terms);
  }

  /// V in parts that are short each by itself: the weights, every spring, the extra potential.
  [[nodiscard]] std::vector<Expression> potentials() const {
    std::vector<Expression> weights;
    for (const ParsedBody& body : scene_.bodies) weights.push_back(weight_of(body));
    std::vector<Expression> terms{graph().sum(weights)};
    for (const ParsedSpring& spring : scene_.springs) {
      terms.push_back(half() * spring.stiffness * pow(spring.length - spring.rest_length, Number(2)));
    }
    if (scene_.potential) terms.push_back(*scene_.potential);
    return terms;
  }

 private:
  [[nodiscard]] Graph& graph() const { return *scene_.graph; }
  [[nodiscard]] Expression half() const { return graph().number(Number::ratio(1, 2)); }

  [[nodiscard]] Vector velocity(const Vector& position) const {
    Vector v;
    for (const Expression& component : position) v.push_back(total_derivative(component, rates_));
    return v;
  }

  [[nodiscard]] Expression kinetic_of(const ParsedBody& body) const {
    const Vector v = velocity(body.centre);
    std::vector<Expression> terms{half() * body.mass * dot(graph(), v, v)};
    for (const ParsedSpin& spin : body.spins) terms.push_back(half() * spin.inertia * spin.rate * spin.rate);
    return graph().sum(terms);
  }

  [[nodiscard]] Expression weight_of(const ParsedBody& body) const {
    return scene_.gravity.empty() ? graph().number(0)
                                  : -(body.mass * dot(graph(), scene_.gravity, body.centre));
  }

  const ParsedScene& scene_;
  std::vector<Replacement> rates_;
};

std::vector<Replacement> holding(const ParsedScene& scene) {
  std::vector<Replacement> result;
  const Symbols::Varying& held = scene.symbols.held;
  for (std::size_t i = 0; i < held.value.size(); ++i) {
    result.emplace_back(held.value[i], scene.held_values[i]);
    result.emplace_back(held.rate[i], scene.graph->number(0));
    result.emplace_back(held.second_rate[i], scene.graph->number(0));
  }
  return result;
}

/// Q_x = sum of F . dr/dx + sum of torque . domega/dx' - dD/dx' + sum of lambda_j d(phi_j)/dx.
Expression generalized_force(const ParsedScene& scene, const Expression& x, const Expression& rate) {
  std::vector<Expression> terms;
  for (const ParsedForce& force : scene.forces) {
    for (std::size_t k = 0; k < force.vector.size(); ++k) {
      terms.push_back(force.vector[k] * differentiate(force.point[k], x));
    }
  }
  for (const ParsedTorque& torque : scene.torques) {
    for (std::size_t k = 0; k < torque.vector.size(); ++k)
      terms.push_back(torque.vector[k] * differentiate(torque.angular_velocity[k], rate));
  }
  if (scene.dissipation) terms.push_back(-differentiate(*scene.dissipation, rate));
  for (std::size_t j = 0; j < scene.constraints.size(); ++j)
    terms.push_back(scene.symbols.multipliers[j] * slope_of(scene.constraints[j], x, rate));
  return shortened(substitute(scene.graph->sum(terms), holding(scene)));
}

std::vector<Expression> generalized_forces(const ParsedScene& scene, const Symbols::Varying& varying) {
  std::vector<Expression> forces;
  for (std::size_t i = 0; i < varying.value.size(); ++i) {
    forces.push_back(generalized_force(scene, varying.value[i], varying.rate[i]));
  }
  return forces;
}

int degree_in(const Monomial& monomial, const std::vector<Expression>& symbols) {
  int degree = 0;
  for (const Expression& symbol : symbols) degree += exponent_of(monomial, symbol.id());
  return degree;
}

/// A root or another function of some of the symbols is among the factors: the degree says nothing then.
bool has_function_of(Graph& graph, const Monomial& monomial, const std::vector<Expression>& symbols) {
  return std::ranges::any_of(monomial, [&](const Atom& atom) {
    return !std::holds_alternative<Symbol>(graph.node(atom.base)) &&
           depends_on(Expression(graph, atom.base), symbols);
  });
}

}  // namespace

Lagrangian derive_lagrangian(const ParsedScene& scene) {
  Lagrangian result;
  result.graph = scene.graph;
  result.symbols = scene.symbols;
  result.holding = holding(scene);
  result.generalized_forces = generalized_forces(scene, scene.symbols.coordinates);
  result.held_forces = generalized_forces(scene, scene.symbols.held);
  result.constraints = constraint_equations(scene, result.holding);
  if (scene.lagrangian) {
    result.varied = *scene.lagrangian;
    const Expression written =
        with_squares_under_roots(substitute(result.varied, result.holding), scene.symbols.coordinates.value);
    result.lagrangian = shortened_by_degree(written, scene.symbols);
  } else {
    const Energies energies(scene);
    const Expression kinetic = energies.kinetic();
    const std::vector<Expression> potentials = energies.potentials();
    result.varied = kinetic - scene.graph->sum(potentials);
    result.kinetic_energy = simplify_by_degree(substitute(kinetic, result.holding), scene.symbols);
    std::vector<Expression> terms;
    for (const Expression& term : potentials)
      terms.push_back(shortened(
          with_squares_under_roots(substitute(term, result.holding), scene.symbols.coordinates.value)));
    result.potential_energy = scene.graph->sum(terms);
    result.lagrangian = *result.kinetic_energy - *result.potential_energy;
  }
  return result;
}

Lagrangian copied(const Lagrangian& lagrangian) {
  Lagrangian copy = lagrangian;
  copy.graph = std::make_shared<Graph>(*lagrangian.graph);
  const auto move = [&](Expression& e) { e = copy.graph->adopt(e); };
  const auto move_all = [&](std::vector<Expression>& all) { std::for_each(all.begin(), all.end(), move); };
  for (Symbols::Varying* varying : {&copy.symbols.coordinates, &copy.symbols.inputs, &copy.symbols.held}) {
    move_all(varying->value);
    move_all(varying->rate);
    move_all(varying->second_rate);
  }
  move(copy.symbols.t);
  move_all(copy.symbols.parameters);
  move_all(copy.symbols.multipliers);
  move(copy.lagrangian);
  if (copy.kinetic_energy) move(*copy.kinetic_energy);
  if (copy.potential_energy) move(*copy.potential_energy);
  move_all(copy.generalized_forces);
  move(copy.varied);
  move_all(copy.held_forces);
  for (ConstraintEquation& constraint : copy.constraints) {
    if (constraint.position) move(*constraint.position);
    move(constraint.rate);
    move_all(constraint.slope);
    move(constraint.rest);
  }
  for (auto& [held, value] : copy.holding) {
    move(held);
    move(value);
  }
  return copy;
}

Lagrangian replaced(const Lagrangian& lagrangian, std::span<const Replacement> replacements) {
  if (replacements.empty()) return lagrangian;
  Lagrangian result = lagrangian;
  if (lagrangian.kinetic_energy) {
    result.kinetic_energy =
        simplify_by_degree(substitute(*lagrangian.kinetic_energy, replacements), lagrangian.symbols);
    result.potential_energy = shortened(substitute(*lagrangian.potential_energy, replacements));
  }
  result.lagrangian =
      shortened_by_degree(substitute(lagrangian.lagrangian, replacements), lagrangian.symbols);
  for (Expression& force : result.generalized_forces) force = shortened(substitute(force, replacements));
  const auto put_in = [&](Expression& e) { e = substitute(e, replacements); };
  for (ConstraintEquation& constraint : result.constraints) {
    if (constraint.position) put_in(*constraint.position);
    put_in(constraint.rate);
    std::ranges::for_each(constraint.slope, put_in);
    put_in(constraint.rest);
  }
  return result;
}

std::string momentum_unit(const Scene& scene, std::size_t coordinate) {
  const Dimension action = parse_unit("J*s")->dimension;
  const auto unit = parse_unit(scene.coordinates[coordinate].unit);
  return to_text(unit ? action / unit->dimension : action);
}

Expression velocity_degree(const Expression& e, const Symbols& symbols, int n) {
  Polynomial part;
  for (const auto& [monomial, coefficient] : multiplied_out(e)) {
    if (degree_in(monomial, symbols.coordinates.rate) == n) add(part, monomial, coefficient);
  }
  return to_expression(e.graph(), part);
}

Expression simplify_by_degree(const Expression& e, const Symbols& symbols) {
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, coefficient] : multiplied_out(e)) {
    const bool has_degree = !has_function_of(e.graph(), monomial, symbols.coordinates.rate);
    add(parts[has_degree ? degree_in(monomial, symbols.coordinates.rate) : 0], monomial, coefficient);
  }
  std::vector<Expression> terms;
  for (const auto& [degree, part] : parts) {
    const Expression rest = simplify(to_expression(e.graph(), part));
    terms.push_back(degree == 0 ? rest
                                : collected_form(e.graph(), multiplied_out(rest), symbols.coordinates.rate));
  }
  return e.graph().sum(terms);
}

Expression shortened_by_degree(const Expression& e, const Symbols& symbols) {
  const auto [plain, kept] = split_kept_terms(e);
  if (kept.is_zero() || depends_on(kept, symbols.coordinates.rate)) return simplify_by_degree(e, symbols);
  return simplify_by_degree(plain, symbols) + kept;
}

std::vector<Expression> conjugate_momenta(const Lagrangian& lagrangian) {
  std::vector<Expression> momenta;
  for (const Expression& rate : lagrangian.symbols.coordinates.rate) {
    momenta.push_back(simplify(differentiate(lagrangian.lagrangian, rate)));
  }
  return momenta;
}

Expression jacobi_integral(const Lagrangian& lagrangian) {
  const Symbols& symbols = lagrangian.symbols;
  if (lagrangian.kinetic_energy) {  // h = T2 - T0 + V
    const Expression t2 = velocity_degree(*lagrangian.kinetic_energy, symbols, 2);
    const Expression t0 = velocity_degree(*lagrangian.kinetic_energy, symbols, 0);
    return simplify_by_degree(t2, symbols) - simplify(t0) + *lagrangian.potential_energy;
  }
  std::vector<Expression> terms{-lagrangian.lagrangian};
  for (const Expression& rate : symbols.coordinates.rate) {
    terms.push_back(rate * differentiate(lagrangian.lagrangian, rate));
  }
  return shortened_by_degree(lagrangian.graph->sum(terms), symbols);
}

Expression reaction(const Lagrangian& lagrangian, const ParsedReaction& which) {
  const Symbols& symbols = lagrangian.symbols;
  const Expression momentum = differentiate(lagrangian.varied, symbols.held.rate[which.held]);
  const Expression force = total_derivative(momentum, symbols.rates()) -
                           differentiate(lagrangian.varied, symbols.held.value[which.held]) -
                           lagrangian.held_forces[which.held];
  return simplify(Number(which.sign) * substitute(force, lagrangian.holding));
}

}  // namespace qdot
