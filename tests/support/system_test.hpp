#pragma once
// Tests that run for each of many systems and carry its name.

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/scenes.hpp"
#include "tests/support/states.hpp"

namespace qdot::test {

/// Seeded states at which an identity is tried: one that fails on an open set escapes none of them.
inline constexpr int identity_states = 100;

class SystemTest : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] const Model& model() const { return *model_; }

  /// Calls look(state) for every seeded state.
  template <class Look>
  void each_state(Look look, int count = identity_states) const {
    Random random(20240607);
    for (int i = 0; i < count && !HasFailure(); ++i) look(random_state(model(), random));
  }

 private:
  std::shared_ptr<const Model> model_{model_of(GetParam())};
};

/// Practice problems and textbook systems, those that `fits` takes.
template <class Fits>
std::vector<std::string> systems_where(Fits fits) {
  std::vector<std::string> names;
  for (const auto* group : {&practice_systems(), &textbook_systems()})
    std::copy_if(group->begin(), group->end(), std::back_inserter(names), fits);
  return names;
}

inline std::vector<std::string> all_systems() {
  return systems_where([](const std::string&) { return true; });
}

inline std::string system_name(const testing::TestParamInfo<std::string>& info) { return info.param; }

}  // namespace qdot::test
