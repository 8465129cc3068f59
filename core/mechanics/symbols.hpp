#pragma once
// The symbols that the expressions of a scene are made of.

#include <string>
#include <vector>

#include "core/expr/calculus.hpp"

namespace qdot {

/// A vector's 2 or 3 components in the inertial frame.
using Vector = std::vector<Expression>;

/// The symbols of a scene: q, q_dot, q_ddot in the order of its coordinates, the time t, and so on.
/// Inputs and held lengths vary in time too:
/// x[i], x_dot[i] and x_ddot[i] stand for them and their derivatives.
struct Symbols {
  struct Varying {
    std::vector<Expression> value, rate, second_rate;
  };
  Varying coordinates;
  Expression t;
  Varying inputs;
  Varying held;
  std::vector<Expression> parameters;
  std::vector<Expression> multipliers;  ///< of the constraints, in their order

  /// (x, x') for everything that varies along a motion, the time with rate 1: the chain rule's d/dt.
  [[nodiscard]] std::vector<Replacement> rates() const;
};

/// What formulas call the momentum of each coordinate: p_<coordinate>, or momentum_<coordinate> where the
/// scene calls something else so.
[[nodiscard]] std::vector<std::string> momentum_names(const Symbols& symbols);

}  // namespace qdot
