#pragma once
// Lists with one record for each value of an enumeration: methods of integration, printed forms.

#include <algorithm>
#include <stdexcept>
#include <string>

namespace qdot {

/// The record with this key. Throws std::logic_error where there is none: somebody added the key alone.
template <class Records, class Key, class Record>
const Record& record_with(const Records& records, Key key, Key Record::*member, const char* what) {
  const auto found = std::ranges::find(records, key, member);
  if (found == std::ranges::end(records)) {
    throw std::logic_error(std::string("no ") + what + " has number " +
                           std::to_string(static_cast<int>(key)));
  }
  return *found;
}

}  // namespace qdot
