#include "api/json/writer.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

namespace qdot::api {
namespace {

std::string text(double value, int digits = shortest_digits) {
  std::string out;
  append_number(out, value, digits);
  return out;
}

/// Doubles of every size: random bits, without infinities and NaN.
std::vector<double> doubles_of_every_size(int count) {
  std::mt19937_64 bits(1);
  std::vector<double> result;
  while (result.size() < static_cast<std::size_t>(count)) {
    const auto value = std::bit_cast<double>(bits());
    if (std::isfinite(value)) result.push_back(value);
  }
  return result;
}

TEST(Numbers, LookLikeFloatingPointNumbers) {
  EXPECT_EQ(text(1), "1.0");
  EXPECT_EQ(text(-0.0), "0.0");
  EXPECT_EQ(text(0), "0.0");
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(-2.5), "-2.5");
  EXPECT_EQ(text(100000), "100000.0");
  EXPECT_EQ(text(123456789012345), "123456789012345.0");
  EXPECT_EQ(text(1e15), "1e+15");
  EXPECT_EQ(text(0.0001), "0.0001");
  EXPECT_EQ(text(0.00001), "1e-05");
  EXPECT_EQ(text(1e300), "1e+300");
}

TEST(Numbers, AreReadBackAsTheSameBits) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-6, 17);
  std::vector<double> values = doubles_of_every_size(100'000);
  for (int i = 0; i < 100'000; ++i) values.push_back(std::pow(10.0, exponent(random)));
  for (const double value : values) {
    const std::string written = text(value);
    ASSERT_EQ(Json::parse(written).get<double>(), value) << written;
    ASSERT_TRUE(Json::parse(written).is_number_float()) << written;
    ASSERT_LE(written.size(), Json(value).dump().size()) << "longer than the library's own";
  }
}

TEST(Numbers, AreRoundedToSignificantDigits) {
  EXPECT_EQ(text(3.14159265358979, 3), "3.14");
  EXPECT_EQ(text(2.5, 1), "2.0");  // ties to even
  EXPECT_EQ(text(99.96, 3), "100.0");
  EXPECT_EQ(text(-0.00012345, 2), "-0.00012");
  EXPECT_EQ(text(1234567, 2), "1200000.0");
  EXPECT_EQ(text(1.0 / 3, 17), text(1.0 / 3));
  EXPECT_EQ(text(std::numeric_limits<double>::max(), 1), text(std::numeric_limits<double>::max()));
  EXPECT_EQ(rounded(0.123456789, 4), 0.1235);
}

TEST(Numbers, OfSoManyDigitsAreNotLonger) {
  for (const double value : doubles_of_every_size(20'000)) {
    if (std::abs(value) > 1e307) continue;  // would round to infinity, so it stays whole
    for (int digits = 1; digits <= 17; ++digits) {
      std::string mantissa = text(value, digits);
      mantissa.resize(std::min(mantissa.size(), mantissa.find('e')));
      const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
      if (mantissa.ends_with(".0") || mantissa.starts_with("0.") || mantissa.starts_with("-0.")) continue;
      ASSERT_LE(std::ranges::count_if(mantissa, is_digit), digits) << text(value, digits);
    }
  }
}

TEST(Numbers, ThatAreNotFiniteAreOurMistake) {
  EXPECT_THROW(text(std::numeric_limits<double>::infinity()), std::logic_error);
  EXPECT_THROW(text(std::nan("")), std::logic_error);
  EXPECT_THROW((void)to_text(Json{{"x", std::nan("")}}), std::logic_error);
}

TEST(JsonWriter, WritesColumnsInOrder) {
  const std::vector<double> t{0, 0.5, 1};
  const std::vector<double> theta{0.1, -0.0, 1e-7};
  JsonWriter writer(Layout::compact);
  writer.begin_object();
  writer.member("system", "spring_pendulum");
  writer.key("trajectory");
  writer.columns(std::vector<Column>{{"t", t}, {"theta", theta}});
  writer.member("steps", 12);
  writer.end_object();
  EXPECT_EQ(std::move(writer).finish(),
            "{\"system\":\"spring_pendulum\",\"trajectory\":{\"t\":[0.0,0.5,1.0],\"theta\":[0.1,0.0,1e-07]},"
            "\"steps\":12}\n");
}

TEST(JsonWriter, WritesOnlyTheMembersOfTheDocumentThatAreWanted) {
  const std::vector<std::string> wanted{"b"};
  JsonWriter writer(Layout::compact, &wanted);
  writer.begin_object();
  writer.member("a", 1);
  EXPECT_FALSE(writer.wants("c"));
  writer.member("b", Json{{"a", 2}, {"c", 3}});
  writer.member("c", 4);
  writer.end_object();
  EXPECT_EQ(std::move(writer).finish(), "{\"b\":{\"a\":2,\"c\":3}}\n");
}

TEST(JsonWriter, WritesOnlyTheNumbersOfATableThatAreWanted) {
  const std::vector<double> t{0, 0.5, 1}, theta{0.1, 0.2, 0.3};
  const std::vector<Column> table{{"t", t}, {"theta", theta}, {"theta_dot", theta}};
  const auto written = [&](const std::vector<std::string>& wanted) {
    JsonWriter writer(Layout::compact, &wanted);
    writer.begin_object();
    if (writer.wants("trajectory")) {
      writer.key("trajectory");
      writer.columns(table);
    }
    writer.end_object();
    return std::move(writer).finish();
  };
  EXPECT_EQ(written({"/trajectory/theta/2", "units"}), "{\"trajectory\":{\"theta\":[null,null,0.3]}}\n");
  EXPECT_EQ(written({"/trajectory/theta/0", "/trajectory/t/1", "/trajectory/theta/9"}),
            "{\"trajectory\":{\"t\":[null,0.5,null],\"theta\":[0.1,null,null]}}\n");
  EXPECT_EQ(written({"/trajectory/t"}), "{\"trajectory\":{\"t\":[0.0,0.5,1.0]}}\n");
  EXPECT_EQ(written({"/trajectory/l/0"}), "{\"trajectory\":{}}\n");
  EXPECT_EQ(written({"/accuracy/rtol", "/trajectory"}), "{}\n");
}

TEST(JsonWriter, PrettyKeepsArraysOfNumbersOnOneLine) {
  const Json json{
      {"t", {0.5, 1}}, {"empty", Json::object()}, {"modes", Json::array({{{"omega", 2.0}}, {{"f", 1}}})}};
  EXPECT_EQ(to_text(json, Layout::pretty),
            "{\n"
            "  \"t\": [0.5, 1],\n"
            "  \"empty\": {},\n"
            "  \"modes\": [\n"
            "    {\n"
            "      \"omega\": 2.0\n"
            "    },\n"
            "    {\n"
            "      \"f\": 1\n"
            "    }\n"
            "  ]\n"
            "}\n");
}

TEST(JsonWriter, TwoRoadsOfOneDocument) {
  const Json json =
      Json::parse(R"({"a":[1,2.5,null,true,"x\"\\\n\u0000é"],"b":{"c":[[],{}],"d":-7},"e":[]})");
  EXPECT_EQ(to_text(json), json.dump() + "\n");
  EXPECT_EQ(Json::parse(to_text(json, Layout::pretty)), json);
}

