#include "server/resumed.hpp"

#include <algorithm>
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

/// Whether something comes behind NULs in the first bytes, which are those that are kept.
bool goes_on_behind_nuls(const InputLine& answer) {
  const std::size_t nul = answer.text.find('\0');
  return nul != std::string::npos && (answer.is_ended || nul + answer.nuls != answer.bytes);
}

/// What was written of an answer; nothing where that is nothing.
std::optional<InputLine> written(std::optional<InputLine> answer) {
  if (!answer || answer->nuls == 0) return answer;
  answer->text.resize(std::min(answer->text.find('\0'), answer->text.size()));
  answer->is_ended = false;
  return answer->text.empty() ? std::nullopt : std::move(answer);
}

}  // namespace

Resumed resumed(LineReader& answers, LineReader& lines,
                const std::function<std::string(const InputLine&)>& id_of) {
  Resumed found;
  auto first = answers.next();
  // Behind answers to these lines the rest is theirs; before them it may be anything.
  if (first && goes_on_behind_nuls(*first)) refuse("the first of them has NULs in it");
  auto answer = written(std::move(first));
  while (answer) {
    auto line = lines.next();
    if (!line) refuse("there are more of them than lines, of which there are " + std::to_string(found.lines));
    auto behind = answer->is_ended ? written(answers.next()) : std::nullopt;
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
