#pragma once
// The textbook systems on paper; a dot is 1 and two dots are 2 behind the letter.

#include <array>

#include "tests/support/hand_written.hpp"

namespace qdot::test {

Mechanics plane_pendulum(const Values& s);
Mechanics spherical_pendulum(const Values& s);
Mechanics kepler(const Values& s);
Mechanics driven_pivot(const Values& s);
Mechanics atwood(const Values& s);
Mechanics bead_on_hoop(const Values& s);
Mechanics foucault(const Values& s);
Mechanics triple_pendulum(const Values& s);  ///< accelerations and determinant are left to the equations
Mechanics damped_oscillator(const Values& s);
Mechanics magnetic_particle(const Values& s);

}  // namespace qdot::test
