#include "core/expr/linear.hpp"

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// m without its first row and one column.
Matrix minor_of(const Matrix& m, std::size_t column) {
  Matrix result;
  for (std::size_t i = 1; i < m.size(); ++i) {
    result.push_back(m[i]);
    result.back().erase(result.back().begin() + static_cast<std::ptrdiff_t>(column));
  }
  return result;
}

}  // namespace

Expression determinant(const Matrix& m) {
  if (m.size() == 1) return m[0][0];
  std::vector<Expression> terms;
  for (std::size_t j = 0; j < m.size(); ++j) {
    terms.push_back(Number(j % 2 == 0 ? 1 : -1) * (m[0][j] * determinant(minor_of(m, j))));
  }
  return m[0][0].graph().sum(terms);
}

std::vector<Expression> cramer(const Matrix& m, const std::vector<Expression>& b) {
  std::vector<Expression> unknowns;
  const Expression denominator = determinant(m);
  for (std::size_t j = 0; j < m.size(); ++j) {
    Matrix replaced = m;
    for (std::size_t i = 0; i < m.size(); ++i) replaced[i][j] = b[i];
    unknowns.push_back(simplify_quotient(determinant(replaced), denominator));
  }
  return unknowns;
}

}  // namespace qdot