TEST(JsonWriter, ReplacesWhatIsNotUtf8) {
  std::string out;
  append_string(out, "a\xFF");
  EXPECT_EQ(out, "\"a\xEF\xBF\xBD\"");
}

TEST(Csv, HasAHeaderRowAndLineFeeds) {
  const std::vector<double> t{0, 1};
  const std::vector<double> x{0.25, -3};
  EXPECT_EQ(to_csv(std::vector<Column>{{"t", t}, {"x", x}}), "t,x\n0.0,0.25\n1.0,-3.0\n");
  EXPECT_EQ(to_csv(std::vector<Column>{{"t", {}}}), "t\n");
  EXPECT_THROW((void)to_csv(std::vector<Column>{{"t", t}, {"x", {}}}), std::logic_error);
}

TEST(Rounding, OfABoundGoesUpToTheDigitsThatAreWritten) {
  EXPECT_EQ(rounded_up(0.00023333, 3), 0.000234);
  EXPECT_EQ(rounded_up(0.000234, 3), 0.000234);
  EXPECT_EQ(rounded_up(9.991, 3), 10);
  EXPECT_EQ(rounded_up(0, 3), 0);
  EXPECT_EQ(rounded_up(1.5, shortest_digits), 1.5);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> size(-300, 300);
  for (int i = 0; i < 20000; ++i) {
    const double bound = std::pow(10, size(random));
    const int digits = 1 + i % 17;
    const double written = rounded_up(bound, digits);
    EXPECT_GE(written, bound) << digits;
    EXPECT_EQ(rounded(written, digits), written) << digits;
    EXPECT_LE(written, bound * (1 + 1.0001 * std::pow(10, 1 - digits))) << digits;
  }
}

// Not a measurement, only a guard against a slip of an order of magnitude: tests/bench has the figures.
TEST(JsonWriter, WritesATrajectoryAboutAsFastAsItsDigits) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> size(-3, 3);
  std::vector<double> values(5 * 1001);
  for (double& value : values) value = size(random);
  using Clock = std::chrono::steady_clock;
  Clock::duration plain = Clock::duration::max();
  Clock::duration ours = Clock::duration::max();
  std::vector<char> buffer(32 * values.size());
  for (int repetition = 0; repetition < 20; ++repetition) {
    auto start = Clock::now();
    char* end = buffer.data();
    for (const double value : values) end = std::to_chars(end, buffer.data() + buffer.size(), value).ptr;
    plain = std::min(plain, Clock::now() - start);
    start = Clock::now();
    JsonWriter writer(Layout::compact);
    writer.numbers(values);
    const std::string out = std::move(writer).finish();
    ours = std::min(ours, Clock::now() - start);
    ASSERT_GT(out.size(), values.size());
  }
  RecordProperty("percent_of_to_chars", static_cast<int>(100 * ours / plain));
  EXPECT_LT(ours, 5 * plain);
}

}  // namespace
}  // namespace qdot::api
