#include "core/grading/student_functions.hpp"

#include <map>
#include <string>

namespace qdot {
namespace {

using Apply = std::optional<Expression> (*)(const Expression& x);

template <Function function>
std::optional<Expression> plain(const Expression& x) {
  return x.graph().call(function, x);
}

template <Function function>
std::optional<Expression> inverse(const Expression& x) {
  const Expression value = x.graph().call(function, x);
  return value.is_zero() ? std::nullopt : std::optional(pow(value, Number(-1)));
}

std::optional<Expression> cotangent(const Expression& x) {
  const Expression below = sin(x);
  return below.is_zero() ? std::nullopt : std::optional(cos(x) / below);
}

std::optional<Expression> root(const Expression& x) { return sqrt(x); }

const std::map<std::string, Apply, std::less<>>& functions() {
  using enum Function;
  static const std::map<std::string, Apply, std::less<>> all{
      {"sin", plain<sin>},     {"cos", plain<cos>},   {"tan", plain<tan>},     {"asin", plain<asin>},
      {"acos", plain<acos>},   {"atan", plain<atan>}, {"arcsin", plain<asin>}, {"arccos", plain<acos>},
      {"arctan", plain<atan>}, {"sinh", plain<sinh>}, {"cosh", plain<cosh>},   {"tanh", plain<tanh>},
      {"exp", plain<exp>},     {"log", plain<log>},   {"ln", plain<log>},      {"abs", plain<abs>},
      {"sign", plain<sign>},   {"sgn", plain<sign>},  {"sec", inverse<cos>},   {"csc", inverse<sin>},
      {"cosec", inverse<sin>}, {"cot", cotangent},    {"cotan", cotangent},    {"sqrt", root}};
  return all;
}

const Apply* find(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  const auto found = functions().find(lower);
  return found == functions().end() ? nullptr : &found->second;
}

}  // namespace

bool is_function_word(std::string_view word) { return find(word) != nullptr; }

std::optional<Expression> applied(std::string_view word, const Expression& argument) {
  const Apply* apply = find(word);
  return apply == nullptr ? std::nullopt : (*apply)(argument);
}

}  // namespace qdot
