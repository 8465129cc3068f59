// Frequencies and shapes as formulas: as the practice sheet has them, and none where there is none.

#include "core/closed/exact_modes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/closed/linear_motions.hpp"
#include "core/closed/trial.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

/// The formulas of all modes, empty where one has none.
std::vector<std::string> squares(const std::string& system, const WrittenTexts& written = {},
                                 const Values& given = {}) {
  const Dynamics dynamics(test::model_of(system));
  const Reals parameters = parameter_values(dynamics.model(), given);
  const Modes found = normal_modes(dynamics, parameters, initial_state(dynamics.model(), parameters, given));
  std::vector<std::string> texts;
  for (const auto& mode : exact_modes(dynamics, parameters, written, found).modes)
    texts.push_back(mode ? mode->square.text : "");
  return texts;
}

using testing::ElementsAre;

TEST(ExactModes, AreThoseOfThePracticeSheet) {
  EXPECT_THAT(squares("cart_pendulum"), ElementsAre("g/(2*l)", "2*g/l"));
  EXPECT_THAT(squares("rod_pendulum"), ElementsAre("(17 - sqrt(217))*g/(4*l)", "(17 + sqrt(217))*g/(4*l)"));
  EXPECT_THAT(squares("orbiting_pendulum"), ElementsAre("omega0^2"));
}

TEST(ExactModes, FollowTheValuesThatAreWritten) {
  EXPECT_THAT(squares("cart_pendulum", {{"k", "0"}}, {{"k", 0}}), ElementsAre("", "3*g/(2*l)"));
  EXPECT_THAT(squares("orbiting_pendulum", {{"r", "0.7"}}, {{"r", 0.7}}), ElementsAre("r*omega0^2/l"));
  EXPECT_THAT(squares("whirling_pendulum", {{"Omega", "3"}}, {{"Omega", 3}}), ElementsAre("g/l - Omega^2"));
}

TEST(ExactModes, AreNoneWhereTheEquilibriumHasNoFormula) {
  EXPECT_THAT(squares("rotating_l_bar"), ElementsAre(""));
}

TEST(Trial, TellsAWrongFormulaThatAgreesWithTheNumbers) {
  const auto model = test::model_of("rod_pendulum");
  const auto graph = std::make_shared<Graph>(*model->parsed.graph);
  const ExactValues values(*model, graph, {}, parameter_values(*model, {}));
  const Expression m = graph->symbol("m"), l = graph->symbol("l");  // both are 0.5 by default
  const Relations none;
  Trial right(values, none), wrong(values, none);
  right.vanishes({m * l, -(l * m)});
  wrong.vanishes({m, -l});
  EXPECT_TRUE(right.passes());
  EXPECT_FALSE(wrong.passes());
}

}  // namespace
}  // namespace qdot
