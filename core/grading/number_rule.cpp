#include "core/grading/number_rule.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>

#include "core/numerics/function.hpp"

namespace qdot {
namespace {

bool is_within_digits(double submitted, double expected, int places) {
  const double half = 0.51 * power(10.0, static_cast<double>(-places));
  return submitted > expected - half && submitted < expected + half;
}

/// floor(log10 |x|), from the decimal digits of x; x != 0.
int decimal_exponent(double x) {
  char text[32];
  const char* const end =
      std::to_chars(text, text + sizeof text, std::abs(x), std::chars_format::scientific).ptr;
  const char* exponent = std::find<const char*>(text, end, 'e') + 1;
  if (*exponent == '+') ++exponent;
  int value{};
  std::from_chars(exponent, end, value);
  return value;
}

/// Decimal places that so many significant digits of x have.
int places_of(double x, int digits) { return digits - 1 - (x == 0 ? 0 : decimal_exponent(x)); }

bool webwork_accepts(const NumberRule& rule, double submitted, double expected) {
  double tolerance = rule.tolerance;
  if (rule.is_relative) {
    const bool is_small = std::min(std::abs(submitted), std::abs(expected)) < rule.zero_level;
    tolerance = is_small ? rule.zero_tolerance : tolerance * std::abs(expected);
  }
  return std::abs(submitted - expected) < tolerance || submitted == expected;
}

/// A few units in the last place: there, the expected number counts as the double that it is.
bool is_rounding(const KnownNumber& x) {
  return x.error <= 4 * std::numeric_limits<double>::epsilon() * std::abs(x.value);
}

/// The numbers that a rule accepts for s are an interval around s. So what holds at both ends holds between
/// them, unless s itself is there.
Agreement agreement(const NumberRule& rule, double submitted, const KnownNumber& expected) {
  const bool at_value = accepts(rule, submitted, expected.value);
  if (is_rounding(expected)) return at_value ? Agreement::yes : Agreement::no;
  const double lower = expected.value - expected.error, upper = expected.value + expected.error;
  if (!std::isfinite(upper - lower)) return Agreement::unknown;
  const bool at_lower = accepts(rule, submitted, lower), at_upper = accepts(rule, submitted, upper);
  if (at_value && at_lower && at_upper) return Agreement::yes;
  const bool is_outside = submitted < lower || submitted > upper;
  return !at_value && !at_lower && !at_upper && is_outside ? Agreement::no : Agreement::unknown;
}

/// e moved by whole periods as near to s as it gets.
KnownNumber nearest(double submitted, KnownNumber expected, const std::optional<double>& period) {
  if (!period) return expected;
  const double turns = std::nearbyint((submitted - expected.value) / *period);
  expected.value += turns * *period;
  expected.error +=
      4 * std::numeric_limits<double>::epsilon() * (std::abs(expected.value) + std::abs(turns * *period));
  return expected;
}

Agreement worst(std::span<const Agreement> all) {
  if (std::ranges::find(all, Agreement::no) != all.end()) return Agreement::no;
  if (std::ranges::find(all, Agreement::unknown) != all.end()) return Agreement::unknown;
  return Agreement::yes;
}

/// Whether each row gets a column of its own that `fits` it (augmenting paths).
bool has_matching(std::size_t n, const std::function<bool(std::size_t, std::size_t)>& fits) {
  std::vector<std::optional<std::size_t>> row_of(n);
  for (std::size_t start = 0; start < n; ++start) {
    std::vector<bool> is_tried(n);
    const std::function<bool(std::size_t)> place = [&](std::size_t row) {
      for (std::size_t column = 0; column < n; ++column) {
        if (is_tried[column] || !fits(row, column)) continue;
        is_tried[column] = true;
        if (row_of[column] && !place(*row_of[column])) continue;
        row_of[column] = row;
        return true;
      }
      return false;
    };
    if (!place(start)) return false;
  }
  return true;
}

Agreement compare_sets(const NumberRule& rule, const std::optional<double>& period,
                       std::span<const double> submitted, std::span<const KnownNumber> expected) {
  const std::size_t n = expected.size();
  std::vector<Agreement> table;
  for (const double s : submitted) {
    for (const KnownNumber& e : expected) table.push_back(agreement(rule, s, nearest(s, e, period)));
  }
  if (has_matching(n, [&](auto i, auto j) { return table[i * n + j] == Agreement::yes; }))
    return Agreement::yes;
  const bool may_match = has_matching(n, [&](auto i, auto j) { return table[i * n + j] != Agreement::no; });
  return may_match ? Agreement::unknown : Agreement::no;
}

/// The submitted numbers on the scale of the expected ones, told by the largest of these; none where that is
/// zero on one side only.
std::optional<std::vector<double>> on_the_same_scale(std::span<const double> submitted,
                                                     std::span<const KnownNumber> expected) {
  const auto size = [](const KnownNumber& x) { return std::abs(x.value); };
  const auto largest = std::ranges::max_element(expected, {}, size);
  const double of_submitted = submitted[static_cast<std::size_t>(largest - expected.begin())];
  if (of_submitted == 0 || largest->value == 0) return std::nullopt;
  const double scale = of_submitted / largest->value;
  std::vector<double> scaled;
  for (const double s : submitted) scaled.push_back(s / scale);
  return scaled;
}

}  // namespace

bool accepts(const NumberRule& rule, double submitted, double expected) {
  const double distance = std::abs(submitted - expected);
  switch (rule.comparison) {
    case Comparison::relabs:
      return distance <= rule.atol + rule.rtol * std::abs(expected);
    case Comparison::sigfig:
      return is_within_digits(submitted, expected, places_of(expected, rule.digits));
    case Comparison::decdig:
      return is_within_digits(submitted, expected, rule.digits);
    case Comparison::stack_relative:
      return distance <= rule.tolerance * std::abs(expected);
    case Comparison::stack_absolute:
      return distance < rule.tolerance;
    case Comparison::webwork:
      return webwork_accepts(rule, submitted, expected);
  }
  return false;
}

Agreement compare(const NumberRule& rule, const Grouping& grouping, std::span<const double> submitted,
                  std::span<const KnownNumber> expected) {
  if (submitted.size() != expected.size()) return Agreement::no;
  if (expected.empty()) return Agreement::yes;
  std::optional<std::vector<double>> scaled;
  if (grouping.any_scale) {
    scaled = on_the_same_scale(submitted, expected);
    if (!scaled) return Agreement::no;
    submitted = *scaled;
  }
  if (grouping.any_order) return compare_sets(rule, grouping.period, submitted, expected);
  std::vector<Agreement> all;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    all.push_back(agreement(rule, submitted[i], nearest(submitted[i], expected[i], grouping.period)));
  }
  return worst(all);
}

}  // namespace qdot
