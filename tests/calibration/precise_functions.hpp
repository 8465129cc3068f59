#pragma once
// Elementary functions of the numbers that references are computed in.

#include <quadmath.h>

#include <cmath>

#include "tests/calibration/quad_series.hpp"

namespace qdot::test {

inline Quad sine(Quad x) { return sinq(x); }
inline Long sine(Long x) { return std::sin(x); }
inline Quad cosine(Quad x) { return cosq(x); }
inline Long cosine(Long x) { return std::cos(x); }
inline Quad arc_cosine(Quad x) { return acosq(x); }
inline Long arc_cosine(Long x) { return std::acos(x); }
inline Quad exponential(Quad x) { return expq(x); }
inline Long exponential(Long x) { return std::exp(x); }
inline Quad logarithm(Quad x) { return logq(x); }
inline Long logarithm(Long x) { return std::log(x); }
inline Quad rounded_up(Quad x) { return ceilq(x); }
inline Long rounded_up(Long x) { return std::ceil(x); }
inline Quad size_of(Quad x) { return fabsq(x); }
inline Long size_of(Long x) { return std::fabs(x); }

}  // namespace qdot::test
