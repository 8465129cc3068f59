#pragma once
// Power series in time with 113-bit coefficients, for references: equations are written once with ordinary
// operators on Series, which records them, and the recording then gives the coefficients order by order.
// Shares nothing with the program: neither expressions, tape, recurrences nor steps.
//
//   (uv)_k = sum_j u_j v_{k-j},   (u/v)_k = (u_k - sum_{j<k} (u/v)_j v_{k-j}) / v_0,
//   k sin(u)_k = sum_j j u_j cos(u)_{k-j},   k exp(u)_k = sum_j j u_j exp(u)_{k-j}
// Source: Griewank, Walther, Evaluating Derivatives, 2nd ed., 13.2.

#include <span>
#include <vector>

namespace qdot::test {

/// IEEE binary128: 34 decimal digits.
using Quad = __float128;

class Recording;

/// One quantity of a recording.
struct Series {
  Recording* recording{};
  std::size_t place{};
};

class Recording {
 public:
  explicit Recording(unsigned order) : order_(order) {}
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  [[nodiscard]] unsigned order() const { return order_; }
  /// A quantity whose coefficients are set from outside: time and the state.
  Series input();
  [[nodiscard]] Quad* coefficients(Series s) { return rows_.data() + s.place * (order_ + 1); }
  /// Coefficient k of everything recorded, from those up to k of the inputs.
  void advance(unsigned k);

  enum class Kind { input, sum, difference, multiple, shifted, product, quotient, sine, cosine, exponential };
  Series record(Kind kind, Series a, Series b, Quad c);

 private:
  struct Step {
    Kind kind;
    std::size_t a, b;
    Quad c;
  };
  [[nodiscard]] Quad* row(std::size_t place) { return rows_.data() + place * (order_ + 1); }
  [[nodiscard]] Quad coefficient(const Step& step, const Quad* out, unsigned k);

  unsigned order_;
  std::vector<Step> steps_;
  std::vector<Quad> rows_;
};

Series operator+(Series a, Series b);
Series operator-(Series a, Series b);
Series operator*(Series a, Series b);
Series operator/(Series a, Series b);
Series operator*(Quad c, Series a);
Series operator+(Quad c, Series a);
inline Series operator-(Quad c, Series a) { return c + Quad(-1) * a; }
inline Series operator-(Series a, Quad c) { return -c + a; }
inline Series operator-(Series a) { return Quad(-1) * a; }
inline Series squared(Series a) { return a * a; }
struct SineAndCosine {
  Series sine, cosine;
};
SineAndCosine sine_and_cosine(Series a);
inline Series sin(Series a) { return sine_and_cosine(a).sine; }
inline Series cos(Series a) { return sine_and_cosine(a).cosine; }
Series exp(Series a);

}  // namespace qdot::test
