// The reference is what it says: its series are those of known functions, its two orders agree, and it meets
// the files that another program computed.

#include "tests/calibration/quad_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/calibration/requests.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::test {
namespace {

constexpr double agreement = 1e-25;

double magnitude(Quad value) { return std::abs(static_cast<double>(value)); }

TEST(QuadSeries, HasTheCoefficientsOfKnownFunctions) {
  Recording<Quad> recording(20);
  const Series<Quad> t = recording.input();
  const Series<Quad> exponential = exp(t), wave = sin(t) * cos(t), geometric = exponential / (Quad(1) - t);
  recording.coefficients(t)[1] = 1;
  for (unsigned k = 0; k <= 20; ++k) recording.advance(k);
  Quad factorial = 1, sum = 0, power = 1;
  for (unsigned k = 0; k <= 20; ++k) {
    if (k > 0) factorial *= k;
    sum += 1 / factorial;
    EXPECT_LE(magnitude(recording.coefficients(exponential)[k] - 1 / factorial), 1e-33);
    EXPECT_LE(magnitude(recording.coefficients(geometric)[k] - sum), 1e-32);  // e^t / (1 - t)
    const Quad expected = k % 2 == 0 ? Quad(0) : power / factorial / 2;       // sin(2 t)/2
    EXPECT_LE(magnitude(recording.coefficients(wave)[k] - expected), 1e-32) << k;
    power *= k % 2 == 0 ? Quad(2) : Quad(-2);
  }
}

/// The problem that a case of tests/reference states.
QuadProblem problem_in(const api::Json& json) {
  const auto model = model_of(json.at("system"));
  Values given;
  for (const char* group : {"parameters", "initial"}) {
    for (const auto& [name, value] : json.at(group).items()) given[name] = value;
  }
  QuadProblem problem;
  problem.system = json.at("system");
  const std::vector<double> parameters = parameter_values(*model, given);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    problem.parameters.emplace_back(model->scene.parameters[i].name, parameters[i]);
  }
  problem.y_start = initial_state(*model, parameters, given);
  problem.grid = {0};
  for (const api::Json& t : json.at("times")) problem.grid.push_back(t);
  if (json.contains("force")) {
    const api::Json& force = json.at("force");
    problem.force.amplitude = force.at("amplitude");
    if (force.at("type") != "constant") {
      problem.force.frequency = force.at("omega");
      problem.force.phase = force.at("phase");
    }
  }
  return problem;
}

TEST(QuadReference, MeetsTheFilesOfAnotherProgram) {
  // The files took the decimals of the parameters, the reference their doubles.
  constexpr double rounding_of_parameters = 4e-15;
  int cases = 0;
  for (const std::string& system : practice_systems()) {
    const api::Json file = json_file("tests/reference/" + system + ".json");
    for (const api::Json& json : file.at("cases")) {
      if (json.at("quantity") != "trajectory") continue;
      const QuadProblem problem = problem_in(json);
      const Reference<Quad> reference = quad_reference(problem, 100'000);
      ASSERT_EQ(reference.motion.rows, problem.grid.size()) << json.at("id");
      const auto model = model_of(system);
      const std::size_t n = model->degrees_of_freedom();
      for (std::size_t i = 1; i < problem.grid.size(); ++i) {
        const double amplification = std::max(1.0, json.at("amplification")[i - 1].get<double>());
        for (std::size_t k = 0; k < 2 * n; ++k) {
          const std::string name = model->scene.coordinates[k % n].name + (k < n ? "" : "_dot");
          const double expected = json.at("expected").at(name)[i - 1];
          const double value = static_cast<double>(reference.value(i * 2 * n + k));
          const double size = std::max(1.0, std::abs(expected));
          EXPECT_NEAR(value, expected, rounding_of_parameters * size * amplification)
              << json.at("id") << name;
          EXPECT_LE(reference.doubt[i * 2 * n + k], agreement * size * amplification)
              << json.at("id") << name;
        }
      }
      ++cases;
    }
  }
  EXPECT_GE(cases, 11);
}

/// What the quick one's two motions differ by tells what each of them is off by.
TEST(QuickReference, IsAsFarOffAsItSays) {
  constexpr std::uint64_t steps = 300;
  // It is taken where its doubt is a thousandth of a stated error at most: 3 % of that error then.
  constexpr double times_doubt = 30, last_digits_of_long = 1e-18;
  int compared = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const QuadProblem problem = random_request(4, i).problem();
    const Reference<Long> quick = quick_reference(problem, steps);
    if (quick.motion.rows < problem.grid.size()) continue;
    const PreciseMotion<Quad> motion = precise_motion<Quad>(problem, {38, 1e-30, steps});
    const std::size_t width = problem.y_start.size();
    std::vector<double> doubt(width), scale(width);
    for (std::size_t place = 0; place < motion.rows * width; ++place) {
      const std::size_t k = place % width;
      doubt[k] = std::max(doubt[k], quick.doubt[place]);
      scale[k] = std::max(scale[k], magnitude(motion.state[place]));
      const double off = magnitude(motion.state[place] - Quad(quick.value(place)));
      EXPECT_LE(off, times_doubt * doubt[k] + last_digits_of_long * scale[k]) << i << ' ' << place;
    }
    ++compared;
  }
  EXPECT_GE(compared, 15);
}

/// x'' = -x + |cos t|, from rest: a closed form up to the second kink.
TEST(QuadReference, GoesOverKinks) {
  QuadProblem problem{"damped_oscillator", {{"m", 1}, {"b", 0}, {"k", 1}}, {0, 0}, 0, {0, 1, 3}, {}, false};
  problem.force = {1, 0, 1, 0, true};
  const Reference<Quad> reference = quad_reference(problem, 1000);
  const double half = std::numbers::pi / 2;
  // t sin(t)/2 before the kink; beyond, -t sin(t)/2 and a free oscillation that fits x and x' there.
  EXPECT_NEAR(static_cast<double>(reference.value(2)), std::sin(1) / 2, 1e-16);
  const double x = -3 * std::sin(3) / 2 + half * std::sin(3) - std::cos(3);
  EXPECT_NEAR(static_cast<double>(reference.value(4)), x, 1e-15);
  EXPECT_LE(reference.doubt[4], agreement);
}

}  // namespace
}  // namespace qdot::test
