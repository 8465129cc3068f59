#pragma once
// What a batch that goes on finds in its file: answers to the first of the lines, in their order. Nothing
// else is taken for them, so that no other file is written over and no answers to other lines are gone on
// with.
//
// What an answer tells of its line is its id, and that of the last one is computed again. So lines that were
// all changed are noticed under the same ids, or without any; a single one may not be.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "server/line_reader.hpp"

namespace qdot::server {

/// More bytes than an answer has up to its status; the ids of lines are short.
inline constexpr std::size_t beginning_of_answer = 4096;

struct Resumed {
  std::uint64_t lines{0};           ///< that are answered
  std::uint64_t line_bytes{0};      ///< of the input in them
  std::uint64_t answer_bytes{0};    ///< of their answers, which are kept
  std::optional<InputLine> last{};  ///< that is answered
  std::optional<InputLine> next{};  ///< was read, and is to be answered first
};

/// Reads over the answers and the lines that they answer. Two answers are not kept, and can only be the last:
/// one that was torn, and that to a line which could not be read, because it may have been half a line then.
/// A machine that fell may have left NULs, which no answer has, where it had not written yet: an answer is
/// torn there, and what is behind is not kept either.
/// `id_of` is the id of a line as it is written. Throws UsageError where the answers are not those to the
/// lines.
[[nodiscard]] Resumed resumed(LineReader& answers, LineReader& lines,
                              const std::function<std::string(const InputLine&)>& id_of);

}  // namespace qdot::server
