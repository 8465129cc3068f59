#include "core/numerics/long_schur.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace qdot {
namespace {

using Index = Eigen::Index;

constexpr long double epsilon_of_80_bits = std::numeric_limits<long double>::epsilon();
/// Of Francis' steps, for each row.
constexpr Index most_steps = 40;
/// So many steps for one eigenvalue tell that the shifts go round in circles.
constexpr Index steps_between_other_shifts = 10;

/// H = I - tau v v^T with v_0 = 1 and H x = (beta, 0, 0, ...).
struct Reflection {
  std::vector<long double> v;
  long double tau = 0, beta;

  explicit Reflection(std::vector<long double> x) : v(std::move(x)), beta(v[0]) {
    long double rest = 0;
    for (std::size_t i = 1; i < v.size(); ++i) rest += v[i] * v[i];
    if (rest > 0) {
      const long double first = v[0], length = std::sqrt(first * first + rest);
      beta = first >= 0 ? -length : length;
      for (long double& entry : v) entry /= first - beta;
      tau = (beta - first) / beta;
    }
    v[0] = 1;
  }

  [[nodiscard]] Index size() const { return static_cast<Index>(v.size()); }
  [[nodiscard]] long double entry(Index i) const { return v[static_cast<std::size_t>(i)]; }
};

/// H A: rows from `row` on, in columns from `column` on.
void reflect_rows(LongMatrix& a, const Reflection& h, Index row, Index column) {
  for (Index j = column; j < a.cols(); ++j) {
    long double sum = 0;
    for (Index i = 0; i < h.size(); ++i) sum += h.entry(i) * a(row + i, j);
    for (Index i = 0; i < h.size(); ++i) a(row + i, j) -= h.tau * h.entry(i) * sum;
  }
}

/// A H: columns from `column` on, in the first `rows` rows.
void reflect_columns(LongMatrix& a, const Reflection& h, Index column, Index rows) {
  for (Index i = 0; i < rows; ++i) {
    long double sum = 0;
    for (Index j = 0; j < h.size(); ++j) sum += a(i, column + j) * h.entry(j);
    for (Index j = 0; j < h.size(); ++j) a(i, column + j) -= h.tau * sum * h.entry(j);
  }
}

/// A = Q T Q^T; T is upper triangular, with a block of two rows for each pair of eigenvalues that are
/// not real.
class RealSchur {
 public:
  explicit RealSchur(const LongMatrix& a) : t_(a), q_(LongMatrix::Identity(a.rows(), a.cols())) {
    reduce_to_hessenberg_form();
    for (Index j = 0; j < size(); ++j) {
      for (Index i = 0; i < std::min(size(), j + 2); ++i) norm_ += std::abs(t_(i, j));
    }
    converged_ = std::isfinite(norm_) && iterate();
  }

  [[nodiscard]] bool converged() const { return converged_; }
  [[nodiscard]] const LongMatrix& t() const { return t_; }
  [[nodiscard]] const LongMatrix& q() const { return q_; }

 private:
  [[nodiscard]] Index size() const { return t_.rows(); }

  void reduce_to_hessenberg_form() {
    for (Index k = 0; k + 2 < size(); ++k) {
      std::vector<long double> below;
      for (Index i = k + 1; i < size(); ++i) below.push_back(t_(i, k));
      const Reflection h(std::move(below));
      t_(k + 1, k) = h.beta;
      for (Index i = k + 2; i < size(); ++i) t_(i, k) = 0;
      reflect_rows(t_, h, k + 1, k + 1);
      reflect_columns(t_, h, k + 1, size());
      reflect_columns(q_, h, k + 1, size());
    }
  }

  /// Rows from `last` + 1 on have their final form.
  bool iterate() {
    Index steps = 0, steps_here = 0;
    for (Index last = size() - 1; last > 0;) {
      const Index first = start_of_block(last);
      if (first > 0) t_(first, first - 1) = 0;
      if (first + 1 >= last) {
        if (first < last) split(first);
        last = first - 1;
        steps_here = 0;
      } else {
        if (++steps > most_steps * size()) return false;
        step(first, last, shifts(last, ++steps_here % steps_between_other_shifts == 0));
      }
    }
    return true;
  }

