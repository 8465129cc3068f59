// Motions in double-doubles against values of twenty digits computed by another program
// (tests/reference/*.json), and what they tell of doubles.

#include "core/motion/extended_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include "core/expr/number.hpp"
#include "tests/support/files.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

using api::Json;
using Form = ExtendedMotionRequest::Form;

/// Of a number that a file has with twenty digits.
constexpr double written_to = 5.1e-20;
constexpr double made_by_rounding = 1e-29;

/// The text of a JSON file with its numbers as strings: their digits are more than a double keeps.
std::string with_quoted_numbers(const std::string& text) {
  std::string result;
  bool in_string = false, in_number = false;
  for (const char c : text) {
    const bool belongs_to_number =
        !in_string && (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' ||
                       (in_number && (c == '.' || c == 'e' || c == 'E' || c == '+')));
    if (belongs_to_number != in_number) result += '"';
    in_number = belongs_to_number;
    if (c == '"') in_string = !in_string;  // no file has a quote in a string
    result += c;
  }
  return result;
}

Json reference_file(const std::string& system) {
  std::ifstream file(QDOT_SOURCE_DIR "/tests/reference/" + system + ".json");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return Json::parse(with_quoted_numbers(text));
}

Real real_of(const Json& decimal) {
  const std::string text = decimal.get<std::string>();
  const bool negative = text.starts_with('-');
  const Number size = Number::written(text.substr(negative ? 1 : 0)).value();
  return (negative ? Number(0) - size : size).rounded();
}

struct Case {
  std::string id;
  Json json;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.id; }

std::vector<Case> trajectories() {
  std::vector<Case> found;
  for (const std::string& system : test::practice_systems()) {
    const Json file = reference_file(system);
    for (const Json& json : file.at("cases")) {
      if (json.at("quantity") == "trajectory") found.push_back({json.at("id"), json});
    }
  }
  return found;
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  std::string name = "problem_" + info.param.id;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// The double next to a decimal, with all the digits that it has.
std::string double_as_text(const Json& decimal) {
  char digits[80];
  std::snprintf(digits, sizeof digits, "%.60g", real_of(decimal).value);
  return digits;
}

std::vector<std::string> inputs_in(const Json& json) {
  if (!json.contains("force")) return {};
  const Json& force = json.at("force");
  const std::string amplitude = double_as_text(force.at("amplitude"));
  if (force.at("type") == "constant") return {amplitude};
  return {amplitude + "*cos(" + double_as_text(force.at("omega")) + "*t + " +
          double_as_text(force.at("phase")) + ")"};
}

/// The files' motions start from the doubles next to their decimals.
ExtendedMotionRequest request_of(const Json& json, const Model& model, Form form) {
  Values given;
  for (const char* group : {"parameters", "initial"}) {
    for (const auto& [name, value] : json.at(group).items()) given[name] = real_of(value).value;
  }
  const Reals parameters = parameter_values(model, given);
  ExtendedMotionRequest extended =
      extended_request(parameters, initial_state(model, parameters, given), 0, {});
  for (const Json& t : json.at("times")) extended.grid.push_back(real_of(t).value);
  extended.form = form;
  return extended;
}

class ExtendedReference : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Files, ExtendedReference, testing::ValuesIn(trajectories()), case_name);

/// Every number within `written` of its size and `made` times the file's amplification of errors.
void expect_followed(const Json& json, Form form, double written, double made) {
  const auto model = test::model_of(json.at("system"));
  const Dynamics dynamics(model, inputs_in(json));
  const ExtendedRun run = extended_states(dynamics, request_of(json, *model, form));
  const std::size_t n = model->degrees_of_freedom();
  ASSERT_EQ(run.rows, json.at("times").size());
  for (std::size_t i = 0; i < run.rows; ++i) {
    const double amplification = std::max(1.0, real_of(json.at("amplification")[i]).value);
    for (std::size_t k = 0; k < 2 * n; ++k) {
      const std::string name = model->scene.coordinates[k % n].name + (k < n ? "" : "_dot");
      const DoubleDouble expected = real_of(json.at("expected").at(name)[i]).double_double();
      const double allowed = written * std::abs(expected.high) + made * amplification;
      EXPECT_LE(std::abs((run.states[2 * n * i + k] - expected).high), allowed) << name << i;
    }
  }
}

TEST_P(ExtendedReference, IsMetToTheTwentyDigitsThatAreWritten) {
  expect_followed(GetParam().json, Form::full, written_to, made_by_rounding);
}

TEST_P(ExtendedReference, IsMetInMixedFormFarBelowTheRoundOffOfDoubles) {
  expect_followed(GetParam().json, Form::mixed, written_to, 1e-17);
}

