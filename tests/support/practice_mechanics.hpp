#pragma once
// The practice problems on paper; Omega is W, a dot is 1 and two dots are 2 behind the letter.

#include "tests/support/hand_written.hpp"

namespace qdot::test {

Mechanics spring_pendulum(const Values& s);         ///< (1), (2), (5), (6)
Mechanics forced_spring_pendulum(const Values& s);  ///< (10) to (14) and the equations after them
Mechanics rolling_disk_platform(const Values& s);   ///< (17)
Mechanics cart_pendulum(const Values& s);           ///< (21), (22), with M for 2m
Mechanics rod_pendulum(const Values& s);            ///< (37), (38)
Mechanics rod_spring_pendulum(const Values& s);
Mechanics whirling_pendulum(const Values& s);
Mechanics orbiting_pendulum(const Values& s);
Mechanics free_spin_pendulum(const Values& s);  ///< (47) to (55)
Mechanics compass_walker(const Values& s);
Mechanics rotating_l_bar(const Values& s);  ///< (61) to (63), corrected

}  // namespace qdot::test
