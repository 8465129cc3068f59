#pragma once
// Why the kind of a critical value is not decided (core/steady/critical_value.hpp), in words.

namespace qdot {

inline constexpr const char* degenerate_crossing =
    "Curves of equilibria cross here, but a derivative that decides how is zero to within its error.";
inline constexpr const char* degenerate_fold =
    "More than one derivative along the curve of equilibria vanishes here: it folds, or passes on without a fold.";
inline constexpr const char* degenerate_growth =
    "Several pairs of eigenvalues cross the imaginary axis at once, or one only touches it: oscillations may begin to "
    "grow here.";
inline constexpr const char* several_events =
    "Within the error a curve of equilibria folds more than once, or folds and crosses another, or only comes "
    "near to that: a degenerate point, or several close together.";
inline constexpr const char* change_of_stability =
    "The stability along a curve of equilibria changes here; in which way other equilibria take part is not "
    "proven.";
inline constexpr const char* growth_along_curve =
    "Found where the stability of an equilibrium that stays in its place changes: a pair of eigenvalues leaves the "
    "imaginary axis between the bounds of the error, and that no other does near there is not proven.";
inline constexpr const char* more_growth =
    "Oscillations about an equilibrium may begin to grow at more values than are listed: the search for them "
    "was given up, or rounding hides whether they do.";
inline constexpr const char* more_poles =
    "Curves of equilibria may run into places where the forces have no value at more values than are listed: the "
    "search for them was given up, or rounding hides whether they do.";
inline constexpr const char* growth_not_found =
    "The stability of an equilibrium changes where no equilibrium meets another: oscillations about it begin "
    "to grow, and the value at which they do was not found. The branches show between which it is.";
inline constexpr const char* curves_not_told_apart =
    "Curves of equilibria come so near to each other that rounding hides which goes on as which: a branch that "
    "changes its stability, begins or ends where no critical value is goes over from one of them to another there.";

}  // namespace qdot
