#include "api/answers/sweep/sweep_answer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "api/answers/sweep/answer_bound.hpp"
#include "api/json/limits.hpp"
#include "api/scenes/catalogue.hpp"
#include "core/base/work.hpp"

namespace qdot::api {
namespace {

constexpr SweepFormat formats[] = {SweepFormat::json, SweepFormat::csv, SweepFormat::ndjson};

/// k from 0 on, and columns that are called by `name` and their number.
SweepPlan plan_of(std::size_t rows, std::size_t columns, const std::string& name, SweepFormat format) {
  static const Catalogue catalogue = Catalogue::built_in();
  const SweepVariable k{"k", SymbolRole::parameter, "N/m"};
  SweepPlan plan{.format = format};
  plan.scene = std::make_shared<const Scene>(catalogue.find("spring_pendulum")->scene);
  plan.swept.variables = {k};
  plan.swept.rows = rows;
  plan.swept.ranges = {{.variable = k, .value = [](std::size_t i) { return double(i); }, .count = rows}};
  for (std::size_t i = 0; i < columns; ++i) plan.columns.push_back({name + std::to_string(i), "/V"});
  return plan;
}

/// Rows that have `value` in each of so many columns.
SweptRows rows_of(std::size_t rows, std::size_t columns, const Json& value, const std::string& reason = {}) {
  const SweptRow row{.status = 200, .reason = reason, .values = std::vector<Json>(columns, value)};
  return {.rows = std::vector<SweptRow>(rows, row), .units = std::vector<std::string>(columns, "J")};
}

Response written(const SweepPlan& plan, SweptRows rows, Work work = Work::bounded) {
  const Request request{.work = work};
  return sweep_answer(plan, std::move(rows), Call{.request = request, .target = {}});
}

TEST(SweepAnswer, HasRoomForAllNumbersThatMayBeAskedFor) {
  const auto rows = static_cast<std::size_t>(limits::sweep_rows);
  const std::string name(28, 'n');
  for (const SweepFormat format : formats) {
    const auto plan = plan_of(rows, limits::sweep_columns, name, format);
    const auto longest = rows_of(rows, limits::sweep_columns, -1.2345678901234567e-100);
    EXPECT_GT(written(plan, longest).body.size(), 23 * rows * limits::sweep_columns);
  }
}

TEST(SweepAnswer, IsAsLongAsAServiceSendsAndNoLonger) {
  for (const SweepFormat format : formats) {
    const auto plan = plan_of(100, 1, "text", format);
    const auto length = [&](std::size_t bytes) {
      return written(plan, rows_of(100, 1, std::string(bytes, 't'))).body.size();
    };
    const std::size_t most = (limits::sweep_answer_bytes - length(0)) / 100;
    EXPECT_NEAR(length(most), limits::sweep_answer_bytes, 100);
    EXPECT_THROW((void)length(most + 1), AnswerTooLong);
    const auto reasons = rows_of(100, 1, Json(), std::string(most + 1, 'r'));
    EXPECT_THROW((void)written(plan, reasons), AnswerTooLong);
    EXPECT_GT(written(plan, reasons, Work::unbounded).body.size(), limits::sweep_answer_bytes)
        << "someone's own machine sends what there is";
  }
}

TEST(SweepAnswer, IsNotWrittenForNobody) {
  for (const SweepFormat format : formats) {
    const auto plan = plan_of(3, 2, "column", format);
    const WorkScope scope(1000, [] { return true; });
    EXPECT_THROW((void)written(plan, rows_of(3, 2, 1.5)), Interrupted);
    EXPECT_FALSE(written(plan, rows_of(3, 2, 1.5), Work::unbounded).body.empty())
        << "who ends a sweep on a machine of their own wants the rows that there are";
  }
}

TEST(SweepAnswer, SaysOfEachRowWhatIsMissing) {
  const auto text = [](SweepFormat format) {
    SweptRows rows = rows_of(2, 1, "a \"b\"");
    rows.rows[1] = {.status = 422, .reason = "No value.", .values = {Json()}};
    return written(plan_of(2, 1, "c", format), std::move(rows)).body;
  };
  EXPECT_EQ(text(SweepFormat::csv), "k,c0,status,reason\n0.0,\"a \"\"b\"\"\",200,\n1.0,,422,No value.\n");
  EXPECT_EQ(text(SweepFormat::ndjson),
            "{\"k\":0.0,\"c0\":\"a \\\"b\\\"\"}\n"
            "{\"k\":1.0,\"c0\":null,\"status\":422,\"reason\":\"No value.\"}\n");
  const std::string end =
      R"("rows":2,"columns":{"k":[0.0,1.0],"c0":["a \"b\"",null]},)"
      R"("failed":[{"row":1,"status":422,"reason":"No value."}],"units":{"k":"N/m","c0":"J"}})";
  EXPECT_TRUE(text(SweepFormat::json).ends_with(end + "\n")) << text(SweepFormat::json);
}

}  // namespace
}  // namespace qdot::api
