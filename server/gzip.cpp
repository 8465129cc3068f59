#include "server/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <new>

#include "api/json/text.hpp"

namespace qdot::server {
namespace {

constexpr int level = 1;  // columns of digits shrink to half; more effort brings a tenth more
constexpr int gzip_window = 15 + 16;
constexpr int default_memory = 8;

/// "gzip;q=0.5": its quality, 1 without one.
double quality(std::string_view parameters) {
  const auto mark = parameters.find("q=");
  double value = 1;
  if (mark != parameters.npos)
    std::from_chars(parameters.data() + mark + 2, parameters.data() + parameters.size(), value);
  return value;
}

}  // namespace

bool accepts_gzip(std::string_view accept_encoding) {
  double named = -1;
  double any = 0;
  while (!accept_encoding.empty()) {
    const auto part = accept_encoding.substr(0, accept_encoding.find(','));
    accept_encoding.remove_prefix(std::min(part.size() + 1, accept_encoding.size()));
    const auto name = api::lower_case(api::trimmed(part.substr(0, part.find(';'))));
    if (name == "gzip" || name == "x-gzip") named = quality(part);
    if (name == "*") any = quality(part);
  }
  return (named < 0 ? any : named) > 0;
}

std::string gzipped(std::string_view text) {
  z_stream stream{};
  if (::deflateInit2(&stream, level, Z_DEFLATED, gzip_window, default_memory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype(&::deflateEnd)> end(&stream, &::deflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  std::string result;
  result.reserve(text.size() / 2);
  std::array<char, 65536> part;
  do {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = part.size();
    ::deflate(&stream, Z_FINISH);
    result.append(part.data(), part.size() - stream.avail_out);
  } while (stream.avail_out == 0);
  return result;
}

}  // namespace qdot::server
