#include "api/about/agreement.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"

namespace qdot::api {
namespace {

using Values = std::map<std::string, double>;

constexpr double tolerance = 1e-9;
constexpr int states = 4;
constexpr int accelerations = 4;  // tried in each state
constexpr std::string_view equals = " = ";

bool is_equation(std::string_view text) { return text.find(equals) != std::string_view::npos; }

bool is_acceleration(std::string_view name) { return name.ends_with("_ddot"); }

bool are_close(double a, double b) {
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

/// The symbols of an expression or an equation.
std::set<std::string> names_in(std::string_view text) {
  const auto belongs = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::set<std::string> names;
  while (!text.empty()) {
    const auto end = std::ranges::find_if_not(text, belongs);
    const std::string word(text.begin(), end);
    const bool is_name = !word.empty() && std::isdigit(static_cast<unsigned char>(word[0])) == 0;
    if (is_name && word != "pi" && word != "sqrt" && !function_named(word)) names.insert(word);
    text.remove_prefix(std::max<std::size_t>(word.size(), 1));
  }
  return names;
}

double value_of(std::string_view text, const Values& values) {
  Graph graph;
  std::vector<std::string> names;
  std::vector<Assignment> assignments;
  for (const auto& [name, value] : values) {
    names.push_back(name);
    assignments.emplace_back(graph.symbol(name), value);
  }
  return evaluate(parse(text, graph, names), assignments);
}

std::pair<double, double> sides_of(std::string_view equation, const Values& values) {
  const std::size_t middle = equation.find(equals);
  return {value_of(equation.substr(0, middle), values),
          value_of(equation.substr(middle + equals.size()), values)};
}

double residual(std::string_view equation, const Values& values) {
  const auto [left, right] = sides_of(equation, values);
  return left - right;
}

/// Numbers from 0.5 to 1.5, other ones for each state and, of accelerations, for each trial.
Values sample(const std::set<std::string>& names, int state, int trial) {
  constexpr double golden = 0.6180339887498949, plastic = 0.7548776662466927;
  Values values;
  for (const std::string& name : names) {
    const int round = is_acceleration(name) ? state * accelerations + trial : state;
    const double x = golden * static_cast<double>(values.size() + 1) + plastic * (round + 1);
    values[name] = 0.5 + (x - std::floor(x));
  }
  return values;
}

std::set<std::string> names_in_both(const std::string& printed, const std::string& answer) {
  std::set<std::string> names = names_in(printed);
  names.merge(names_in(answer));
  return names;
}

bool is_same_expression(const std::string& printed, const std::string& answer) {
  const std::set<std::string> names = names_in_both(printed, answer);
  for (int state = 0; state < states; ++state) {
    const Values values = sample(names, state, 0);
    if (!are_close(value_of(printed, values), value_of(answer, values))) return false;
  }
  return true;
}

bool is_same_equation(const std::string& printed, const std::string& answer) {
  const std::set<std::string> names = names_in_both(printed, answer);
  if (std::ranges::none_of(names, is_acceleration)) return false;
  for (int state = 0; state < states; ++state) {
    const Values first = sample(names, state, 0);
    const double a = residual(printed, first), b = residual(answer, first);
    for (int trial = 1; trial < accelerations; ++trial) {
      const Values values = sample(names, state, trial);
      if (a == 0 || b == 0 || !are_close(residual(printed, values) * b, residual(answer, values) * a))
        return false;
    }
  }
  return true;
}

/// Half a unit of the last digit of a decimal; 0 for anything else.
double half_a_unit(const std::string& printed) {
  const std::size_t point = printed.find('.');
  if (point == std::string::npos || printed.find_first_not_of("-0123456789.") != std::string::npos) return 0;
  return 0.5 * power(10.0, -static_cast<double>(printed.size() - point - 1));
}

bool is_same_number(const std::string& printed, double answer, const std::string& name, Values values) {
  if (is_equation(printed)) {
    values[name] = answer;
    const auto [left, right] = sides_of(printed, values);
    return std::abs(left - right) <= tolerance * std::max({1.0, std::abs(left), std::abs(right)});
  }
  const double value = value_of(printed, values);
  return are_close(value, answer) || std::abs(value - answer) <= half_a_unit(printed);
}

Json names_of(const Json& answer) {
  if (answer.is_array()) return answer;
  Json names = Json::array();
  for (const auto& [name, value] : answer.items()) names.push_back(name);
  return names;
}

bool agrees_at(const Json& at, const Json& printed, const Json& answer) {
  const Json::json_pointer place(at.get<std::string>());
  const Json& found = answer.at(place);
  if (printed.is_array()) return names_of(found) == printed;
  const auto text = printed.get<std::string>();
  if (found.is_number()) {
    const Values parameters = answer.at("request").value("parameters", Json::object()).get<Values>();
    return is_same_number(text, found.get<double>(), place.back(), parameters);
  }
  const auto given = found.get<std::string>();
  return is_equation(text) ? is_equation(given) && is_same_equation(text, given)
                           : is_same_expression(text, given);
}

}  // namespace

bool agrees(const Json& prints, const Json& answer) {
  return std::ranges::all_of(
      prints, [&](const Json& one) { return agrees_at(one.at("at"), one.at("value"), answer); });
}

}  // namespace qdot::api
