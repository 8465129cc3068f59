#include <gtest/gtest.h>

#include "api/answers/energy/request.hpp"
#include "api/answers/equations/request.hpp"
#include "api/answers/simulate/request.hpp"
#include "tests/api/example_systems.hpp"

namespace qdot::api {
namespace {

auto simulate(const std::string& members) {
  return read_body(simulate_table(), R"({"system": "spring_pendulum", )" + members + "}");
}

SimulateRequest request(const std::string& members) {
  const auto outcome = simulate(members);
  if (!std::holds_alternative<Resolved<SimulateRequest>>(outcome))
    throw std::runtime_error(errors_of(outcome));
  return std::get<Resolved<SimulateRequest>>(outcome).request;
}

TEST(SimulateRequest, HasTheContractsDefaults) {
  const auto outcome = simulate(R"("t_end": 10)");
  const auto& [request, echo] = std::get<Resolved<SimulateRequest>>(outcome);
  EXPECT_EQ(request.grid.size(), 101U);
  EXPECT_EQ(request.rtol, 1e-9);
  EXPECT_EQ(request.atol, 1e-12);
  EXPECT_EQ(request.method, Method::taylor);
  EXPECT_EQ(
      echo.dump(),
      R"({"system":"spring_pendulum","parameters":{},"initial":{},"inputs":{},"t_start":0.0,"t_end":10.0,)"
      R"("samples":101,"include":[],"events":[],"on_invalid":"stop","impacts":true,"method":"auto",)"
      R"("rtol":1e-09,"atol":1e-12,"verify":true})");
}

TEST(SimulateRequest, DigitsAskedForAreNotUndoneByTheOtherTolerance) {
  EXPECT_EQ(request(R"("t_end": 1, "rtol": 1e-14)").atol, 1e-17);
  EXPECT_EQ(request(R"("t_end": 1, "rtol": 1e-3)").atol, 1e-12);
  EXPECT_EQ(request(R"("t_end": 1, "rtol": 1e-14, "atol": 1e-12)").atol, 1e-12);
}

TEST(SimulateRequest, ReadsTheContractsExample) {
  const SimulateRequest read =
      request(R"("parameters": {"m": 0.5, "k": 40}, "initial": {"l": "50cm", "theta": "30deg"},
      "t_end": 10, "samples": 101, "include": ["energy", "momenta", "positions", "accelerations", "validity"],
      "events": ["theta=0+"], "digits": 10)");
  EXPECT_EQ(read.include.size(), 5U);
  EXPECT_EQ(read.digits, 10);
  EXPECT_EQ(read.events, std::vector<std::string>{"theta=0+"});
}

TEST(SimulateRequest, ItsEndFollowsFromItsTimes) {
  const SimulateRequest read = request(R"("times": [0, "100 ms", 2])");
  EXPECT_EQ(read.t_end, 2);
  EXPECT_EQ(std::vector<double>(read.grid), (std::vector{0.0, 0.1, 2.0}));
  EXPECT_FALSE(read.samples);
}

TEST(SimulateRequest, RefusesWhatCannotBe) {
  EXPECT_EQ(errors_of(simulate(R"("samples": 5)")), "#/t_end missing");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "samples": 1)")), "#/samples out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1e10)")), "#/t_end out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "t_start": 2)")), "#/t_end out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "dt": 0.3)")), "#/dt out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "dt": -0.1)")), "#/dt out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "dt": 0.1, "samples": 11)")), "#/dt exclusive");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "rtol": 1e-15, "atol": 0)")),
            "#/rtol out_of_range | #/atol out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "digits": 18)")), "#/digits out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "impacts": false)")), "#/impacts not_applicable");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "events": [1])")), "#/events/0 wrong_type");
}

