// Tapes in intervals and in balls against Arb, which computes the same expressions with 300 bits: what Arb
// says is in every enclosure, and most enclosures are narrow.

#include <arb.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/compile/tape_builder.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/print/print.hpp"
#include "core/numerics/ball.hpp"
#include "tests/support/random_expression.hpp"

namespace qdot {
namespace {

constexpr slong bits = 300;

/// A number of Arb's: a ball of its own.
class ArbNumber {
 public:
  ArbNumber() { arb_init(x_); }
  explicit ArbNumber(double value) : ArbNumber() { arb_set_d(x_, value); }
  ArbNumber(const ArbNumber& other) : ArbNumber() { arb_set(x_, other.x_); }
  ArbNumber& operator=(const ArbNumber& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  ~ArbNumber() { arb_clear(x_); }
  [[nodiscard]] arb_ptr get() { return x_; }
  [[nodiscard]] arb_srcptr get() const { return x_; }

  /// Digits enough to judge others by.
  [[nodiscard]] bool is_sharp() const { return arb_is_finite(x_) != 0 && arb_rel_accuracy_bits(x_) > 150; }

 private:
  arb_t x_;
};

/// p/q for Arb.
class ArbFraction {
 public:
  explicit ArbFraction(const Number& number) {
    fmpq_init(q_);
    set(fmpq_numref(q_), number.numerator());
    set(fmpq_denref(q_), number.denominator());
  }
  ~ArbFraction() { fmpq_clear(q_); }
  ArbFraction(const ArbFraction&) = delete;
  ArbFraction& operator=(const ArbFraction&) = delete;
  [[nodiscard]] const fmpq* get() const { return q_; }

 private:
  static void set(fmpz* target, const Number& integer) {
    const Decimal decimal = integer.decimal().value();
    const std::string digits = decimal.digits + std::string(static_cast<std::size_t>(decimal.exponent), '0');
    ASSERT_EQ(fmpz_set_str(target, digits.empty() ? "0" : digits.c_str(), 10), 0);
    if (integer.is_negative()) fmpz_neg(target, target);
  }
  fmpq_t q_;
};

ArbNumber arb_of(const Number& number) {
  ArbNumber result;
  arb_set_fmpq(result.get(), ArbFraction(number).get(), bits);
  return result;
}

ArbNumber called(Function function, const ArbNumber& u) {
  ArbNumber y;
  switch (function) {
    case Function::sin:
      arb_sin(y.get(), u.get(), bits);
      break;
    case Function::cos:
      arb_cos(y.get(), u.get(), bits);
      break;
    case Function::tan:
      arb_tan(y.get(), u.get(), bits);
      break;
    case Function::asin:
      arb_asin(y.get(), u.get(), bits);
      break;
    case Function::acos:
      arb_acos(y.get(), u.get(), bits);
      break;
    case Function::atan:
      arb_atan(y.get(), u.get(), bits);
      break;
    case Function::sinh:
      arb_sinh(y.get(), u.get(), bits);
      break;
    case Function::cosh:
      arb_cosh(y.get(), u.get(), bits);
      break;
    case Function::tanh:
      arb_tanh(y.get(), u.get(), bits);
      break;
    case Function::exp:
      arb_exp(y.get(), u.get(), bits);
      break;
    case Function::log:
      arb_log(y.get(), u.get(), bits);
      break;
    case Function::abs:
      arb_abs(y.get(), u.get());
      break;
    case Function::sign:
      arb_sgn(y.get(), u.get());
      break;
  }
  return y;
}

/// `known` has the symbols.
ArbNumber evaluated_by_arb(const Expression& e, std::map<NodeId, ArbNumber> known) {
  const Graph& graph = e.graph();
  const NodeId root[]{e.id()};
  for (const NodeId id : reachable(graph, root)) {
    if (known.contains(id)) continue;
    known[id] = std::visit(overloaded{[](const Literal& x) { return arb_of(x.value); },
                                      [](const Symbol& x) {
                                        ArbNumber result;
                                        EXPECT_EQ(x.name, "pi");
                                        arb_const_pi(result.get(), bits);
                                        return result;
                                      },
                                      [&](const Sum& x) {
                                        ArbNumber sum;
                                        for (const NodeId term : x.terms) {
                                          arb_add(sum.get(), sum.get(), known[term].get(), bits);
                                        }
                                        return sum;
                                      },
                                      [&](const Product& x) {
                                        ArbNumber product = arb_of(x.coefficient);
                                        for (const NodeId factor : x.factors) {
                                          arb_mul(product.get(), product.get(), known[factor].get(), bits);
                                        }
                                        return product;
                                      },
                                      [&](const Power& x) {
                                        ArbNumber result;
                                        arb_pow_fmpq(result.get(), known[x.base].get(),
                                                     ArbFraction(x.exponent).get(), bits);
                                        return result;
                                      },
                                      [&](const Call& x) { return called(x.function, known[x.argument]); }},
                           graph.node(id));
  }
  return known[e.id()];
}

bool holds(const Interval& interval, const ArbNumber& x) {
  const ArbNumber lower(interval.lower), upper(interval.upper);
  return arb_gt(lower.get(), x.get()) == 0 && arb_lt(upper.get(), x.get()) == 0;
}

bool holds(const Ball& ball, const ArbNumber& x) {
  if (!ball.is_finite()) return true;
  ArbNumber distance = x;
  arb_sub(distance.get(), distance.get(), ArbNumber(ball.middle.high).get(), bits);
  arb_sub(distance.get(), distance.get(), ArbNumber(ball.middle.low).get(), bits);
  arb_abs(distance.get(), distance.get());
  return arb_gt(distance.get(), ArbNumber(ball.radius).get()) == 0;
}

/// A decimal of up to 25 digits.
Number some_decimal(test::Random& random) {
  std::string text = std::to_string(random.integer(0, 9)) + ".";
  for (auto digits = random.integer(1, 25); digits > 0; --digits) {
    text += static_cast<char>('0' + random.integer(0, 9));
  }
  const Number size = Number::written(text + "e" + std::to_string(random.integer(-6, 3))).value();
  return random.integer(0, 1) == 0 ? size : -size;
}

template <class T>
T value_on_tape(const CompiledFunction& tape, const Reals& parameters, const Reals& variables) {
  TapeEvaluator<T> evaluate(tape, parameters.as<T>());
  T out;
  evaluate(variables.as<T>(), {&out, 1});
  return out;
}

struct Widths {
  std::vector<double> intervals, balls;

