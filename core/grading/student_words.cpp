// Words, brackets and functions of submissions.

#include "core/base/work.hpp"
#include "core/expr/parse_tokens.hpp"
#include "core/expr/refused_sign.hpp"
#include "core/grading/student_functions.hpp"
#include "core/grading/student_grammar.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_words = 8000;

}  // namespace

Expression StudentGrammar::primary() {
  spend_work(1);
  const StudentToken& first = token();
  if (accept(Mark::number)) return checked(graph_.number(first.value));
  if (at(Mark::open)) return primed(bracket());
  if (accept(Mark::bar)) return between_bars();
  if (at(Mark::prime) && (at_word("diff", 1) || at_word("integrate", 1))) ++next_;  // Maxima's noun
  if (at(Mark::name)) return named();
  refuse(at(Mark::end) ? "the formula ends where a number, a symbol or a bracket is needed"
                       : "a number, a symbol or a bracket is needed at " + excerpt(first.text),
         first.offset);
}

Expression StudentGrammar::bracket() {
  ++next_;
  const Expression inside = nested([this] { return sum(); });
  close();
  return inside;
}

void StudentGrammar::close() {
  if (accept(Mark::close)) return;
  if (at(Mark::end)) refuse("a bracket is not closed");
  refuse_rest();
}

Expression StudentGrammar::between_bars() {
  ++open_bars_;
  const Expression inside = nested([this] { return sum(); });
  --open_bars_;
  if (!accept(Mark::bar)) refuse("a bar | is not closed", token().offset);
  return checked(graph_.call(Function::abs, inside));
}

Expression StudentGrammar::named() {
  if (const auto found = derivative()) return of_time(primed(*found));
  if (at_word("Rational") && at(Mark::open, 1)) return rational();
  cut_word();
  const std::string_view word = token().text;
  if (!vocabulary_.find(word)) return application();
  const Expression e = *vocabulary_.find(word);
  ++next_;
  return of_time(primed(of_time(e)));
}

Expression StudentGrammar::of_time(const Expression& e) {
  const bool is_acceleration =
      std::ranges::find(vocabulary_.rates(), e, &Replacement::second) != vocabulary_.rates().end();
  const bool is_of_time = at(Mark::open) && at_word("t", 1) && at(Mark::close, 2);
  if (is_of_time && (is_acceleration || vocabulary_.varies(e))) next_ += 3;
  return e;
}

Expression StudentGrammar::rational() {
  next_ += 2;
  const Expression above = nested([this] { return sum(); });
  if (!accept(Mark::comma)) refuse("Rational has two numbers, with a comma between them", token().offset);
  const Expression below = nested([this] { return sum(); });
  close();
  if (below.is_zero()) refuse("division by zero", token().offset);
  return checked(above / below);
}

Expression StudentGrammar::primed(Expression e) {
  while (accept(Mark::prime)) e = rate_of(e);
  const bool is_raised = at(Mark::power) && (at(Mark::prime, 1) || (at(Mark::open, 1) && at(Mark::prime, 2)));
  if (!is_raised) return e;
  ++next_;  // \theta^{\prime\prime}
  const bool is_grouped = accept(Mark::open);
  while (accept(Mark::prime)) e = rate_of(e);
  if (is_grouped) close();
  return e;
}

Expression StudentGrammar::rate_of(const Expression& e) {
  if (!vocabulary_.varies(e) || vocabulary_.has_accelerations(e))
    refuse("only coordinates have derivatives here, up to the second", token().offset);
  const Expression rate = total_derivative(e, vocabulary_.rates());
  if (rate.is_zero()) refuse("only coordinates have derivatives here, up to the second", token().offset);
  return checked(rate);
}

void StudentGrammar::cut_word() {
  const StudentToken whole = token();
  const auto knows = [&](std::string_view w) { return vocabulary_.find(w) || is_function_word(w); };
  const bool is_word = knows(whole.text);
  if (is_word && (vocabulary_.is_certain(whole.text) || is_function_word(whole.text))) return;
  const auto found = cuts(whole.text, knows);
  if (found.empty() && whole.text == "e" && at(Mark::power, 1)) return;
  if (found.empty()) refuse_joined_number(whole);
  if (found.empty()) refuse_unknown(whole);
  if (found.size() > 1)
    refuse(excerpt(whole.text) + " has two readings: write its products with *", whole.offset);
  if (tokens_.size() + found[0].size() > most_words)
    refuse("the formula has too many words", whole.offset, ErrorCode::too_large);
  std::vector<StudentToken> words;
  for (const std::string_view word : found[0]) {
    words.push_back({.mark = Mark::name, .text = word, .offset = whole.offset, .is_apart = false});
  }
  words.front().is_apart = whole.is_apart;
  const auto here = tokens_.begin() + static_cast<std::ptrdiff_t>(next_);
  *here = words.front();
  tokens_.insert(here + 1, words.begin() + 1, words.end());
}

