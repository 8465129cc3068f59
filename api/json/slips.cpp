#include "api/json/slips.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::string_view shell_hint =
    " If they were there when you typed it, the shell took them: put the whole body in single quotes, "
    "-d '{\"system\": ...}'.";

/// Other languages' words, and what JSON has for them.
constexpr auto foreign_words = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"True", "true"},
    {"False", "false"},
    {"TRUE", "true"},
    {"FALSE", "false"},
    {"None", "null"},
    {"nil", "null"},
    {"NULL", "null"},
    {"Null", "null"},
    {"undefined", "null"},
});

constexpr auto unbounded_words = std::to_array<std::string_view>(
    {"NaN", "nan", "Infinity", "-Infinity", "inf", "-inf", "Inf", "-Inf", "+Infinity", "infinity"});

constexpr auto quotes_of_typographers = std::to_array<std::string_view>({"“", "”", "„", "‘", "’", "«", "»"});

constexpr auto blanks_of_others =
    std::to_array<std::string_view>({"\xC2\xA0", "\xE2\x80\x8B", "\xE2\x80\xAF", "\xE3\x80\x80"});
constexpr auto dashes = std::to_array<std::string_view>({"−", "–", "—"});
constexpr std::string_view doubled_quotes =
    "Two double quotes stand together here: one on each side of a text is enough, \"system\".";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_plain(std::string_view number) {
  return std::ranges::all_of(number, [](char c) { return is_digit(c) || c == '.' || c == '-'; });
}

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("_+-.").find(c) != std::string_view::npos;
}

bool begins_with_one_of(std::string_view text, const auto& words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return text.starts_with(word); });
}

/// What may stand next.
enum class Next { value, value_or_end, key, key_or_end, colon, comma_or_end, nothing };

class SlipFinder {
 public:
  explicit SlipFinder(std::string_view text) : text_(text), at_(text.starts_with("\xEF\xBB\xBF") ? 3 : 0) {}

  std::string find() {
    if (rest().starts_with("[object "))
      return "This is what JavaScript calls an object, not the object: send JSON.stringify(...) of it.";
    while (slip_.empty()) {
      at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
      if (at_ == text_.size()) return next_ == Next::nothing ? "" : early_end();
      if (!take_token()) break;
    }
    return slip_;
  }

