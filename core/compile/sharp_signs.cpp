#include "core/compile/sharp_signs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/taylor_enclosure.hpp"

namespace qdot {
namespace {

constexpr double of_doubles = 64 * std::numeric_limits<double>::epsilon();  ///< of the coefficients
/// Times what twice the digits leave in doubt: a shorter piece shows no more.
constexpr double small_beside_digits = 64;
constexpr int most_looks_along = 400;
constexpr int halvings = 52;
constexpr double closer = 0x1p-8;  ///< of a piece that has a zero, on each side of where that is
constexpr std::size_t last_term = quadrature_order;

std::vector<FineSeries> constants_of(std::span<const Ball> parameters) {
  std::vector<FineSeries> constants;
  for (const Ball& p : parameters) constants.push_back(FineSeries::constant(p));
  return constants;
}

/// Along the way about `centre`, over all of the piece.
FineSeries along(const FunctionAlong& g, TapeEvaluator<FineSeries>& function, double centre,
                 const Interval& piece) {
  const FineSeries s = FineSeries::variable(Ball(centre), piece);
  std::vector<FineSeries> y;
  for (std::size_t i = 0; i < g.rows.size(); i += g.terms) {
    FineSeries sum = FineSeries::constant(Ball(g.rows[i + g.terms - 1]));
    for (std::size_t k = g.terms - 1; k-- > 0;) {
      const bool is_known = k == 0 && !g.start.empty();
      sum = sum * s + FineSeries::constant(is_known ? g.start[i / g.terms] : Ball(g.rows[i + k]));
    }
    y.push_back(sum);
  }
  function.set_time(FineSeries::constant(Ball(g.t)) + s);
  FineSeries value;
  function(y, {&value, 1});
  return value;
}

class SignsAlong {
 public:
  /// Of its derivative that often: not at all, or once.
  SignsAlong(const FunctionAlong& g, double shortest, std::size_t derived)
      : g_(g), shortest_(shortest), derived_(derived), function_(g.function, constants_of(g.parameters)) {}

  void explore(double from, double to) {
    const double h = to - from;
    const Series series = series_on(from, to);
    const bool has_kink = derived_ == 0 && std::isinf(series.in_digits) && series.has_value;
    if (series.sign != 0) return add(from, to, series.sign);
    const bool is_told = series.size > small_beside_digits * series.in_digits,
               is_told_first = std::abs(series.c[0]) > small_beside_digits * series.first_in_digits;
    const bool is_hopeless = !has_kink && !is_told && !is_told_first;
    if (h <= shortest_ || ++looks_ > most_looks_along || is_hopeless) return add(from, to, sign_of(series));
    if (!std::isfinite(series.off)) return halve(from, to);
    double told = from;
    for (const SignPiece& piece : signs_of(series.c, series.off)) {
      const double begin = from + piece.from * h, end = piece.to == 1 ? to : from + piece.to * h;
      if (begin > told)
        close_in(told, begin, zero_of(series.c, (told - from) / h, piece.from, piece.sign) * h + from);
      told = end;
      if (piece.sign != 0)
        add(begin, end, piece.sign);
      else if (piece.to - piece.from < 0.5)
        explore(begin, end);
      else
        halve(begin, end);
    }
  }

  [[nodiscard]] std::vector<SignPiece> pieces() && { return std::move(pieces_); }

 private:
  /// In the unit of the piece.
  struct Series {
    std::vector<double> c;
    double size{}, in_digits{}, off{};
    double first_in_digits{};  ///< of the first coefficient
    bool has_value{};          ///< where the piece begins
    int sign{};                ///< that all values of the piece have, by intervals alone
  };

  Series series_on(double from, double to) {
    const FineSeries value = along(g_, function_, from, {from, to});
    Series series;
    double power = 1;
    for (std::size_t k = derived_; k < last_term && k < value.terms; ++k, power *= to - from) {
      const double factor = factor_of(k) * power;
      series.c.push_back(value.at[k].value() * factor);
      series.size += std::abs(series.c.back());
      series.in_digits += value.at[k].radius * factor;
    }
    if (series.c.empty()) series.c.push_back(0);
    series.has_value = value.at[0].is_finite();
    if (value.terms > derived_) {
      const Interval& all = value.over[derived_];
      series.sign = (all.lower > 0) - (all.upper < 0);
      series.first_in_digits = value.at[derived_].radius;
    }
    const double rest =
        value.terms > last_term ? value.over[last_term].magnitude() * factor_of(last_term) * power : 0;
    series.off = series.in_digits + rest + of_doubles * series.size;
    return series;
  }

  /// What a derivative makes of s^k.
  [[nodiscard]] double factor_of(std::size_t k) const { return derived_ == 0 ? 1 : static_cast<double>(k); }

  static int sign_of(const Series& series) {
    double others = series.off;
    for (std::size_t k = 1; k < series.c.size(); ++k) others += std::abs(series.c[k]);
    if (!(std::abs(series.c[0]) > others)) return 0;
    return series.c[0] > 0 ? 1 : -1;
  }

  /// Where coefficients come to have this sign, between two places.
  static double zero_of(std::span<const double> c, double from, double to, int sign) {
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (from + to);
      double sum = 0;
      for (std::size_t k = c.size(); k-- > 0;) sum = sum * middle + c[k];
      (sign * sum > 0 ? to : from) = middle;
    }
    return to;
  }

  /// On one zero, which is near to `place`.
  void close_in(double from, double to, double place) {
    const double beside = closer * (to - from);
    const double begin = std::max(from, place - beside), end = std::min(to, place + beside);
    if (begin > from) explore(from, begin);
    if (end > begin) explore(begin, end);
    if (to > end) explore(end, to);
  }

  void halve(double from, double to) {
    const double middle = from + (to - from) / 2;
    explore(from, middle);
    explore(middle, to);
  }

  void add(double from, double to, int sign) { pieces_.push_back({from, to, sign}); }

  const FunctionAlong& g_;
  double shortest_;
  std::size_t derived_;
  TapeEvaluator<FineSeries> function_;
  std::vector<SignPiece> pieces_;
  int looks_{};
};

}  // namespace

std::vector<Ball> sharp_series(const FunctionAlong& g) {
  TapeEvaluator<FineSeries> function(g.function, constants_of(g.parameters));
  const FineSeries value = along(g, function, 0, 0);
  std::vector<Ball> series(value.at.begin(), value.at.end());
  for (std::size_t k = value.terms; k < series.size(); ++k) series[k] = Ball();
  return series;
}

std::vector<SignPiece> sharp_signs(const FunctionAlong& g, double from, double to, double shortest) {
  SignsAlong signs(g, shortest, 0);
  signs.explore(from, to);
  return std::move(signs).pieces();
}

std::vector<SignPiece> sharp_slopes(const FunctionAlong& g, double from, double to, double shortest) {
  SignsAlong slopes(g, shortest, 1);
  slopes.explore(from, to);
  return std::move(slopes).pieces();
}

}  // namespace qdot
