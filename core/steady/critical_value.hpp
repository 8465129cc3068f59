#pragma once
// One value of a parameter at which equilibria appear, vanish or meet.

#include <string>
#include <vector>

namespace qdot {

/// Unresolved: a place where equilibria may appear, vanish or meet, in none of these ways for certain.
enum class BifurcationKind { pitchfork, saddle_node, transcritical, unresolved };
[[nodiscard]] const char* name(BifurcationKind kind);

struct CriticalValue {
  BifurcationKind kind{};
  double value{};  ///< of the parameter
  double error{};
  std::vector<double> y, errors;  ///< (q, q') there
  /// False: round-off leaves a cluster instead of one proven point, or the kind is what the numbers of
  /// equilibria beside it say.
  bool proven{true};
  std::string reason;  ///< why the kind is unresolved, a sentence
};

/// To within their errors.
[[nodiscard]] bool same_place(const CriticalValue& a, const CriticalValue& b);

}  // namespace qdot
