#pragma once
// What decides whether a motion in an even potential comes from x0 to -x0. With u = x^2, or u = cos x,
//
//   h - V = (u - u0) Q(u),
//
// and Q keeps its sign from u0 to the u of x = 0, of which V(x0) > V(0) tells at the one end and the force at
// x0 at the other. Between them a hill may rise all the same, as between the wells of a x^2 - b x^4 + d x^6:
// a quadratic Q has none where its discriminant is negative, or where it rises inwards from one of the ends.
// Of more powers of x^2 there is none where all coefficients of Q have the sign.

#include "core/closed/assumed_signs.hpp"
#include "core/closed/elementary_period.hpp"

namespace qdot {

/// What makes sure that there is no hill is assumed, whether or not one is found.
void ask_about_hills(const QuadratureProblem& problem, const Expression& x0, const ExactValues& values,
                     AssumedSigns& signs);

}  // namespace qdot
