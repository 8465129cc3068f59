// Random expressions in the SymPy and C forms, evaluated by SymPy (30 digits) and by the C compiler, against
// the tree walk: the second road to what a form means.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/expr/calculus.hpp"
#include "core/expr/print/print.hpp"
#include "tests/support/random_expression.hpp"

namespace qdot {
namespace {

/// Names that mean something to SymPy, Python or C are among them. No powers of numbers: SymPy 1.11 does not
/// come back from sqrt((1/sqrt(Rational(5, 4)))**Rational(3, 2)).
const test::Ingredients ingredients{.symbols = {"m", "gamma", "lambda", "N", "E", "beta", "double", "theta"},
                                    .powers_of_numbers = false};

/// Doubles walk a tree of depth 3 to about 1e-13; a few arguments near poles and zeros lose more. A form that
/// means something else is wrong in the first digits.
constexpr const char* tolerance = "1e-7";

struct Sample {
  Expression expression;
  double value{0};
};

struct Samples {
  Graph graph;
  std::vector<Assignment> point;
  std::vector<Sample> list;
};

/// Whether no function has an argument so large that its period is lost in rounding.
bool keeps_periods(const Expression& e, std::span<const Assignment> point) {
  const NodeId root[]{e.id()};
  const std::vector<NodeId> nodes = reachable(e.graph(), root);
  return std::none_of(nodes.begin(), nodes.end(), [&](NodeId id) {
    const auto* call = std::get_if<Call>(&e.graph().node(id));
    return call != nullptr && std::abs(evaluate({e.graph(), call->argument}, point)) > 100;
  });
}

/// Expressions with a finite value where the symbols have their values.
void draw(Samples& samples, std::size_t wanted) {
  test::Random random(11);
  int quarters = 2;
  for (const std::string& name : ingredients.symbols) {
    samples.point.emplace_back(samples.graph.symbol(name), 0.25 * quarters++);
  }
  while (samples.list.size() < wanted) {
    const Expression e = test::random_expression(random, samples.graph, 3, ingredients);
    const double value = evaluate(e, samples.point);
    const bool usual = std::abs(value) > 1e-8 && std::abs(value) < 1e8 && keeps_periods(e, samples.point);
    if (usual) samples.list.push_back({e, value});
  }
}

std::string written(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

std::string symbol_in(Form form, const Expression& symbol) { return print(symbol, form); }

TEST(PrintOracle, SympyEvaluatesItsFormToTheSameNumber) {
  Samples samples;
  draw(samples, 250);
  const std::string script = testing::TempDir() + "qdot_forms.py";
  {
    std::ofstream out(script);
    out << "import sys\nimport mpmath\nfrom sympy import Symbol, lambdify\nfrom sympy.parsing.sympy_parser "
           "import "
           "parse_expr\n"
        << "point = {";
    for (const auto& [symbol, value] : samples.point) {
      out << "'" << symbol_in(Form::sympy, symbol) << "': " << written(value) << ", ";
    }
    out << "}\nmpmath.mp.dps = 30\nsymbols = {name: Symbol(name) for name in point}\nwrong = 0\n"
        << "for form, expected in [\n";
    for (const Sample& sample : samples.list) {
      out << "    ('" << print(sample.expression, Form::sympy) << "', " << written(sample.value) << "),\n";
    }
    out << "]:\n"
        << "    e = parse_expr(form, local_dict=dict(symbols))\n"
        << "    value = lambdify(list(symbols.values()), e, 'mpmath')(*[mpmath.mpf(x) for x in "
           "point.values()])\n"
        << "    if not (mpmath.im(value) == 0 and abs(value - expected) <= " << tolerance
        << "*abs(expected)):\n"
        << "        print(form, 'is', value, 'not', expected)\n        wrong += 1\n"
        << "sys.exit(1 if wrong else 0)\n";
  }
  EXPECT_EQ(std::system(("/usr/bin/python3 -I -B " + script).c_str()), 0);
}

TEST(PrintOracle, TheCCompilerEvaluatesItsFormToTheSameNumber) {
  Samples samples;
  draw(samples, 1000);
  const std::string program = testing::TempDir() + "qdot_forms";
  {
    std::ofstream out(program + ".c");
    out << "#include <math.h>\n#include <stdio.h>\nint main(void) {\n  int wrong = 0;\n";
    for (const auto& [symbol, value] : samples.point) {
      out << "  double " << symbol_in(Form::c, symbol) << " = " << written(value) << ";\n";
    }
    for (const Sample& sample : samples.list) {
      const std::string form = print(sample.expression, Form::c);
      out << "  if (!(fabs((" << form << ") - (" << written(sample.value) << ")) <= " << tolerance << "*fabs("
          << written(sample.value) << "))) wrong += printf(\"%s\\n\", \"" << form << "\");\n";
    }
    out << "  return wrong > 0;\n}\n";
  }
  const std::string compile = "cc -std=c99 -pedantic-errors -o " + program + " " + program + ".c -lm";
  ASSERT_EQ(std::system(compile.c_str()), 0);
  EXPECT_EQ(std::system(program.c_str()), 0);
}

}  // namespace
}  // namespace qdot
