#pragma once
// The modes at an equilibrium known in closed form, with some relations between parameters put in, as
// formulas: lambda = omega^2, omega, the period and the shape, each held against the linearized equations K v
// = lambda M v, or their determinant, at other values of the parameters.

#include <optional>
#include <utility>
#include <vector>

#include "core/closed/assumed_signs.hpp"
#include "core/closed/exact_mode.hpp"
#include "core/closed/exact_place.hpp"
#include "core/closed/linear_modes.hpp"

namespace qdot {

/// One eigenvalue with its forms.
struct ModeForms {
  Expression root;  ///< omega, or the size of the rate
  bool oscillates{};
  ExactMode form;
  std::vector<Expression> shape;      ///< of all coordinates, or empty
  std::optional<Expression> decay{};  ///< with friction, -Re s: negative where it grows
};

class ModeDerivation {
 public:
  ModeDerivation(const LinearMotions& motions, const ExactPlace& place, const ExactValues& values,
                 const Relations& relations);

  /// Those whose equations hold; lambda is not 0 where nothing is damped.
  [[nodiscard]] const std::vector<LinearMode>& modes() const { return modes_; }
  [[nodiscard]] double value(const LinearMode& mode) const;              ///< lambda
  [[nodiscard]] Expression square(const LinearMode& mode);               ///< |lambda|
  [[nodiscard]] std::optional<ClosedForm> form(const LinearMode& mode);  ///< |lambda|
  /// The form of |lambda| with the signs of sums that it assumes.
  [[nodiscard]] ClosedForm with_signs(const LinearMode& mode, ClosedForm form);
  /// All forms of a mode without damping whose square has one.
  [[nodiscard]] ModeForms forms(const LinearMode& mode);
  /// Of a damped one, which is an oscillation or creeps at two rates, where lambda = 0 at one beside rest.
  [[nodiscard]] std::vector<ModeForms> damped_forms(const LinearMode& mode);

 private:
  [[nodiscard]] std::optional<ClosedForm> formula(const Expression& e) const;
  [[nodiscard]] bool oscillates(const LinearMode& mode) const;
  [[nodiscard]] bool is_true(const LinearMode& mode) const;
  [[nodiscard]] Trial claims(const LinearMode& mode) const;
  [[nodiscard]] Trial claims_of_place() const;
  void add_signs_of_place(ExactMode& form);
  void add_signs_of_place(ClosedForm& form);
  [[nodiscard]] std::vector<std::string> needed(const LinearMode& mode,
                                                const std::vector<Expression>& positive);
  void take_root_as_written(const Surd& square, ModeForms& result);
  void add_shape(const LinearMode& mode, ModeForms& result);
  [[nodiscard]] std::optional<ModeForms> swinging(const Expression& square, const Expression& decay);
  [[nodiscard]] std::optional<ModeForms> creeping(const Expression& decay);
  [[nodiscard]] std::optional<ModeForms> critically_damped(const Expression& stiffness,
                                                           const Expression& rate);
  [[nodiscard]] bool vanishes(const Expression& e, const Expression& size) const;
  [[nodiscard]] std::vector<Expression> characteristic_terms(std::size_t i, std::size_t j,
                                                             const Expression& lambda) const;
  [[nodiscard]] Expression root_of(const Polynomial& n);
  [[nodiscard]] Expression written(const Surd& x);
  [[nodiscard]] Expression root(const Surd& x);
  [[nodiscard]] std::optional<Expression> sum_of_roots(const Surd& x);
  [[nodiscard]] std::optional<ClosedForm> period(const Surd& square);
  [[nodiscard]] std::optional<ClosedForm> scaled_lambda(const Surd& lambda);
  [[nodiscard]] std::vector<Surd> whole_shape(const LinearMode& mode) const;
  [[nodiscard]] std::vector<Surd> scaled(std::vector<Surd> shape) const;
  [[nodiscard]] std::vector<ClosedForm> closed_forms(const std::vector<Surd>& shape);

  const LinearMotions& motions_;
  const ExactPlace& place_;
  const ExactValues& values_;
  Relations relations_;
  Graph& graph_;
  std::vector<Expression> given_;  ///< beside the parameters: momenta, and coordinates that no force decides
  AssumedSigns signs_;
  std::optional<std::vector<std::string>> signs_of_place_;  ///< without which there is no such place
  std::vector<LinearMode> modes_;
  std::vector<std::pair<Polynomial, Expression>> roots_;  ///< n and forms of sqrt(n)
};

}  // namespace qdot
