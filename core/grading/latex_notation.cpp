#include <algorithm>
#include <array>
#include <optional>

#include "core/base/error.hpp"
#include "core/grading/plain_notation.hpp"

namespace qdot {
namespace {

constexpr int deepest = 64;

/// Commands that are a name here: \sin, \theta.
constexpr std::array named{
    "alpha", "beta",  "gamma",  "delta",  "epsilon", "zeta", "eta",   "theta", "kappa", "lambda", "mu",
    "nu",    "xi",    "pi",     "rho",    "sigma",   "tau",  "phi",   "chi",   "psi",   "omega",  "Gamma",
    "Delta", "Theta", "Lambda", "Sigma",  "Phi",     "Psi",  "Omega", "sin",   "cos",   "tan",    "cot",
    "sec",   "csc",   "arcsin", "arccos", "arctan",  "sinh", "cosh",  "tanh",  "exp",   "ln",     "log"};

struct Command {
  std::string_view latex, plain;
};
constexpr std::array replaced{Command{"varphi", " phi "},
                              Command{"vartheta", " theta "},
                              Command{"varepsilon", " epsilon "},
                              Command{"ell", " l "},
                              Command{"cdot", "*"},
                              Command{"times", "*"},
                              Command{"ast", "*"},
                              Command{"div", "/"},
                              Command{"quad", " "},
                              Command{"qquad", " "},
                              Command{"displaystyle", " "},
                              Command{"limits", " "},
                              Command{"lbrace", "("},
                              Command{"rbrace", ")"},
                              Command{"prime", "'"},
                              Command{"lvert", "|"},
                              Command{"rvert", "|"},
                              Command{"vert", "|"},
                              Command{"max", " max "},
                              Command{"min", " min "},
                              Command{"newline", "\n"}};

/// Sizes of brackets, and words that say how a text looks.
constexpr std::array skipped{"left", "right", "big",   "Big",   "bigl",  "bigr",   "Bigl",     "Bigr", "bigg",
                             "Bigg", "biggl", "biggr", "Biggl", "Biggr", "middle", "nonumber", "notag"};
constexpr std::array styles{"mathrm",     "mathit", "text", "operatorname", "mathbf",
                            "boldsymbol", "textrm", "rm",   "mathcal",      "mathscr"};

bool contains(const auto& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

bool is_latin(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string without_blanks(std::string_view text) {
  std::string result;
  std::ranges::copy_if(text, std::back_inserter(result), [](char c) { return c != ' '; });
  return result;
}

class LatexReader {
 public:
  explicit LatexReader(std::string_view text) : text_(text) {}

  std::string read() {
    std::string out;
    while (at_ < text_.size()) {
      if (text_[at_] == '}') refuse("there is no '{' for this '}'");
      out += piece();
    }
    return out;
  }

 private:
  [[noreturn]] void refuse(const std::string& message) const { throw Error(ErrorCode::syntax, message, at_); }

  [[nodiscard]] bool ends() const { return at_ == text_.size(); }

  void skip_blanks() {
    while (!ends() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t')) ++at_;
  }

  /// A command, a group or a single character.
  std::string piece() {
    const char c = text_[at_];
    if (c == '\\') return command();
    if (c == '{') return "(" + group() + ")";
    ++at_;
    if (c == '$' || c == '&' || c == '~') return " ";
    if (c == '_') return "_" + without_blanks(argument());
    return {c};
  }

  /// What stands between braces.
  std::string group() {
    if (++depth_ > deepest) throw Error(ErrorCode::too_large, "braces are nested too deep", at_);
    ++at_;
    std::string out;
    while (!ends() && text_[at_] != '}') out += piece();
    if (ends()) refuse("expected '}'");
    ++at_;
    --depth_;
    return out;
  }

  /// A command's argument: a group, a command or one character.
  std::string argument() {
    skip_blanks();
    if (ends()) refuse("a command has no argument");
    if (text_[at_] == '{') return group();
    if (text_[at_] == '}') refuse("a command has no argument");
    return piece();
  }

  std::string command() {
    ++at_;
    if (ends()) refuse("there is a lone '\\'");
    if (text_.substr(at_).starts_with("\\[")) return line_with_space();
    if (!is_latin(text_[at_])) return sign(text_[at_++]);
    const std::size_t first = at_;
    while (!ends() && is_latin(text_[at_])) ++at_;
    return word(text_.substr(first, at_ - first));
  }

  /// "\\[4pt]" ends a line.
  std::string line_with_space() {
    const std::size_t end = text_.find(']', at_);
    const std::string_view length = end == std::string_view::npos ? "" : text_.substr(at_ + 2, end - at_ - 2);
    const bool is_length = length.size() > 2 && length.size() < 8 &&
                           (length.ends_with("pt") || length.ends_with("ex") || length.ends_with("em") ||
                            length.ends_with("mm") || length.ends_with("cm"));
    at_ = is_length ? end + 1 : at_ + 1;
    return "\n";
  }

  static std::string sign(char c) {
    switch (c) {
      case '\\':
        return "\n";
      case '{':
        return "(";
      case '}':
        return ")";
      case '|':
        return "|";
      default:
        return " ";  // \, \; \! \: and the delimiters \( \) \[ \]
    }
  }

  std::string word(std::string_view name) {
    if (contains(named, name)) return " " + std::string(name) + " " + index();
    if (name == "dot") return dotted("_dot");
    if (name == "ddot") return dotted("_ddot");
    if (name == "overset" || name == "stackrel") return dotted_above();
    if (name == "frac" || name == "dfrac" || name == "tfrac" || name == "cfrac") return fraction();
    if (name == "sqrt") return root();
    if (name == "begin" || name == "end" || name == "tag" || name == "label") {
      (void)argument();
      return " ";
    }
    if (contains(styles, name)) return " " + argument() + " " + index();
    if (contains(skipped, name)) {
      if (!ends() && text_[at_] == '.') ++at_;  // \right. closes nothing
      return " ";
    }
    for (const Command& known : replaced) {
      if (known.latex == name) return std::string(known.plain);
    }
    refuse("the LaTeX command \\" + std::string(name.substr(0, 20)) + " is not known here");
  }

  /// "\omega_0" keeps its index: the blank before it goes.
  std::string index() {
    if (ends() || text_[at_] != '_') return "";
    ++at_;
    return std::string(1, backspace) + "_" + without_blanks(argument()) + " ";
  }

  std::string dotted(const char* suffix) {
    const std::string inside = without_blanks(argument());
    const std::string after = index();
    const std::string number = after.empty() ? "" : without_blanks(after).substr(1);
    return " " + inside + number + suffix + " ";
  }

  /// "\overset{..}{\theta}": points above a letter.
  std::string dotted_above() {
    std::string points = without_blanks(argument());
    std::erase(points, '(');
    std::erase(points, ')');
    const bool are_points = points.find_first_not_of(".*") == std::string::npos;
    if (!are_points || points.empty() || points.size() > 2)
      refuse("over a letter stand one point or two here: \\dot, \\ddot");
    return dotted(points.size() == 1 ? "_dot" : "_ddot");
  }

  std::string fraction() {
    const std::string above = argument();
    const std::string below = argument();
    const std::string n = without_blanks(above), d = without_blanks(below);
    if (d == "dt" && n.starts_with('d')) {
      return n == "d" ? " d/dt " : " d/dt(" + above.substr(above.find('d') + 1) + ")";
    }
    for (const std::string_view second : {"d^2", "d^(2)"}) {
      const bool is_second = (d == "dt^2" || d == "dt^(2)") && n.starts_with(second);
      if (is_second) return " d/dt(d/dt(" + n.substr(second.size()) + "))";
    }
    return "((" + above + ")/(" + below + "))";
  }

  std::string root() {
    skip_blanks();
    if (ends() || text_[at_] != '[') return " sqrt(" + argument() + ")";
    const std::size_t end = text_.find(']', at_);
    if (end == std::string_view::npos) refuse("expected ']'");
    const std::string degree(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return " ((" + argument() + ")^(1/(" + degree + ")))";
  }

 public:
  static constexpr char backspace = '\b';

 private:
  std::string_view text_;
  std::size_t at_{0};
  int depth_{0};
};

/// Carries out what LatexReader leaves for an index: blanks before a backspace go with it.
std::string with_indices_joined(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c != LatexReader::backspace) {
      out += c;
    } else {
      while (!out.empty() && out.back() == ' ') out.pop_back();
    }
  }
  return out;
}

}  // namespace

std::string without_latex(std::string_view text) {
  if (text.find(LatexReader::backspace) != std::string_view::npos)
    throw Error(ErrorCode::syntax, "there is a character that formulas do not have");
  return with_indices_joined(LatexReader(text).read());
}

}  // namespace qdot
