#pragma once
// A system as its questions see it: the formulas that can be expected of it, its symbols with their domains,
// and the parameters that a question fixes, so that letters and numbers for them are both right.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/grading/sampled_states.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

class ExpectedSystem {
 public:
  /// Works on a copy of the model's graph. Keeps a reference to the model.
  explicit ExpectedSystem(const Model& model);

  [[nodiscard]] Graph& graph() const { return *own_.graph; }
  [[nodiscard]] const Symbols& symbols() const { return own_.symbols; }
  [[nodiscard]] const Scene& scene() const { return model_.scene; }
  [[nodiscard]] std::size_t degrees_of_freedom() const { return model_.degrees_of_freedom(); }

  /// Gives a parameter a value, which may speak of others.
  void fix(std::size_t parameter, const Expression& value);
  /// e with these values.
  [[nodiscard]] Expression with_fixed(const Expression& e) const;
  [[nodiscard]] bool has_fixed() const { return !fixed_.empty(); }
  /// Whether e speaks of a fixed parameter.
  [[nodiscard]] bool speaks_of_fixed(const Expression& e) const;

  /// T, V, L, E, h, H, R, p_theta, Q_theta, theta_ddot, a multiplier's, condition's or report's name. Throws
  /// Error(not_applicable) where the system has none of that; none for a name that means nothing.
  [[nodiscard]] std::optional<Expression> quantity(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> quantity_names() const;
  /// Whether the scene calls something of its own, such as a tension T, as an energy or a momentum is called.
  [[nodiscard]] bool is_ambiguous(std::string_view name) const;

  /// S and r of S u = r, with the rows of the coordinates divided by their common factors: M q'' = f, and
  /// with constraints [M, -C; A, 0] (q'', lambda) = (f, -rest).
  [[nodiscard]] const Matrix& matrix() const { return matrix_; }
  [[nodiscard]] const std::vector<Expression>& right() const { return right_; }
  /// u: the accelerations, then the multipliers.
  [[nodiscard]] const std::vector<Expression>& unknowns() const { return unknowns_; }

  [[nodiscard]] bool has_constraints() const { return model_.has_constraints(); }
  /// With fixed parameters put in.
  [[nodiscard]] std::vector<ConstraintEquation> constraints() const;
  /// Multipliers that have no other name than lambda, so that their sign is free.
  [[nodiscard]] std::vector<Expression> plain_multipliers() const;

  /// p_theta and the like.
  [[nodiscard]] std::vector<Expression> momenta() const;
  /// e with p_theta = dL/dtheta' put in.
  [[nodiscard]] Expression with_momenta(const Expression& e) const;
  /// Free parameters, coordinates, velocities, momenta, inputs with their rates, and the time.
  [[nodiscard]] std::vector<SymbolDomain> domains() const;

 private:
  [[nodiscard]] std::optional<Expression> energy_named(std::string_view name) const;
  [[nodiscard]] std::optional<Expression> by_coordinate(std::string_view name) const;
  [[nodiscard]] Expression unknown_written_out(std::size_t i) const;
  [[nodiscard]] std::optional<Expression> multiplier(std::string_view name) const;
  [[nodiscard]] std::optional<Expression> condition(std::string_view name) const;

  const Model& model_;
  Lagrangian own_;
  Matrix matrix_;
  std::vector<Expression> right_, unknowns_;
  std::vector<Replacement> fixed_;
};

}  // namespace qdot
