#include "api/answers/check/trajectory_item.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "api/answers/check/trajectory_table.hpp"
#include "api/json/text.hpp"
#include "core/mechanics/units.hpp"
#include "core/numerics/constants.hpp"

namespace qdot::api {
namespace {

constexpr double longest_gap = 0.1;  // of the whole time; also before the first and after the last row

struct TrajectoryItem {
  const Asking* asking{};
  Json request;  ///< of simulate, without its instants
  std::vector<std::string> columns;
  Json names;  ///< the submission's words for columns
  double t_start{}, t_end{};
  double rtol{}, atol{};

  std::map<std::string, std::string> units{};  ///< of the columns

  /// What the submission calls the column `name`; empty where it has none.
  [[nodiscard]] std::string word_for(const TrajectoryTable& table, const std::string& name) const {
    if (table.columns.contains(name)) return name;
    if (!names.is_object()) return "";
    for (const auto& [word, meaning] : names.items()) {
      if (meaning == name && table.columns.contains(word)) return word;
    }
    return "";
  }

  /// The values of a column that is there, in SI.
  [[nodiscard]] std::vector<double> column(const TrajectoryTable& table, const std::string& name) const {
    const std::string word = word_for(table, name);
    std::vector<double> values = table.columns.at(word);
    for (double& value : values) value *= table.units.at(word).factor;
    return values;
  }

  [[nodiscard]] bool has_fitting_unit(const TrajectoryTable& table, const std::string& name) const {
    const ColumnHeading& heading = table.units.at(word_for(table, name));
    const auto unit = parse_unit(units.at(name));
    return !heading.has_unit || !unit || heading.dimension == unit->dimension;
  }
};

/// What is wrong with the instants; empty: nothing.
std::string fault_of_times(const TrajectoryItem& item, const std::vector<double>& t) {
  const double span = item.t_end - item.t_start, gap = std::abs(span) * longest_gap;
  if (t.size() < 2) return "At least two rows are needed.";
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (!((t[i] - t[i - 1]) * span > 0)) return "The instants have to follow each other in time.";
    if (std::abs(t[i] - t[i - 1]) > gap * (1 + 1e-9))
      return "Two rows are further apart than a tenth of the whole time.";
  }
  if (std::min(t.front(), t.back()) < std::min(item.t_start, item.t_end) ||
      std::max(t.front(), t.back()) > std::max(item.t_start, item.t_end))
    return "There are rows before the beginning or after the end.";
  if (std::abs(t.front() - item.t_start) > gap || std::abs(t.back() - item.t_end) > gap)
    return "The rows have to cover the whole time.";
  return "";
}

/// The motion at the instants submitted; none where it ends before the last of them.
std::optional<Json> motion_at(const TrajectoryItem& item, const std::vector<double>& t) {
  Json request = item.request;
  for (const char* other : {"samples", "dt", "times", "digits"}) request.erase(other);
  request["times"] = t;
  Errors errors;
  const Place here(Road::body);
  auto answer = item.asking->ask("simulate", request, here, errors);
  if (!answer || (*answer)["trajectory"]["t"].size() != t.size()) return std::nullopt;
  return answer;
}

/// Where a column is too far off; none where it is not; unknown where the reference does not tell.
struct ColumnVerdict {
  Agreement agreement{Agreement::yes};
  std::size_t row{};
};
ColumnVerdict compare_column(const TrajectoryItem& item, const std::vector<double>& submitted,
                             const std::vector<double>& expected, double error) {
  double scale = 0;
  for (const double e : expected) scale = std::max(scale, std::abs(e));
  const double tolerance = item.atol + item.rtol * scale;
  ColumnVerdict verdict;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double distance = std::abs(submitted[i] - expected[i]);
    if (distance - error > tolerance) return {Agreement::no, i};
    if (!(distance + error <= tolerance)) verdict = {Agreement::unknown, i};
  }
  return verdict;
}

/// A slip that makes every value of a column another one.
struct ColumnSlip {
  const char* name;
  double factor;
  bool (*is_of)(std::string_view unit);
  const char* text;
};

constexpr std::array column_slips{
    ColumnSlip{"sign", -1, [](std::string_view) { return true; }, "The sign is wrong."},
    ColumnSlip{"degrees", 180 / pi, [](std::string_view unit) { return unit.starts_with("rad"); },
               "It is in degrees; a number without a unit is in radians."},
    ColumnSlip{"factor", 2, [](std::string_view) { return true; },
               "A simple factor is missing, or too much."},
    ColumnSlip{"factor", 0.5, [](std::string_view) { return true; },
               "A simple factor is missing, or too much."}};

