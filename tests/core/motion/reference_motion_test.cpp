// Motions, energies and momenta of the practice systems against values computed to twenty digits by another
// program (tests/reference/*.json).

#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "tests/support/files.hpp"
#include "tests/support/motions.hpp"

namespace qdot::reference_motion_test {
namespace {

using api::Json;

/// A motion's error is what is made on the way times what the system makes of it: `amplification` in the
/// files, max |dx_i(t)/dx_j(0)|. Promised is 1e-8; the best method makes 1e-11 in these times.
constexpr double made_on_the_way = 1e-10;
constexpr double made_by_round_off = 2e-15;
constexpr double conserved_drift = 1e-8;
/// Of the sizes of T and V at one state: a few roundings.
constexpr double at_one_state = 1e-14;

struct Case {
  std::string id;
  Json json;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.id; }

std::vector<Case> cases_about(const std::vector<std::string>& quantities) {
  std::vector<Case> found;
  for (const std::string& system : test::practice_systems()) {
    const Json file = test::json_file("tests/reference/" + system + ".json");
    for (const Json& json : file.at("cases")) {
      const bool wanted =
          std::find(quantities.begin(), quantities.end(), json.at("quantity")) != quantities.end();
      if (wanted) found.push_back({json.at("id"), json});
    }
  }
  return found;
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  std::string name = "problem_" + info.param.id;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Parameters and initial values of a case.
Values given_in(const Json& json) {
  Values given;
  for (const char* group : {"parameters", "initial"}) {
    for (const auto& [name, value] : json.at(group).items()) given[name] = value;
  }
  return given;
}

std::string text(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.17g", value);
  return digits;
}

/// The inputs of a case: F as an expression in t.
std::vector<std::string> inputs_in(const Json& json) {
  if (!json.contains("force")) return {};
  const Json& force = json.at("force");
  const std::string amplitude = text(force.at("amplitude"));
  if (force.at("type") == "constant") return {amplitude};
  return {amplitude + "*cos(" + text(force.at("omega")) + "*t + " + text(force.at("phase")) + ")"};
}

class ReferenceMotion : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Files, ReferenceMotion, testing::ValuesIn(cases_about({"trajectory"})), case_name);

/// The motion that a file is about, asked for at the file's instants.
Simulation reference_motion(const Json& json, Method method, const Tolerances& tolerances) {
  const auto model = test::model_of(json.at("system"));
  std::vector<double> grid{0};
  for (const Json& t : json.at("times")) grid.push_back(t);
  SimulationRequest request = test::request_for(*model, given_in(json), grid);
  request.on_invalid = OnInvalid::go_on;  // some files follow the ideal constraint on purpose
  request.impacts = Impacts::ignore;
  request.method = method;
  request.tolerances = tolerances;
  return simulate(Dynamics(model, inputs_in(json)), request);
}

/// Errors made on the way grow by the file's amplification.
void expect_followed(const Json& json, const Simulation& motion, double error) {
  const auto model = test::model_of(json.at("system"));
  const std::size_t n = model->degrees_of_freedom();
  ASSERT_EQ(motion.rows, json.at("times").size() + 1);
  for (std::size_t i = 1; i < motion.rows; ++i) {
    const double tolerance = error * std::max(1.0, json.at("amplification")[i - 1].get<double>());
    for (std::size_t k = 0; k < n; ++k) {
      const std::string q = model->scene.coordinates[k].name;
      EXPECT_NEAR(test::row(motion, i)[k], json.at("expected").at(q)[i - 1], tolerance) << q << i;
      EXPECT_NEAR(test::row(motion, i)[n + k], json.at("expected").at(q + "_dot")[i - 1], tolerance)
          << q << i;
    }
  }
}

TEST_P(ReferenceMotion, IsFollowedByTaylorToRoundOff) {
  const Json& json = GetParam().json;
  expect_followed(json, reference_motion(json, Method::taylor, {1e-14, 1e-17}), made_by_round_off);
}

TEST_P(ReferenceMotion, IsFollowed) {
  const Json& json = GetParam().json;
  const Simulation motion = reference_motion(json, test::best_method, test::best_tolerances);
  expect_followed(json, motion, made_on_the_way);
  for (const ConservedRecord& record : motion.conserved)
    EXPECT_LE(record.max_abs_drift, conserved_drift * std::max(1.0, std::abs(record.initial))) << record.name;
}

class ReferenceValues : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Files, ReferenceValues, testing::ValuesIn(cases_about({"energy", "momenta"})),
                         case_name);

TEST_P(ReferenceValues, AreFound) {
  const Json& json = GetParam().json;
  const auto model = test::model_of(json.at("system"));
  const Dynamics dynamics(model, inputs_in(json));
  std::vector<Column> columns{{"lagrangian", "J", model->lagrangian.lagrangian}};
  for (const auto& group : {test::energy_columns(*model), momentum_columns(*model),
                            acceleration_columns(*model), validity_columns(*model)})
    columns.insert(columns.end(), group.begin(), group.end());
  const SimulationRequest request = test::request_for(*model, given_in(json), {0});
  const std::vector<double> values =
      values_at(dynamics, columns, request.parameters, json.at("time"), request.y_start);
  std::map<std::string, double> found;
  for (std::size_t i = 0; i < columns.size(); ++i) found[columns[i].name] = values[i];

  const std::map<std::string, std::string> column_of{{"kinetic", "T"},     {"potential", "V"},
                                                     {"total", "energy"},  {"jacobi", "h"},
                                                     {"hamiltonian", "h"}, {"string_tension", "tension"}};
  const double size = 1 + std::abs(found.at("T")) + std::abs(found.at("V"));
  const auto expect = [&](const std::string& name, double expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_NEAR(found.at(name), expected, at_one_state * size) << name;
  };
  for (const auto& [name, expected] : json.at("expected").items()) {
    if (name == "accelerations") {
      for (const auto& [q, value] : expected.items()) expect(q + "_ddot", value);
    } else {
      expect(column_of.contains(name) ? column_of.at(name) : name, expected);
    }
  }
}

}  // namespace
}  // namespace qdot::reference_motion_test
