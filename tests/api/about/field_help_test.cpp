#include "api/about/field_help.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "api/answers/endpoints.hpp"

namespace qdot::api {
namespace {

using testing::HasSubstr;

TEST(FieldHelp, SaysMeaningUnitBoundsAndDefault) {
  const FieldSet set{
      .fields = {{.name = "t_end", .kind = NumberKind{.unit = "s"}, .description = "end of the motion"},
                 {.name = "atol",
                  .kind = NumberKind{"1", {.lower = 0, .upper = 1, .lower_open = true}},
                  .description = "tolerance",
                  .default_value = 1e-12},
                 {.name = "form",
                  .kind = ChoiceKind{{"text", "c"}},
                  .description = "notation",
                  .default_value = "text"},
                 {.name = "name", .kind = TextKind{9}, .description = "which one", .need = Need::required}}};
  EXPECT_EQ(fields_as_text(set),
            "Fields (a value may carry its unit, \"30deg\"):\n"
            "  t_end           end of the motion (number in s)\n"
            "  atol            tolerance (number > 0 and <= 1; default 1e-12)\n"
            "  form            notation (one of text, c; default text)\n"
            "  name            which one (text; required)");
}

TEST(FieldHelp, HasEveryFieldOfEveryEndpointInLinesThatFit) {
  std::size_t count = 0;
  for (const Endpoint& endpoint : endpoints()) {
    const std::string text = fields_as_text(*endpoint.question.fields);
    for (const FieldInfo& field : endpoint.question.fields->fields) {
      EXPECT_THAT(text, HasSubstr("\n  " + field.name + " "));
      ++count;
    }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  }
  EXPECT_GT(count, 60U);
}

}  // namespace
}  // namespace qdot::api
