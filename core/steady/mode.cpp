#include "core/steady/mode.hpp"

namespace qdot {

const char* name(ModeKind kind) {
  switch (kind) {
    case ModeKind::rigid:
      return "rigid";
    case ModeKind::neutral:
      return "neutral";
    case ModeKind::growth:
      return "growth";
    case ModeKind::decay:
      return "decay";
    case ModeKind::oscillation:
      break;
  }
  return "oscillation";
}

}  // namespace qdot