TEST(SimulateRequest, AcceptsItsLimits) {
  EXPECT_EQ(request(R"("t_end": 1e9, "rtol": 1e-14, "atol": 1, "digits": 17, "samples": 100000)").grid.size(),
            100'000U);
  EXPECT_EQ(request(R"("t_end": 1, "rtol": 1e-2)").rtol, 1e-2);
}

TEST(SimulateRequest, CountsTheNumbersOfAnAnswer) {
  // t, 2 coordinates and 2 velocities, 1 energy, 2 momenta, 2 accelerations, 2 components of the bob
  EXPECT_EQ(column_count(*spring_pendulum(), {Extra::energy, Extra::momenta, Extra::accelerations,
                                              Extra::positions, Extra::validity}),
            12);
  EXPECT_EQ(detail_of(simulate(R"("t_end": 1, "samples": 100000,
                                  "include": ["energy", "momenta", "accelerations", "positions"])")),
            "100000 rows of 12 columns are 1200000 numbers; an answer has at most 1000000.");
}

TEST(SimulateRequest, GaussStepsByH) {
  const SimulateRequest read = request(R"("t_end": 1, "method": "gauss", "h": "10 ms")");
  EXPECT_EQ(read.method, Method::gauss);
  EXPECT_EQ(read.h, 0.01);
  EXPECT_EQ(read.rtol, 0);  // it has no tolerances, not even by default
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "method": "gauss")")), "#/h missing");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "method": "gauss", "h": 0)")), "#/h out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "method": "gauss", "h": "1 kg")")), "#/h wrong_dimension");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "h": 0.01)")), "#/h not_applicable");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "method": "erk", "h": 0.01)")), "#/h not_applicable");
}

TEST(SimulateRequest, AFixedStepHasNoToleranceAndNoErrorWanted) {
  for (const char* other : {R"("rtol": 1e-6)", R"("atol": 1e-6)", R"("max_error": 1e-6)",
                            R"("accuracy": "fast")", R"("max_evaluations": 1000)"}) {
    EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "method": "gauss", "h": 0.01, )" + std::string(other))),
              "#/h exclusive");
  }
}

TEST(SimulateRequest, TooManyStepsAreToldAtTheDoor) {
  EXPECT_EQ(errors_of(simulate(R"("t_end": 250, "method": "gauss", "h": 1e-3)")), "none");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 251, "method": "gauss", "h": 1e-3)")), "#/h too_many");
  EXPECT_EQ(detail_of(simulate(R"("t_end": 1, "method": "gauss", "h": 1e-300)")),
            "Steps of this length are too many: a motion may take 250000.");
}

TEST(SimulateRequest, WantsTheErrorOrTheWorkOrTheTolerances) {
  EXPECT_EQ(request(R"("t_end": 1, "max_error": 1e-9)").max_error, 1e-9);
  EXPECT_EQ(request(R"("t_end": 1, "accuracy": "fast")").accuracy, Preset::fast);
  EXPECT_EQ(request(R"("t_end": 1, "max_evaluations": 1000, "method": "adams")").max_evaluations, 1000);
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "max_error": 1e-15)")), "#/max_error out_of_range");
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "max_error": 1e-9, "verify": false)")), "#/verify exclusive");
  EXPECT_NE(errors_of(simulate(R"("t_end": 1, "max_error": 1e-9, "rtol": 1e-9)")), "none");
}

TEST(SimulateRequest, CountsStridesOfWhatWalks) {
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "steps": 3)")), "#/steps not_applicable");
}

TEST(SimulateRequest, KnowsOtherProgramsWords) {
  EXPECT_EQ(errors_of(simulate(R"("t_end": 1, "reltol": 1e-6, "t_eval": [], "Solver": "bdf", "tmax": 3)")),
            "#/reltol unknown_field rtol | #/t_eval unknown_field times | #/Solver unknown_field method | "
            "#/tmax unknown_field t_end");
}

TEST(EnergyRequest, IsAStateAndAnInstant) {
  const auto outcome =
      read_query(energy_table(), {{"system", "spring_pendulum"}, {"theta", "30deg"}, {"t", "100ms"}});
  const auto& read = std::get<Resolved<EnergyRequest>>(outcome);
  EXPECT_EQ(read.request.t, 0.1);
  EXPECT_EQ(read.request.system.initial.size(), 1U);
}

TEST(EquationsRequest, HasAFormAndNoNumbers) {
  const auto outcome = read_query(equations_table(), {{"system", "spring_pendulum"}, {"form", "latex"}});
  EXPECT_EQ(std::get<Resolved<EquationsRequest>>(outcome).request.form, Form::latex);
  EXPECT_EQ(errors_of(read_query(equations_table(), {{"system", "spring_pendulum"}, {"k", "1"}})),
            "k unknown_field");
}

}  // namespace
}  // namespace qdot::api
