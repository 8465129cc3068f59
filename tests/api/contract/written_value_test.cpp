#include "api/contract/written_value.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/expr/number.hpp"

namespace qdot::api::written_value_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Parameters m = 0.5 kg, l = 2 m, g = 9.81 m/s^2 and k = 2*m*g/l by default.
class WrittenValue : public testing::Test {
 protected:
  WrittenValue() {
    add("m", "kg", "0.5");
    add("l", "m", "2");
    add("g", "m/s^2", "9.81");
    add("k", "N/m", "2*m*g/l");
  }

  void add(std::string name, std::string unit, std::string by_default) {
    Parameter& parameter = scene_.parameters.emplace_back();
    parameter.name = std::move(name);
    parameter.unit = std::move(unit);
    parameter.default_value = std::move(by_default);
  }

  std::variant<Real, QuantityError> read(std::string_view text, std::string_view unit) {
    ParameterScope scope(scene_, given_, place_);
    return written_value(text, unit, scope);
  }
  double si(std::string_view text, std::string_view unit) {
    const auto result = read(text, unit);
    if (const auto* error = std::get_if<QuantityError>(&result)) {
      ADD_FAILURE() << text << ": " << error->code << ": " << error->detail;
      return 0;
    }
    return std::get<Real>(result).value;
  }
  std::string code(std::string_view text, std::string_view unit) {
    const auto result = read(text, unit);
    return std::holds_alternative<Real>(result) ? "none" : std::get<QuantityError>(result).code;
  }

  Scene scene_;
  Json given_ = Json::object();
  Place place_{Road::body};
};

TEST_F(WrittenValue, NumbersMayBeWorkedOut) {
  EXPECT_EQ(si("1/3", "m"), 1.0 / 3);
  EXPECT_EQ(si("pi/6", "rad"), 0.5235987755982989);
  EXPECT_EQ(si("30*deg", "rad"), si("pi/6", "rad"));
  EXPECT_EQ(si("-(1 + 1/2)*pi", "rad/s"), -1.5 * pi);
  EXPECT_EQ(si("2 m", "m"), 2);
  EXPECT_EQ(code("2 m", "kg"), "wrong_dimension");
}

TEST_F(WrittenValue, ParametersHaveTheValuesGivenOrTheirDefaults) {
  EXPECT_EQ(si("m", "kg"), 0.5);
  EXPECT_DOUBLE_EQ(si("k", "N/m"), 4.905);
  given_ = {{"l", "50 cm"}, {"g", 10}};
  EXPECT_EQ(si("2*l", "m"), 1);
  EXPECT_EQ(si("k", "N/m"), 20);
  EXPECT_EQ(si("2*sqrt(g/l)", "rad/s"), 2 * std::sqrt(20));
  given_ = {{"l", "g/(10/3)^2*(l0_is_no_parameter)"}};
  EXPECT_EQ(code("2*l", "m"), "unknown_symbol");
}

TEST_F(WrittenValue, NothingIsRoundedTwice) {
  given_ = {{"m", "0.1"}, {"l", "0.3"}, {"g", "0.3"}};
  const Real exactly = std::get<Real>(read("m*g/l", "N/m"));  // 1/10, not the double nearest to it
  const Real tenth = Number::ratio(1, 10).rounded();
  EXPECT_EQ(exactly.value, tenth.value);
  EXPECT_NEAR(exactly.low, tenth.low, 1e-31);
  EXPECT_LT(exactly.error, 1e-30);
}

TEST_F(WrittenValue, ACircleHasNoValue) {
  given_ = {{"l", "g*m/k"}, {"k", "m*g/l"}};
  EXPECT_EQ(code("l", "m"), "circular");
  EXPECT_EQ(code("2*k", "N/m"), "circular");
  EXPECT_EQ(code("m", "kg"), "none");
}

TEST_F(WrittenValue, DimensionsFit) {
  EXPECT_EQ(code("m*l", "N/m"), "wrong_dimension");
  EXPECT_EQ(code("m + l", "kg"), "wrong_dimension");
  EXPECT_EQ(code("sin(l)", "1"), "wrong_dimension");
  EXPECT_EQ(code("g/l", "1/s^2"), "none");
  EXPECT_EQ(code("0*m", "m"), "none");
}

TEST_F(WrittenValue, WhatIsWrongIsSaid) {
  EXPECT_EQ(code("30 dge", "rad"), "unknown_unit");
  EXPECT_EQ(code("2*", "m"), "syntax");
  EXPECT_EQ(code("l0", "m"), "unknown_symbol");
  EXPECT_EQ(code("3*kg", "kg"), "unknown_symbol");
  EXPECT_EQ(code("1/0", "m"), "syntax");
  EXPECT_EQ(code("log(m - m)", "1"), "out_of_range");
  EXPECT_EQ(code("", "m"), "syntax");
  EXPECT_EQ(std::get<QuantityError>(read("2*ll", "m")).allowed,
            (std::vector<std::string>{"m", "l", "g", "k"}));
}

TEST_F(WrittenValue, WhatWasMeantIsSuggested) {
  const auto meant = [&](std::string_view text, std::string_view unit) {
    const auto result = read(text, unit);
    return std::holds_alternative<Real>(result) ? "nothing" : std::get<QuantityError>(result).did_you_mean;
  };
  EXPECT_EQ(meant("2mg/l", "N/m"), "2*m*g/l");
  EXPECT_EQ(meant("2mg/l", "kg"), "") << "the product's dimension does not fit";
  EXPECT_EQ(meant("2mg/l", "m"), "");
  EXPECT_EQ(meant("30 dgrees", "rad"), "30 deg");
  EXPECT_EQ(meant("0,6", "m"), "0.6");
  EXPECT_EQ(meant("1E 2", "kg"), "1e2");
  EXPECT_EQ(meant("2*L", "m"), "l");
  EXPECT_EQ(code("inf", "kg"), "out_of_range");
}

TEST_F(WrittenValue, SignsBeyondAsciiAreRead) {
  EXPECT_EQ(si("π/6", "rad"), si("pi/6", "rad"));
  EXPECT_EQ(si("−2", "m"), -2);
  EXPECT_EQ(si("2·m", "kg"), 1);
}

TEST_F(WrittenValue, WithoutAScopeThereAreNumbersOnly) {
  ParameterScope none;
  EXPECT_EQ(std::get<Real>(written_value("2*pi", "s", none)).value, 2 * pi);
  EXPECT_EQ(std::get<QuantityError>(written_value("2*m", "s", none)).code, "unknown_unit");
}

}  // namespace
}  // namespace qdot::api::written_value_test
