#pragma once
// One value of a parameter at which equilibria appear, vanish or meet.

#include <vector>

namespace qdot {

enum class BifurcationKind { pitchfork, saddle_node, transcritical };
[[nodiscard]] const char* name(BifurcationKind kind);

struct CriticalValue {
  BifurcationKind kind{};
  double value{};  ///< of the parameter
  double error{};
  std::vector<double> y, errors;  ///< (q, q') there
  /// False: round-off leaves a cluster instead of one proven point; the kind is what the numbers of
  /// equilibria beside it say.
  bool proven{true};
};

}  // namespace qdot
