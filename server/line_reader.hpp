#pragma once
// The lines of a file or a pipe, one after the other, whatever its size: an overlong line is read to its end,
// but only its beginning is kept.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace qdot::server {

struct InputLine {
  std::string text;         ///< without its newline; the beginning of an overlong one
  bool is_overlong{false};  ///< it has more bytes than a line may have
  bool is_ended{false};     ///< by a newline, which the last one may lack
  std::uint64_t bytes{0};   ///< of the input, its newline included
  std::uint64_t nuls{0};    ///< bytes among them that are NUL
};

class LineReader {
 public:
  /// `longest` is the most bytes that a line may have. The descriptor stays the caller's.
  LineReader(int descriptor, std::size_t longest) : descriptor_(descriptor), longest_(longest) {}

  /// Nothing at the end of the input. The last line need not end with a newline. Throws std::system_error
  /// where the input cannot be read.
  [[nodiscard]] std::optional<InputLine> next();

 private:
  void take(std::size_t count, InputLine& line);
  bool refill();

  int descriptor_;
  std::size_t longest_;
  std::string block_;
  std::size_t at_{0};  // what comes before it was taken
};

}  // namespace qdot::server
