#include "api/contract/units.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "core/mechanics/units.hpp"

namespace qdot::api {
namespace {

constexpr double pi = std::numbers::pi;

double si(std::string_view text, std::string_view unit) {
  const auto result = parse_quantity(text, unit);
  if (const auto* error = std::get_if<QuantityError>(&result)) {
    ADD_FAILURE() << text << ": " << error->code << ": " << error->detail;
    return 0;
  }
  return std::get<Real>(result).value;
}

QuantityError error_of(std::string_view text, std::string_view unit) {
  const auto result = parse_quantity(text, unit);
  return std::holds_alternative<Real>(result) ? QuantityError{"none", ""} : std::get<QuantityError>(result);
}

TEST(Units, BareNumbersAreSi) {
  EXPECT_EQ(si("1.5e-3", "m"), 1.5e-3);
  EXPECT_EQ(si(" -3 ", "kg"), -3);
  EXPECT_EQ(si("+.5", "rad"), 0.5);
  EXPECT_EQ(si("7.", "1"), 7);
}

TEST(Units, DecimalPrefixesAreExact) {
  EXPECT_EQ(si("35cm", "m"), 0.35);  // 35*0.01 would be 0.35000000000000003
  EXPECT_EQ(si("12 cm", "m"), 0.12);
  EXPECT_EQ(si("7 g/cm^3", "kg/m^3"), 7000);
  EXPECT_EQ(si("40 N/m", "kg/s^2"), 40);
  EXPECT_EQ(si("9.81 m/s^2", "m/s^2"), 9.81);
  EXPECT_EQ(si("9.81m/s**2", "m/s^2"), 9.81);
}

TEST(Units, AnglesComeOutInRadians) {
  EXPECT_EQ(si("180deg", "rad"), pi);
  EXPECT_DOUBLE_EQ(si("30 deg", "rad"), pi / 6);
  EXPECT_EQ(si("1 rev", "rad"), 2 * pi);
  EXPECT_DOUBLE_EQ(si("90deg/s", "rad/s"), pi / 2);
}

TEST(Units, NothingIsRoundedBeforeItIsADouble) {
  const auto real = [](std::string_view text, std::string_view unit) {
    return std::get<Real>(parse_quantity(text, unit));
  };
  EXPECT_EQ(real("35cm", "m"), Number::ratio(7, 20).rounded());
  EXPECT_EQ(real("0.1000000000000000000001", "m"), Number::written("0.1000000000000000000001")->rounded());
  EXPECT_EQ(real("3 um^4", "m^4"), Number::written("3e-24")->rounded());
  EXPECT_EQ(real("180deg", "rad").double_double().low, exact_pi.low);
  EXPECT_LT(real("30deg", "rad").error, 1e-30);
  EXPECT_NE(real("30deg", "rad").low, 0);
  EXPECT_EQ(error_of("1 (um^99)^99", "m").code, "unknown_unit");
}

TEST(Units, AnAngularVelocityInHertzCountsTurns) {
  EXPECT_DOUBLE_EQ(si("2 rev/s", "rad/s"), 4 * pi);
  EXPECT_DOUBLE_EQ(si("120 rpm", "rad/s"), 4 * pi);
  EXPECT_DOUBLE_EQ(si("2 Hz", "rad/s"), 4 * pi);
  EXPECT_DOUBLE_EQ(si("2 Hz^2", "rad^2/s^2"), 8 * pi * pi);
  EXPECT_EQ(si("2 1/s", "rad/s"), 2);
  EXPECT_EQ(si("2 Hz", "1/s"), 2);
  EXPECT_EQ(si("2 Hz", "Hz"), 2);
}

TEST(Units, WordsAndSignsArePeoplesOwn) {
  EXPECT_EQ(si("180°", "rad"), pi);
  EXPECT_EQ(si("180 degrees", "rad"), pi);
  EXPECT_EQ(si("90 degrees/second", "rad/s"), pi / 2);
  EXPECT_EQ(si("9.81 m/s²", "m/s^2"), 9.81);
  EXPECT_EQ(si("3 N·m", "J"), 3);
  EXPECT_EQ(si("5 µm", "m"), 5e-6);
  EXPECT_EQ(si("10 rad/sec", "rad/s"), 10);
  EXPECT_EQ(si("250 cm/s", "m/s"), 2.5);
  EXPECT_EQ(si("2 newtons/meter", "kg/s^2"), 2);
}

TEST(Units, AMisspelledUnitIsToldTheOneMeantAndAllThatFit) {
  EXPECT_EQ(error_of("30 dge", "rad").detail,
            "'dge' is not a unit known here; did you mean deg? Write a number of rad (deg or rev will do as "
            "well).");
  EXPECT_EQ(error_of("3 furlong", "m").detail,
            "'furlong' is not a unit known here; write a number of m (km, cm, mm or um will do as well).");
  EXPECT_EQ(error_of("3 §", "m/s^2").detail, "'§' is not a unit known here; write a number of m/s^2.");
}

TEST(Units, AUnitIsSuggestedOnlyWhereItFits) {
  EXPECT_EQ(error_of("9.81 m/s2", "m/s^2").did_you_mean, "9.81 m/s^2");
  EXPECT_EQ(error_of("9.81ms-2", "m/s^2").did_you_mean, "9.81 m/s^2");
  EXPECT_EQ(error_of("30d", "rad").did_you_mean, "30 deg");
  EXPECT_EQ(error_of("1 KG", "kg").did_you_mean, "1 kg");
  EXPECT_EQ(error_of("1 kg*2", "kg").did_you_mean, "");
  EXPECT_EQ(error_of("10 gal", "m/s^2").detail, "'gal' is not a unit known here; write a number of m/s^2.");
  EXPECT_EQ(error_of("10 grad", "rad").did_you_mean, "");
  EXPECT_EQ(si("180º", "rad"), pi);
}

TEST(Units, NumbersOfOtherCountriesAndLanguagesAreToldHowTheyAreWrittenHere) {
  EXPECT_EQ(error_of("1,5", "m").did_you_mean, "1.5");
  EXPECT_EQ(error_of("1.000,5", "m").did_you_mean, "1000.5");
  EXPECT_EQ(error_of("1_000", "m").did_you_mean, "1000");
  EXPECT_EQ(error_of("1'000", "m").did_you_mean, "1000");
  EXPECT_EQ(error_of("1d-3", "m").did_you_mean, "1e-3");
  EXPECT_EQ(error_of("2π", "rad").did_you_mean, "2*pi");
}

TEST(Units, AWrongDimensionNamesBoth) {
  const QuantityError error = error_of("3 kg", "m");
  EXPECT_EQ(error.code, "wrong_dimension");
  EXPECT_EQ(error.detail, "'kg' does not fit; m is needed.");
  EXPECT_EQ(error_of("3 J", "N").detail, "'J' (kg*m^2/s^2) does not fit; N (kg*m/s^2) is needed.");
  EXPECT_EQ(error_of("30deg", "m").code, "wrong_dimension");
}

TEST(Units, WhatIsNoQuantityIsRefused) {
  for (const char* text :
       {"", " ", "abc", "inf", "nan", "-inf", "0x10a", "--3", "+-3", "1,5", "1 2", "- 3", "."}) {
    EXPECT_NE(error_of(text, "m").code, "none") << text;
  }
  EXPECT_EQ(error_of("1e999", "m").code, "out_of_range");
  EXPECT_EQ(error_of("1e308 km", "m").code, "out_of_range");
  EXPECT_EQ(error_of("3 furlong", "m").code, "unknown_unit");
  EXPECT_EQ(error_of("3 m/", "m").code, "unknown_unit");
  EXPECT_EQ(error_of(std::string(10'000, '1'), "m").code, "syntax");
  EXPECT_LT(error_of(std::string(10'000, '1'), "m").detail.size(), 200U);
}

// The names of core/mechanics/units.hpp.

TEST(UnitNames, AreReadAsProductsQuotientsAndPowers) {
  for (const char* text :
       {"N*s/m", "kg/s", "N/(m/s)", "kg*s^-1", " N * s / m ", "N s/m", "kg s^-1", "N m^-1 s"}) {
    const auto unit = parse_unit(text);
    ASSERT_TRUE(unit) << text;
    EXPECT_EQ(to_text(unit->dimension), "kg/s") << text;
    EXPECT_TRUE(unit->is_coherent());
  }
  for (const char* text :
       {"", "m/", "*m", "kg  2", "(m", "m)", "m^", "m^x", "m^1000", "m^(1/0)", "cm^(1/2)", "2", "M"}) {
    EXPECT_FALSE(parse_unit(text)) << text;
  }
}

TEST(UnitNames, AreOfOtherSystemsToo) {
  EXPECT_EQ(si("1 in", "m"), 0.0254);
  EXPECT_EQ(si("3 feet", "m"), si("1 yd", "m"));
  EXPECT_EQ(si("1 lbf", "N"), 4.4482216152605);
  EXPECT_EQ(si("1 kWh", "J"), 3.6e6);
  EXPECT_EQ(si("200 gon", "rad"), si("180 deg", "rad"));
  EXPECT_EQ(si("2 /s", "1/s"), 2);
}

TEST(UnitNames, DefinitionsAgree) {
  const auto dimension = [](std::string_view text) { return parse_unit(text).value().dimension; };
  EXPECT_EQ(dimension("N*m"), dimension("J"));
  EXPECT_EQ(dimension("J/s"), dimension("W"));
  EXPECT_EQ(dimension("V*A"), dimension("W"));
  EXPECT_EQ(dimension("C*V"), dimension("J"));
  EXPECT_EQ(dimension("T*A*m"), dimension("N"));  // the force on a wire
  EXPECT_EQ(dimension("ohm"), dimension("V/A"));
  EXPECT_EQ(dimension("Pa"), dimension("N/m^2"));
  EXPECT_TRUE(dimension("rad*deg").is_dimensionless());
}

TEST(UnitNames, ADimensionIsReadBackFromItsText) {
  for (const char* text : {"1", "kg*m^2/(s^3*A)", "1/s", "m^(1/2)", "kg^(2/3)/A^9"}) {
    const auto unit = parse_unit(text);
    ASSERT_TRUE(unit) << text;
    EXPECT_EQ(to_text(unit->dimension), text);
  }
}

TEST(UnitNames, PowersUndoThemselves) {
  const Dimension period_squared = parse_unit("s^2").value().dimension;
  EXPECT_EQ(to_text(pow(period_squared, 1, 2)), "s");
  EXPECT_EQ(pow(pow(period_squared, 1, 3), 3), period_squared);
  EXPECT_TRUE(pow(period_squared, 0).is_dimensionless());
}

TEST(UnitNames, NoExponentOverflows) {
  Dimension large = parse_unit("m").value().dimension;
  Dimension fine = large;
  for (int i = 0; i < 64; ++i) {
    large = pow(large, 99);
    fine = pow(fine, 1, 97);
  }
  EXPECT_FALSE(large.is_dimensionless());
  EXPECT_FALSE(parse_unit("um^99"));
  EXPECT_TRUE(parse_unit("((((rad^99)^99)^99)^99)^99"));
}

}  // namespace
}  // namespace qdot::api
