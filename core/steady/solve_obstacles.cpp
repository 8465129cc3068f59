#include "core/steady/solve_obstacles.hpp"

#include "core/steady/search_region.hpp"

namespace qdot {

std::string sentence(const Candidates& found, const std::string& u, const std::string& position) {
  const std::string at = position.empty() ? "any place" : position;
  const std::string held = position.empty() ? "the system" : position;
  switch (found.obstacle) {
    case Obstacle::none:
      break;
    case Obstacle::not_in_balance:
      return found.name + " is not in balance at " + at + ", whatever " + u + " is.";
    case Obstacle::off_surface:
      return "The constraint '" + found.name + "' does not hold at " + at + ", whatever " + u + " is.";
    case Obstacle::dependent:
      return "The constraints depend on each other at " + at +
             ", so that they do not tell which forces balance.";
    case Obstacle::does_not_matter:
      return "Every value does: " + u + " does not matter at " + at + ".";
    case Obstacle::undefined:
      return "The forces have no single finite value at " + at +
             ". Where a distance in them is 0 there, whole intervals of " + u + " may hold it.";
    case Obstacle::no_finite_value:
      return "No finite " + u + " holds " + held + ": to within rounding it is a position that " + u +
             " approaches as it grows without bound.";
    case Obstacle::no_real_value:
      return "No real " + u + " holds " + held + ".";
    case Obstacle::negative_square:
      return "No real " + u + " holds " + held + ": " + u + "^2 would have to be " +
             short_number(found.number, 6) + ".";
    case Obstacle::none_in_domain:
      return "No " + u + " in its domain holds " + held + ".";
    case Obstacle::not_decided:
      return "The forces are too small, or vanish too often, to tell which " + u + " hold " + held + ".";
    case Obstacle::may_end:
      return "The forces may have values for a part of all " + u +
             " only, and vanish where that ends: which " + u + " hold " + held + " was not told.";
    case Obstacle::at_kink:
      return "An abs() or a sign() in the forces has its kink at " + at + ", or one that moves with " + u +
             ": forces have no single value there, and whole intervals of " + u + " may hold it.";
    case Obstacle::no_common_value:
      return "No single value of " + u + " balances all forces at " + at + ".";
    case Obstacle::at_pole:
      return "No real " + u + " holds " + held + ": at " + u + " = " + short_number(found.number, 6) +
             ", where the forces would balance, what they divide by is zero, too.";
    case Obstacle::outside_domain:
      return u + " would have to be " + short_number(found.number, 6) + ", which is outside its domain.";
    case Obstacle::impossible_body:
      return u + " would have to be " + short_number(found.number, 6) + ", with which " + found.name +
             ": that is no body.";
  }
  return "";
}

}  // namespace qdot