  static double share(std::vector<double>& widths, double part) {
    std::ranges::sort(widths);
    return widths.at(static_cast<std::size_t>(part * static_cast<double>(widths.size() - 1)));
  }
};

/// Random expressions in decimals; half of the symbols are parameters, the others variables.
Widths compare(std::uint64_t seed, int cases, const test::Ingredients& ingredients) {
  test::Random random(seed);
  Widths widths;
  int judged = 0;
  for (int i = 0; i < cases; ++i) {
    Graph graph;
    const Expression e = test::random_expression(random, graph, 1 + i % 4, ingredients);
    std::map<NodeId, ArbNumber> known;
    std::vector<Expression> symbols[2];
    Reals values[2];
    for (std::size_t k = 0; k < ingredients.symbols.size(); ++k) {
      const Expression symbol = graph.symbol(ingredients.symbols[k]);
      const Number value = some_decimal(random);
      known[symbol.id()] = arb_of(value);
      symbols[k % 2].push_back(symbol);
      values[k % 2].push_back(value.rounded());
    }
    const ArbNumber exact = evaluated_by_arb(e, known);
    if (!exact.is_sharp()) continue;
    TapeBuilder builder(graph, symbols[0], graph.symbol("t"), symbols[1]);
    builder.output(e);
    const CompiledFunction tape = builder.finish();
    const auto interval = value_on_tape<Interval>(tape, values[0], values[1]);
    const auto ball = value_on_tape<Ball>(tape, values[0], values[1]);
    const std::string text = print(e, Form::text);
    EXPECT_TRUE(holds(interval, exact)) << i << ": " << text;
    EXPECT_TRUE(holds(ball, exact)) << i << ": " << text;
    ++judged;
    const double size = std::abs(arf_get_d(arb_midref(exact.get()), ARF_RND_NEAR));
    if (!(size > 1e-200) || !std::isfinite(size)) continue;
    widths.intervals.push_back(interval.radius() / size);
    widths.balls.push_back(ball.radius / size);
  }
  EXPECT_GT(judged, cases / 2);
  return widths;
}

TEST(EnclosuresAgainstArb, HoldRandomExpressionsOfAllFunctions) {
  Widths widths = compare(21, 4000, {});
  EXPECT_LT(Widths::share(widths.intervals, 0.5), 1e-14);
  EXPECT_LT(Widths::share(widths.intervals, 0.9), 1e-9);
  EXPECT_LT(Widths::share(widths.balls, 0.5), 1e-14);
}

TEST(EnclosuresAgainstArb, HaveTwiceTheDigitsInBallsOfSinesAndCosines) {
  Widths widths = compare(22, 4000, {.functions = {Function::sin, Function::cos}});
  EXPECT_LT(Widths::share(widths.intervals, 0.5), 1e-14);
  EXPECT_LT(Widths::share(widths.balls, 0.5), 1e-29);
  EXPECT_LT(Widths::share(widths.balls, 0.8), 1e-25);
}

}  // namespace
}  // namespace qdot
