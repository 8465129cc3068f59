#pragma once
// Why the error of a motion is not known, or not what was wanted, in words for who asked.

#include <string>

namespace qdot::accuracy_reasons {

inline constexpr const char* work_spent =
    "The evaluations that a request may take were spent on the way to the error asked for; this is the best "
    "found.";
inline constexpr const char* out_of_reach =
    "The error asked for is out of reach for this motion in double precision; this is the best found.";
inline constexpr const char* may_not_stop =
    "By its error, or as its condition is rounded, the motion may stop at another time or go on: that time has no "
    "error.";
inline constexpr const char* may_reach_end =
    "By the error of the time at which it stops, the motion may come to its end before it.";
inline std::string may_fail_before(const std::string& conditions) {
  return "Within the error of the time at which the motion stops these conditions may fail, too, and before the one "
         "that is told: " +
         conditions + ".";
}
inline constexpr const char* may_go_otherwise =
    ": it may go on otherwise from there, and the errors stated are of both ways.";
inline constexpr const char* may_go_anywhere =
    ": it may go on in several ways from there, of which this is one, and no error of it is known.";
inline constexpr const char* not_bounded =
    "The error was measured, but not every step has a bound of what it may hide between the places that were "
    "looked at.";
inline constexpr const char* forces_are_rounding =
    "Forces are small differences of numbers so large that their rounding has no bound: nothing is known of them where "
    "that is so.";
inline constexpr const char* went_on =
    "The second computation went on beyond the end of this one: that it stops here is no more certain than its "
    "error allows.";

inline std::string contradiction(const std::string& conserved) {
  return "The answer contradicts itself: " + conserved +
         " is conserved, and changes by more than the errors stated of coordinates and velocities can explain. Do "
         "not rely on them.";
}

}  // namespace qdot::accuracy_reasons
