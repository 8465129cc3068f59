#include "api/answers/sweep/variables.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "api/contract/notes.hpp"
#include "api/contract/record_reader.hpp"
#include "api/contract/system_choice.hpp"
#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "core/numerics/function.hpp"
#include "core/numerics/random_bits.hpp"

namespace qdot::api {
namespace {

/// One variable as it was given, with where its parts stand.
struct GivenVariable {
  std::string name;
  Json parts;
  bool is_flat;  ///< its parts stand in the request itself
};

/// What one variable runs over: values, or a law that a sample draws from.
struct SweptRange {
  SweepVariable variable;
  std::vector<double> values;
  enum class Law { none, uniform, normal } law{Law::none};
  double first{}, second{};
  Json echo{};
};

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
  if (request.spacing) parts["spacing"] = *request.spacing == Spacing::linear ? "linear" : "log";
  return parts;
}

class VariableReader {
 public:
  VariableReader(const Scene& scene, const FieldSet& asked, const Place& whole, ParameterScope& scope,
                 Errors& errors)
      : scene_(scene),
        asked_(asked),
        whole_(whole),
        vary_(whole.below("vary")),
        scope_(scope),
        errors_(errors) {}

  std::optional<SweptRange> read(const GivenVariable& given) {
    const Place place = given.is_flat ? vary_ : vary_.below(given.name);
    auto variable = variable_called(given.name, place);
    if (!variable) return std::nullopt;
    const Place& parts_place = given.is_flat ? whole_ : place;
    const std::size_t errors_before = errors_.size();
    const Json parts = resolved_parts(given, parts_place);
    SweptRange range{.variable = std::move(*variable), .values = {}};
    if (errors_.size() == errors_before) fill(parts, parts_place, range);
    return errors_.size() == errors_before ? std::optional(std::move(range)) : std::nullopt;
  }