TEST(ExtendedMotion, StartsFromTheDecimalsThatWereTyped) {
  const auto model = test::model_of("plane_pendulum");
  const auto real = [](const char* decimal) { return Number::written(decimal)->rounded(); };
  const RealValues given{{"m", 1.0},
                         {"l", real("0.7")},
                         {"g", real("9.81")},
                         {"theta", real("1.1")},
                         {"theta_dot", real("0.3")}};
  const Reals parameters = parameter_values(*model, given);
  ExtendedMotionRequest request =
      extended_request(parameters, initial_state(*model, parameters, given), 0, {});
  request.grid.push_back(real("7.3").double_double());
  request.form = Form::full;
  const ExtendedRun run = extended_states(Dynamics(model), request);
  ASSERT_EQ(run.rows, 1u);
  // By mpmath with 45 digits, series of orders 50 and 60.
  EXPECT_LE(std::abs((run.states[0] - real("1.102607563344723785776242952123083").double_double()).high),
            1e-28);
  EXPECT_LE(std::abs((run.states[1] + real("0.1575494357689143364110118146665223").double_double()).high),
            1e-28);
}

/// The largest difference of two runs' coordinates and velocities at row i.
double difference_at(const ExtendedRun& a, const ExtendedRun& b, std::size_t i) {
  const std::size_t width = a.y.size();
  double largest = 0;
  for (std::size_t k = i * width; k < (i + 1) * width; ++k) {
    largest = std::max(largest, std::abs((a.states[k] - b.states[k]).high));
  }
  return largest;
}

ExtendedMotionRequest wild_rods(double t_end, Form form) {
  const auto model = test::model_of("rod_pendulum");
  const SimulationRequest doubles =
      test::request_for(*model, {{"theta", 2.5}, {"phi", 2.9}}, test::instants(t_end, 60));
  ExtendedMotionRequest request = extended_request(doubles.parameters, doubles.y_start, 0, doubles.grid);
  request.form = form;
  return request;
}

TEST(ExtendedMotion, TellsWhatRoundingDidToARunInDoubles) {
  const auto model = test::model_of("rod_pendulum");
  const Dynamics dynamics(model);
  SimulationRequest request =
      test::request_for(*model, {{"theta", 0.5}, {"phi", -0.3}}, test::instants(20, 40));
  request.method = Method::taylor;
  request.tolerances = {1e-14, 1e-17};
  const Simulation motion = simulate(dynamics, request);
  ExtendedMotionRequest extended = extended_request(request.parameters, request.y_start, 0, request.grid);
  const ExtendedRun mixed = extended_states(dynamics, extended);
  extended.form = Form::full;
  const ExtendedRun full = extended_states(dynamics, extended);
  double by_mixed = 0, by_full = 0, largest = 0;
  for (std::size_t i = 0; i < motion.states.size(); ++i) {
    largest = std::max(largest, std::abs(motion.states[i]));
    by_mixed = std::max(by_mixed, std::abs((mixed.states[i] - DoubleDouble(motion.states[i])).high));
    by_full = std::max(by_full, std::abs((full.states[i] - DoubleDouble(motion.states[i])).high));
  }
  EXPECT_GT(by_full, 1e-16);
  EXPECT_LT(by_full, 1e-11);
  EXPECT_NEAR(by_mixed, by_full, 0x1p-53 * largest);  // half a last digit of a state
}

/// sin(theta) is left of two numbers near 3 there, and a double of it has lost most of its digits.
TEST(ExtendedMotion, TellsWhatRoundingDidNearAnEquilibrium) {
  const auto model = test::model_of("plane_pendulum");
  const Dynamics dynamics(model);
  const Values nearly_upright{{"m", 1}, {"l", 1.25}, {"g", 24}, {"theta", 3.141592653527967}};
  const SimulationRequest request = test::request_for(*model, nearly_upright, test::instants(1.675, 64));
  ExtendedMotionRequest extended = extended_request(request.parameters, request.y_start, 0, request.grid);
  const ExtendedRun mixed = extended_states(dynamics, extended);
  extended.form = Form::full;
  const ExtendedRun full = extended_states(dynamics, extended);
  ASSERT_EQ(full.rows, 65u);
  for (std::size_t i = 0; i < full.rows; ++i) EXPECT_LT(difference_at(mixed, full, i), 2e-16) << i;
}

TEST(ExtendedMotion, IsGoodForTwiceTheTimeThatDoublesAre) {
  const auto model = test::model_of("rod_pendulum");
  const Dynamics dynamics(model);
  constexpr double t_end = 60;
  const ExtendedRun mixed = extended_states(dynamics, wild_rods(t_end, Form::mixed));
  ExtendedMotionRequest request = wild_rods(t_end, Form::full);
  const ExtendedRun full = extended_states(dynamics, request);
  request.taylor_order = 30;
  for (DoubleDouble& y : request.y_start) y = y * DoubleDouble(1, 1e-32);
  const ExtendedRun other = extended_states(dynamics, request);
  ASSERT_EQ(full.rows, 61u);
  constexpr double lost = 1e-3;
  const auto first_lost = [&](const ExtendedRun& a, const ExtendedRun& b) {
    for (std::size_t i = 0; i < a.rows; ++i) {
      if (difference_at(a, b, i) > lost) return i;
    }
    return a.rows;
  };
  EXPECT_GT(first_lost(full, other), 1.6 * first_lost(full, mixed));
}

}  // namespace
}  // namespace qdot
