#include "core/grading/student_parser.hpp"

#include <cmath>

#include "core/base/work.hpp"
#include "core/expr/parse_tokens.hpp"
#include "core/expr/refused_sign.hpp"
#include "core/grading/plain_notation.hpp"
#include "core/grading/student_functions.hpp"
#include "core/grading/student_grammar.hpp"

namespace qdot {
namespace {

constexpr double largest_exponent = 64;
constexpr std::size_t most_nodes = 2000;

Blanks blanks_in(std::string_view text) {
  return text.find('\\') == std::string_view::npos ? Blanks::are_seen : Blanks::are_not_seen;
}

}  // namespace

std::vector<ReadEquation> StudentGrammar::whole() {
  std::vector<ReadEquation> equations;
  for (;;) {
    while (at(Mark::line) || at(Mark::comma)) ++next_;
    if (at(Mark::end)) break;
    equations.push_back(equation());
    if (!at(Mark::line) && !at(Mark::comma) && !at(Mark::end)) refuse_rest();
    const bool is_tight = at(Mark::comma) && !token().is_apart && at(Mark::number, 1) && !token(1).is_apart;
    if (is_tight && tokens_[next_ - 1].mark == Mark::number)
      refuse("a decimal has a point here, 0.5, and no comma", token().offset);
  }
  if (equations.empty()) refuse("there is no formula");
  return equations;
}

bool StudentGrammar::accept(Mark mark) {
  if (!at(mark)) return false;
  ++next_;
  return true;
}

ReadEquation StudentGrammar::equation() {
  if (at_word("Eq") && at(Mark::open, 1)) {
    next_ += 2;
    const Expression left = sum();
    if (!accept(Mark::comma)) refuse("Eq has two sides, with a comma between them");
    const Expression right = sum();
    close();
    return {left, right};
  }
  const Expression left = sum();
  if (!accept(Mark::equals)) return {left, std::nullopt};
  const Expression right = sum();
  if (at(Mark::equals)) refuse("there are two equals signs in one equation");
  return {left, right};
}

Expression StudentGrammar::sum() {
  std::vector<Expression> terms{term()};
  while (at(Mark::plus) || at(Mark::minus)) {
    const bool is_negative = at(Mark::minus);
    ++next_;
    const Expression next = term();
    terms.push_back(is_negative ? -next : next);
  }
  return terms.size() == 1 ? terms[0] : checked(graph_.sum(terms));
}

Expression StudentGrammar::term() {
  const bool is_negative = signs();
  std::size_t before = next_;
  std::vector<Expression> factors{factor()};
  for (;;) {
    if (accept(Mark::times)) {
      before = next_;
      factors.push_back(signed_factor());
    } else if (accept(Mark::over)) {
      factors.push_back(divisor(is_plain_number(before)));
      before = tokens_.size();
    } else if (begins_factor()) {
      before = next_;
      factors.push_back(factor());
    } else {
      break;
    }
  }
  const Expression product = factors.size() == 1 ? factors[0] : checked(graph_.product(factors));
  return is_negative ? -product : product;
}

bool StudentGrammar::is_plain_number(std::size_t first) const {
  return first < tokens_.size() && tokens_[first].mark == Mark::number && next_ == first + 2;
}

Expression StudentGrammar::divisor(bool is_fraction) {
  const std::size_t first = next_;
  const Expression e = signed_factor();
  if (e.is_zero()) refuse("division by zero");
  // g/2l, g/ml and k/m^2l have two readings; 1/2m is a fraction before m. Blanks do not show in LaTeX.
  const bool is_single = next_ == first + 1 || tokens_[first + 1].mark == Mark::power;
  const bool is_joined = at(Mark::name) && (blanks_ == Blanks::are_not_seen || !token().is_apart);
  const bool goes_on = is_joined && !is_function_word(token().text);
  const bool fraction = is_fraction && tokens_[first].mark == Mark::number;
  if (is_single && goes_on && !fraction) {
    std::string divisor;
    for (std::size_t i = first; i < next_; ++i)
      divisor += tokens_[i].mark == Mark::power ? "^" : tokens_[i].text;
    const std::string next(token().text);
    refuse("'/" + divisor + (token().is_apart ? " " : "") + next + "' has two readings: write /(" + divisor +
               "*" + next + ") or /" + divisor + "*" + next,
           token().offset);
  }
  return checked(pow(e, Number(-1)));
}

bool StudentGrammar::signs() {
  bool is_negative = false;
  for (; at(Mark::plus) || at(Mark::minus); ++next_) is_negative ^= at(Mark::minus);
  return is_negative;
}

Expression StudentGrammar::signed_factor() {
  const bool is_negative = signs();
  const Expression e = factor();
  return is_negative ? -e : e;
}

bool StudentGrammar::begins_factor() const {
  if (at(Mark::number)) refuse("two factors stand side by side: write * before the number", token().offset);
  return at(Mark::name) || at(Mark::open) || (at(Mark::bar) && open_bars_ == 0);
}

Expression StudentGrammar::factor() {
  const Expression base = primary();
  if (!accept(Mark::power)) return base;
  return raised(base, exponent());
}

Expression StudentGrammar::exponent() {
  const bool is_negative = signs();
  const bool is_one = at_number(1, 0);  // x^1/2 is meant as a root
  const Expression e = nested([this] {
    const Expression base = primary();
    return accept(Mark::power) ? raised(base, exponent()) : base;
  });
  if (is_one && at(Mark::over) && at(Mark::number, 1))
    refuse("a fraction in an exponent needs brackets: x^(1/2)", token().offset);
  return is_negative ? -e : e;
}

Expression StudentGrammar::raised(const Expression& base, const Expression& exponent) {
  const Number* number = exponent.number();
  if (number == nullptr) return checked(pow(base, exponent));
  if (std::abs(number->value()) > largest_exponent)
    refuse("an exponent is larger than 64", token().offset, ErrorCode::too_large);
  if (base.is_zero() && number->is_negative()) refuse("division by zero", token().offset);
  return checked(pow(base, *number));
}

Expression StudentGrammar::checked(const Expression& e) const {
  spend_work(1);
  if (graph_.size() - first_node_ > most_nodes)
    refuse("the formula has too many parts", token().offset, ErrorCode::too_large);
  const Number coefficient = split_coefficient(e).coefficient;
  if (!std::isfinite(coefficient.value()))
    refuse("a number in the formula is outside the range of a double", token().offset, ErrorCode::too_large);
  return e;
}

void StudentGrammar::refuse_rest() const {
  if (at(Mark::close)) refuse("there is no opening bracket for a closing one", token().offset);
  refuse("an operator is needed before " + excerpt(token().text), token().offset);
}

ReadSubmission read_submission(std::string_view text, Graph& graph, const Vocabulary& vocabulary) {
  ReadSubmission result;
  try {
    const std::string plain = plain_notation(text);
    result.equations = StudentGrammar(plain, graph, vocabulary, blanks_in(text)).whole();
  } catch (const Error& error) {
    result.errors.emplace_back(error.what());
  }
  return result;
}

}  // namespace qdot
