#include "api/answers/motion_fields.hpp"

namespace qdot::api {

Words<Method> words_of_methods() {
  Words<Method> words;
  for (const MethodRecord& record : methods()) words.emplace_back(record.name, record.method);
  return words;
}

std::string methods_in_words() {
  std::string text;
  for (const MethodRecord& record : methods()) {
    text += (text.empty() ? "" : "; ") + std::string(record.name) + ": " + std::string(record.summary);
  }
  return text;
}

std::string methods_of_fixed_step() {
  std::string names;
  for (const MethodRecord& method : methods()) {
    if (method.has_fixed_step()) names += (names.empty() ? "" : " or ") + std::string(method.name);
  }
  return names;
}

}  // namespace qdot::api
