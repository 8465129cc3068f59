#pragma once
// A practice sheet's key, or the answers that are checked against it, can be wrong as a whole: then there is
// no verdict, and the teacher or the student gets one sentence.

#include <string>

namespace qdot::api {

/// The sentence, which says what is wrong.
struct SheetError {
  std::string text;
};

}  // namespace qdot::api
