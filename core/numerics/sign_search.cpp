#include "core/numerics/sign_search.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr double hopeless = 16;  ///< in units of the remainder: smaller values have no sign
constexpr int deepest = 48;
constexpr std::size_t most_cells = 4000;

using Coefficients = std::array<double, largest_degree + 1>;

/// b_j = sum_{k<=j} C(j,k)/C(n,k) c_k
Coefficients in_bernstein_form(std::span<const double> c) {
  Coefficients b{};
  std::copy(c.begin(), c.end(), b.begin());
  const std::size_t n = c.size() - 1;
  // c_k over C(n,k), then a Pascal triangle of sums.
  double binomial = 1;
  for (std::size_t k = 1; k <= n; ++k) {
    binomial *= static_cast<double>(n - k + 1) / static_cast<double>(k);
    b[k] /= binomial;
  }
  for (std::size_t i = 1; i <= n; ++i) {
    for (std::size_t j = n; j >= i; --j) b[j] += b[j - 1];
  }
  return b;
}

class Search {
 public:
  Search(std::span<const double> c, double remainder) : n_(c.size() - 1), r_(remainder) {
    cell(in_bernstein_form(c), 0, 1, 0);
  }

  std::vector<SignPiece> pieces() && { return std::move(pieces_); }

 private:
  [[nodiscard]] int sign(double b) const { return (b > r_) - (b < -r_); }

  void cell(const Coefficients& b, double from, double to, int depth) {
    const auto [least, most] =
        std::minmax_element(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(n_ + 1));
    if (sign(*least) > 0) return add(from, to, 1);
    if (sign(*most) < 0) return add(from, to, -1);
    const bool is_small = !(std::max(-*least, *most) > hopeless * r_);
    if (is_small || depth == deepest || ++cells_ > most_cells) return add(from, to, 0);
    if (has_one_zero(b)) {
      add(from, from, sign(b[0]));
      return add(to, to, sign(b[n_]));
    }
    halve(b, from, to, depth);
  }

  /// Any function within the remainder changes its sign once: all coefficients but one have definite signs.
  [[nodiscard]] bool has_one_zero(const Coefficients& b) const {
    const int first = sign(b[0]), last = sign(b[n_]);
    if (first * last >= 0) return false;
    std::size_t i = 0;
    while (sign(b[i]) == first) ++i;
    if (sign(b[i]) == 0) ++i;
    while (i <= n_ && sign(b[i]) == last) ++i;
    return i > n_;
  }

  void halve(const Coefficients& b, double from, double to, int depth) {
    Coefficients left{}, right = b;
    for (std::size_t i = 0; i <= n_; ++i) {
      left[i] = right[0];
      for (std::size_t j = 0; j + i < n_; ++j) right[j] = 0.5 * (right[j] + right[j + 1]);
    }
    const double middle = 0.5 * (from + to);
    cell(left, from, middle, depth + 1);
    cell(right, middle, to, depth + 1);
  }

  /// Neighbours of one sign are one piece.
  void add(double from, double to, int sign) {
    if (!pieces_.empty() && pieces_.back().sign == sign && pieces_.back().to == from) {
      pieces_.back().to = to;
    } else {
      pieces_.push_back({from, to, sign});
    }
  }

  std::size_t n_;
  double r_;
  std::size_t cells_{};
  std::vector<SignPiece> pieces_;
};

}  // namespace

std::vector<SignPiece> signs_of(std::span<const double> coefficients, double remainder) {
  assert(!coefficients.empty() && coefficients.size() <= largest_degree + 1);
  if (!(remainder < infinity)) return {{0, 1, 0}};
  return Search(coefficients, remainder).pieces();
}

}  // namespace qdot
