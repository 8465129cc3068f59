// The ways in which submissions write derivatives by time.

#include "core/grading/student_grammar.hpp"

namespace qdot {

bool StudentGrammar::is_derivative_call() const {
  const std::string_view word = token().text;
  const bool is_named = word == "diff" || word == "Derivative" || (word == "D" && !vocabulary_.find("D"));
  return is_named && at(Mark::open, 1);
}

bool StudentGrammar::derivative_begins() const {
  const std::string_view word = token().text;
  return word == "diff" || word == "Derivative" || word == "dot" || word == "ddot" ||
         (word == "d" && (at_word("dt", 2) || at_word("dt", 4)));
}

std::optional<Expression> StudentGrammar::derivative() {
  const std::string_view word = token().text;
  if (is_derivative_call()) return called_derivative();
  if ((word == "dot" || word == "ddot") && at(Mark::open, 1)) {
    ++next_;
    const Expression inside = rate_of(bracket());
    return word == "dot" ? inside : rate_of(inside);
  }
  if (const auto of_word = leibniz_of_word()) return of_word;
  if (word != "d") return std::nullopt;
  if (at(Mark::open, 1)) return leibniz_of_bracket();
  if (at(Mark::over, 1) && at_word("dt", 2)) {  // d/dt (...)
    next_ += 3;
    return rate_of(nested([this] { return primary(); }));
  }
  return leibniz();
}

std::optional<Expression> StudentGrammar::leibniz() {
  const bool is_second = at(Mark::power, 1) && at_number(2, 2);
  const std::size_t next = is_second ? 3 : 1;
  const std::size_t after = is_second ? 4 : 2;
  if (is_second && at(Mark::over, next) && ends_with_dt(next, true)) {
    next_ += next + 4;
    return rate_of(rate_of(nested([this] { return primary(); })));
  }
  if (!at(Mark::name, next) || !ends_with_dt(after, is_second)) return std::nullopt;
  const auto word = vocabulary_.find(token(next).text);
  if (!word || !vocabulary_.varies(*word)) return std::nullopt;
  next_ += after + (is_second ? 4 : 2);
  return is_second ? rate_of(rate_of(*word)) : rate_of(*word);
}

bool StudentGrammar::ends_with_dt(std::size_t ahead, bool is_second) const {
  if (!at(Mark::over, ahead) || !at_word("dt", ahead + 1)) return false;
  return !is_second || (at(Mark::power, ahead + 2) && at_number(2, ahead + 3));
}

std::optional<Expression> StudentGrammar::leibniz_of_word() {
  const std::string_view word = token().text;
  const bool is_second = word.starts_with("d2");
  const std::string_view rest = word.substr(std::min<std::size_t>(is_second ? 2 : 1, word.size()));
  if (!word.starts_with('d') || rest.empty() || !at(Mark::over, 1)) return std::nullopt;
  if (!at_word(is_second ? "dt2" : "dt", 2)) return std::nullopt;
  const auto symbol = vocabulary_.find(rest);
  if (!symbol || !vocabulary_.varies(*symbol)) return std::nullopt;
  next_ += 3;
  return is_second ? rate_of(rate_of(*symbol)) : rate_of(*symbol);
}

std::optional<Expression> StudentGrammar::leibniz_of_bracket() {
  std::size_t end = 1;
  for (int open = 0; !at(Mark::end, end); ++end) {
    if (at(Mark::open, end)) ++open;
    if (at(Mark::close, end) && --open == 0) break;
  }
  if (!at(Mark::over, end + 1) || !at_word("dt", end + 2)) return std::nullopt;
  ++next_;
  const Expression inside = bracket();
  next_ += 2;
  return rate_of(inside);
}

Expression StudentGrammar::called_derivative() {
  next_ += 2;
  Expression e = nested([this] { return sum(); });
  int order = 0;
  while (accept(Mark::comma)) {
    const bool is_pair = accept(Mark::open);
    if (at_word("t")) {
      ++next_;
      ++order;
      if (!is_pair && at_number(2, 0)) {  // Maple's t$2, whose $ is a blank
        ++next_;
        ++order;
      }
      if (!is_pair) continue;
      if (!accept(Mark::comma)) refuse("a derivative is by t here", token().offset);
    }
    if (!at_number(1, 0) && !at_number(2, 0)) refuse("a derivative is by t here", token().offset);
    order += at_number(2, 0) ? 1 : 0;
    ++next_;
    if (is_pair) close();
  }
  close();
  if (order == 0) refuse("a derivative is by t here: diff(theta, t)", token().offset);
  for (int i = 0; i < order; ++i) e = rate_of(e);
  return e;
}

}  // namespace qdot
