#pragma once
// Power series in time with 113-bit or 64-bit coefficients, for references: equations are written once with
// ordinary operators on Series, which records them, and the recording then gives the coefficients order by
// order. Shares nothing with the program: neither expressions, tape, recurrences nor steps.
//
//   (uv)_k = sum_j u_j v_{k-j},   (u/v)_k = (u_k - sum_{j<k} (u/v)_j v_{k-j}) / v_0,
//   k sin(u)_k = sum_j j u_j cos(u)_{k-j},   k exp(u)_k = sum_j j u_j exp(u)_{k-j}
// Source: Griewank, Walther, Evaluating Derivatives, 2nd ed., 13.2.

#include <type_traits>
#include <vector>

namespace qdot::test {

/// IEEE binary128: 34 decimal digits.
using Quad = __float128;
/// The processor's own 64 bits: 19 digits, forty times as fast, and the same range.
using Long = long double;

template <typename Number>
class Recording;

/// One quantity of a recording.
template <typename Number>
struct Series {
  Recording<Number>* recording{};
  std::size_t place{};
};

template <typename Number>
class Recording {
 public:
  explicit Recording(unsigned order) : order_(order) {}
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  [[nodiscard]] unsigned order() const { return order_; }
  /// A quantity whose coefficients are set from outside: time and the state.
  Series<Number> input();
  [[nodiscard]] Number* coefficients(Series<Number> s) { return rows_.data() + s.place * (order_ + 1); }
  /// Coefficient k of everything recorded, from those up to k of the inputs.
  void advance(unsigned k);

  enum class Kind { input, sum, difference, multiple, shifted, product, quotient, sine, cosine, exponential };
  Series<Number> record(Kind kind, Series<Number> a, Series<Number> b, Number c);

 private:
  struct Step {
    Kind kind;
    std::size_t a, b;
    Number c;
  };
  [[nodiscard]] Number* row(std::size_t place) { return rows_.data() + place * (order_ + 1); }
  [[nodiscard]] Number coefficient(const Step& step, const Number* out, unsigned k);

  unsigned order_;
  std::vector<Step> steps_;
  std::vector<Number> rows_;
};

template <typename Number>
Series<Number> operator+(Series<Number> a, Series<Number> b);
template <typename Number>
Series<Number> operator-(Series<Number> a, Series<Number> b);
template <typename Number>
Series<Number> operator*(Series<Number> a, Series<Number> b);
template <typename Number>
Series<Number> operator/(Series<Number> a, Series<Number> b);
template <typename Number>
Series<Number> operator*(std::type_identity_t<Number> c, Series<Number> a);
template <typename Number>
Series<Number> operator+(std::type_identity_t<Number> c, Series<Number> a);
template <typename Number>
Series<Number> operator-(std::type_identity_t<Number> c, Series<Number> a) {
  return c + Number(-1) * a;
}
template <typename Number>
Series<Number> operator-(Series<Number> a, std::type_identity_t<Number> c) {
  return -c + a;
}
template <typename Number>
Series<Number> operator-(Series<Number> a) {
  return Number(-1) * a;
}
template <typename Number>
Series<Number> squared(Series<Number> a) {
  return a * a;
}
template <typename Number>
struct SineAndCosine {
  Series<Number> sine, cosine;
};
template <typename Number>
SineAndCosine<Number> sine_and_cosine(Series<Number> a);
template <typename Number>
Series<Number> sin(Series<Number> a) {
  return sine_and_cosine(a).sine;
}
template <typename Number>
Series<Number> cos(Series<Number> a) {
  return sine_and_cosine(a).cosine;
}
template <typename Number>
Series<Number> exp(Series<Number> a);

}  // namespace qdot::test
