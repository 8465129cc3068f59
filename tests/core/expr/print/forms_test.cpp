// Each form of print, on a table, and how names are written.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"

namespace qdot::forms_test {
namespace {

const Notation notation{{"M", "m", "k", "l0", "g", "mass", "mu_hat", "lambda", "double"},
                        {"x", "l", "theta", "phi"},
                        {{"phi", "\\varphi"}}};

const std::vector<std::string> names{
    "M", "m",     "k",   "l0", "g",     "mass",  "mu_hat",    "lambda",  "double",     "x",
    "l", "theta", "phi", "b",  "x_dot", "l_dot", "theta_dot", "phi_dot", "theta_ddot", "p_phi"};

std::string printed(const std::string& text, Form form) {
  Graph graph;
  return print(parse(text, graph, names), form, notation);
}

struct Row {
  std::string text, form;
};

void expect_rows(Form form, const std::vector<Row>& rows) {
  for (const Row& row : rows) EXPECT_EQ(printed(row.text, form), row.form) << row.text;
}

TEST(PrintLatex, WritesAsOnABoard) {
  expect_rows(Form::latex, {
                               {"m*g*l*sin(theta)", R"(m g l \sin\theta)"},
                               {"m*l^2*theta_ddot + 2*m*l*l_dot*theta_dot",
                                R"(m l^2 \ddot\theta + 2 m l \dot{l} \dot\theta)"},
                               {"3/4*m*x_dot^2", R"(\frac{3}{4} m \dot{x}^2)"},
                               {"-b^2/(2*m*l^2)", R"(-\frac{b^2}{2 m l^2})"},
                               {"k*(l - l0)", R"(k \left(l - l_0\right))"},
                               {"(l - l0)/m", R"(\frac{l - l_0}{m})"},
                               {"1/(1 + x)", R"(\frac{1}{1 + x})"},
                               {"sqrt(g/l)", R"(\sqrt{\frac{g}{l}})"},
                               {"1/sqrt(x)", R"(\frac{1}{\sqrt{x}})"},
                               {"2*3^(1/3)", R"(2 \cdot 3^{\frac{1}{3}})"},
                               {"x^12 + 1", R"(1 + x^{12})"},
                               {"(1 + x)^2", R"(\left(1 + x\right)^2)"},
                               {"sin(theta)^2*cos(theta - l)", R"(\sin^2\theta \cos\left(\theta - l\right))"},
                               {"sin(x)*(1 + theta)", R"(\sin\left(x\right) \left(1 + \theta\right))"},
                               {"sin(x)^2*(1 + theta)", R"(\sin^2\left(x\right) \left(1 + \theta\right))"},
                               {"sin(x)", R"(\sin x)"},
                               {"exp(-x)^2", R"(\left(e^{-x}\right)^2)"},
                               {"log(x)^2", R"(\left(\ln x\right)^2)"},
                               {"abs(x)*sign(x)", R"(\left|x\right| \operatorname{sgn} x)"},
                               {"asin(x) + atan(x)^2", R"(\arcsin x + \arctan^2 x)"},
                               {"sqrt(sin(x))", R"(\sqrt{\sin x})"},
                               {"1.5e-30*x", R"(1.5 \cdot 10^{-30} x)"},
                               {"(-2)^(1/3)", R"(\left(-2\right)^{\frac{1}{3}})"},
                               {"9.81*m", R"(9.81 m)"},
                               {"2*mass*x", R"(2 \, \mathrm{mass} \, x)"},
                               {"2*pi*m", R"(2 \pi m)"},
                               {"phi_dot*phi", R"(\varphi \dot\varphi)"},
                           });
}

TEST(PrintMathml, IsPresentationMarkup) {
  const auto math = [](const std::string& content) {
    return "<math xmlns=\"http://www.w3.org/1998/Math/MathML\"><mrow>" + content + "</mrow></math>";
  };
  expect_rows(
      Form::mathml,
      {
          {"m*g*sin(theta)", math("<mi>m</mi><mo>\u2062</mo><mi>g</mi><mo>\u2062</mo>"
                                  "<mrow><mi>sin</mi><mo>\u2061</mo><mi>θ</mi></mrow>")},
          {"-b/(2*m)", math("<mo>−</mo><mfrac><mrow><mi>b</mi></mrow>"
                            "<mrow><mn>2</mn><mo>\u2062</mo><mi>m</mi></mrow></mfrac>")},
          {"theta_ddot", math("<mover accent=\"true\"><mi>θ</mi><mo>¨</mo></mover>")},
          {"l0^2", math("<msup><msub><mi>l</mi><mn>0</mn></msub><mn>2</mn></msup>")},
          {"k*(l - l0)", math("<mi>k</mi><mo>\u2062</mo><mrow><mo>(</mo><mi>l</mi><mo>−</mo>"
                              "<msub><mi>l</mi><mn>0</mn></msub><mo>)</mo></mrow>")},
          {"sqrt(1 + x)", math("<msqrt><mn>1</mn><mo>+</mo><mi>x</mi></msqrt>")},
          {"sin(2*x)^2", math("<mrow><msup><mi>sin</mi><mn>2</mn></msup><mo>\u2061</mo>"
                              "<mrow><mo>(</mo><mn>2</mn><mo>\u2062</mo><mi>x</mi><mo>)</mo></mrow></mrow>")},
          {"log(x)^2",
           math("<msup><mrow><mo>(</mo><mrow><mi>ln</mi><mo>\u2061</mo><mi>x</mi></mrow><mo>)</mo></mrow>"
                "<mn>2</mn></msup>")},
          {"exp(-x)", math("<msup><mi>e</mi><mrow><mo>−</mo><mi>x</mi></mrow></msup>")},
          {"x^(-b)", math("<msup><mi>x</mi><mrow><mo>−</mo><mi>b</mi></mrow></msup>")},
          {"abs(x)", math("<mrow><mo>|</mo><mi>x</mi><mo>|</mo></mrow>")},
          {"2*3^(1/3)",
           math("<mn>2</mn><mo>⋅</mo><msup><mn>3</mn><mfrac><mn>1</mn><mn>3</mn></mfrac></msup>")},
          {"1e-30", math("<mrow><mn>1</mn><mo>⋅</mo><msup><mn>10</mn><mrow><mo>−</mo><mn>30</mn></mrow></"
                         "msup></mrow>")},
      });
}

TEST(PrintSympy, IsPythonWithExactNumbers) {
  expect_rows(Form::sympy, {
                               {"3/4*m*x_dot^2", "Rational(3, 4)*m*x_dot**2"},
                               {"-x/2", "-Rational(1, 2)*x"},
                               {"9.81*m", "Rational(981, 100)*m"},
                               {"9.81*m/l", "Rational(981, 100)*m/l"},
                               {"b/(2*m)", "b/(2*m)"},
                               {"x^(1/3)", "x**Rational(1, 3)"},
                               {"x^-0.3", "1/x**Rational(3, 10)"},
                               {"(3/4)^(1/3)", "Rational(3, 4)**Rational(1, 3)"},
                               {"abs(x) + sign(x) + log(x) + asin(x)", "asin(x) + log(x) + Abs(x) + sign(x)"},
                               {"2*pi*lambda", "2*pi*lambda_"},
                               {"sqrt(g/l)", "sqrt(g/l)"},
                               {"0.30000000000000004", "Rational(7500000000000001, 25000000000000000)"},
                           });
}

TEST(PrintMaxima, HasItsOwnNames) {
  expect_rows(Form::maxima, {
                                {"3/4*m*x_dot^2", "3/4*m*x_dot^2"},
                                {"9.81*m/l", "981/100*m/l"},
                                {"2*pi*m", "2*%pi*m"},
                                {"x^(1/3)", "x^(1/3)"},
                                {"abs(x) + sign(x)", "abs(x) + signum(x)"},
                                {"1.5e-20*x", "3/200000000000000000000*x"},
                            });
}

TEST(PrintC, HasNoIntegerDivisionAndNoNeedlessPow) {
  expect_rows(Form::c, {
                           {"3/4*m*x_dot^2", "3.0/4.0*m*x_dot*x_dot"},
                           {"x^4 + x^5", "x*x*x*x + pow(x, 5.0)"},
                           {"1/x^2", "1.0/(x*x)"},
                           {"b/(2*m)", "b/(2.0*m)"},
                           {"sin(x)^2", "pow(sin(x), 2.0)"},
                           {"x^(1/3)", "pow(x, 1.0/3.0)"},
                           {"sqrt(g/l)", "sqrt(g/l)"},
                           {"abs(x)", "fabs(x)"},
                           {"sign(x + 1)", "(((1.0 + x) > 0) - ((1.0 + x) < 0))"},
                           {"pi*x", "3.141592653589793*x"},
                           {"double*x", "double_*x"},
                           {"9.81", "9.81"},
                           {"1e20*x", "1e+20*x"},
                       });
}

TEST(PrintForms, WriteAPowerWithASymbolAboveAsOne) {
  EXPECT_EQ(printed("k*x^b", Form::text), "k*x^b");
  EXPECT_EQ(printed("(x/l)^(-b/2)", Form::text), "(x/l)^(-1/2*b)");
  EXPECT_EQ(printed("sin(x)^b", Form::text), "sin(x)^b");
  EXPECT_EQ(printed("x^b", Form::sympy), "x**b");
  EXPECT_EQ(printed("(1 + x)^(-b)", Form::c), "pow(1.0 + x, -b)");
  EXPECT_EQ(printed("k*(x/l)^b", Form::latex), R"(k \left(\frac{x}{l}\right)^{b})");
  EXPECT_EQ(printed("sin(x)^b", Form::latex), R"(\left(\sin x\right)^{b})");
  EXPECT_EQ(printed("exp(2*log(x))", Form::text), "exp(2*log(x))");  // not for x < 0, as x^2
}

TEST(PrintForms, EachHasANameOfItsOwn) {
  std::set<std::string_view> found;
  for (const PrintForm& form : print_forms()) EXPECT_TRUE(found.insert(form.name).second) << form.name;
  EXPECT_GE(found.size(), 6U);
}

TEST(PrintForms, EachWritesEquationsInItsOwnWay) {
  Graph graph;
  const Expression left = parse("2*g", graph, names), right = parse("k", graph, names);
  const auto equation = [&](Form form) { return print_equation(left, right, form, notation); };
  EXPECT_EQ(equation(Form::text), "2*g = k");
  EXPECT_EQ(equation(Form::latex), "2 g = k");
  EXPECT_EQ(equation(Form::maxima), "2*g = k");
  EXPECT_EQ(equation(Form::sympy), "Eq(2*g, k)");
  EXPECT_EQ(equation(Form::c), "2.0*g == k");
  const std::string math = equation(Form::mathml);
  EXPECT_TRUE(math.ends_with("<mi>g</mi></mrow><mo>=</mo><mrow><mi>k</mi></mrow></math>")) << math;
  EXPECT_EQ(math.find("<math"), math.rfind("<math"));
}

TEST(Notation, TakesNamesApart) {
  const auto latex = [](std::string_view name) { return latex_name(name, {}); };
  EXPECT_EQ(latex("theta"), R"(\theta)");
  EXPECT_EQ(latex("Omega"), R"(\Omega)");
  EXPECT_EQ(latex("l0"), "l_0");
  EXPECT_EQ(latex("omega0"), R"(\omega_0)");
  EXPECT_EQ(latex("theta_dot"), R"(\dot\theta)");
  EXPECT_EQ(latex("theta_ddot"), R"(\ddot\theta)");
  EXPECT_EQ(latex("x_dot"), R"(\dot{x})");
  EXPECT_EQ(latex("p_theta"), R"(p_\theta)");
  EXPECT_EQ(latex("theta1_dot"), R"(\dot\theta_1)");
  EXPECT_EQ(latex("x12"), "x_{12}");
  EXPECT_EQ(latex("m_foot"), R"(m_{\mathrm{foot}})");
  EXPECT_EQ(latex("m_foot_1"), R"(m_{\mathrm{foot},1})");
  EXPECT_EQ(latex("mu_hat"), R"(\hat\mu)");
  EXPECT_EQ(latex("x_hat_dot"), R"(\dot{\hat{x}})");
  EXPECT_EQ(latex("mass"), R"(\mathrm{mass})");
  EXPECT_EQ(mathml_name("p_theta"), "<msub><mi>p</mi><mi>θ</mi></msub>");
  EXPECT_EQ(mathml_name("theta1_dot"),
            "<msub><mover accent=\"true\"><mi>θ</mi><mo>˙</mo></mover><mn>1</mn></msub>");
  EXPECT_EQ(mathml_name("m_foot_1"), "<msub><mi>m</mi><mrow><mi>foot</mi><mo>,</mo><mn>1</mn></mrow></msub>");
}

TEST(Notation, ASceneMayGiveTheLatexOfAName) {
  const Notation given{
      {}, {"theta", "s", "z"}, {{"theta", "\\theta_1"}, {"s", "\\ell"}, {"z", "\\tilde{z_1}"}}};
  EXPECT_EQ(latex_name("theta", given), R"(\theta_1)");
  EXPECT_EQ(latex_name("theta_dot", given), R"(\dot\theta_1)");
  EXPECT_EQ(latex_name("s_ddot", given), R"(\ddot\ell)");
  EXPECT_EQ(latex_name("p_s", given), R"(p_\ell)");
  EXPECT_EQ(latex_name("p_theta", given), R"(p_{\theta_1})");
  EXPECT_EQ(latex_name("z_dot", given), R"(\dot{\tilde{z_1}})");
}

TEST(Notation, KnowsRolesByNameAndDeclaration) {
  const Notation roles{{"m", "g"}, {"x", "theta"}, {}};
  EXPECT_EQ(place_of("g", roles), (Place{Role::parameter, 1}));
  EXPECT_EQ(place_of("theta", roles), (Place{Role::coordinate, 1}));
  EXPECT_EQ(place_of("theta_dot", roles), (Place{Role::velocity, 1}));
  EXPECT_EQ(place_of("p_theta", roles), (Place{Role::velocity, 1}));
  EXPECT_EQ(place_of("x_ddot", roles), (Place{Role::acceleration, 0}));
  EXPECT_EQ(place_of("t", roles).role, Role::other);
  EXPECT_EQ(place_of("p_foot", roles).role, Role::other);
  EXPECT_EQ(place_of("pi", roles).role, Role::constant);
}

TEST(PrintForms, LargeAndSmallNumbersAreWrittenExactly) {
  Graph graph;
  const auto written = [&](const std::string& text, Form form) {
    return print(parse(text, graph, names), form);
  };
  for (const Form form : {Form::text, Form::sympy, Form::maxima, Form::latex})
    EXPECT_EQ(written("0", form), "0");
  EXPECT_EQ(written("0", Form::c), "0.0");
  EXPECT_EQ(written("6.02e23", Form::text), "6.02e+23");
  EXPECT_EQ(written("6.02e23", Form::c), "6.02e+23");
  EXPECT_EQ(written("6.02e23", Form::sympy), "602000000000000000000000");
  EXPECT_EQ(written("6.02e23", Form::latex), "6.02 \\cdot 10^{23}");
  EXPECT_EQ(written("1.602e-19", Form::text), "1.602e-19");
  EXPECT_EQ(written("2^-3*10^-18", Form::sympy), "Rational(1, 8000000000000000000)");
  EXPECT_EQ(written("0.10000000000000001", Form::text), "0.10000000000000001");
  EXPECT_EQ(written("1/3e20", Form::text), "1/3e+20");
}

}  // namespace
}  // namespace qdot::forms_test
