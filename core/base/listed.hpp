#pragma once
// Several words in a row, as English lists them: "a, b and c".

#include <string>
#include <vector>

namespace qdot {

[[nodiscard]] inline std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k)
    text += (k == 0 ? "" : k + 1 == parts.size() ? " and " : ", ") + parts[k];
  return text;
}

}  // namespace qdot
