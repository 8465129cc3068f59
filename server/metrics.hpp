#pragma once
// Counts what has been done, and says so in the text format of Prometheus (0.0.4).

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <tuple>

#include "server/lanes.hpp"

namespace qdot::server {

/// The present state of the server, which is reported beside the counts.
struct Gauges {
  std::array<Lanes::Gauges, all_lanes.size()> lanes{};
  std::size_t connections{};
  std::size_t unsent_bytes{};
  bool draining{};
};

class Metrics {
 public:
  struct Served {
    std::string_view method;
    std::string_view route;  ///< a pattern such as /v1/systems/{name}, never the path that was sent
    int status{};
    double seconds{};
    std::uint64_t evaluations{};
  };
  void count(const Served& served);
  void count_shed() { ++shed_; }
  void count_abandoned() { ++abandoned_; }

  [[nodiscard]] std::string text(const Gauges& gauges, std::uint64_t dropped_log_lines) const;

 private:
  /// Upper bounds in seconds; the last bucket, +Inf, is the count.
  static constexpr std::array bounds{0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1,
                                     0.25,  0.5,    1.0,   2.5,  5.0,   10.0};
  struct Histogram {
    std::array<std::uint64_t, bounds.size()> buckets{};
    std::uint64_t count{};
    double sum{};
  };

  mutable std::mutex mutex_;
  std::map<std::tuple<std::string, std::string, int>, std::uint64_t> requests_;
  std::map<std::string, Histogram> durations_;
  std::uint64_t evaluations_{};
  std::atomic<std::uint64_t> shed_{}, abandoned_{};
};

}  // namespace qdot::server
