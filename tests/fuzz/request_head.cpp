// Bytes of a connection: requests do not depend on how the bytes are cut, and a head that is taken is plain.

#include <algorithm>
#include <vector>

#include "server/message_reader.hpp"
#include "tests/fuzz/law.hpp"

namespace {

using namespace qdot;

bool is_plain(std::string_view text) {
  return std::ranges::all_of(text, [](unsigned char c) { return c > ' ' && c != 0x7f; });
}

/// What the reader says of all requests, when the bytes come in pieces of so many.
std::vector<std::string> read(std::string_view bytes, std::size_t piece) {
  std::vector<std::string> seen;
  server::MessageReader reader;
  bool open = true;
  const auto take = [&] {
    while (open) {
      const auto incoming = reader.next();
      if (!incoming) return;
      if (const auto* refusal = std::get_if<server::Refusal>(&*incoming)) {
        seen.push_back("refused: " + std::to_string(static_cast<int>(refusal->kind)) + refusal->detail);
        open = false;
      } else {
        const auto& request = std::get<api::Request>(*incoming);
        fuzz::require(is_plain(request.method) && is_plain(request.target), "method and target are plain");
        std::string text = request.method + ' ' + request.target;
        for (const auto& [name, value] : request.headers) {
          fuzz::require(is_plain(name), "names of fields are plain");
          fuzz::require(value.find_first_of("\r\n", 0) == std::string::npos, "values are one line");
          text += '\n' + name + ':' + value;
        }
        seen.push_back(text + "\n\n" + request.body);
        open = reader.keep_alive();
      }
    }
  };
  for (std::size_t i = 0; i < bytes.size() && open; i += piece) {
    reader.append(bytes.substr(i, piece));
    take();
  }
  return seen;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = fuzz::text_of(data, std::min<std::size_t>(size, 20'000));
  const std::vector<std::string> whole = read(bytes, bytes.size() + 1);
  fuzz::require(read(bytes, 1) == whole, "cut into single bytes it is the same");
  fuzz::require(read(bytes, 7) == whole, "cut into sevens it is the same");
  return 0;
}