 private:
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }

  bool say(std::string sentence) {
    slip_ = std::move(sentence);
    return false;
  }

  /// Goes over one token that fits, or says what is wrong with it.
  bool take_token() {
    const char c = text_[at_];
    if (rest().starts_with("//") || rest().starts_with("/*") || c == '#')
      return say("JSON has no comments: leave this one out.");
    if (c == '\'') return say("JSON has double quotes around its strings, not single ones.");
    if (rest().starts_with("\\\""))
      return say("Between single quotes of a shell, double quotes need no backslash: '{\"system\": ...}'.");
    if (begins_with_one_of(rest(), quotes_of_typographers))
      return say("JSON has straight double quotes, \", around its strings, not typographic ones.");
    if (begins_with_one_of(rest(), blanks_of_others))
      return say("This blank is not an ordinary space but one that web pages use: type it again.");
    if (begins_with_one_of(rest(), dashes)) return say("A minus is the sign -, not a dash.");
    if (c == '`') return say("JSON has double quotes around its strings, not `.");
    switch (next_) {
      case Next::value:
      case Next::value_or_end:
        return c == ']' || c == '}' ? close(c) : take_value(c);
      case Next::key:
      case Next::key_or_end:
        return c == '}' || c == ']' ? close(c) : take_key(c);
      case Next::colon:
        return take_colon(c);
      case Next::comma_or_end:
        return c == '}' || c == ']' ? close(c) : take_comma(c);
      case Next::nothing:
        return say("The JSON is complete before " + in_quotes(rest().substr(0, 1)) +
                   (c == '}' || c == ']' ? ": it has one too many." : ": leave out what follows."));
    }
    return false;
  }

  bool close(char c) {
    const bool after_comma = next_ == Next::value || next_ == Next::key;
    if (after_comma && after_comma_)
      return say(std::string("There is a comma before the closing ") + c + ": leave it out.");
    if (after_comma) return say(std::string("A value is missing before ") + c + ".");
    const char expected = open_.back() == '{' ? '}' : ']';
    if (c != expected)
      return say(std::string("Here ") + open_.back() + " is closed by " + c + "; write " + expected + ".");
    open_.pop_back();
    ++at_;
    value_is_over();
    return true;
  }

  void value_is_over() {
    after_comma_ = false;
    next_ = open_.empty() ? Next::nothing : Next::comma_or_end;
  }

  bool take_key(char c) {
    if (c == ',') return say("A comma stands where a name was expected: leave it out.");
    if (c != '"') {
      const std::string_view word = word_here();
      if (word.empty()) return false;
      if (last_is_number_ && std::ranges::all_of(word, is_digit))
        return say("Decimals have a point, not a comma: " + printable(last_number_) + "." + printable(word) +
                   ".");
      return say("Names stand in double quotes: \"" + printable(word) + "\"." + std::string(shell_hint));
    }
    next_ = Next::colon;
    return take_string();
  }

  bool take_colon(char c) {
    if (c != ':' && last_is_empty_) return say(std::string(doubled_quotes));
    if (c != ':')
      return say(std::string("Between a name and its value stands a colon") +
                 (c == '=' ? ", not =: " : "; it is missing: ") + "\"name\": value.");
    ++at_;
    next_ = Next::value;
    after_comma_ = false;
    return true;
  }

  bool take_comma(char c) {
    if (c == ',') {
      ++at_;
      after_comma_ = true;
      next_ = open_.back() == '{' ? Next::key : Next::value;
      return true;
    }
    if (c == ';') return say("Between two parts stands a comma, not a semicolon.");
    if (last_is_empty_ && !last_is_number_ && is_word_character(c)) return say(std::string(doubled_quotes));
    if (last_is_number_ && c != '"' && c != '{' && c != '[')
      return say("A number with a unit, and an expression, stand in double quotes: \"30 deg\", \"2*m*g/l\".");
    return say("A comma is missing before " +
               in_quotes(rest().substr(0, std::min<std::size_t>(12, rest().find('\n')))) + ".");
  }

  bool take_value(char c) {
    last_is_number_ = false;
    if (c == '{' || c == '[') {
      open_ += c;
      ++at_;
      after_comma_ = false;
      next_ = c == '{' ? Next::key_or_end : Next::value_or_end;
      return true;
    }
    if (c == ',') return say("A comma stands where a value was expected: leave it out.");
    if (c == '"') {
      if (!take_string()) return false;
      value_is_over();
      return true;
    }
    return take_word(word_here());
  }

  /// The letters, digits and signs that begin here.
  [[nodiscard]] std::string_view word_here() const {
    const auto end = std::ranges::find_if_not(rest(), is_word_character);
    return rest().substr(0, static_cast<std::size_t>(end - rest().begin()));
  }

  bool take_word(std::string_view word) {
    if (std::ranges::find(unbounded_words, word) != unbounded_words.end())
      return say("JSON has no " + std::string(word) + ": numbers are finite.");
    const auto foreign = std::ranges::find(foreign_words, word, [](const auto& pair) { return pair.first; });
    if (foreign != foreign_words.end())
      return say("JSON writes " + std::string(foreign->second) + ", not " + std::string(word) + ".");
    if (word == "true" || word == "false" || word == "null") {
      at_ += word.size();
      value_is_over();
      return true;
    }
    if (!word.empty() &&
        (is_digit(word[0]) || std::string_view("+-.").find(word[0]) != std::string_view::npos))
      return take_number(word);
    if (word.empty()) return false;
    return say("A text stands in double quotes: \"" + printable(word) + "\"." + std::string(shell_hint));
  }

  bool take_number(std::string_view word) {
    const std::string_view digits = word.starts_with('-') ? word.substr(1) : word;
    const std::string_view whole =
        digits.substr(0, std::ranges::find_if_not(digits, is_digit) - digits.begin());
    const std::string_view tail = digits.substr(whole.size());
    if (word.starts_with('+')) return say("A number has no + before it: leave it out.");
    if (whole.empty() && tail.size() > 1 && tail[0] == '.' && is_digit(tail[1]))
      return say("A number has a digit before its point: 0" + printable(tail) + ".");
    if (whole.size() > 1 && whole[0] == '0')
      return say("A number does not begin with a zero before other digits.");
    if (whole == "0" && (tail.starts_with('x') || tail.starts_with('X') || tail.starts_with('b')))
      return say("Numbers in JSON are decimal.");
    if (!whole.empty() && tail.starts_with('.') && (tail.size() == 1 || !is_digit(tail[1])))
      return say("A number has a digit after its point: " + std::string(whole) + ".0.");
    if (digits.empty()) return say("A number has a digit after its minus.");
    if (std::string plain(word); tail.starts_with('_') && std::erase(plain, '_') > 0 && is_plain(plain))
      return say("The digits of a number stand together: " + printable(plain) + ".");
    if (!tail.empty() && tail[0] != '.' && tail[0] != 'e' && tail[0] != 'E')
      return say("A number with a unit, and an expression, stand in double quotes: \"" + printable(word) +
                 "\".");
    if (!tail.empty() && std::string_view("eE+-").find(tail.back()) != std::string_view::npos)
      return say("The exponent of " + printable(word) + " is missing.");
    if (whole.empty()) return false;
    at_ += word.size();
    value_is_over();
    last_is_number_ = true;
    last_number_ = word;
    return true;
  }

  bool take_string() {
    for (std::size_t i = at_ + 1; i < text_.size(); ++i) {
      if (text_[i] == '"') {
        last_is_empty_ = i == at_ + 1;
        at_ = i + 1;
        return true;
      }
      if (text_[i] == '\t') return say("A tab in a text is written \\t.");
      if (text_[i] == '\n' || text_[i] == '\r')
        return say("A text ends on the line on which it begins: a double quote is missing, or write \\n.");
      if (text_[i] != '\\') continue;
      ++i;
      if (i < text_.size() && std::string_view("\"\\/bfnrtu").find(text_[i]) == std::string_view::npos)
        return say("\\" + printable(text_.substr(i, 1)) +
                   " means nothing in a JSON text; a backslash is written \\\\.");
    }
    return say("The JSON ends inside a text: its closing double quote is missing.");
  }

  [[nodiscard]] std::string early_end() const {
    if (open_.empty()) return "";
    std::string closing;
    for (auto c = open_.rbegin(); c != open_.rend() && closing.size() < 8; ++c)
      closing += *c == '{' ? '}' : ']';
    return "The JSON ends too early: " + closing + " is missing at its end.";
  }

  std::string_view text_;
  std::size_t at_;
  Next next_{Next::value};
  bool after_comma_{false};
  bool last_is_number_{false};
  bool last_is_empty_{false};     ///< of the texts
  std::string_view last_number_;  ///< as it is written
  std::string open_;              ///< brackets that are not closed yet
  std::string slip_;
};

}  // namespace

std::string json_slip(std::string_view text) { return SlipFinder(text).find(); }

}  // namespace qdot::api
