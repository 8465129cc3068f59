#pragma once
// What the program itself needs of libm's functions, with the same bits on every x86-64 processor: glibc's
// own take other roads where there is AVX2 or FMA. Those that expressions call: core/numerics/function.hpp.

namespace qdot {

/// sqrt(a^2 + b^2) to a unit in the last place, without overflow on the way.
[[nodiscard]] double hypotenuse(double a, double b);
[[nodiscard]] double inverse_sinh(double x);
[[nodiscard]] double exponential(double x);
[[nodiscard]] double logarithm(double x);

}  // namespace qdot