  [[nodiscard]] Index start_of_block(Index last) const {
    const long double as_good_as_zero = norm_ * epsilon_of_80_bits * epsilon_of_80_bits;
    for (Index i = last; i > 0; --i) {
      const long double beside = epsilon_of_80_bits * (std::abs(t_(i - 1, i - 1)) + std::abs(t_(i, i)));
      if (std::abs(t_(i, i - 1)) <= std::max(beside, as_good_as_zero)) return i;
    }
    return 0;
  }

  /// A matrix (y, .; ., x) whose entries beside the diagonal have the product w: its eigenvalues are near
  /// those that come next.
  struct Shifts {
    long double x, y, w;
  };

  [[nodiscard]] Shifts shifts(Index last, bool others) const {
    const long double x = t_(last, last);
    if (!others) return {x, t_(last - 1, last - 1), t_(last, last - 1) * t_(last - 1, last)};
    const long double s = std::abs(t_(last, last - 1)) + std::abs(t_(last - 1, last - 2));
    return {x + 0.75L * s, x + 0.75L * s, -0.4375L * s * s};
  }

  /// The first column of (T - s1)(T - s2), from row `k` on.
  [[nodiscard]] std::vector<long double> first_column(Index k, const Shifts& shifts) const {
    const long double r = shifts.x - t_(k, k), s = shifts.y - t_(k, k);
    return {(r * s - shifts.w) / t_(k + 1, k) + t_(k, k + 1), t_(k + 1, k + 1) - t_(k, k) - r - s,
            t_(k + 2, k + 1)};
  }

  void step(Index first, Index last, const Shifts& shifts) {
    for (Index k = first; k < last; ++k) {
      std::vector<long double> x = first_column_or_bulge(k, first, last, shifts);
      const Reflection h(std::move(x));
      if (k > first) {
        t_(k, k - 1) = h.beta;
        for (Index i = 1; i < h.size(); ++i) t_(k + i, k - 1) = 0;
      }
      reflect_rows(t_, h, k, k);
      reflect_columns(t_, h, k, std::min(last, k + 3) + 1);
      reflect_columns(q_, h, k, size());
    }
  }

  [[nodiscard]] std::vector<long double> first_column_or_bulge(Index k, Index first, Index last,
                                                               const Shifts& shifts) const {
    if (k == first) return first_column(k, shifts);
    std::vector<long double> bulge;
    for (Index i = k; i <= std::min(last, k + 2); ++i) bulge.push_back(t_(i, k - 1));
    return bulge;
  }

  /// Two rows whose eigenvalues are real become triangular.
  void split(Index k) {
    const long double p = (t_(k, k) - t_(k + 1, k + 1)) / 2;
    const long double square = p * p + t_(k + 1, k) * t_(k, k + 1);
    if (!(square >= 0)) return;
    const long double above = p >= 0 ? p + std::sqrt(square) : p - std::sqrt(square), below = t_(k + 1, k);
    const long double length = std::sqrt(above * above + below * below);
    const long double c = above / length, s = below / length;
    for (Index j = 0; j < size(); ++j) {
      const long double x = t_(k, j), y = t_(k + 1, j);
      t_(k, j) = c * x + s * y;
      t_(k + 1, j) = c * y - s * x;
    }
    turn_columns(t_, k, c, s);
    turn_columns(q_, k, c, s);
    t_(k + 1, k) = 0;
  }

  static void turn_columns(LongMatrix& a, Index k, long double c, long double s) {
    for (Index i = 0; i < a.rows(); ++i) {
      const long double x = a(i, k), y = a(i, k + 1);
      a(i, k) = c * x + s * y;
      a(i, k + 1) = c * y - s * x;
    }
  }

