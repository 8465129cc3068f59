#include "server/words.hpp"

#include <unistd.h>

#include <cctype>
#include <fstream>
#include <iostream>

#include "api/json/text.hpp"
#include "core/expr/print/print.hpp"
#include "server/usage_error.hpp"

namespace qdot::server {
namespace {

/// At most one byte more than is allowed, so that an overlong text shows: /dev/zero has no end.
std::string all_of(std::istream& stream, const std::string& name, std::size_t most) {
  std::string text(most + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most)
    throw UsageError(name + " is longer than " + std::to_string(most) +
                     " bytes, the most that a request may have");
  text.shrink_to_fit();
  return text;
}

bool has_value(const std::string& word) { return word.find('=') != std::string::npos; }

[[noreturn]] void refuse_word(const std::vector<std::string>& words, std::size_t i) {
  const std::string word = api::printable(words[i]);
  const bool has_next = i + 1 < words.size();
  if (has_next && words[i + 1] == "=" && i + 2 < words.size())
    throw UsageError("leave out the blanks around =: " + word + "=" + api::printable(words[i + 2]));
  if (has_next && !has_value(words[i + 1]))
    throw UsageError("a value has = before it: " + word + "=" + api::printable(words[i + 1]));
  if (i > 0 && has_value(words[i - 1]))
    throw UsageError("'" + word + "' stands alone; if it belongs to " + api::printable(words[i - 1]) +
                     ", put both in quotes: '" + api::printable(words[i - 1]) + " " + word + "'");
  if (const std::string_view form = form_called(words[i]); !form.empty())
    throw UsageError("a notation is given as form=" + std::string(form));
  throw UsageError("'" + word + "' is not of the form key=value");
}

/// The first word without a value is the system's name.
std::string system_in(const std::string& word) {
  if (word.ends_with(".json"))
    throw UsageError("a request in a file is given with --request: --request " +
                     api::printable(word.substr(word.starts_with('@') ? 1 : 0)));
  return "system=" + percent_encoded(word) + "&";
}

}  // namespace

std::string percent_encoded(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string result;
  for (const unsigned char c : text) {
    if ((c < 128 && std::isalnum(c)) ||
        std::string_view("-._~").find(static_cast<char>(c)) != std::string::npos) {
      result += static_cast<char>(c);
    } else {
      result += {'%', digits[c >> 4], digits[c & 15]};
    }
  }
  return result;
}

std::string query_of(const std::vector<std::string>& words) {
  std::string query;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const std::size_t equals = word.find('=');
    if (equals == 0) throw UsageError("'" + api::printable(word) + "' is not of the form key=value");
    if (equals != std::string::npos) {
      query += percent_encoded(word.substr(0, equals)) + "=" + percent_encoded(word.substr(equals + 1)) + "&";
    } else if (i == 0 && (words.size() < 2 || words[1] != "=")) {
      query += system_in(word);
    } else {
      refuse_word(words, i);
    }
  }
  return query;
}

std::string_view form_called(std::string_view word) {
  if (word == "tex") return "latex";
  for (const PrintForm& form : print_forms()) {
    if (form.name == word) return form.name;
  }
  return {};
}

bool is_body(const std::vector<std::string>& words) {
  return words.size() == 1 && words[0].find_first_not_of(" \t\r\n") != std::string::npos &&
         words[0][words[0].find_first_not_of(" \t\r\n")] == '{';
}

std::string request_body(const std::string& file, std::size_t most) {
  if (!file.empty() && file != "-") {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw UsageError("cannot read " + file);
    return all_of(stream, file, most);
  }
  if (file.empty() && ::isatty(STDIN_FILENO)) {
    throw UsageError(
        "name a system, such as cart_pendulum, or give the request with --request FILE or on stdin");
  }
  return all_of(std::cin, "the request on stdin", most);
}

}  // namespace qdot::server
