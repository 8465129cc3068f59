// Whether the errors that answers state are true: random requests against the reference.
//
//   calibration --requests 2000 --seed 1 [--first 0] [--all]
//
// Prints every column whose error is understated (true > stated) or overstated (stated > 100 true), every
// wanted error that was said to be met and was not, and the sums.

#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>

#include "tests/calibration/outcome.hpp"
#include "tests/calibration/verdict.hpp"

namespace {

using namespace qdot::test;

struct Options {
  std::uint64_t requests{2000}, seed{1}, first{0}, steps{5'000};
  bool all{};
};

Options options_from(int count, char** words) {
  Options options;
  std::map<std::string, std::uint64_t*> numbers{{"--requests", &options.requests},
                                                {"--seed", &options.seed},
                                                {"--first", &options.first},
                                                {"--steps", &options.steps}};
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--all") {
      options.all = true;
    } else if (numbers.contains(word) && i + 1 < count) {
      *numbers[word] = std::stoull(words[++i]);
    } else {
      throw std::invalid_argument("calibration [--requests N] [--seed N] [--first N] [--steps N] [--all]");
    }
  }
  return options;
}

}  // namespace

int main(int count, char** words) {
  const Options options = options_from(count, words);
  Tally tally;
  for (std::uint64_t i = options.first; i < options.first + options.requests; ++i) {
    const Asked asked = random_request(options.seed, i);
    const Outcome outcome = outcome_of(asked, options.steps);
    const std::string remarks = tally.add(asked, outcome);
    if (remarks.empty() && !options.all) continue;
    std::printf("#%llu %s\n  %s\n%s", static_cast<unsigned long long>(i), asked.words().c_str(),
                description(outcome).c_str(), remarks.c_str());
    std::fflush(stdout);
  }
  std::printf("%s", tally.summary().c_str());
  return tally.passes() ? 0 : 1;
}
