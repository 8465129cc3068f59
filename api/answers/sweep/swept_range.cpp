#include "api/answers/sweep/swept_range.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/contract/notes.hpp"
#include "api/contract/record_reader.hpp"
#include "api/contract/system_choice.hpp"
#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "core/numerics/double_double_function.hpp"

namespace qdot::api {
namespace {

constexpr std::int64_t most_counted = 1'000'000'000;  ///< the rows are counted together

/// The place of step i of n between two numbers, rounded once from the decimals that were written: 0.1 to 1
/// in nine steps goes over 0.3, and 1 to 1000 in three equal ratios over 10. No step comes near the largest
/// double on the way.
DoubleDouble between(const DoubleDouble& from, const DoubleDouble& to, double i, double n) {
  constexpr int room = 64;  // powers of two, more than there are steps
  if (std::max(std::abs(from.high), std::abs(to.high)) > 0x1p900)
    return scaled(between(scaled(from, -room), scaled(to, -room), i, n), room);
  return (from * (n - i) + to * i) / n;
}

using Between = std::function<double(double i, double n)>;

Between evenly_between(const Real& from, const Real& to) {
  return [first = from.double_double(), last = to.double_double()](double i, double n) {
    return between(first, last, i, n).high;
  };
}

constexpr double near_the_largest = 600;  ///< logarithm from which exp may pass doubles on its way

/// Of the logarithms of what is on one side of zero, each written there in its own digits.
Between between_by_ratio(const Real& from, const Real& to) {
  const double side = from.value < 0 ? -1 : 1;
  const auto logarithm = [](const Real& x) { return evaluate(Function::log, abs(x.double_double())); };
  return [side, first = logarithm(from), last = logarithm(to)](double i, double n) {
    const DoubleDouble at = between(first, last, i, n);
    if (at.high < near_the_largest) return side * exp(at).high;
    const DoubleDouble root = exp(at * 0.5);
    return side * scaled(root * scaled(root, -64), 64).high;
  };
}

}  // namespace

const FieldSet& parts_of_variable() {
  const AnyKind number{{{"type", {"number", "string"}}}};  // in the unit of the variable
  static const FieldSet set{
      .name = "variable",
      .description = "What one variable runs over: a grid, values, or the law that a sample draws from.",
      .fields = {{.name = "from",
                  .kind = number,
                  .description = "first value",
                  .aliases = {"start", "min", "lower", "range", "interval", "linspace"}},
                 {.name = "to",
                  .kind = number,
                  .description = "last value",
                  .aliases = {"end", "stop", "max", "upper"}},
                 {.name = "count",
                  .kind = IntegerKind{1, most_counted},
                  .description = "how many values",
                  .aliases = {"n", "num", "samples", "number", "step", "steps", "points", "npoints", "by",
                              "increment"}},
                 {.name = "spacing",
                  .kind = ChoiceKind{{"linear", "log"}},
                  .description = "how the values lie: equal differences, or with 'log' equal ratios",
                  .aliases = {"scale"}},
                 {.name = "values",
                  .kind = ListKind{number, static_cast<std::size_t>(limits::sweep_rows), 1},
                  .description = "the values one by one",
                  .aliases = {"list"}},
                 {.name = "uniform",
                  .kind = ListKind{number, 2, 2},
                  .description = "least and largest value in a sample"},
                 {.name = "normal",
                  .kind = ListKind{number, 2, 2},
                  .description = "mean and standard deviation in a sample",
                  .aliases = {"gaussian", "gauss"}}},
      .one_of = {{.ways = {{"from", "to", "count", "spacing"}, {"values"}, {"uniform"}, {"normal"}},
                  .need = Need::required}}};
  return set;
}

std::optional<SweptRange> VariableReader::read(const GivenVariable& given) {
  const Place place = given.is_flat ? vary_ : vary_.below(given.name);
  auto variable = variable_called(given.name, place);
  if (!variable) return std::nullopt;
  const Place& parts_place = given.is_flat ? whole_ : place;
  const std::size_t errors_before = errors_.size();
  const Json parts = resolved_parts(given, parts_place);
  SweptRange range{.variable = std::move(*variable)};
  if (errors_.size() == errors_before) fill(parts, parts_place, range);
  return errors_.size() == errors_before ? std::optional(std::move(range)) : std::nullopt;
}

Json VariableReader::resolved_parts(const GivenVariable& given, const Place& place) {
  if (!given.parts.is_object()) {
    const bool is_list = given.parts.is_array();
    report(errors_, wrong_type(place, given.name,
                               is_list ? "an object: {\"values\": [...]} of these values, or {\"from\": 1, "
                                         "\"to\": 2, \"count\": 11}"
                                       : "an object such as {\"from\": 1, \"to\": 2, \"count\": 11}",
                               given.parts));
    return Json::object();
  }
  SystemChoice none;
  Json parts = read_record(parts_of_variable(), given.parts, place, none, errors_).resolved;
  if (parts.contains("from") || parts.contains("to")) {
    for (const std::string name : {"from", "to", "count"}) {
      if (!given.parts.contains(name))
        report(errors_, place.of_missing(name).error("missing", "'" + name +
                                                                    "' is missing: a grid has from, "
                                                                    "to and count."));
    }
  }
  return parts;
}

std::optional<SweepVariable> VariableReader::variable_called(const std::string& name, const Place& place) {
  std::vector<std::string> allowed;
  for (const SymbolRole role : {SymbolRole::parameter, SymbolRole::initial}) {
    if (field_of(asked_, role) == nullptr) continue;
    for (const Symbol& symbol : symbols(scene_, role)) {
      if (symbol.name == name) return SweepVariable{name, role, symbol.unit};
      allowed.push_back(symbol.name);
    }
  }
  if (allowed.empty()) {
    report(errors_,
           place.error("not_applicable", "The question that is asked takes no numbers that could vary."));
    return std::nullopt;
  }
  std::string detail = "What varies is a parameter or an initial value of the system that is asked about; " +
                       in_quotes(name) + " is none.";
  if (const std::size_t end = name.find_first_of(":=,; "); end != std::string::npos) {
    detail += name[end] == ',' ? " A query has one that varies; a POST has several, each in 'vary'."
                               : " Its values stand beside it: from=1&to=50&count=50, or values=1,2,5.";
    FieldError error = unknown_name(place, std::move(detail), name, allowed);
    error.did_you_mean = closest(name.substr(0, end), allowed);
    report(errors_, std::move(error));
    return std::nullopt;
  }
  report(errors_, unknown_name(place, std::move(detail), name, std::move(allowed)));
  return std::nullopt;
}

Real VariableReader::number(const Json& value, const SweepVariable& variable, const Place& place) {
  const auto read =
      read_number(NumberKind{.unit = variable.unit}, variable.name, value, place, scope_, errors_);
  if (!read) return {};
  // One sentence of a kind is enough, however many values are meant so.
  if (!has_noted_meaning_)
    if (std::string note = note_on({variable.name, variable.unit, {}}, value, read->value); !note.empty()) {
      has_noted_meaning_ = true;
      notes_.push_back(std::move(note));
    }
  if (value.is_string() && !has_noted_rounding_ && !is_what_its_double_says(*read, variable)) {
    has_noted_rounding_ = true;
    notes_.push_back(in_quotes(value.get<std::string>()) +
                     " is rounded: rows are asked with the numbers that the columns show.");
  }
  return *read;
}

/// Whether a row that is asked with the double is asked with the number, as with 0.5 for "50 cm": pi is not.
bool VariableReader::is_what_its_double_says(const Real& number, const SweepVariable& variable) {
  Errors none;
  const auto said =
      read_number(NumberKind{.unit = variable.unit}, variable.name, Json(number.value), whole_, scope_, none);
  return said && *said == number;
}

void VariableReader::fill(const Json& parts, const Place& place, SweptRange& range) {
  using Law = SweptRange::Law;
  if (parts.contains("values")) return fill_values(parts["values"], place.below("values"), range);
  for (const auto& [law, name] : {std::pair(Law::uniform, "uniform"), std::pair(Law::normal, "normal")})
    if (parts.contains(name)) return fill_law(law, parts[name], place.below(std::string_view(name)), range);
  fill_grid(parts, place, range);
}

void VariableReader::fill_values(const Json& values, const Place& place, SweptRange& range) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < values.size(); ++i)
    numbers.push_back(number(values[i], range.variable, place.below(i)).value);
  range.echo = {{"values", numbers}};
  range.count = numbers.size();
  range.value = [numbers = std::move(numbers)](std::size_t i) { return numbers[i]; };
}

