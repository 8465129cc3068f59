#include "api/answers/endpoints.hpp"

#include <gtest/gtest.h>

#include "core/expr/print/print.hpp"
#include "core/integrate/methods.hpp"

namespace qdot::api {
namespace {

std::vector<std::string> options(const std::string& address, const std::string& field) {
  const Kind& kind = endpoint_at(address)->question.fields->find(field)->kind;
  const auto* list = std::get_if<ListKind>(&kind);
  return (list == nullptr ? std::get<ChoiceKind>(kind) : std::get<ChoiceKind>(*list->element)).options;
}

TEST(Endpoints, EachRecordIsWholeAndHasANameOfItsOwn) {
  EXPECT_GE(endpoints().size(), 9U);
  for (const Endpoint& endpoint : endpoints()) {
    EXPECT_EQ(endpoint_at(address_of(endpoint)), &endpoint);
    EXPECT_FALSE(endpoint.help.empty() || endpoint.help.ends_with('.')) << endpoint.name;
    const bool is_first = endpoint.question.fields->fields[0].name == "system";
    EXPECT_EQ(is_first, asks_about_a_system(endpoint)) << endpoint.name;
    EXPECT_EQ(endpoint.offers[0], endpoint.body_type) << endpoint.name;
    EXPECT_GT(endpoint.cost.milliseconds, 0) << endpoint.name;
    const Json about = description_of(endpoint);
    for (const char* member : {"tag", "operation", "summary", "description", "answer", "schema"}) {
      EXPECT_TRUE(about.contains(member)) << endpoint.name << ' ' << member;
    }
  }
  EXPECT_EQ(endpoint_at("/v1/nothing"), nullptr);
}

TEST(Endpoints, OfferEveryMethodOfIntegration) {
  std::vector<std::string> names;
  for (const MethodRecord& method : methods()) names.emplace_back(method.name);
  EXPECT_GE(names.size(), 5U);
  EXPECT_EQ(options("/v1/accuracy", "methods"), names);
  names.insert(names.begin(), "auto");
  EXPECT_EQ(options("/v1/simulate", "method"), names);
}

TEST(Endpoints, OfferEveryPrintForm) {
  std::vector<std::string> names;
  for (const PrintForm& form : print_forms()) names.emplace_back(form.name);
  EXPECT_GE(names.size(), 6U);
  EXPECT_EQ(options("/v1/equations", "form"), names);
}

}  // namespace
}  // namespace qdot::api
