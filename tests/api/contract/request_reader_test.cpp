#include "api/contract/request_reader.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "api/json/limits.hpp"
#include "core/expr/number.hpp"
#include "tests/api/example_systems.hpp"

namespace qdot::api {
namespace {

enum class Colour { red, green };

struct TestRequest {
  SystemChoice system{};
  double mass{};
  std::optional<double> dt{};
  std::optional<int> count{};
  bool flag{true};
  Colour colour{};
  std::vector<Colour> colours{};
  std::vector<double> times{};
  std::vector<std::string> events{};
};

const RequestTable<TestRequest>& table() {
  using R = TestRequest;
  static const RequestTable<R> table(
      {system_field<R>(), parameters_field<R>(), initial_field<R>(), inputs_field<R>(),
       number("mass", &R::mass, {"kg", {.lower = 0, .lower_open = true}}, "a mass", {.default_value = 2.5}),
       number("dt", &R::dt, {"s"}, "a step"),
       integer("count", &R::count, {1, 10}, "a number", {.default_value = 3, .aliases = {"rows"}}),
       boolean("flag", &R::flag, "a flag", {.default_value = true}),
       choice("colour", &R::colour, {{"red", Colour::red}, {"green", Colour::green}}, "a colour",
              {.default_value = "red"}),
       choices("colours", &R::colours, {{"red", Colour::red}, {"green", Colour::green}}, "colours"),
       list("times", &R::times, NumberKind{"s"}, 5, "instants"),
       list("events", &R::events, TextKind{20}, 3, "events")},
      {{{{"count"}, {"dt"}, {"times"}}}});
  return table;
}

auto body(std::string_view text) { return read_body(table(), text); }
auto query(const std::vector<std::pair<std::string, std::string>>& pairs) {
  return read_query(table(), pairs);
}

template <class Outcome>
const Resolved<TestRequest>& good(const Outcome& outcome) {
  if (!std::holds_alternative<Resolved<TestRequest>>(outcome)) throw std::runtime_error(errors_of(outcome));
  return std::get<Resolved<TestRequest>>(outcome);
}

TEST(RequestReader, ResolvesUnitsAndDefaults) {
  const auto outcome = body(R"json({"mass": "250 g", "system": "spring_pendulum", "colours": ["green", "red"],
      "parameters": {"Omega": "2 rev/s", "m": 1}, "initial": {"theta_dot": "90deg/s", "l": "50cm"},
      "inputs": {"F": "0.8*cos(4*t)"}, "colour": "green"})json");
  const auto& [request, echo] = good(outcome);
  EXPECT_EQ(request.mass, 0.25);
  EXPECT_EQ(request.count, 3);
  EXPECT_EQ(request.colour, Colour::green);
  EXPECT_EQ(request.colours, (std::vector{Colour::green, Colour::red}));
  EXPECT_EQ(request.system.scene->name, "spring_pendulum");
  EXPECT_EQ(request.system.parameters[0], (std::pair<std::string, Real>{"m", 1}));  // the scene's order
  EXPECT_DOUBLE_EQ(request.system.parameters[1].second.value, 4 * std::numbers::pi);
  EXPECT_EQ(request.system.initial[0], (std::pair<std::string, Real>{"l", 0.5}));
  EXPECT_EQ(request.system.inputs[0].second, "0.8*cos(4*t)");
  EXPECT_EQ(echo.dump(),
            R"({"system":"spring_pendulum","parameters":{"m":1.0,"Omega":12.566370614359172},)"
            R"json("initial":{"l":0.5,"theta_dot":1.5707963267948966},"inputs":{"F":"0.8*cos(4*t)"},)json"
            R"("mass":0.25,"count":3,"flag":true,"colour":"green","colours":["green","red"]})");
}

TEST(RequestReader, TwoRoadsOfOneRequest) {
  const auto posted =
      body(R"json({"system": "spring_pendulum", "parameters": {"k": 19.62}, "count": 7, "flag": false,
      "initial": {"theta": "30deg", "l_dot": -1}, "inputs": {"F": "atan2(t, 2)"}, "colours": ["red"],
      "events": ["atan2(l,theta)=0", "theta=0+"]})json");
  const auto gotten = query({{"theta", "30deg"},
                             {"system", "spring_pendulum"},
                             {"k", "19.62"},
                             {"count", "7"},
                             {"flag", "false"},
                             {"initial.l_dot", "-1"},
                             {"F", "atan2(t, 2)"},
                             {"colours", "red"},
                             {"events", "atan2(l,theta)=0, theta=0+"}});
  EXPECT_EQ(good(posted).echo, good(gotten).echo);
  EXPECT_EQ(good(posted).request.system.initial, good(gotten).request.system.initial);
}

