#include "tests/support/hand_written.hpp"

#include <map>

#include "tests/support/practice_mechanics.hpp"
#include "tests/support/textbook_mechanics.hpp"

namespace qdot::test {

Mechanics mechanics_of(const std::string& system, const Values& state) {
  static const std::map<std::string, Mechanics (*)(const Values&)> formulas{
      {"spring_pendulum", spring_pendulum},
      {"forced_spring_pendulum", forced_spring_pendulum},
      {"rolling_disk_platform", rolling_disk_platform},
      {"cart_pendulum", cart_pendulum},
      {"rod_pendulum", rod_pendulum},
      {"rod_spring_pendulum", rod_spring_pendulum},
      {"whirling_pendulum", whirling_pendulum},
      {"orbiting_pendulum", orbiting_pendulum},
      {"free_spin_pendulum", free_spin_pendulum},
      {"compass_walker", compass_walker},
      {"rotating_l_bar", rotating_l_bar},
      {"plane_pendulum", plane_pendulum},
      {"spherical_pendulum", spherical_pendulum},
      {"kepler", kepler},
      {"driven_pivot", driven_pivot},
      {"atwood", atwood},
      {"bead_on_hoop", bead_on_hoop},
      {"foucault", foucault},
      {"triple_pendulum", triple_pendulum},
      {"damped_oscillator", damped_oscillator},
      {"magnetic_particle", magnetic_particle},
  };
  return formulas.at(system)(state);
}

}  // namespace qdot::test
