// What is watched along a motion has a name, which messages about doubts use.

#include "core/dynamics/watch.hpp"

#include <gtest/gtest.h>

#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

TEST(Watches, HaveNames) {
  std::size_t singularities = 0;
  for (const std::string& name : test::all_systems()) {
    const auto model = test::model_of(name);
    const std::vector<double> parameters = parameter_values(*model, {});
    for (const Watch& watch : watches(Dynamics(model), {.parameters = parameters})) {
      EXPECT_FALSE(watch.name.empty()) << name << ": " << watch.message;
      singularities += watch.kind == Watch::Kind::singularity ? 1 : 0;
    }
  }
  EXPECT_GT(singularities, 3U);
}

}  // namespace
}  // namespace qdot