TEST(RequestReader, ANumberIsTheDecimalThatWasTyped) {
  const std::string digits = "19.620000000000000000000001";
  const Real typed = Number::written(digits)->rounded();
  ASSERT_NE(typed, Real(19.62));
  const auto given = [](const auto& outcome) { return good(outcome).request.system.parameters[0].second; };
  const std::string head = R"({"system": "spring_pendulum", "parameters": {"k": )";
  EXPECT_EQ(given(body(head + digits + "}}")), typed);
  EXPECT_EQ(given(body(head + "\"" + digits + " N/m\"}}")), typed);
  EXPECT_EQ(given(query({{"system", "spring_pendulum"}, {"k", digits}})), typed);
  EXPECT_EQ(given(body(head + "19.62}}")), Number::ratio(981, 50).rounded());
  EXPECT_EQ(given(body(head + "9007199254740993}}")), Number(9007199254740993).rounded());
  EXPECT_EQ(good(body(R"({"system": "spring_pendulum", "inputs": {"F": )" + digits + "}}"))
                .request.system.inputs[0]
                .second,
            digits);
}

TEST(RequestReader, AnswersItsOwnEchoWithTheSameEcho) {
  const Json echo = good(query({{"system", "spring_pendulum"}, {"k", "4e1"}, {"mass", "1g"}})).echo;
  EXPECT_EQ(good(body(echo.dump())).echo, echo);
}

TEST(RequestReader, ReportsEverythingAtOnce) {
  EXPECT_EQ(
      errors_of(body(R"({"system": "spring_pendulum", "parameters": {"kk": 1, "m": -1, "Omega": "2 m"},
      "initial": [], "mass": "two", "flag": 1, "count": 1.5, "colour": "gren", "times": [0, "1 kg"], "mas": 1})")),
      "#/mas unknown_field mass | #/parameters/kk unknown_field k | #/parameters/m out_of_range | "
      "#/parameters/Omega wrong_dimension | #/initial wrong_type | #/mass syntax | #/count wrong_type | "
      "#/flag wrong_type | #/colour not_allowed green | #/times/1 wrong_dimension | #/times exclusive");
}

TEST(RequestReader, SpeaksOfParametersInAQuery) {
  EXPECT_EQ(errors_of(query({{"system", "spring_pendulum"}, {"kk", "1"}, {"theta", "1m"}, {"times", "1,x"}})),
            "kk unknown_field k | theta wrong_dimension | times syntax");
  EXPECT_EQ(errors_of(query({{"system", "spring_pendulum"}, {"k", "1"}, {"k", "2"}})), "k duplicate_field");
  EXPECT_EQ(errors_of(query({{"system", "spring_pendulum"}, {"k", "1"}, {"parameters.k", "2"}})),
            "k duplicate_field");
  EXPECT_EQ(errors_of(query({{"system", "spring_pendulum"}, {"parameters.x", "1"}})), "x unknown_field");
  EXPECT_EQ(errors_of(query({{"system", "spring_pendulum"}, {"parameters", "k=1"}})),
            "parameters unknown_field");
}

TEST(RequestReader, AFieldWinsOverASymbolOfItsNameInAQuery) {
  const auto outcome = query({{"system", "spring_pendulum"}, {"dt", "3"}, {"parameters.dt", "4"}});
  EXPECT_EQ(good(outcome).request.dt, 3);
  EXPECT_EQ(good(outcome).request.system.parameters[0].second.value, 4);
}

TEST(RequestReader, KnowsWhereAMisplacedSymbolBelongs) {
  const auto outcome = body(R"({"system": "spring_pendulum", "theta": 1, "parameters": {"l": 2}})");
  EXPECT_EQ(errors_of(outcome),
            "#/theta unknown_field initial.theta | #/parameters/l unknown_field initial.l");
  EXPECT_EQ(std::get<Problem>(outcome).errors[0].detail,
            "There is no field 'theta'. spring_pendulum has it: it belongs in 'initial'.");
  EXPECT_EQ(std::get<Problem>(outcome).errors[1].detail,
            "spring_pendulum has no parameter 'l'. It belongs in 'initial'.");
}

TEST(RequestReader, KnowsOtherProgramsWords) {
  EXPECT_EQ(errors_of(body(R"({"system": "spring_pendulum", "Rows": 3, "params": {}})")),
            "#/Rows unknown_field count | #/params unknown_field parameters");
}

