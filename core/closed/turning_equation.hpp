#pragma once
// The equation of turning points as the energy integral of one coordinate gives it, in symbols and with the
// initial state put in:
//
//   1/2 A(x; p) x'^2 + U(x; p) = h,   p_c the momenta of the ignored coordinates

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/closed/closed_form.hpp"
#include "core/closed/exact_values.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/turning/turning_points.hpp"

namespace qdot {

struct TurningEquation {
  TurningEquation(const Dynamics& dynamics, const Reals& parameters, const WrittenTexts& written,
                  const TurningPoints& turning_points, const std::string& energy_name);

  /// False where the initial state is known by decimals only. A number with a dimension would leave formulas
  /// whose terms do not fit together.
  bool take_start();

  /// Takes of the start x0 alone, known exactly, where x rests there: sets `energy` to U(x0; p). Between this
  /// and leave_start() formulas speak of p.
  bool take_place_of_start();
  void leave_start();

  /// What formulas may speak of and the start does not give.
  [[nodiscard]] std::vector<Expression> free_constants() const;

  /// U(x; p) - U(x0; p) - 1/2 A(x0) x0'^2 with p of the initial state; sets `momenta` and `energy`. After
  /// take_start().
  [[nodiscard]] Expression with_start();

  /// x where the motion begins; after take_start().
  [[nodiscard]] std::optional<Expression> start() const;

  /// Assumes what was put in for the initial state, `started`, and the signs of constants in it. It may speak
  /// of `allowed`, too.
  [[nodiscard]] std::optional<ClosedForm> formula(const Expression& e, const Relations& relations,
                                                  const std::vector<std::string>& started,
                                                  std::span<const Expression> allowed = {},
                                                  std::size_t longest = longest_closed_form) const;

  std::shared_ptr<const Statics> statics;
  std::shared_ptr<Graph> graph;
  ExactValues values;
  const TurningPoints& found;
  Expression x;
  Expression potential, inertia;      ///< U(x; p) and A(x; p)
  std::vector<Expression> constants;  ///< p_c and h as symbols, which have values
  Expression energy_symbol;           ///< h
  bool by_constants{};                ///< h is the name of no parameter
  std::vector<std::string> assumed;   ///< "theta(0) = pi/6"
  std::vector<Replacement> momenta;   ///< p_c, by the parameters
  std::optional<Expression> energy;   ///< h, by the parameters

 private:
  void take_constants(const std::string& energy_name);
  bool take_initial_state();
  /// A value with a unit of its own would leave formulas whose terms do not fit together.
  [[nodiscard]] bool is_without_units(std::size_t i, const Expression& q, const Expression& rate) const;
  void take_assumption(std::size_t i, const Expression& q, const Expression& rate);
  [[nodiscard]] Expression at_start(const Expression& e) const;
  /// The model's expressions know nothing of parameters that are zero.
  [[nodiscard]] Expression without_zeros(const Expression& e) const;

  std::vector<Replacement> start_;  ///< (q0, q0'), of all coordinates and velocities
};

}  // namespace qdot
