#pragma once
// Which function answers which address. A pattern has literal segments and names in braces:
// "/v1/systems/{name}".

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/address.hpp"
#include "api/http/messages.hpp"
#include "api/json/layout.hpp"

namespace qdot::api {

/// How long the parts of an answer took, for the Server-Timing header. Bodies must not depend on time.
class Timing {
 public:
  /// Ends a part: the time since the one before belongs to `name`.
  void lap(std::string_view name);
  /// "parse;dur=0.1, solve;dur=3.2", in milliseconds; empty without laps.
  [[nodiscard]] std::string header() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_{Clock::now()};
  std::vector<std::pair<std::string, double>> laps_;
};

/// One request on its way to its handler.
struct Call {
  const Request& request;
  Target target;  ///< without `pretty`, which `layout` has
  Layout layout{Layout::compact};
  std::vector<std::string> captures{};  ///< what the names in braces stand for, in order
  std::string accepted{};               ///< the media type that the client prefers of those that are offered
  std::vector<std::string> notes{};     ///< sentences about how the request was understood
  Timing timing{};
  /// Members of the answer that are read, or their parts by pointer (JsonWriter), where others need not be
  /// written; else nullptr.
  const std::vector<std::string>* wanted{};
};

using Handler = std::function<Response(Call&)>;

/// What an answer costs, roughly: the same for every request, and more where a motion is followed, by the
/// fields that say how far (api/about/appraisal.hpp).
struct Cost {
  double milliseconds{0.3};                                              ///< of one core
  enum class Motion { none, always, up_to_t_end } motion{Motion::none};  ///< up_to_t_end: where that is given
  std::string_view each{};  ///< the list whose every entry costs as much; empty: none
  /// Whether it costs what the requests cost that it is made of.
  enum class MadeOf { itself, lines, rows, items } made_of{MadeOf::itself};
};

struct Route {
  std::string method{};  ///< "GET" answers HEAD too
  std::string pattern{};
  Handler handler{};
  std::vector<std::string> offers{"application/json"};  ///< media types, the default first
  Cost cost{};
};

class Routes {
 public:
  void add(Route route) { all_.push_back(std::move(route)); }

  struct Match {
    const Route* route{};  ///< nullptr: the path or its method is not known
    std::vector<std::string> captures{};
    std::string allow{};  ///< the path's methods, "GET, HEAD, OPTIONS"; empty: no such path
  };
  [[nodiscard]] Match match(std::string_view method, std::string_view path) const;

  [[nodiscard]] const std::vector<Route>& all() const { return all_; }

 private:
  std::vector<Route> all_;
};

}  // namespace qdot::api
