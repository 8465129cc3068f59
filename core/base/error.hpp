#pragma once
// Core's one exception type: thrown where no answer exists, translated once in api/.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace qdot {

enum class ErrorCode {
  syntax,              ///< an expression does not parse; `offset` says where
  unknown_symbol,      ///< an expression names something that is not declared
  too_large,           ///< an expression passes a size, depth or node bound
  invalid_scene,       ///< the scene has mistakes (SceneError lists them)
  invalid_parameters,  ///< the scene makes no sense with these parameters
  invalid_state,       ///< the coordinates describe no configuration, or a quantity has no value there
  not_applicable       ///< the question makes no sense for this scene
};

class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, std::size_t offset = 0)
      : std::runtime_error(message), code_(code), offset_(offset) {}
  [[nodiscard]] ErrorCode code() const { return code_; }
  /// Byte offset into the expression (syntax, unknown_symbol).
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  ErrorCode code_;
  std::size_t offset_;
};

}  // namespace qdot
