#include "core/grading/student_parser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/expr/print/print.hpp"
#include "core/grading/expected_system.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::test {
namespace {

using testing::HasSubstr;

/// Reads submissions about one system of the catalogue.
class Reader {
 public:
  explicit Reader(const std::string& system)
      : model_(model_of(system)), system_(*model_), vocabulary_(system_.symbols(), system_.momenta()) {
    vocabulary_.mark_angle(system_.symbols().coordinates.value.back());
  }

  ReadSubmission read(const std::string& text) { return read_submission(text, system_.graph(), vocabulary_); }

  /// The one formula or equation as text; what went wrong in brackets.
  std::string operator()(const std::string& text) {
    const ReadSubmission read = this->read(text);
    if (!read.errors.empty()) return "[" + read.errors.front() + "]";
    const ReadEquation& first = read.equations.front();
    return first.right ? print_equation(first.left, *first.right, Form::text) : print(first.left, Form::text);
  }

  Vocabulary& vocabulary() { return vocabulary_; }

 private:
  std::shared_ptr<const Model> model_;
  ExpectedSystem system_;
  Vocabulary vocabulary_;
};

Reader pendulum() { return Reader("spring_pendulum"); }  // l, theta; m, k, l0, g

/// Each line says the same thing.
void expect_same(Reader reader, const std::vector<std::string>& texts) {
  const std::string first = reader(texts.front());
  EXPECT_NE(first.front(), '[') << first;
  for (const std::string& text : texts) EXPECT_EQ(reader(text), first) << text;
}

TEST(StudentParser, KnowsAccelerationsInEverySpelling) {
  expect_same(pendulum(), {"theta_ddot",
                           "theta''",
                           "θ''",
                           "θ̈",
                           "θ″",
                           "\\ddot{\\theta}",
                           "\\ddot\\theta",
                           "$\\ddot{\\theta}$",
                           "thetadd",
                           "theta_dd",
                           "thetaddot",
                           "d^2theta/dt^2",
                           "d2theta/dt2",
                           "d^2 theta / dt^2",
                           "\\frac{d^2\\theta}{dt^2}",
                           "\\frac{\\mathrm{d}^2\\theta}{\\mathrm{d}t^2}",
                           "diff(theta, t, t)",
                           "diff(theta,t,2)",
                           "Derivative(theta(t), (t, 2))",
                           "d/dt(theta')",
                           "theta(t)''",
                           "theta''(t)",
                           "d²θ/dt²",
                           "ddtheta",
                           "d(theta')/dt",
                           "(theta)''",
                           "\\ddot{\\theta}(t)",
                           "ddot(theta)",
                           "\\frac{d}{dt}\\dot\\theta",
                           "dot(theta_dot)"});
}

TEST(StudentParser, KnowsVelocities) {
  expect_same(pendulum(), {"l_dot^2", "l'^2", "ldot^2", "l_d^2", "(dl/dt)^2", "\\dot l^2", "\\dot{l}^{2}",
                           "l̇²", "\\left(\\frac{dl}{dt}\\right)^2", "Derivative(l(t), t)**2"});
}

TEST(StudentParser, ReadsProductsWithoutSigns) {
  expect_same(pendulum(), {"m*g*l*cos(theta)", "mgl cos(theta)", "m g l cos theta", "mglcos(theta)",
                           "mgl\\cos\\theta", "m·g·l·cos θ", "mglcosθ", "m g l\\cos\\left(\\theta\\right)",
                           "cos(theta)mgl", "m (g l) Cos[theta]", "l*m*g*\\cos{\\theta}"});
}

TEST(StudentParser, ReadsFractionsFromLeftToRight) {
  expect_same(pendulum(),
              {"m*l_dot^2/2", "1/2 m l'^2", "\\frac12 m\\dot l^2", "\\frac{1}{2}m\\dot{l}^2", "½ m l'^2",
               "0.5 m l'^2", "1/2m*l'^2", "m/2 l'^2", "\\tfrac{m\\dot l^2}{2}", "m l'**2 * (1/2)"});
}

TEST(StudentParser, ReadsArgumentsWithoutBrackets) {
  expect_same(pendulum(), {"sin(2*theta)", "sin 2theta", "\\sin 2\\theta", "sin(2θ)", "\\sin{2\\theta}"});
  expect_same(pendulum(), {"g*sin(theta)", "g sin(theta(t))", "g sin theta(t)", "g\\sin\\theta(t)"});
  expect_same(pendulum(), {"sin(theta)^2*cos(theta)", "sin^2 theta cos theta", "\\sin^2\\theta\\cos\\theta",
                           "sin²θ cosθ", "sin(theta)**2cos(theta)", "\\sin^{2}(\\theta)\\cos\\theta"});
  expect_same(pendulum(), {"cos(theta)*theta_ddot", "\\cos\\theta\\,\\ddot\\theta", "cos theta theta''"});
  expect_same(Reader("rolling_disk_platform"),
              {"g*sin(Omega*t)", "g sin Omega t", "g\\sin\\Omega t", "g sin(Ωt)"});
  expect_same(pendulum(), {"g*sin(theta)/l", "g sin theta / l", "g/l sin θ", "\\frac{g}{l}\\sin\\theta"});
}

TEST(StudentParser, ReadsNamesWithIndices) {
  expect_same(pendulum(), {"k*(l - l0)", "k(l-l_0)", "k(l-l_{0})", "k\\left(l-l_0\\right)", "k (l − l₀)"});
  expect_same(Reader("orbiting_pendulum"),
              {"omega0^2", "\\omega_0^2", "ω₀²", "omega_0^2", "\\omega_{0}^{2}"});
}

TEST(StudentParser, ReadsEquations) {
  expect_same(pendulum(), {"m*l_ddot = m*g*cos(theta)", "m l'' = mg cos(theta)", "Eq(m*l'', m*g*cos(theta))",
                           "m\\ddot l &= mg\\cos\\theta \\\\", "m l''\n  = mg cos theta"});
  EXPECT_EQ(pendulum().read("l'' = 1\ntheta'' = 2; ").equations.size(), 2U);
}

TEST(StudentParser, TakesTheTeachersWords) {
  Reader reader("rotating_l_bar");
  EXPECT_THAT(reader("w^2"), HasSubstr("unknown symbol 'w'"));
  ASSERT_TRUE(reader.vocabulary().add("w", "Omega"));
  ASSERT_TRUE(reader.vocabulary().add("q1", "theta"));
  EXPECT_FALSE(reader.vocabulary().add("q2", "nothing"));
  EXPECT_EQ(reader("w^2 q1''"), reader("Omega^2 theta''"));
}

TEST(StudentParser, RefusesWhatHasTwoReadings) {
  for (const char* text : {"g/2l", "g/ml", "p_l^2/2m", "sin theta^2", "sin theta/2", "\\sin\\theta/2",
                           "sin^-1(theta)", "m^1/2", "sin 2*theta", "\\cos m k", "k/l^2m", "\\dot l / 2 m",
                           "g \\sin{\\theta} / l m", "\\dot{l} / l^{2} m"}) {
    EXPECT_EQ(pendulum()(text).front(), '[') << text << " is read as " << pendulum()(text);
  }
}

TEST(StudentParser, KnowsAccelerationsOfOtherPrograms) {
  expect_same(pendulum(),
              {"theta_ddot", "theta\"", "theta``", "theta_tt", "theta_double_dot", "thetadoubledot",
               "\\theta^{\\prime\\prime}", "D[theta[t],{t,2}]", "'diff(theta,t,2)", "d/dt(theta_t)"});
}

TEST(StudentParser, TakesNumbersAndNamesOfEquationsForLabels) {
  const std::string first = "l'' = g", second = "l theta'' = 0";
  for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{
           {"", ""}, {"(1) ", "(2) "}, {"1) ", "2) "}, {"1. ", "2. "}, {"a) ", "b) "}, {"l: ", "theta: "}}) {
    Reader reader = pendulum();
    const ReadSubmission read = reader.read(a + first + "\n" + b + second);
    ASSERT_EQ(read.equations.size(), 2U) << a;
    EXPECT_EQ(print_equation(read.equations[1].left, *read.equations[1].right, Form::text),
              "l*theta_ddot = 0")
        << b;
  }
  Reader reader = pendulum();
  const ReadSubmission behind = reader.read("l'' = -k l (1)\nl theta'' = -g theta (2)");
  EXPECT_EQ(print(*behind.equations[1].right, Form::text), "-g*theta");
  EXPECT_EQ(pendulum()("l'' = (2) g"), "l_ddot = 2*g") << "no label: there is no first";
  EXPECT_EQ(reader.read("l'' = g and\nl theta'' = 0.").equations.size(), 2U);
  EXPECT_EQ(reader.read("l'' = g \\tag{1} \\\\[4pt] l\\ddot\\theta = 0 \\tag{2}").equations.size(), 2U);
}