 private:
  Json resolved_parts(const GivenVariable& given, const Place& place) {
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

  std::optional<SweepVariable> variable_called(const std::string& name, const Place& place) {
    std::vector<std::string> allowed;
    for (const SymbolRole role : {SymbolRole::parameter, SymbolRole::initial}) {
      if (field_of(asked_, role) == nullptr) continue;
      for (const Symbol& symbol : symbols(scene_, role)) {
        if (symbol.name == name) return SweepVariable{name, role, symbol.unit};
        allowed.push_back(symbol.name);
      }
    }
    std::string detail =
        "What varies is a parameter or an initial value of the system that is asked about; " +
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

  double number(const Json& value, const SweepVariable& variable, const Place& place) {
    const auto read =
        read_number(NumberKind{.unit = variable.unit}, variable.name, value, place, scope_, errors_);
    if (!read) return 0;
    // One sentence is enough, however many values are meant so.
    if (notes_.empty())
      if (std::string note = note_on({variable.name, variable.unit, {}}, value, read->value); !note.empty())
        notes_.push_back(std::move(note));
    return read->value;
  }

  void fill(const Json& parts, const Place& place, SweptRange& range) {
    const SweepVariable& variable = range.variable;
    if (parts.contains("values")) {
      const Place values = place.below("values");
      for (std::size_t i = 0; i < parts["values"].size(); ++i)
        range.values.push_back(number(parts["values"][i], variable, values.below(i)));
      range.echo = {{"values", range.values}};
      return;
    }
    for (const char* law : {"uniform", "normal"}) {
      if (!parts.contains(law)) continue;
      const Place pair = place.below(std::string_view(law));
      range.law = law == std::string_view("uniform") ? SweptRange::Law::uniform : SweptRange::Law::normal;
      range.first = number(parts[law][0], variable, pair.below(std::size_t{0}));
      range.second = number(parts[law][1], variable, pair.below(std::size_t{1}));
      range.echo[law] = {range.first, range.second};
      const bool is_normal = range.law == SweptRange::Law::normal;
      if (is_normal ? range.second < 0 : range.second < range.first)
        report(errors_, pair.error("out_of_range", is_normal ? "A standard deviation is not negative."
                                                             : "The least value stands first."));
      return;
    }
    fill_grid(parts, place, range);
  }

  void fill_grid(const Json& parts, const Place& place, SweptRange& range) {
    const double from = number(parts["from"], range.variable, place.below("from"));
    const double to = number(parts["to"], range.variable, place.below("to"));
    const auto count = parts["count"].get<std::int64_t>();
    const bool is_log = parts.value("spacing", "linear") == "log";
    if (is_log && (from == 0 || to == 0 || (from > 0) != (to > 0))) {
      report(errors_,
             place.below("spacing").error("out_of_range", "Equal ratios need values on one side of 0."));
      return;
    }
    if (count > most_) {
      refuse_rows(place.below("count"));
      return;
    }
    range.echo = {{"from", from}, {"to", to}, {"count", count}, {"spacing", is_log ? "log" : "linear"}};
    const auto steps = static_cast<double>(count - 1);
    for (std::int64_t i = 0; i < count; ++i) {
      const auto step = static_cast<double>(i);
      // Whole numbers of steps: 1 to 20 in 190 steps goes over 1.1, not over 1.0999999999999999.
      const double between =
          is_log ? from * power(to / from, step / steps) : (from * (steps - step) + to * step) / steps;
      range.values.push_back(i == 0 ? from : i == count - 1 ? to : between);
    }
    if (!std::ranges::all_of(range.values, [](double value) { return std::isfinite(value); }))
      report(errors_, place.below("to").error("out_of_range", "The values between pass double precision."));
  }

 public:
  void refuse_rows(const Place& place) {
    report(errors_, place.error("too_many", "The sweep has more than " + std::to_string(most_) +
                                                " rows, the most that are answered at once."));
  }
  void allow(std::int64_t most_rows) { most_ = most_rows; }
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  const Scene& scene_;
  const FieldSet& asked_;
  const Place& whole_;
  Place vary_;
  ParameterScope& scope_;
  Errors& errors_;
  std::vector<std::string> notes_;
  std::int64_t most_{};
};

/// One more draw of a variable.
double drawn(const SweptRange& range, RandomBits& random) {
  if (range.law == SweptRange::Law::uniform)
    return range.first + (range.second - range.first) * random.fraction();
  const double radius = std::sqrt(-2 * evaluate(Function::log, 1 - random.fraction()));
  return range.first +
         range.second * (radius * evaluate(Function::cos, 2 * std::numbers::pi * random.fraction()));
}

void draw(const std::vector<SweptRange>& ranges, std::uint64_t seed, SweptValues& swept) {
  RandomBits random(seed);
  for (std::size_t row = 0; row < swept.rows; ++row)
    for (const SweptRange& range : ranges) swept.values.push_back(drawn(range, random));
}

void combine(const std::vector<SweptRange>& ranges, SweptValues& swept) {
  for (std::size_t row = 0; row < swept.rows; ++row) {
    std::size_t block = swept.rows;
    for (const SweptRange& range : ranges) {
      block /= range.values.size();
      swept.values.push_back(range.values[row / block % range.values.size()]);
    }
  }
}

std::vector<GivenVariable> given_variables(const SweepRequest& request, const Place& whole, Errors& errors) {
  const Place vary = whole.below("vary");
  if (request.vary.is_string()) return {{request.vary.get<std::string>(), parts_beside(request), true}};
  if (!request.vary.is_object() || request.vary.empty()) {
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

const FieldSet& parts_of_variable() {
  static const FieldSet set{
      .name = "variable",
      .fields = {{.name = "from",
                  .kind = AnyKind{},
                  .aliases = {"start", "min", "lower", "range", "interval", "linspace"}},
                 {.name = "to", .kind = AnyKind{}, .aliases = {"end", "stop", "max", "upper"}},
                 {.name = "count",
                  .kind = IntegerKind{1, std::int64_t{1} << 40U},
                  .aliases = {"n", "num", "samples", "number", "step", "steps", "points", "npoints", "by",
                              "increment"}},
                 {.name = "spacing", .kind = ChoiceKind{{"linear", "log"}}, .aliases = {"scale"}},
                 {.name = "values",
                  .kind = ListKind{AnyKind{}, static_cast<std::size_t>(limits::sweep_rows), 1},
                  .aliases = {"list"}},
                 {.name = "uniform", .kind = ListKind{AnyKind{}, 2, 2}},
                 {.name = "normal", .kind = ListKind{AnyKind{}, 2, 2}, .aliases = {"gaussian", "gauss"}}},
      .one_of = {{.ways = {{"from", "to", "count", "spacing"}, {"values"}, {"uniform"}, {"normal"}},
                  .need = Need::required}}};
  return set;
}

std::optional<SweptValues> read_variables(const SweepRequest& request, const Scene& scene,
                                          const FieldSet& asked, const Place& whole, ParameterScope& scope,
                                          std::int64_t most_rows, Errors& errors) {
  const std::size_t errors_before = errors.size();
  VariableReader reader(scene, asked, whole, scope, errors);
  reader.allow(most_rows);
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
  for (const SweptRange& range : ranges) rows *= is_sample ? 1 : static_cast<double>(range.values.size());
  if (rows > static_cast<double>(most_rows)) {
    reader.refuse_rows(is_sample ? whole.below("count") : whole.below("vary"));
    return std::nullopt;
  }
  SweptValues swept{.rows = static_cast<std::size_t>(rows),
                    .is_sample = is_sample,
                    .echo = Json::object(),
                    .notes = reader.notes()};
  for (const SweptRange& range : ranges) {
    swept.variables.push_back(range.variable);
    swept.echo[range.variable.name] = range.echo;
  }
  if (is_sample) {
    draw(ranges, static_cast<std::uint64_t>(request.seed.value_or(0)), swept);
  } else {
    combine(ranges, swept);
  }
  const bool are_finite =
      std::ranges::all_of(swept.values, [](double value) { return std::isfinite(value); });
  if (are_finite) return swept;
  report(errors, whole.below("vary").error("out_of_range", "The values drawn pass double precision."));
  return std::nullopt;
}

}  // namespace qdot::api
