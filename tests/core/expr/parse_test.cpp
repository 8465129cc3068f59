// What expression text means, and where and how it is refused.

#include "core/expr/parse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/expr/calculus.hpp"
#include "tests/support/random.hpp"

namespace qdot::parse_test {
namespace {

using testing::HasSubstr;

const std::vector<std::string> names{"x", "y", "z", "theta", "theta_dot"};

struct Reading {
  Graph graph;
  Expression x{graph.symbol("x")};
  Expression y{graph.symbol("y")};
  Expression z{graph.symbol("z")};
  Expression operator()(std::string_view text) { return parse(text, graph, names); }
  Expression number(Number value) { return graph.number(value); }
};

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

/// The only error of `text`.
ParseError error_of(std::string_view text) {
  Graph graph;
  const ParseResult result = parse_all(text, graph, names);
  EXPECT_FALSE(result.expression.has_value()) << text;
  EXPECT_EQ(result.errors.size(), 1u) << text;
  return result.errors.empty() ? ParseError{} : result.errors[0];
}

void expect_error(std::string_view text, ErrorCode code, std::size_t offset, const std::string& message) {
  const ParseError error = error_of(text);
  EXPECT_EQ(error.code, code) << text;
  EXPECT_EQ(error.offset, offset) << text;
  EXPECT_EQ(error.message, message) << text;
}

TEST(Parse, MaxAndMinAreWrittenWithAbs) {
  Reading read;
  EXPECT_EQ(read("max(x, y)"), read("(x + y + abs(x - y))/2"));
  EXPECT_EQ(read("2*min(x, y*z) + 1"), read("x + y*z - abs(x - y*z) + 1"));
  EXPECT_EQ(read("max(x, y, z)"), read("max(max(x, y), z)"));
  EXPECT_EQ(read("max(1/3, 0.25, -2)"), read.number(Number::ratio(1, 3)));
}

TEST(Parse, ProductsBindTighterThanSumsAndPowersTighterThanProducts) {
  Reading read;
  EXPECT_EQ(read("x + y*z"), read.x + read.y * read.z);
  EXPECT_EQ(read("(x + y)*z"), (read.x + read.y) * read.z);
  EXPECT_EQ(read("x*y^2"), read.x * pow(read.y, Number(2)));
  EXPECT_EQ(read("(x*y)^2"), pow(read.x * read.y, Number(2)));
}

TEST(Parse, DifferencesAndQuotientsAssociateToTheLeft) {
  Reading read;
  EXPECT_EQ(read("x - y - z"), read.x - (read.y + read.z));
  EXPECT_EQ(read("x/y/z"), read.x / (read.y * read.z));
  EXPECT_EQ(read("x/y*z"), read.x * read.z / read.y);
  EXPECT_EQ(read("1/2*x"), Number::ratio(1, 2) * read.x);
}

TEST(Parse, PowersAssociateToTheRight) {
  Reading read;
  EXPECT_EQ(read("x^2^3"), pow(read.x, Number(8)));
  EXPECT_EQ(read("x**2**3"), pow(read.x, Number(8)));
  EXPECT_EQ(read("(x^2)^3"), pow(read.x, Number(6)));
}

TEST(Parse, MinusBindsLooserThanPower) {
  Reading read;
  EXPECT_EQ(read("-x^2"), -pow(read.x, Number(2)));
  EXPECT_EQ(read("(-x)^2"), pow(read.x, Number(2)));
  EXPECT_EQ(read("2^-1"), read.number(Number::ratio(1, 2)));
  EXPECT_EQ(read("x^-2"), pow(read.x, Number(-2)));
  EXPECT_EQ(read("x*-y"), -(read.x * read.y));
  EXPECT_EQ(read("x - -y"), read.x + read.y);
  EXPECT_EQ(read("+x"), read.x);
  EXPECT_EQ(read("--x"), read.x);
  EXPECT_EQ(read("-2^2"), read.number(-4));
}

TEST(Parse, LeadingMinusBelongsToTheWholeTerm) {
  Reading read;
  EXPECT_EQ(read("-(x - y)*(y - z)"), -((read.x - read.y) * (read.y - read.z)));
  EXPECT_EQ(read("-(x - y)"), read.y - read.x);
}

TEST(Parse, ReadsFunctionsAndPi) {
  Reading read;
  for (std::size_t i = 0; i < function_names.size(); ++i) {
    const std::string call = std::string(function_names[i]) + "(x)";
    EXPECT_EQ(read(call), read.graph.call(static_cast<Function>(i), read.x)) << call;
  }
  EXPECT_EQ(read("sqrt(x)"), pow(read.x, Number::ratio(1, 2)));
  EXPECT_EQ(evaluate(read("2*pi"), {}), 2 * 3.14159265358979323846);
}

TEST(Parse, SymbolicExponentIsAnExponential) {
  Reading read;
  EXPECT_EQ(read("x^y"), read.graph.call(Function::exp, read.y * read.graph.call(Function::log, read.x)));
}

TEST(Parse, DecimalsAreExact) {
  Reading read;
  EXPECT_EQ(read("9.81"), read.number(Number::ratio(981, 100)));
  EXPECT_EQ(read("1e-3"), read.number(Number::ratio(1, 1000)));
  EXPECT_EQ(read("1.5E+2"), read.number(150));
  EXPECT_EQ(read(".5"), read.number(Number::ratio(1, 2)));
  EXPECT_EQ(read("2."), read.number(2));
  EXPECT_EQ(read("0.0"), read.number(0));
  EXPECT_EQ(read("0.200310900544247"), read.number(Number::ratio(200310900544247, 1000000000000000)));
  EXPECT_EQ(read("9007199254740992"), read.number(std::int64_t{1} << 53));
  EXPECT_EQ(read("0.50000000000000000"), read("0.5"));
  EXPECT_NE(read("0.10000000000000001"), read("0.1"));
  EXPECT_EQ(read("0.10000000000000001 - 0.1"), read("1e-17"));
  EXPECT_EQ(read("9007199254740993 - 9007199254740992"), read.number(1));
  EXPECT_EQ(read("6.02e23/1e21"), read.number(602));
  EXPECT_EQ(read("1.602e-19*1e22"), read.number(1602));
  EXPECT_EQ(read("3.14159265358979323846 - 3.14159265358979323"), read("8.46e-18"));
}

TEST(Parse, SpacesMeanNothing) {
  Reading read;
  EXPECT_EQ(read(" \tx\n+ y "), read.x + read.y);
}

TEST(ParseErrors, SayWhatToWriteAndWhere) {
  const auto syntax = ErrorCode::syntax;
  expect_error("", syntax, 0, "expected an expression, not an empty text");
  expect_error("  ", syntax, 2, "expected an expression, not an empty text");
  expect_error("2x", syntax, 1, "write 2*x, not 2x");
  expect_error("1 + 2(x)", syntax, 5, "write 2*(...), not 2(...)");
  expect_error("x y", syntax, 2, "expected an operator, found 'y': a product is written with *");
  expect_error("(x)(y)", syntax, 3, "expected an operator, found '(': a product is written with *");
  expect_error("x(y)", syntax, 0, "write x*(...) for a product");
  expect_error("sin x", syntax, 4, "expected '(' after the function 'sin'");
  expect_error("sin^2(x)", syntax, 3, "write sin(x)^2, not sin^2(x)");
  expect_error("1 kg", syntax, 2,
               "a number in an expression is in SI, with no unit behind it; 'kg' is none of the symbols");
  expect_error("30deg", syntax, 2, "write 30*deg, not 30deg");
  expect_error("ln(x)", syntax, 0, "write log(...), not ln(...)");
  expect_error("|x|", syntax, 0, "write abs(...) for the absolute value");
  expect_error("½*x", syntax, 0, "write 1/2 for the fraction");
  expect_error("(x + y", syntax, 6, "expected ')' to close the '(' at byte 0");
  expect_error("x + y)", syntax, 5, "there is no '(' for this ')'");
  expect_error("()", syntax, 1, "expected a number, a symbol or '(', found ')'");
  expect_error("x +", syntax, 3, "expected a number, a symbol or '(', found the end");
  expect_error("x * / y", syntax, 4, "expected a number, a symbol or '(', found '/'");
  expect_error("x = y", syntax, 2, "an expression is no equation: for a = b write a - (b), which is zero");
  expect_error("sin(x, y)", syntax, 5, "every function but max and min takes one argument: unexpected ','");
  expect_error("1,5*x", syntax, 1, "decimals have a point: unexpected ','");
  expect_error("(x, y)", syntax, 2, "unexpected ','");
  expect_error("2*max((x))", syntax, 9, "max takes two or more, with commas between them");
  expect_error("max(x, y", syntax, 8, "expected ')' to close the '(' at byte 3");
  expect_error("max((x, y), 1)", syntax, 6, "unexpected ','");
  expect_error("max(sin(x, y), 1)", syntax, 9,
               "every function but max and min takes one argument: unexpected ','");
  expect_error("diff(x(t), t)^2", syntax, 9, "write x_dot for the derivative of x by the time");
  expect_error("D(x)^2", syntax, 0, "write x_dot for the derivative of x by the time, not D(...)");
  expect_error("x.diff(t)^2", syntax, 1, "write x_dot for the velocity of x");
  expect_error("y*x'^2", syntax, 3, "write x_dot for the velocity of x");
  expect_error("y*\\dot{x}^2", syntax, 2, "write x_dot for the velocity of x");
  expect_error("\\frac{x}{y}", syntax, 0,
               "leave out LaTeX's backslashes: names stand alone, pi, theta or sin(...)");
  expect_error("x + \xce\xb8", syntax, 4, "expressions are ASCII: write theta for the Greek letter");
  expect_error("x + \xc3\xa9", syntax, 4, "expressions are ASCII: this sign is not");
  expect_error("x \xe2\x88\x92 y", syntax, 2, "write - for a minus");
  expect_error("x\xc2\xb7y", syntax, 1, "write * for a product");
  expect_error("30\xc2\xb0", syntax, 2, "write 30*deg for 30 degrees");
  expect_error("\xe1\xba\x8b^2/2", syntax, 0, "write x_dot for the velocity of x");
  expect_error("y\xcc\x87^2/2", syntax, 1, "write y_dot for the velocity of y");
  expect_error("9.81 x/y", syntax, 5,
               "write 9.81*x, not 9.81x; if x is a unit, give the number in SI instead, without it");
  expect_error("theta'", syntax, 5, "write theta_dot for the velocity of theta");
  expect_error("[x]", syntax, 0, "write ( and ) for brackets");
  expect_error("x & y", syntax, 2, "an expression cannot contain '&'");
  expect_error("_x", syntax, 0, "an expression cannot contain '_'");
  expect_error("x.y", syntax, 1, "an expression cannot contain '.'");
  expect_error("2*np.pi", syntax, 2, "write pi, sqrt or sin, not 'np.pi'");
  expect_error("0..10", syntax, 0, "a range is given by its ends, in fields of their own, not by ..");
  expect_error(std::string("x\0y", 3), syntax, 1, "an expression cannot contain '?'");
  EXPECT_THAT(error_of("x + hypot(y)").message,
              HasSubstr("unknown function 'hypot', there are sqrt, sin, cos"));
  EXPECT_EQ(error_of("x + hypot(y)").offset, 4u);
}

TEST(ParseErrors, DivisionByZeroIsRefusedAtTheDivisor) {
  expect_error("x/0", ErrorCode::syntax, 2, "division by zero");
  expect_error("x/(y - y)", ErrorCode::syntax, 2, "division by zero");
  expect_error("x + 0^-2", ErrorCode::syntax, 6, "division by zero");
  expect_error("1/-0.0", ErrorCode::syntax, 2, "division by zero");
}

TEST(ParseErrors, AllUnknownSymbolsAreReportedOnceEach) {
  Graph graph;
  const ParseResult result = parse_all("x + kk*jj - kk + sin(ww", graph, names);
  EXPECT_FALSE(result.expression.has_value());
  ASSERT_EQ(result.errors.size(), 4u);
  EXPECT_EQ(result.errors[0].message, "unknown symbol 'kk'");
  EXPECT_EQ(result.errors[0].symbol, "kk");
  EXPECT_EQ(result.errors[0].offset, 4u);
  EXPECT_EQ(result.errors[1].symbol, "jj");
  EXPECT_EQ(result.errors[2].symbol, "ww");
  EXPECT_EQ(result.errors[2].code, ErrorCode::unknown_symbol);
  EXPECT_EQ(result.errors[3].code, ErrorCode::syntax);
  EXPECT_EQ(result.errors[3].offset, 23u);
}

TEST(ParseErrors, AreThrownWithCodeAndOffset) {
  Graph graph;
  try {
    (void)parse("x + kk", graph, names);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unknown_symbol);
    EXPECT_EQ(error.offset(), 4u);
    EXPECT_STREQ(error.what(), "unknown symbol 'kk'");
  }
}

TEST(ParseErrors, ExcerptsHaveAtMostFortyBytes) {
  EXPECT_EQ(error_of(std::string(100, 'a')).message, "unknown symbol '" + std::string(40, 'a') + "'");
}

TEST(ParseBounds, DepthOfBracketsCallsAndExponents) {
  Reading read;
  EXPECT_EQ(read(repeated("(", 64) + "x" + repeated(")", 64)), read.x);
  expect_error(repeated("(", 65) + "x" + repeated(")", 65), ErrorCode::too_large, 65,
               "the expression is nested deeper than 64 levels");
  (void)read(repeated("sin(", 64) + "x" + repeated(")", 64));
  EXPECT_EQ(error_of(repeated("sin(", 65) + "x" + repeated(")", 65)).code, ErrorCode::too_large);
  EXPECT_EQ(read(repeated("1^", 64) + "1"), read.number(1));
  EXPECT_EQ(error_of(repeated("1^", 65) + "1").code, ErrorCode::too_large);
  EXPECT_EQ(error_of(repeated("(", 4000)).code, ErrorCode::too_large);
  EXPECT_EQ(error_of(repeated("(", 65)).code, ErrorCode::too_large);
}

TEST(ParseBounds, BracketsBesideEachOtherAreNotDeep) {
  Reading read;
  EXPECT_EQ(read("0" + repeated("+(x)", 100) + repeated("*x^2", 10)), read("99*x + x^21"));
}

TEST(ParseBounds, ChainsAreFlatAndMayBeLong) {
  Reading read;
  const ParseLimits wide{.bytes = 1 << 20, .tokens = 1 << 20, .nodes = 1 << 20};
  const auto sum = parse_all("x" + repeated("+x", 9'999), read.graph, names, wide);
  EXPECT_EQ(sum.expression.value(), Number(10'000) * read.x);
  const auto distinct = parse_all("x" + repeated("*y+x", 9'999), read.graph, names, wide);
  EXPECT_EQ(distinct.expression.value(), read("x + 9998*x*y + x*y"));
  const auto product = parse_all("x" + repeated("/x*x", 5'000), read.graph, names, wide);
  EXPECT_EQ(product.expression.value(), read.x);
  const auto signs = parse_all(repeated("-", 10'000) + "x", read.graph, names, wide);
  EXPECT_EQ(signs.expression.value(), read.x);
}

TEST(ParseBounds, FourKibibytes) {
  Reading read;
  EXPECT_EQ(read("x" + std::string(4095, ' ')), read.x);
  expect_error("x" + std::string(4096, ' '), ErrorCode::too_large, 4096,
               "the expression is longer than 4096 bytes");
}

TEST(ParseBounds, TwoThousandTokens) {
  Reading read;
  EXPECT_EQ(read("-x" + repeated("+x", 999)), Number(998) * read.x);
  expect_error("-+x" + repeated("+x", 999), ErrorCode::too_large, 2000,
               "the expression has more than 2000 tokens");
}

TEST(ParseBounds, IntegersOfSeventeenDigits) {
  Reading read;
  EXPECT_EQ(read(std::string(17, '9')), read.number(power(Number(10), 17) - Number(1)));
  expect_error("x+" + std::string(18, '9'), ErrorCode::too_large, 2,
               "the integer '999999999999999999' has more than 17 digits");
}

TEST(ParseBounds, ExponentsOfSixtyFour) {
  Reading read;
  EXPECT_EQ(read("x^64"), pow(read.x, Number(64)));
  EXPECT_EQ(read("x^-64"), pow(read.x, Number(-64)));
  expect_error("x^65", ErrorCode::too_large, 2, "the exponent is larger than 64");
  expect_error("x^-64.5", ErrorCode::too_large, 2, "the exponent is larger than 64");
  expect_error("x^9^9", ErrorCode::too_large, 2, "the exponent is larger than 64");
}

TEST(ParseBounds, NumbersBeyondADouble) {
  expect_error("1e999", ErrorCode::too_large, 0, "the number '1e999' is outside the range of a double");
  expect_error("1e-999", ErrorCode::too_large, 0, "the number '1e-999' is outside the range of a double");
  expect_error("1e99999999999", ErrorCode::too_large, 0,
               "the number '1e99999999999' is outside the range of a double");
  expect_error("x*1e200*1e200", ErrorCode::too_large, 13,
               "a number in the expression is outside the range of a double");
}

TEST(ParseBounds, NumbersThatUnderflowWhereTheyStay) {
  // exact as an expression, but computed it would be sqrt(0)*1e198
  expect_error("x*sqrt(((2.38e-50)^4)^2)*1e198", ErrorCode::too_large, 30,
               "a number in the expression is outside the range of a double");
  expect_error("1e-200*x*1e-200", ErrorCode::too_large, 15,
               "a number in the expression is outside the range of a double");
  Reading read;
  EXPECT_EQ(read("(1e-200*1e-200)*x*1e200*1e200"), read.x);
}

TEST(ParseBounds, TwoThousandNodesHoweverTheyArise) {
  // A power of a product of 300 symbols makes 300 nodes: a short text, many nodes.
  Graph graph;
  std::vector<std::string> many;
  std::string nested = "1";
  for (int i = 0; i < 300; ++i) {
    many.push_back("s" + std::to_string(i));
    nested += "*" + many.back();
  }
  for (int i = 0; i < 4; ++i) nested = "(" + nested + ")^2";
  EXPECT_TRUE(parse_all(nested, graph, many).expression.has_value());
  Graph other;
  for (int i = 0; i < 4; ++i) nested = "(" + nested + ")^2";
  const ParseResult result = parse_all(nested, other, many);
  ASSERT_EQ(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].message, "the expression has more than 2000 parts");
}

TEST(ParseBounds, HostileTextIsReadOrRefusedWithAPlace) {
  const std::vector<std::string> pieces{"x",     "y",     "pi",   "kk",   "2",    "0",    "1e9",   "0.1",
                                        "1e308", ".",     "+",    "-",    "*",    "/",    "^",     "**",
                                        "(",     "(",     ")",    ")",    "sin(", "exp(", "sqrt(", "^-",
                                        "e5",    "(1/3)", "acos", "log(", " ",    "\xff", "^64",   "1-1"};
  test::Random random(99);
  int read = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (auto length = random.integer(1, 12); length > 0; --length) {
      text +=
          pieces[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(pieces.size()) - 1))];
    }
    Graph graph;
    const ParseResult result = parse_all(text, graph, names);
    ASSERT_EQ(result.expression.has_value(), result.errors.empty()) << text;
    for (const ParseError& error : result.errors) {
      EXPECT_LE(error.offset, text.size()) << text;
      EXPECT_FALSE(error.message.empty()) << text;
    }
    read += result.expression.has_value() ? 1 : 0;
  }
  EXPECT_GT(read, 500);
}

TEST(ParseEvent, IsADifferenceWithADirection) {
  Reading read;
  const auto event = [&](std::string_view text) { return parse_event(text, read.graph, names); };
  EXPECT_EQ(event("theta=0+").expression, read("theta"));
  EXPECT_EQ(event("theta=0+").crossing, Crossing::rising);
  EXPECT_EQ(event("theta_dot = 0-").expression, read("theta_dot"));
  EXPECT_EQ(event("theta_dot = 0-").crossing, Crossing::falling);
  EXPECT_EQ(event("x=1.2").expression, read("x - 1.2"));
  EXPECT_EQ(event("x=1.2").crossing, Crossing::either);
  EXPECT_EQ(event("x - 2*theta = y + ").expression, read("x - 2*theta - y"));
  EXPECT_EQ(event("x - 2*theta = y + ").crossing, Crossing::rising);
  EXPECT_EQ(event("x=-1").crossing, Crossing::either);
}

TEST(ParseEvent, ErrorsCountFromTheBeginningOfTheText) {
  const auto error_of_event = [](std::string_view text) {
    Graph graph;
    try {
      (void)parse_event(text, graph, names);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << text;
    return Error(ErrorCode::syntax, "");
  };
  EXPECT_EQ(error_of_event("theta").offset(), 5u);
  EXPECT_STREQ(error_of_event("theta").what(),
               "write an event as theta=0, theta=0+ (rising) or theta=0- (falling)");
  EXPECT_EQ(error_of_event("x==0").offset(), 2u);
  EXPECT_EQ(error_of_event("x=y+kk-").offset(), 4u);
  EXPECT_EQ(error_of_event("x=y+kk-").code(), ErrorCode::unknown_symbol);
  EXPECT_EQ(error_of_event("kk=0").offset(), 0u);
  EXPECT_EQ(error_of_event("x=+").offset(), 2u);
  EXPECT_EQ(error_of_event("=0").offset(), 0u);
}

}  // namespace
}  // namespace qdot::parse_test
