#pragma once
// A formula tried at values of the parameters that nobody chose: what it claims for all of them has to hold
// there, too, to twice the digits of a double.

#include <vector>

#include "core/closed/exact_values.hpp"
#include "core/expr/linear.hpp"

namespace qdot {

class Trial {
 public:
  /// `relations` hold at every place that is tried.
  Trial(const ExactValues& values, const Relations& relations) : values_(values), relations_(relations) {}

  /// Symbols that are no parameters, or asked for, and what they are by what has a value already.
  void set(const std::vector<Expression>& symbols, const std::vector<Expression>& values);
  /// Symbols that may have any value, and have one.
  void set_given(const std::vector<Expression>& symbols);
  /// Claims that the sum of the terms is zero.
  void vanishes(std::vector<Expression> terms) { claims_.push_back(std::move(terms)); }
  /// Claims that the determinant is zero.
  void is_singular(Matrix matrix) { singular_.push_back(std::move(matrix)); }
  /// Claims nothing of far places where what was set has no value: formulas say so themselves.
  void only_where_real() { only_where_real_ = true; }
  /// Claims that it is above zero.
  void is_positive(const Expression& e) { positive_.push_back(e); }
  /// Every claim holds wherever all its terms have values, and somewhere they have.
  [[nodiscard]] bool passes() const;
  /// Where the parameters, and the symbols that are given, have these values.
  [[nodiscard]] bool holds_at(const std::vector<RealAssignment>& parameters) const;

 private:
  [[nodiscard]] std::vector<RealAssignment> place(int number) const;
  [[nodiscard]] std::vector<RealAssignment> with_others(std::vector<RealAssignment> assigned) const;

  const ExactValues& values_;
  const Relations& relations_;
  std::vector<Expression> given_;
  std::vector<Replacement> others_;
  std::vector<std::vector<Expression>> claims_;
  std::vector<Matrix> singular_;
  std::vector<Expression> positive_;
  bool only_where_real_{};
};

}  // namespace qdot