void VariableReader::fill_law(SweptRange::Law law, const Json& pair, const Place& place, SweptRange& range) {
  const bool is_normal = law == SweptRange::Law::normal;
  range.law = law;
  range.first = number(pair[0], range.variable, place.below(std::size_t{0})).value;
  range.second = number(pair[1], range.variable, place.below(std::size_t{1})).value;
  range.echo[is_normal ? "normal" : "uniform"] = {range.first, range.second};
  if (is_normal ? range.second < 0 : range.second < range.first)
    report(errors_, place.error("out_of_range", is_normal ? "A standard deviation is not negative."
                                                          : "The least value stands first."));
}

void VariableReader::fill_grid(const Json& parts, const Place& place, SweptRange& range) {
  const Real from = number(parts["from"], range.variable, place.below("from"));
  const Real to = number(parts["to"], range.variable, place.below("to"));
  const auto count = parts["count"].get<std::int64_t>();
  const bool is_log = parts.value("spacing", "linear") == "log";
  if (is_log && (from.value == 0 || to.value == 0 || (from.value > 0) != (to.value > 0))) {
    report(errors_,
           place.below("spacing").error("out_of_range", "Equal ratios need values on one side of 0."));
    return;
  }
  if (count > most_rows_) {
    refuse_rows(place.below("count"));
    return;
  }
  range.echo = {
      {"from", from.value}, {"to", to.value}, {"count", count}, {"spacing", is_log ? "log" : "linear"}};
  range.count = static_cast<std::size_t>(count);
  range.value = [from = from.value, to = to.value, last = range.count - 1,
                 inside = is_log ? between_by_ratio(from, to) : evenly_between(from, to)](std::size_t i) {
    if (i == 0 || i == last) return i == 0 ? from : to;
    return inside(static_cast<double>(i), static_cast<double>(last));
  };
}

void VariableReader::refuse_rows(const Place& place) {
  report(errors_, place.error("too_many", "The sweep has more than " + std::to_string(most_rows_) +
                                              " rows, the most that are answered at once."));
}

}  // namespace qdot::api