void StudentGrammar::refuse_joined_number(const StudentToken& word) const {
  const std::size_t digits = word.text.find_first_of("0123456789");
  if (digits == std::string_view::npos || !is_function_word(word.text.substr(0, digits))) return;
  const std::string function(word.text.substr(0, digits)), number(1, word.text[digits]);
  refuse(excerpt(word.text) + " has two readings: write " + function + "(" + number + "*...) or " + function +
             "^" + number + "(...)",
         word.offset);
}

void StudentGrammar::refuse_unknown(const StudentToken& word) const {
  std::string names;
  for (const std::string& name : vocabulary_.names()) names += (names.empty() ? "" : ", ") + name;
  refuse("unknown symbol " + excerpt(word.text) + "; there are " + names, word.offset,
         ErrorCode::unknown_symbol);
}

Expression StudentGrammar::application() {
  const StudentToken word = token();
  ++next_;
  if (word.text == "e") {
    ++next_;  // the ^ that cut_word saw
    return checked(graph_.call(Function::exp, exponent()));
  }
  std::optional<Expression> power;
  if (accept(Mark::power)) {
    power = exponent();
    const Number* number = power->number();
    if (number == nullptr || number->is_negative())
      refuse("sin^-1 has two readings: write asin or 1/sin", word.offset);
  }
  const Expression argument = at(Mark::open) ? bracket() : bare_argument(word);
  const auto value = applied(word.text, argument);
  if (!value) refuse(excerpt(word.text) + " has no value there", word.offset);
  return power ? raised(checked(*value), *power) : checked(*value);
}

Expression StudentGrammar::bare_argument(const StudentToken& function) {
  const std::string name(function.text);
  std::vector<Expression> factors;
  if (at(Mark::number)) {
    factors.push_back(graph_.number(token().value));
    ++next_;
  }
  if (!at(Mark::name) || (derivative_begins() && factors.empty())) return lone_number(factors, function);
  cut_word();
  const auto word = vocabulary_.find(token().text);
  if (!word) refuse("write brackets around the argument of " + name, token().offset);
  ++next_;
  const Expression last = of_time(primed(of_time(*word)));
  factors.push_back(last);
  const bool is_parameter = !vocabulary_.varies(last) && !(last == vocabulary_.time());
  if (is_parameter && at(Mark::name)) {
    cut_word();
    const auto next = vocabulary_.find(token().text);
    if (next && !(*next == vocabulary_.time()))
      refuse("write brackets around the argument of " + name, token().offset);
    if (next) {
      factors.push_back(*next);
      ++next_;
    }
  }
  refuse_ambiguous_end(name, last);
  return checked(graph_.product(factors));
}

Expression StudentGrammar::lone_number(const std::vector<Expression>& factors, const StudentToken& function) {
  const std::string name(function.text);
  if (factors.empty()) refuse("write brackets around the argument of " + name, token().offset);
  if (at(Mark::open) || at(Mark::times) || at(Mark::over) || at(Mark::power))
    refuse("write brackets around the argument of " + name, token().offset);
  return factors[0];
}

bool StudentGrammar::opens_with_symbols(std::size_t ahead) const {
  int depth = 0;
  for (std::size_t i = ahead; !at(Mark::end, i); ++i) {
    if (at(Mark::open, i)) ++depth;
    if (depth == 0) return false;
    if (at(Mark::name, i)) return true;
    if (at(Mark::close, i) && --depth == 0) return false;
  }
  return false;
}

void StudentGrammar::refuse_ambiguous_end(const std::string& name, const Expression& argument) const {
  const bool is_clear = vocabulary_.is_angle(argument) && (at(Mark::name, 1) || opens_with_symbols(1));
  const bool is_divided = at(Mark::over) && !is_clear;
  if (at(Mark::power) || is_divided) refuse("write brackets around the argument of " + name, token().offset);
}

}  // namespace qdot
