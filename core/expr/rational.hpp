#pragma once
// What doubles make of GMP's rationals: the nearest one, and what it leaves out.

#include <gmpxx.h>

#include "core/numerics/real.hpp"

namespace qdot {

/// Bits of |n|; 1 for 0.
[[nodiscard]] std::size_t bits_of(const mpz_class& n);

/// A finite double, exactly.
[[nodiscard]] mpq_class rational(double value);

/// The nearest double, infinite beyond their range; halfway between two, the even one.
[[nodiscard]] double nearest(const mpq_class& x);

/// The nearest double, and what it leaves out.
[[nodiscard]] Real rounded(const mpq_class& x);

}  // namespace qdot
