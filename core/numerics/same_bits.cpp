#include "core/numerics/same_bits.hpp"

#include <sleef.h>

namespace qdot {

double hypotenuse(double a, double b) { return Sleef_cinz_hypotd1_u05purec(a, b); }
double inverse_sinh(double x) { return Sleef_cinz_asinhd1_u10purec(x); }
double exponential(double x) { return Sleef_cinz_expd1_u10purec(x); }
double logarithm(double x) { return Sleef_cinz_logd1_u10purec(x); }

}  // namespace qdot

/// SUNDIALS chooses its steps with pow, the only function of libm's that it calls beside sqrt: the linker
/// gives it this one (core/CMakeLists.txt).
extern "C" double __wrap_pow(double base, double exponent);  // NOLINT: the linker's name
extern "C" double __wrap_pow(double base, double exponent) {
  return Sleef_cinz_powd1_u10purec(base, exponent);
}
