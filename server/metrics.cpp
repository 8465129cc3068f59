#include "server/metrics.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>

#include "api/contract/version.hpp"
#include "api/service.hpp"

namespace qdot::server {
namespace {

std::string number(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

void append(std::string& text, std::string_view name, std::string_view labels, const std::string& value) {
  text.append(name);
  if (!labels.empty()) text.append("{").append(labels).append("}");
  text.append(" ").append(value).append("\n");
}

void describe(std::string& text, std::string_view name, std::string_view type, std::string_view help) {
  text.append("# HELP ").append(name).append(" ").append(help).append("\n");
  text.append("# TYPE ").append(name).append(" ").append(type).append("\n");
}

void append_one(std::string& text, std::string_view name, std::string_view type, std::string_view help,
                double value) {
  describe(text, name, type, help);
  append(text, name, "", number(value));
}

double resident_bytes() {
  long size = 0;
  long resident = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%ld %ld", &size, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

double open_descriptors() {
  std::error_code error;
  const std::filesystem::directory_iterator files("/proc/self/fd", error);
  return error ? 0 : static_cast<double>(std::distance(begin(files), end(files)));
}

double cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// A client can send any method, but only the known ones become labels.
std::string_view known(std::string_view method) {
  constexpr std::array methods{"GET", "HEAD", "POST", "OPTIONS", "PUT", "DELETE", "PATCH"};
  return std::ranges::find(methods, method) != methods.end() ? method : "other";
}

void append_process(std::string& text) {
  append_one(text, "process_resident_memory_bytes", "gauge", "Resident memory.", resident_bytes());
  append_one(text, "process_open_fds", "gauge", "Open file descriptors.", open_descriptors());
  append_one(text, "process_cpu_seconds_total", "counter", "CPU time.", cpu_seconds());
}

std::string_view name_of(Lane lane) {
  constexpr std::array<std::string_view, all_lanes.size()> names{"light", "heavy", "lengthy"};
  return names[static_cast<std::size_t>(lane)];
}

void append_by_lane(std::string& text, std::string_view metric, const Gauges& now,
                    std::size_t Lanes::Gauges::*count) {
  for (const Lane lane : all_lanes) {
    const auto label = "lane=\"" + std::string(name_of(lane)) + "\"";
    append(text, metric, label, std::to_string(now.lanes[static_cast<std::size_t>(lane)].*count));
  }
}

void append_gauges(std::string& text, const Gauges& now) {
  describe(text, "qdot_in_flight", "gauge", "Requests that are being computed.");
  append_by_lane(text, "qdot_in_flight", now, &Lanes::Gauges::running);
  describe(text, "qdot_queue_length", "gauge", "Requests that wait to be computed.");
  append_by_lane(text, "qdot_queue_length", now, &Lanes::Gauges::waiting);
  append_one(text, "qdot_connections", "gauge", "Open connections.", static_cast<double>(now.connections));
  append_one(text, "qdot_unsent_bytes", "gauge", "Bytes of answers that clients have not taken yet.",
             static_cast<double>(now.unsent_bytes));
  append_one(text, "qdot_draining", "gauge", "1 once the end of the process was asked for.",
             now.draining ? 1 : 0);
}

}  // namespace

void Metrics::count(const Served& served) {
  const std::lock_guard lock(mutex_);
  const std::string route(served.route);
  ++requests_[{std::string(known(served.method)), route, served.status}];
  evaluations_ += served.evaluations;
  Histogram& histogram = durations_[route];
  ++histogram.count;
  histogram.sum += served.seconds;
  const auto bucket = std::ranges::lower_bound(bounds, served.seconds) - bounds.begin();
  if (bucket < std::ssize(bounds)) ++histogram.buckets[static_cast<std::size_t>(bucket)];
}

std::string Metrics::text(const Gauges& gauges, std::uint64_t dropped_log_lines) const {
  std::string text;
  describe(text, "qdot_build_info", "gauge", "1, with the version as a label.");
  append(text, "qdot_build_info", "version=\"" + std::string(api::service_version()) + "\"", "1");
  append_gauges(text, gauges);
  append_one(text, "qdot_shed_total", "counter", "Requests turned away because too much was waiting.",
             static_cast<double>(shed_));
  append_one(text, "qdot_abandoned_total", "counter", "Requests whose client left before the answer.",
             static_cast<double>(abandoned_));
  append_one(text, "qdot_log_lines_dropped_total", "counter", "Log lines that stderr did not take.",
             static_cast<double>(dropped_log_lines));
  append_process(text);

  const std::lock_guard lock(mutex_);
  append_one(text, "qdot_evaluations_total", "counter", "Evaluations of equations of motion.",
             static_cast<double>(evaluations_));
  describe(text, "http_requests_total", "counter", "Requests answered.");
  for (const auto& [labels, count] : requests_) {
    const auto& [method, route, status] = labels;
    append(text, "http_requests_total",
           "method=\"" + method + "\",route=\"" + route + "\",code=\"" + std::to_string(status) + "\"",
           std::to_string(count));
  }
  describe(text, "http_request_duration_seconds", "histogram", "From a request's last byte to its answer.");
  for (const auto& [route, histogram] : durations_) {
    const auto label = "route=\"" + route + "\"";
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      append(text, "http_request_duration_seconds_bucket", label + ",le=\"" + number(bounds[i]) + "\"",
             std::to_string(below += histogram.buckets[i]));
    }
    append(text, "http_request_duration_seconds_bucket", label + ",le=\"+Inf\"",
           std::to_string(histogram.count));
    append(text, "http_request_duration_seconds_sum", label, number(histogram.sum));
    append(text, "http_request_duration_seconds_count", label, std::to_string(histogram.count));
  }
  return text;
}

}  // namespace qdot::server
