#pragma once
// What a motion needs to know of the kinks |u_k| and sign(u_k) in its equations: where they are, and the
// motion on their sides and on themselves.
//
// The functions take the model's parameters and the sides s_k = +-1 behind them (any number where the motion
// stays on the kink), then t and y = (q, q').

#include <memory>
#include <string>
#include <vector>

#include "core/dynamics/motion_functions.hpp"

namespace qdot {

struct Kinks {
  std::vector<std::string> names;  ///< u_k as text
  /// For each kink u, du/dt, du/dq_i, du/dq_i'; u_k depends on no sides but those of kinks before it.
  CompiledFunction geometry;

  [[nodiscard]] std::size_t size() const { return names.size(); }
};

/// Of the equations of motion, always in the same order; null where there are none. Throws
/// Error(not_applicable) where the Lagrangian jumps, which is no kink (core/mechanics/jumps.hpp).
[[nodiscard]] std::unique_ptr<const Kinks> kinks_of(const Model& model, const InputTexts& inputs);

/// The motion that stays on some of the kinks.
struct KinkedMotion {
  CompiledFunction accelerations;
  std::vector<std::shared_ptr<const CompiledFunction>> arguments;  ///< u_k, one output each
  /// s_k of those on which it stays, one output each; null for the others.
  std::vector<std::shared_ptr<const CompiledFunction>> sides;
  /// 1 - s_k^2 of the same: the motion leaves where that falls below 0.
  std::vector<std::shared_ptr<const CompiledFunction>> holds;
};

/// Null where a motion cannot stay there, whatever the state.
[[nodiscard]] std::shared_ptr<const KinkedMotion> kinked_motion(const Model& model, const InputTexts& inputs,
                                                                const Staying& staying);

}  // namespace qdot
