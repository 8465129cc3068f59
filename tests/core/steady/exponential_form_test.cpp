// Equations nested in their exponentials: the same zeros, and a sign where exponentials overflow.

#include "core/steady/exponential_form.hpp"

#include <gtest/gtest.h>

#include "core/compile/tape_builder.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"

namespace qdot::exponential_form_test {
namespace {

const std::vector<std::string> names{"x", "D", "F", "r"};

class ExponentialForm : public testing::Test {
 protected:
  Expression read(const std::string& text) { return parse(text, graph_, names); }
  Expression nested(const std::string& text, Exponential w = Exponential::rising) {
    const Expression x = graph_.symbol("x");
    return nested_in_exponentials(read(text), {&x, 1}, w);
  }
  Interval value(const Expression& e, const Interval& x) {
    const std::vector<Expression> variables{graph_.symbol("x")},
        constants{graph_.symbol("D"), graph_.symbol("F")};
    TapeBuilder tape(graph_, constants, graph_.symbol("t"), variables);
    tape.output(e);
    const CompiledFunction function = tape.finish();
    Interval result;
    const std::vector<Interval> numbers{2, 3};
    TapeEvaluator<Interval>(function, numbers)({&x, 1}, {&result, 1});
    return result;
  }

  Graph graph_;
};

TEST_F(ExponentialForm, HasASignWhereExponentialsOverflow) {
  const std::string pull = "2*D*(exp(-x) - exp(-2*x)) - F";
  const Interval far(-1e9, -1e3);
  EXPECT_TRUE(value(read(pull), far).contains(0.0));
  EXPECT_LT(value(nested(pull), far).upper, 0);
  EXPECT_LT(value(nested(pull), {1e3, 1e9}).upper, 0);
}

TEST_F(ExponentialForm, HasTheSameZerosAndSigns) {
  for (const std::string text :
       {"2*D*(exp(-x) - exp(-2*x)) - F/4", "D*sinh(2*x) - F*cosh(x)^3 + 1", "D*tanh(x) - 1"}) {
    for (const Exponential w : {Exponential::rising, Exponential::falling}) {
      const Expression e = read(text), form = nested(text, w);
      for (const double x : {-3.0, -1.0, -0.2, 0.1, 0.7, 2.0}) {
        const std::vector<Assignment> at{
            {graph_.symbol("x"), x}, {graph_.symbol("D"), 2}, {graph_.symbol("F"), 3}};
        EXPECT_GT(evaluate(e, at) * evaluate(form, at), 0) << text << " at " << x;
      }
    }
  }
}

TEST_F(ExponentialForm, LeavesOutWhatCannotVanish) {
  EXPECT_EQ(print(nested("D*(2*exp(-x)^2 - exp(-x))"), Form::text, {names, {}, {}}), "2*D - D*exp(x)");
}

TEST_F(ExponentialForm, IsTheEquationItselfWithoutOneCommonExponential) {
  for (const std::string text : {"x^2 - D", "exp(x) - exp(sqrt(2)*x)", "exp(x) - cosh(D*x)"})
    EXPECT_EQ(nested(text), read(text)) << text;
}

}  // namespace
}  // namespace qdot::exponential_form_test
