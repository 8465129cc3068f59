#include "core/grading/slip_kind.hpp"

namespace qdot {

const char* name_of(Slip slip) {
  switch (slip) {
    case Slip::sign:
      return "sign";
    case Slip::factor:
      return "factor";
    case Slip::dropped_term:
      return "dropped_term";
    case Slip::whole_sign:
      return "whole_sign";
    case Slip::whole_factor:
      return "whole_factor";
    case Slip::exponent:
      return "exponent";
    case Slip::sine_and_cosine:
      return "sine_and_cosine";
    case Slip::argument:
      return "argument";
    case Slip::small_angles:
      return "small_angles";
    case Slip::gravity:
      return "gravity";
    case Slip::moment_of_inertia:
      return "moment_of_inertia";
  }
  return "";
}

}  // namespace qdot
