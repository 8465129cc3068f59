#include "api/answers/sweep/variables.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "api/answers/sweep/swept_range.hpp"
#include "api/json/limits.hpp"
#include "core/base/work.hpp"
#include "core/numerics/function.hpp"
#include "core/numerics/random_bits.hpp"

namespace qdot::api {
namespace {

Json parts_beside(const SweepRequest& request) {
  Json parts = Json::object();
  const auto put = [&](const char* name, const Json& value) {
    if (!value.is_null()) parts[name] = value;
  };
  put("from", request.from);
  put("to", request.to);
  put("values", request.values);
  put("uniform", request.uniform);
  put("normal", request.normal);
  const bool is_sample = parts.contains("uniform") || parts.contains("normal");
  if (request.count && !is_sample) parts["count"] = *request.count;
  if (request.spacing) parts["spacing"] = *request.spacing;
  return parts;
}

std::uint64_t fractions_of(const SweptRange& range) { return range.law == SweptRange::Law::normal ? 2 : 1; }

/// The draw of a variable from the next of its fractions.
double drawn(const SweptRange& range, RandomBits& random) {
  if (range.law == SweptRange::Law::uniform) {
    if (const double width = range.second - range.first; std::isfinite(width))
      return range.first + width * random.fraction();
    return 2 * (range.first / 2 + (range.second / 2 - range.first / 2) * random.fraction());
  }
  const double radius = std::sqrt(-2 * evaluate(Function::log, 1 - random.fraction()));
  return range.first +
         range.second * (radius * evaluate(Function::cos, 2 * std::numbers::pi * random.fraction()));
}

double value_of_sample(const SweptValues& swept, std::size_t row, std::size_t variable) {
  std::uint64_t before = 0, of_row = 0;
  for (std::size_t i = 0; i < swept.ranges.size(); ++i) {
    if (i < variable) before += fractions_of(swept.ranges[i]);
    of_row += fractions_of(swept.ranges[i]);
  }
  RandomBits random(swept.seed, row * of_row + before);
  return drawn(swept.ranges[variable], random);
}

double value_of_grid(const SweptValues& swept, std::size_t row, std::size_t variable) {
  std::size_t block = 1;  // rows in which the variable keeps its value
  for (std::size_t i = variable + 1; i < swept.ranges.size(); ++i) block *= swept.ranges[i].count;
  const SweptRange& range = swept.ranges[variable];
  return range.value(row / block % range.count);
}

/// No draw is 16 of its law's numbers away from 0: a normal one is within 8.6 deviations of the mean.
bool is_surely_finite(const SweptRange& range) {
  return std::isfinite(16 * (std::abs(range.first) + std::abs(range.second)));
}

bool are_drawn_finite(const SweptValues& swept) {
  if (std::ranges::all_of(swept.ranges, is_surely_finite)) return true;
  for (std::size_t row = 0; row < swept.rows; ++row) {
    check_interruption(row);
    for (std::size_t i = 0; i < swept.variables.size(); ++i)
      if (!std::isfinite(swept.value(row, i))) return false;
  }
  return true;
}

std::vector<GivenVariable> given_variables(const SweepRequest& request, const Place& whole, Errors& errors) {
  const Place vary = whole.below("vary");
  if (request.vary.is_string()) return {{request.vary.get<std::string>(), parts_beside(request), true}};
  if (request.vary.is_object() && request.vary.empty()) {
    report(errors, vary.error("empty", "Nothing varies: {\"k\": {\"from\": 1, \"to\": 50, \"count\": 50}}."));
    return {};
  }
  if (!request.vary.is_object()) {
    report(errors, wrong_type(vary, "vary", "an object of variables, or the name of one", request.vary));
    return {};
  }
  const Json beside = parts_beside(request);
  for (const auto& [name, value] : beside.items()) {
    if (name != "count")
      report(errors, whole.below(name).error("unused", "'" + name +
                                                           "' stands beside the name of one variable; "
                                                           "here it belongs in 'vary'."));
  }
  if (request.vary.size() > limits::sweep_variables) {
    report(errors, vary.error("too_many", "At most " + std::to_string(limits::sweep_variables) +
                                              " things vary at once."));
    return {};
  }
  std::vector<GivenVariable> all;
  for (const auto& [name, parts] : request.vary.items()) all.push_back({name, parts, false});
  return all;
}

bool is_drawn(const SweptRange& range) { return range.law != SweptRange::Law::none; }

/// A sample has a count, and nothing of a grid beside it; a grid has neither count nor seed.
void check_sample(const SweepRequest& request, const std::vector<SweptRange>& ranges, const Place& whole,
                  Errors& errors) {
  const bool is_sample = std::ranges::any_of(ranges, is_drawn);
  if (is_sample && !std::ranges::all_of(ranges, is_drawn))
    report(errors, whole.below("vary").error("mixed", "A grid and a sample cannot be mixed."));
  if (is_sample && !request.count)
    report(errors, whole.below("count").error("missing", "'count' is missing: the rows of the sample."));
  const bool has_flat_count = request.vary.is_string();
  if (!is_sample && request.count && !has_flat_count)
    report(errors, whole.below("count").error("unused", "A grid has a count for each variable, in 'vary'."));
  if (!is_sample && request.seed)
    report(errors, whole.below("seed").error("unused", "Nothing is drawn by chance here."));
}

}  // namespace

double SweptValues::value(std::size_t row, std::size_t variable) const {
  return is_sample ? value_of_sample(*this, row, variable) : value_of_grid(*this, row, variable);
}

std::optional<SweptValues> read_variables(const SweepRequest& request, const Scene& scene,
                                          const FieldSet& asked, const Place& whole, ParameterScope& scope,
                                          std::int64_t most_rows, Errors& errors) {
  const std::size_t errors_before = errors.size();
  VariableReader reader(scene, asked, whole, most_rows, scope, errors);
  const std::vector<GivenVariable> all = given_variables(request, whole, errors);
  for (const GivenVariable& given : all) scope.leave_open(given.name);
  std::vector<SweptRange> ranges;
  for (const GivenVariable& given : all) {
    if (auto range = reader.read(given)) ranges.push_back(std::move(*range));
  }
  if (errors.size() == errors_before) check_sample(request, ranges, whole, errors);
  if (errors.size() > errors_before) return std::nullopt;
  const bool is_sample = is_drawn(ranges.front());
  double rows = is_sample ? static_cast<double>(*request.count) : 1;
  for (const SweptRange& range : ranges) rows *= is_sample ? 1 : static_cast<double>(range.count);
  if (rows > static_cast<double>(most_rows)) {
    reader.refuse_rows(is_sample ? whole.below("count") : whole.below("vary"));
    return std::nullopt;
  }
  SweptValues swept{.rows = static_cast<std::size_t>(rows),
                    .is_sample = is_sample,
                    .seed = static_cast<std::uint64_t>(request.seed.value_or(0)),
                    .echo = Json::object(),
                    .notes = reader.notes()};
  for (const SweptRange& range : ranges) {
    swept.variables.push_back(range.variable);
    swept.echo[range.variable.name] = range.echo;
  }
  swept.ranges = std::move(ranges);
  if (!is_sample || are_drawn_finite(swept)) return swept;  // the values of a grid are known to be
  report(errors, whole.below("vary").error("out_of_range", "The values drawn pass double precision."));
  return std::nullopt;
}

}  // namespace qdot::api
