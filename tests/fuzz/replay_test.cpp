// Every input that the corpora hold, once, under the compiler of the other tests: tests/fuzz/run looks for
// new ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "tests/fuzz/law.hpp"

// Each target's LLVMFuzzerTestOneInput, by the name that CMakeLists.txt gives it here.
extern "C" {
int fuzz_request_head(const std::uint8_t* data, std::size_t size);
int fuzz_json_door(const std::uint8_t* data, std::size_t size);
int fuzz_expression(const std::uint8_t* data, std::size_t size);
int fuzz_derivative(const std::uint8_t* data, std::size_t size);
int fuzz_scene(const std::uint8_t* data, std::size_t size);
int fuzz_request(const std::uint8_t* data, std::size_t size);
}

namespace qdot::fuzz {
namespace {

struct Target {
  std::string name;
  int (*run)(const std::uint8_t*, std::size_t);
};

void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, BreaksNoLaw) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(QDOT_SOURCE_DIR "/tests/fuzz/corpus/" + GetParam().name))
    files.push_back(entry.path());
  std::ranges::sort(files);
  ASSERT_GE(files.size(), 5U);
  for (const auto& path : files) {
    std::ifstream file(path, std::ios::binary);
    const std::string input{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    SCOPED_TRACE(path.filename());
    EXPECT_EQ(GetParam().run(reinterpret_cast<const std::uint8_t*>(input.data()), input.size()), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Corpus,
                         testing::Values(Target{"request_head", fuzz_request_head},
                                         Target{"json_door", fuzz_json_door},
                                         Target{"expression", fuzz_expression},
                                         Target{"derivative", fuzz_derivative}, Target{"scene", fuzz_scene},
                                         Target{"request", fuzz_request}),
                         [](const auto& one) { return one.param.name; });

TEST(FuzzLaw, ThatDoesNotHoldEndsTheProcess) {
  EXPECT_DEATH(require(false, "two is three"), "broken: two is three");
}

}  // namespace
}  // namespace qdot::fuzz
