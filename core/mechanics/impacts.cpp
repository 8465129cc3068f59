#include "core/mechanics/impacts.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/equations_of_motion.hpp"

namespace qdot {
namespace {

[[noreturn]] void refuse_undetermined() {
  throw Error(
      ErrorCode::not_applicable,
      "The impact does not determine the velocities after it: the system that it would follow from is "
      "singular.");
}

/// x with m x = b by elimination in order, as the part of m that has masses is positive definite.
std::vector<Expression> eliminated(Matrix m, std::vector<Expression> b) {
  const std::size_t n = m.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = k + 1; m[k][k].is_zero() && i < n; ++i) {  // a coordinate without mass
      std::swap(m[k], m[i]);
      std::swap(b[k], b[i]);
    }
    if (m[k][k].is_zero()) refuse_undetermined();
    for (std::size_t i = k + 1; i < n; ++i) {
      if (m[i][k].is_zero()) continue;
      const Expression factor = m[i][k] / m[k][k];
      for (std::size_t j = k + 1; j < n; ++j) m[i][j] = m[i][j] - factor * m[k][j];
      b[i] = b[i] - factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] = b[k] - m[k][j] * b[j];
    b[k] = b[k] / m[k][k];
  }
  return b;
}

std::vector<Expression> solution(const Matrix& m, const std::vector<Expression>& b) {
  if (m.size() > largest_written_system) return eliminated(m, b);
  if (simplify(determinant(m)).is_zero()) refuse_undetermined();
  return cramer(m, b);
}

class ImpactDerivation {
 public:
  ImpactDerivation(const ParsedScene& scene, const ParsedContact& contact, const Lagrangian& lagrangian)
      : scene_(scene),
        contact_(contact),
        lagrangian_(lagrangian),
        graph_(*lagrangian.graph),
        q_(scene.symbols.coordinates),
        rates_(scene.symbols.rates()) {}

  [[nodiscard]] std::vector<Replacement> with_restitution() const {
    const Expression distance = held(contact_.distance);
    std::vector<Expression> slope;
    for (const Expression& x : q_.value) slope.push_back(simplify(differentiate(distance, x)));
    std::vector<Expression> push = pushed(slope);
    push.resize(slope.size());
    const Expression resistance = dot(slope, push);
    if (simplify(resistance).is_zero()) refuse_undetermined();
    const Expression speed = total_derivative(distance, rates_);
    const Expression impulse = (graph_.number(1) + *contact_.restitution) * speed / resistance;
    std::vector<Replacement> map;
    for (std::size_t i = 0; i < push.size(); ++i) {
      if (!push[i].is_zero()) map.emplace_back(q_.rate[i], q_.rate[i] - impulse * push[i]);
    }
    return map;
  }

  [[nodiscard]] std::vector<Replacement> of_contacts() const {
    const std::size_t n = q_.value.size();
    const Matrix inverse = inverse_of_renaming();
    std::vector<Expression> momenta = momenta_before();
    Matrix mass = mass_about_contact();
    // rows and unknowns of the new coordinates: N^-T M N^-1
    mass = times(transposed(inverse), times(mass, inverse));
    for (Expression& p : momenta) p = on_surface(p);
    Matrix column;
    for (const Expression& p : momenta) column.push_back({p});
    column = times(transposed(inverse), column);
    std::vector<Expression> right;
    for (std::size_t i = 0; i < n; ++i) {
      right.push_back(simplify(on_surface(column[i][0])));
      for (Expression& entry : mass[i]) entry = simplify(on_surface(entry));
    }
    const std::vector<Expression> velocities = solution(mass, right);
    std::vector<Replacement> map;
    for (std::size_t i = 0; i < n; ++i) {
      const Expression place = simplify(on_surface(new_name(q_.value[i])));
      if (!(place == q_.value[i])) map.emplace_back(q_.value[i], place);
    }
    for (std::size_t i = 0; i < n; ++i) map.emplace_back(q_.rate[i], velocities[i]);
    return map;
  }

 private:
  /// w with M w = a + A^T nu, A w = 0; then -nu.
  [[nodiscard]] std::vector<Expression> pushed(std::vector<Expression> slope) const {
    Matrix matrix = mass_matrix(lagrangian_);
    const std::size_t n = slope.size();
    for (const ConstraintEquation& constraint : lagrangian_.constraints) {
      for (std::size_t i = 0; i < n; ++i) matrix[i].push_back(constraint.slope[i]);
      matrix.push_back(constraint.slope);
      slope.push_back(graph_.number(0));
    }
    for (auto& row : matrix) row.resize(slope.size(), graph_.number(0));
    return solution(matrix, slope);
  }

  [[nodiscard]] Expression held(const Expression& e) const { return substitute(e, lagrangian_.holding); }

