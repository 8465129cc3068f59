#include "server/resumed.hpp"

#include <string_view>
#include <utility>

#include "server/usage_error.hpp"

namespace qdot::server {
namespace {

constexpr std::string_view to_no_readable_line = R"({"id":null,"status":400,)";

/// As far as it goes, where it was torn.
bool begins_with(const InputLine& answer, std::string_view beginning) {
  const bool is_whole = answer.is_ended || answer.text.size() > beginning.size();
  return is_whole ? answer.text.starts_with(beginning) : beginning.starts_with(answer.text);
}

bool fits(const InputLine& answer, const std::string& id) {
  return begins_with(answer, R"({"id":)" + id + R"(,"status":)");
}

[[noreturn]] void refuse(const std::string& why) {
  throw UsageError("the answers are not those to these lines: " + why);
}

}  // namespace

Resumed resumed(LineReader& answers, LineReader& lines,
                const std::function<std::string(const InputLine&)>& id_of) {
  Resumed found;
  auto answer = answers.next();
  while (answer) {
    auto line = lines.next();
    if (!line) refuse("there are more of them than lines, of which there are " + std::to_string(found.lines));
    auto behind = answers.next();
    const bool may_be_to_half_a_line = !behind && begins_with(*answer, to_no_readable_line);
    if (!may_be_to_half_a_line && !fits(*answer, id_of(*line)))
      refuse("line " + std::to_string(found.lines + 1) + " has another id than its answer");
    if (may_be_to_half_a_line || !answer->is_ended) {
      found.next = std::move(line);
      return found;
    }
    ++found.lines;
    found.line_bytes += line->bytes;
    found.answer_bytes += answer->bytes;
    found.last = std::move(line);
    answer = std::move(behind);
  }
  return found;
}

}  // namespace qdot::server