/// The slip that explains every row of every wrong column; null where none does.
Json column_diagnosis(const TrajectoryItem& item, const TrajectoryTable& table, const Json& motion) {
  for (const ColumnSlip& slip : column_slips) {
    bool explains = true;
    for (const std::string& name : item.columns) {
      const std::vector<double> submitted = item.column(table, name);
      auto expected = motion["trajectory"][name].get<std::vector<double>>();
      if (compare_column(item, submitted, expected, 0).agreement == Agreement::yes) continue;
      for (double& value : expected) value *= slip.factor;
      explains = explains && slip.is_of(item.units.at(name)) &&
                 compare_column(item, submitted, expected, 0).agreement == Agreement::yes;
    }
    if (explains) return {{"slip", slip.name}, {"text", slip.text}};
  }
  return nullptr;
}

Verdict compare_columns(const TrajectoryItem& item, const TrajectoryTable& table, const Json& motion) {
  Verdict verdict{.correct = true,
                  .decided_by = "rule",
                  .understood = {{"rows", table.t.size()}, {"columns", item.columns}}};
  for (const std::string& name : item.columns) {
    const std::vector<double> submitted = item.column(table, name);
    const auto expected = motion["trajectory"][name].get<std::vector<double>>();
    const Json& errors = motion["accuracy"]["max_abs_error"];
    const double error = errors.contains(name) && errors[name].is_number() ? errors[name].get<double>() : 0;
    const auto [agreement, row] = compare_column(item, submitted, expected, error);
    if (agreement == Agreement::no) {
      verdict.correct = false;
      verdict.counterexample = {{"column", name}, {"t", table.t[row]}, {"value", submitted[row]}};
      verdict.diagnosis = column_diagnosis(item, table, motion);
      return verdict;
    }
    if (agreement == Agreement::unknown) verdict.correct.reset();
  }
  if (!verdict.correct) verdict.feedback.emplace_back("The motion is not known well enough to tell.");
  verdict.expected = motion["trajectory"];
  return verdict;
}

Verdict grade_trajectory(const TrajectoryItem& item, const Json& submitted) {
  const TrajectoryTable table = trajectory_table(submitted);
  if (!table.unreadable.empty()) return unreadable(table.unreadable);
  for (const std::string& name : item.columns) {
    if (item.word_for(table, name).empty()) return unreadable("A column " + in_quotes(name) + " is needed.");
    if (!item.has_fitting_unit(table, name))
      return unreadable("The unit of the column " + in_quotes(name) + " is one of another kind of quantity.");
  }
  if (const std::string fault = fault_of_times(item, table.t); !fault.empty()) return unreadable(fault);
  const auto motion = motion_at(item, table.t);
  if (!motion) return undecided("The motion ends before the last of these instants.");
  return compare_columns(item, table, *motion);
}

/// The columns that are asked for: all coordinates and velocities of the motion unless some are named.
std::vector<std::string> columns_of(const Json& expect, const Json& trajectory, const Place& place,
                                    Errors& errors) {
  std::vector<std::string> known, asked;
  for (const auto& [name, values] : trajectory.items()) {
    if (name != "t") known.push_back(name);
  }
  if (!expect.contains("columns")) return known;
  const Json& columns = expect["columns"];
  if (!columns.is_array() || columns.empty()) {
    report(errors, wrong_type(place, "columns", "an array of names", columns));
    return {};
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string name = columns[i].is_string() ? columns[i].get<std::string>() : "";
    if (std::ranges::find(known, name) != known.end()) {
      asked.push_back(name);
    } else {
      FieldError error =
          unknown_name(place.below(i), "The motion has no column " + in_quotes(name) + ".", name, known);
      error.code = "unknown_column";
      report(errors, std::move(error));
    }
  }
  return asked;
}

}  // namespace

std::optional<Grader> read_trajectory_item(const CheckItem& item, const std::string& kind,
                                           const ExpectationScope& scope, const Place& place,
                                           Errors& errors) {
  const Place expect = place.below("expect");
  const std::size_t mistakes = errors.size();
  const RuleRequest rule = item.rule.value_or(RuleRequest{});
  const Place rule_place = place.below("rule");
  const bool is_plain =
      rule.kind == Comparison::relabs && !rule.any_order && !rule.any_scale && rule.modulo.is_null();
  if (!is_plain)
    report(errors,
           rule_place.error("unused",
                            "Trajectories are compared by 'relabs', of each column's largest magnitude."));
  const auto answer = scope.asking.ask(kind, item.expect[kind], expect.below(kind), errors);
  if (!answer) return std::nullopt;
  TrajectoryItem read{
      .asking = &scope.asking, .request = item.expect[kind], .columns = {}, .names = item.names};
  for (const auto& [name, unit] : (*answer)["units"].items()) read.units[name] = unit.get<std::string>();
  read.columns = columns_of(item.expect, (*answer)["trajectory"], expect.below("columns"), errors);
  if (errors.size() != mistakes) return std::nullopt;
  read.t_start = (*answer)["request"]["t_start"].get<double>();
  read.t_end = (*answer)["request"]["t_end"].get<double>();
  const NumberRule defaults;
  read.rtol = rule.rtol.value_or(defaults.rtol);
  read.atol = rule.atol.value_or(defaults.atol);
  return [read = std::move(read)](const Json& submitted) { return grade_trajectory(read, submitted); };
}

}  // namespace qdot::api
