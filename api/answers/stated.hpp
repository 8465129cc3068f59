#pragma once
// A number and the bound of its error, as an answer states them: whoever reads both knows that the true
// number is no farther than the error from what is written. So the error covers what `digits`, conversions
// and the writing of decimals round away - a reader may take the text for a double or for the decimal that it
// is - and it is itself rounded up.

#include <complex>

#include "api/json/json.hpp"
#include "api/json/writer.hpp"
#include "core/numerics/interval.hpp"
#include "core/numerics/real.hpp"

namespace qdot::api {

struct Stated {
  double value{};
  double error{};  ///< |value - the true number| is at most this; not finite where nothing is known

  /// A number near the true one, which is in `enclosure`.
  [[nodiscard]] static Stated within(double value, const Interval& enclosure);
  [[nodiscard]] Interval enclosure() const;
  /// Where nothing but the request decides it, so that it is the double beside what was typed: pi/2 is none.
  [[nodiscard]] Stated as_typed(const Real& typed) const;
};

/// pi is between two doubles.
[[nodiscard]] Interval enclosed_pi();

/// The error of the number as it is written with so many digits; null where nothing is known.
[[nodiscard]] Json stated_error(const Stated& number, int digits);

/// Of a complex number: its distance in the plane.
[[nodiscard]] Json stated_error(const std::complex<double>& value, double error, int digits);

/// A bound that stands by itself, rounded up to so many digits.
[[nodiscard]] Json stated_bound(double bound, int digits);

}  // namespace qdot::api
