#include "core/steady/critical_value.hpp"

namespace qdot {

const char* name(BifurcationKind kind) {
  switch (kind) {
    case BifurcationKind::pitchfork:
      return "pitchfork";
    case BifurcationKind::saddle_node:
      return "saddle_node";
    case BifurcationKind::transcritical:
      return "transcritical";
    case BifurcationKind::unresolved:
      break;
  }
  return "unresolved";
}

}  // namespace qdot