  LongMatrix t_, q_;
  long double norm_ = 0;
  bool converged_ = false;
};

/// Two rows with the eigenvalues u +- iv become triangular, u + iv first.
void split_conjugates(LongSchur& schur, Index k) {
  const long double a = schur.t(k, k).real(), d = schur.t(k + 1, k + 1).real();
  const long double above = schur.t(k, k + 1).real(), below = schur.t(k + 1, k).real();
  const long double p = (a - d) / 2;
  const LongComplex value(d + p, std::sqrt(-(p * p + above * below)));
  const LongComplex first = value - d;
  const long double length = std::sqrt(std::norm(first) + below * below);
  schur.turn(k, first / length, below / length);
  schur.t(k, k) = value;
  schur.t(k + 1, k + 1) = std::conj(value);
  schur.t(k + 1, k) = 0;
}

LongComplexVector values_of(const std::optional<LongSchur>& schur, Index count) {
  constexpr long double missing = std::numeric_limits<long double>::quiet_NaN();
  return schur ? LongComplexVector(schur->t.diagonal()) : LongComplexVector::Constant(count, missing);
}

/// x with (T - T_kk) x = 0 and x_k = 1.
std::vector<LongComplex> kernel_of_triangle(const LongComplexMatrix& t, Index k, long double smallest) {
  std::vector<LongComplex> x(static_cast<std::size_t>(k + 1), 1);
  for (Index i = k - 1; i >= 0; --i) {
    LongComplex rest = 0;
    for (Index j = i + 1; j <= k; ++j) rest += t(i, j) * x[static_cast<std::size_t>(j)];
    const LongComplex gap = t(i, i) - t(k, k);
    LongComplex& found = x[static_cast<std::size_t>(i)];
    found = -rest / (gap == LongComplex(0) ? LongComplex(smallest) : gap);
    const long double size = std::abs(found);
    if (epsilon_of_80_bits * size * size > 1) {
      for (Index j = i; j <= k; ++j) x[static_cast<std::size_t>(j)] /= size;
    }
  }
  return x;
}

void set_eigenvector(LongComplexMatrix& columns, Index k, const LongSchur& schur, long double smallest) {
  const std::vector<LongComplex> x = kernel_of_triangle(schur.t, k, smallest);
  long double square = 0;
  for (Index i = 0; i < columns.rows(); ++i) {
    LongComplex sum = 0;
    for (Index j = 0; j <= k; ++j) sum += schur.q(i, j) * x[static_cast<std::size_t>(j)];
    columns(i, k) = schur.t(k, k).imag() == 0 ? sum.real() : sum;
    square += std::norm(columns(i, k));
  }
  for (Index i = 0; i < columns.rows(); ++i) columns(i, k) /= std::sqrt(square);
}

}  // namespace

void LongSchur::turn(Index k, const LongComplex& c, const LongComplex& s) {
  for (LongComplexMatrix* a : {&t, &q}) {
    for (Index i = 0; i < a->rows(); ++i) {
      const LongComplex first = (*a)(i, k), second = (*a)(i, k + 1);
      (*a)(i, k) = first * c + second * s;
      (*a)(i, k + 1) = second * std::conj(c) - first * std::conj(s);
    }
  }
  for (Index j = 0; j < t.cols(); ++j) {
    const LongComplex upper = t(k, j), lower = t(k + 1, j);
    t(k, j) = std::conj(c) * upper + std::conj(s) * lower;
    t(k + 1, j) = c * lower - s * upper;
  }
}

std::optional<LongSchur> schur_form(const LongMatrix& a) {
  const RealSchur real(a);
  if (!real.converged()) return std::nullopt;
  LongSchur schur{real.t().cast<LongComplex>(), real.q().cast<LongComplex>()};
  for (Index k = 0; k + 1 < a.rows(); ++k) {
    if (real.t()(k + 1, k) != 0) split_conjugates(schur, k);
  }
  return schur;
}

LongComplexVector eigenvalues(const LongMatrix& a) { return values_of(schur_form(a), a.rows()); }

LongEigenvectors eigenvectors(const LongMatrix& a) {
  const auto schur = schur_form(a);
  LongEigenvectors result{values_of(schur, a.rows()), LongComplexMatrix::Identity(a.rows(), a.cols())};
  if (!schur) return result;
  long double size = 0;
  for (Index i = 0; i < a.rows(); ++i) {
    for (Index j = i; j < a.cols(); ++j) size += std::abs(schur->t(i, j));
  }
  for (Index k = 0; k < a.rows(); ++k) {
    const bool second = k > 0 && result.values[k].imag() < 0;
    if (!second) set_eigenvector(result.columns, k, *schur, epsilon_of_80_bits * size);
    for (Index i = 0; second && i < a.rows(); ++i) result.columns(i, k) = std::conj(result.columns(i, k - 1));
  }
  return result;
}

}  // namespace qdot
