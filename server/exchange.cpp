#include "server/exchange.hpp"

#include <utility>

namespace qdot::server {

Exchange::~Exchange() {
  if (answered_) return;
  try {
    answer({.status = 500});
  } catch (...) {
    // There is no memory even for this: the connection's own end of life ends the wait.
  }
}

void Exchange::answer(api::Response response) {
  if (std::exchange(answered_, true)) return;
  deliver_(std::move(response));
}

}  // namespace qdot::server
