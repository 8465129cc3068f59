#include "core/grading/equation_size.hpp"

#include <cmath>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/grading/ball_system.hpp"

namespace qdot {

EquationSize::EquationSize(const ExpectedSystem& system, RightMotion& right, const Expression& residual)
    : right_(right), unknowns_(system.unknowns().size()), roots_(roots(system, residual)), values_(roots_) {}

double EquationSize::operator()(State state) {
  if (!right_.set(state, values_)) return 0;
  values_.evaluate();
  std::vector<Ball> slopes;
  for (std::size_t j = 0; j < unknowns_; ++j) slopes.push_back(values_.of(roots_[j]));
  const BallMatrix matrix = right_.matrix();
  const auto parts = solved(transposed(matrix), slopes);
  if (!parts) return 0;
  double size = 0;
  for (std::size_t i = 0; i < unknowns_; ++i)
    size += std::abs((*parts)[i].value()) * size_of_row(i, matrix[i]);
  return size;
}

std::vector<Expression> EquationSize::roots(const ExpectedSystem& system, const Expression& residual) {
  std::vector<Expression> all;
  for (const Expression& a : system.unknowns()) all.push_back(differentiate(residual, a));
  for (const Expression& forcing : system.right()) {
    for (const Expression& term : terms_of(forcing)) all.push_back(term);
    ends_.push_back(all.size());
  }
  return all;
}

double EquationSize::size_of_row(std::size_t i, const std::vector<Ball>& row) const {
  double size = 0;
  for (std::size_t k = i == 0 ? unknowns_ : ends_[i - 1]; k < ends_[i]; ++k)
    size += std::abs(values_.of(roots_[k]).value());
  for (std::size_t j = 0; j < unknowns_; ++j) size += std::abs(row[j].value() * right_.solution()[j].value());
  return size;
}

}  // namespace qdot
