#include "core/steady/critical_value.hpp"

#include <cmath>

namespace qdot {

const char* name(BifurcationKind kind) {
  switch (kind) {
    case BifurcationKind::pitchfork:
      return "pitchfork";
    case BifurcationKind::saddle_node:
      return "saddle_node";
    case BifurcationKind::transcritical:
      return "transcritical";
    case BifurcationKind::hopf:
      return "hopf";
    case BifurcationKind::flutter:
      return "flutter";
    case BifurcationKind::unresolved:
      break;
  }
  return "unresolved";
}

bool same_place(const CriticalValue& a, const CriticalValue& b) {
  bool same = std::abs(a.value - b.value) <= a.error + b.error;
  for (std::size_t i = 0; i < a.y.size(); ++i)
    same = same && std::abs(a.y[i] - b.y[i]) <= a.errors[i] + b.errors[i];
  return same;
}

}  // namespace qdot