  [[nodiscard]] Expression dot(const std::vector<Expression>& a, const std::vector<Expression>& b) const {
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < a.size(); ++i) terms.push_back(a[i] * b[i]);
    return graph_.sum(terms);
  }

  [[nodiscard]] Vector velocity(const Vector& place) const {
    Vector v;
    for (const Expression& component : place) v.push_back(total_derivative(held(component), rates_));
    return v;
  }

  /// V - V_s.
  [[nodiscard]] Vector relative_velocity(const Vector& place) const {
    Vector v = velocity(place);
    const Vector contact = velocity(contact_.made);
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = v[k] - contact[k];
    return v;
  }

  [[nodiscard]] std::vector<Expression> momenta_before() const {
    std::vector<Expression> momenta;
    for (const Expression& rate : q_.rate) {
      std::vector<Expression> terms;
      for (const ParsedBody& body : scene_.bodies) {
        const Vector v = velocity(body.centre), relative = relative_velocity(body.centre);
        for (std::size_t k = 0; k < v.size(); ++k)
          terms.push_back(body.mass * v[k] * differentiate(relative[k], rate));
        for (const ParsedSpin& spin : body.spins)
          terms.push_back(held(spin.inertia * spin.rate * differentiate(spin.rate, rate)));
      }
      momenta.push_back(graph_.sum(terms));
    }
    return momenta;
  }

  [[nodiscard]] Matrix mass_about_contact() const {
    std::vector<Expression> terms;
    for (const ParsedBody& body : scene_.bodies) {
      const Vector v = relative_velocity(body.centre);
      terms.push_back(Number::ratio(1, 2) * (body.mass * dot(v, v)));
      for (const ParsedSpin& spin : body.spins)
        terms.push_back(held(Number::ratio(1, 2) * (spin.inertia * spin.rate * spin.rate)));
    }
    const Expression kinetic = graph_.sum(terms);
    Matrix mass;
    for (const Expression& a : q_.rate) {
      mass.emplace_back();
      for (const Expression& b : q_.rate) mass.back().push_back(differentiate(differentiate(kinetic, a), b));
    }
    return mass;
  }

  [[nodiscard]] Expression new_name(const Expression& q) const {
    for (const auto& [symbol, value] : contact_.renamed) {
      if (symbol == q) return held(value);
    }
    return q;
  }

  /// N^-1 of N = d(new q)/dq.
  [[nodiscard]] Matrix inverse_of_renaming() const {
    const std::size_t n = q_.value.size();
    Matrix renaming;
    for (const Expression& q : q_.value) {
      renaming.emplace_back();
      for (const Expression& x : q_.value) renaming.back().push_back(simplify(differentiate(new_name(q), x)));
    }
    Matrix inverse(n);
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<Expression> unit(n, graph_.number(0));
      unit[j] = graph_.number(1);
      const std::vector<Expression> column = solution(renaming, unit);
      for (std::size_t i = 0; i < n; ++i) inverse[i].push_back(column[i]);
    }
    return inverse;
  }

  [[nodiscard]] Matrix transposed(const Matrix& m) const {
    Matrix result(m.front().size());
    for (const auto& row : m) {
      for (std::size_t j = 0; j < row.size(); ++j) result[j].push_back(row[j]);
    }
    return result;
  }

  [[nodiscard]] Matrix times(const Matrix& a, const Matrix& b) const {
    const Matrix columns = transposed(b);
    Matrix product;
    for (const auto& row : a) {
      product.emplace_back();
      for (const auto& column : columns) product.back().push_back(dot(row, column));
    }
    return product;
  }

  /// The event is at distance = 0: where it is linear in a coordinate, that is known by the others.
  [[nodiscard]] Expression on_surface(const Expression& e) const {
    const Expression distance = held(contact_.distance);
    for (std::size_t i = q_.value.size(); i-- > 0;) {
      const Expression& x = q_.value[i];
      const Expression slope = simplify(differentiate(distance, x));
      if (slope.is_zero() || slope.number() == nullptr) continue;
      const Replacement known{x, simplify(x - distance / slope)};
      return substitute(e, {&known, 1});
    }
    return e;
  }

  const ParsedScene& scene_;
  const ParsedContact& contact_;
  const Lagrangian& lagrangian_;
  Graph& graph_;
  const Symbols::Varying& q_;
  std::vector<Replacement> rates_;
};

}  // namespace

std::vector<Replacement> derived_impact(const ParsedScene& scene, const ParsedContact& contact,
                                        const Lagrangian& lagrangian) {
  const ImpactDerivation derivation(scene, contact, lagrangian);
  return contact.restitution ? derivation.with_restitution() : derivation.of_contacts();
}

}  // namespace qdot