TEST(StudentParser, DividesAFunctionOfAnAngleByWhatIsNoNumber) {
  EXPECT_EQ(pendulum()("sin theta/(l + l0)"), pendulum()("sin(theta)/(l + l0)"));
  EXPECT_THAT(pendulum()("sin theta/(2)"), HasSubstr("brackets around the argument"));
  EXPECT_THAT(pendulum()("sin2theta"), HasSubstr("two readings"));
}

TEST(StudentParser, HasNoRatesOfAccelerations) {
  EXPECT_THAT(pendulum()("d/dt(l theta'')"), HasSubstr("up to the second"));
  EXPECT_THAT(pendulum()("(l' theta'')'"), HasSubstr("up to the second"));
}

TEST(StudentParser, SaysWhatItCannotRead) {
  EXPECT_THAT(pendulum()("m +"), HasSubstr("ends where"));
  EXPECT_THAT(pendulum()("(m"), HasSubstr("not closed"));
  EXPECT_THAT(pendulum()("m)"), HasSubstr("opening bracket"));
  EXPECT_THAT(pendulum()("0,5 m"), HasSubstr("a decimal has a point"));
  EXPECT_THAT(pendulum()("l/0"), HasSubstr("division by zero"));
  EXPECT_THAT(pendulum()("\\foo"), HasSubstr("\\foo"));
  EXPECT_THAT(pendulum()("m'"), HasSubstr("up to the second"));
  EXPECT_THAT(pendulum()("theta'''"), HasSubstr("up to the second"));
  EXPECT_THAT(pendulum()("m = 1 = 2"), HasSubstr("two equals"));
  EXPECT_THAT(pendulum()("q"), HasSubstr("there are l, theta, m, k, l0, g, p_l, p_theta, t"));
  EXPECT_THAT(pendulum()("м"), HasSubstr("character"));  // Cyrillic
  EXPECT_THAT(pendulum()("\xff\xfe"), HasSubstr("UTF-8"));
  EXPECT_THAT(pendulum()(""), HasSubstr("no formula"));
}

TEST(StudentParser, IsBounded) {
  const auto many = [](const std::string& part, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += part;
    return text;
  };
  EXPECT_THAT(pendulum()(many("(", 1000)), HasSubstr("deep"));
  EXPECT_THAT(pendulum()(many("{", 1000)), HasSubstr("deep"));
  EXPECT_THAT(pendulum()(many("\\frac", 800)), HasSubstr("argument"));
  EXPECT_THAT(pendulum()(many("1+", 1500) + "1"), HasSubstr("2000 parts"));
  EXPECT_THAT(pendulum()(many("m", 5000)), HasSubstr("4096 bytes"));
  EXPECT_THAT(pendulum()("9^9^9^9"), HasSubstr("exponent"));
  EXPECT_THAT(pendulum()(many("sin(", 100) + "l" + many(")", 100)), HasSubstr("deep"));
  EXPECT_THAT(pendulum()(many("m^", 200) + "1"), HasSubstr("deep"));
}

}  // namespace
}  // namespace qdot::test