TEST(RequestReader, NeedsASystem) {
  EXPECT_EQ(errors_of(body("{}")), "#/system missing");
  EXPECT_EQ(errors_of(query({})), "system missing");
  EXPECT_EQ(errors_of(body(R"({"system": "x", "parameters": {"k": 1}, "mas": 1})")),
            "#/system unknown_system | #/mas unknown_field mass");
  // k may well be a parameter of the system that was meant.
  EXPECT_EQ(errors_of(query({{"system", "x"}, {"k", "1"}})), "system unknown_system");
}

TEST(RequestReader, OneWayExcludesTheOthersAndTheirDefaults) {
  EXPECT_FALSE(good(body(R"({"system": "spring_pendulum", "dt": 1})")).request.count);
  const auto outcome = body(R"({"system": "spring_pendulum", "dt": 1, "count": 2})");
  EXPECT_EQ(errors_of(outcome), "#/dt exclusive");
  EXPECT_EQ(detail_of(outcome), "'count' and 'dt' cannot be given together; give one of them.");
}

TEST(RequestReader, RefusesValuesOfOtherTypes) {
  const auto error = [](const std::string& member) {
    return detail_of(body(R"({"system": "spring_pendulum", )" + member + "}"));
  };
  EXPECT_EQ(error(R"("mass": true)"),
            "'mass' needs a number of kg or a text such as \"1 kg\", not a boolean.");
  EXPECT_EQ(error(R"("mass": null)"),
            "'mass' needs a number of kg or a text such as \"1 kg\", not null; leave out what has no value.");
  EXPECT_EQ(error(R"("mass": 0)"), "'mass' must be > 0.0 kg; it is 0.0.");
  EXPECT_EQ(error(R"("count": "7")"), "'count' needs a whole number, not a string.");
  EXPECT_EQ(error(R"("count": 11)"), "'count' must be from 1 to 10; it is 11.");
  EXPECT_EQ(error(R"("count": 18446744073709551615)"),
            "'count' must be from 1 to 10; it is 1.8446744073709552e+19.");
  EXPECT_EQ(error(R"("count": 1e300)"), "'count' must be from 1 to 10; it is 1e+300.");
  EXPECT_EQ(error(R"("count": 2.5)"), "'count' needs a whole number.");
  EXPECT_EQ(error(R"("flag": "true")"), "'flag' needs true or false, not a string.");
  EXPECT_EQ(error(R"("colour": 1)"), "'colour' needs red or green, not a number.");
  EXPECT_EQ(error(R"("colours": ["red", "red"])"), "'colours' has \"red\" twice.");
  EXPECT_EQ(error(R"("colours": "red")"), "'colours' needs an array, such as [\"red\"], not a string.");
  EXPECT_EQ(error(R"("times": [1,2,3,4,5,6])"), "'times' has 6 entries; at most 5 are read.");
  EXPECT_EQ(error(R"("events": [""])"), "'events' is empty.");
  EXPECT_EQ(error(R"("events": ["123456789012345678901"])"), "'events' has 21 bytes; at most 20 are read.");
  EXPECT_EQ(error(R"("inputs": {"F": {}})"), "'F' needs a string, not an object.");
  EXPECT_EQ(good(body(R"({"system": "spring_pendulum", "count": 7.0})")).request.count, 7);
  EXPECT_EQ(
      good(body(R"({"system": "spring_pendulum", "inputs": {"F": 1.5}})")).request.system.inputs[0].second,
      "1.5");
}

TEST(RequestReader, APlusThatTheUrlLostIsNotAnotherEvent) {
  EXPECT_EQ(detail_of(query({{"system", "spring_pendulum"}, {"F", "theta=0 "}})),
            "'F' begins or ends with a blank; in a URL, + is written %2B.");
}

TEST(RequestReader, RepeatsLittleOfWhatWasSent) {
  std::string text = R"({"system": "spring_pendulum")";
  for (int i = 0; i < 200; ++i)
    text += ", \"" + std::string(300, static_cast<char>('a' + i % 26)) + std::to_string(i) + "\": 0";
  const auto outcome = body(text + "}");
  const Problem& problem = std::get<Problem>(outcome);
  EXPECT_EQ(problem.errors.size(), limits::listed_errors);
  for (const FieldError& error : problem.errors) EXPECT_LT(error.pointer.size() + error.detail.size(), 200U);
}

TEST(RequestReader, ASubmissionIsAnObject) {
  EXPECT_EQ(errors_of(body("[1]")), "# wrong_type");
  EXPECT_EQ(errors_of(body(R"({"system": "spring_pendulum", "mass": 1, "mass": 2, "x": 0})")),
            "#/mass duplicate_field | #/x unknown_field");
}

}  // namespace
}  // namespace qdot::api
