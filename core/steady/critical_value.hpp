#pragma once
// One value of a parameter at which equilibria appear, vanish or meet, or oscillations about one begin to
// grow.

#include <string>
#include <vector>

namespace qdot {

/// Hopf: a pair of eigenvalues crosses the imaginary axis; flutter: two pairs meet on it and leave it.
/// Unresolved: a place where equilibria may appear, vanish or meet, in none of these ways for certain.
enum class BifurcationKind { pitchfork, saddle_node, transcritical, hopf, flutter, unresolved };
[[nodiscard]] inline bool is_of_oscillations(BifurcationKind kind) {
  return kind == BifurcationKind::hopf || kind == BifurcationKind::flutter;
}
[[nodiscard]] const char* name(BifurcationKind kind);

struct CriticalValue {
  BifurcationKind kind{};
  double value{};  ///< of the parameter
  double error{};
  std::vector<double> y, errors;  ///< (q, q') there
  /// False: round-off leaves a cluster instead of one proven point, or the kind is what the numbers of
  /// equilibria beside it say.
  bool proven{true};
  double omega{}, omega_error{};  ///< of the oscillations that begin to grow; 0 where it is not known
  std::string reason;             ///< why the kind is unresolved, a sentence
};

/// To within their errors.
[[nodiscard]] bool same_place(const CriticalValue& a, const CriticalValue& b);

}  // namespace qdot
