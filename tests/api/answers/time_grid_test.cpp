#include "api/answers/time_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "api/json/limits.hpp"
#include "core/base/work_bounds.hpp"
#include "core/expr/number.hpp"

namespace qdot::api {
namespace {

std::vector<double> grid(const GridRequest& request) {
  const auto result = time_grid(request);
  if (const auto* error = std::get_if<GridError>(&result)) {
    ADD_FAILURE() << error->field << ": " << error->detail;
    return {};
  }
  return std::get<Reals>(result);
}

GridError error(const GridRequest& request) {
  const auto result = time_grid(request);
  return std::holds_alternative<GridError>(result) ? std::get<GridError>(result) : GridError{"none", "", ""};
}

TEST(TimeGrid, OfSamplesHasBothEndsAndDecimalInstants) {
  const auto instants = grid({.t_end = 10, .samples = 101});
  ASSERT_EQ(instants.size(), 101U);
  EXPECT_EQ(instants[3], 0.3);  // 3*0.1 would be 0.30000000000000004
  EXPECT_EQ(instants.front(), 0);
  EXPECT_EQ(instants.back(), 10);
  EXPECT_EQ(grid({.t_start = 1.0 / 3, .t_end = 2.0 / 3, .samples = 2}), (std::vector{1.0 / 3, 2.0 / 3}));
}

TEST(TimeGrid, InstantsAreThoseThatWereTyped) {
  const auto typed = [](const char* text) { return Number::written(text)->rounded(); };
  const auto left_out = [](const GridRequest& request, std::size_t i) {
    const auto result = time_grid(request);
    return std::get<Reals>(result).exact(i).low;
  };
  const Real late = typed("2000.20669775248365");
  EXPECT_EQ(left_out({.t_end = late, .samples = 2}, 1), late.low);
  const Real third = typed("1.3333333333333333333333333333333333333333");
  EXPECT_EQ(left_out({.t_start = 1, .t_end = 2, .samples = 4}, 1), third.low);
  EXPECT_EQ(grid({.t_end = typed("0.7"), .samples = 8})[1], 0.1) << "a seventh of the double is another one";
  const auto only = [](const Real& t) {
    Reals times;
    times.push_back(t);
    return times;
  };
  const Real before = typed("1.99999999999999999"), beyond = typed("3.00000000000000001");
  EXPECT_EQ(error({.t_start = 2, .t_end = 3, .times = only(before)}).code, "out_of_range");
  EXPECT_EQ(error({.t_start = 2, .t_end = 3, .times = only(beyond)}).code, "out_of_range");
  EXPECT_EQ(error({.t_start = before, .t_end = beyond, .times = only(3)}).field, "none");
}

TEST(TimeGrid, HasAServicesBoundUnlessThereIsNone) {
  const GridRequest many{.t_end = 10, .samples = limits::rows + 1};
  EXPECT_EQ(error(many).code, "too_many");
  {
    const WorkBoundsScope own_machine(WorkBounds::none);
    EXPECT_EQ(grid(many).size(), static_cast<std::size_t>(limits::rows) + 1);
    const WorkBoundsScope service(WorkBounds::of_a_service);
    EXPECT_EQ(error(many).code, "too_many");
  }
  EXPECT_EQ(error(many).code, "too_many");
}

TEST(TimeGrid, OfStepsIsTheSameGrid) {
  EXPECT_EQ(grid({.t_end = 10, .dt = 0.1}), grid({.t_end = 10, .samples = 101}));
  EXPECT_EQ(grid({.t_end = 1, .dt = 1}), (std::vector{0.0, 1.0}));
  EXPECT_EQ(grid({.t_end = 1, .dt = 1.0 / 3 * (1 + 1e-10)}).size(), 4U);
}

TEST(TimeGrid, AStepThatDoesNotDivideTheSpanNamesTheNearestThatDo) {
  const GridError wrong = error({.t_end = 10, .dt = 0.3});
  EXPECT_EQ(wrong.field, "dt");
  EXPECT_EQ(wrong.detail,
            "dt does not divide the 10.0 s from t_start to t_end; near it, 0.30303030303 s and "
            "0.294117647059 s do.");
  EXPECT_EQ(grid({.t_end = 10, .dt = 0.30303030303}).size(), 34U);
  EXPECT_EQ(grid({.t_end = 10, .dt = 0.294117647059}).size(), 35U);
  EXPECT_EQ(error({.t_end = 1, .dt = 5}).detail,
            "dt does not divide the 1.0 s from t_start to t_end; near it, 1.0 s do.");
}

TEST(TimeGrid, OfGivenInstantsIsTheseInstants) {
  EXPECT_EQ(grid({.times = std::vector<double>{0.5, 2}}), (std::vector{0.5, 2.0}));
  EXPECT_EQ(grid({.t_end = 3, .times = std::vector<double>{0, 3}}), (std::vector{0.0, 3.0}));
  EXPECT_EQ(error({.times = std::vector<double>{1, 1}}).code, "not_increasing");
  EXPECT_EQ(error({.times = std::vector<double>{2, 1}}).detail,
            "'times' must increase; 2.0 s is followed by 1.0 s.");
  EXPECT_EQ(error({.t_end = 2, .times = std::vector<double>{1, 3}}).detail,
            "'times' has 3.0 s, which is not from 0.0 s to 2.0 s.");
  EXPECT_EQ(error({.times = std::vector<double>{-1, 3}}).field, "times");
  EXPECT_EQ(error({.times = std::vector<double>{0}}).field, "times") << "there is no motion";
}

TEST(TimeGrid, NeedsAnEndAfterItsStart) {
  EXPECT_EQ(error({.samples = 3}).code, "missing");
  EXPECT_EQ(error({.t_start = 1, .t_end = 1, .samples = 3}).field, "t_end");
  EXPECT_EQ(error({.t_end = -1, .samples = 3}).detail,
            "The motion must end after t_start, 0.0 s; it would end at -1.0 s.");
}

TEST(TimeGrid, HoldsItsLimits) {
  EXPECT_EQ(grid({.t_end = 1, .dt = 1.0 / (limits::rows - 1)}).size(),
            static_cast<std::size_t>(limits::rows));
  EXPECT_EQ(error({.t_end = 1, .dt = 1.0 / limits::rows}).code, "too_many");
  EXPECT_EQ(error({.t_end = 1e9, .dt = 1e-300}).code, "out_of_range");
  EXPECT_EQ(error({.t_start = 1e9, .t_end = 1e9 + 1e-6, .samples = 1000}).code, "out_of_range");
}

}  // namespace
}  // namespace qdot::api
