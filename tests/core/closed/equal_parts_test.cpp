// Equal parts fall apart into sums and differences; unequal ones stay as they are.

#include "core/closed/equal_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/expr/parse.hpp"

namespace qdot {
namespace {

using testing::ElementsAre;
using Texts = std::vector<std::vector<std::string>>;

const std::vector<std::string> names{"m", "M", "k"};

class EqualParts : public testing::Test {
 protected:
  Entries read(const Texts& rows) {
    Entries entries;
    for (const auto& row : rows) {
      entries.emplace_back();
      for (const std::string& text : row)
        entries.back().push_back(rational_function(parse(text, graph_, names)));
    }
    return entries;
  }

  LinearMatrices chain(const std::vector<std::string>& masses, const Texts& stiffness) {
    Texts mass(masses.size(), std::vector<std::string>(masses.size(), "0"));
    const Texts none = mass;
    for (std::size_t i = 0; i < masses.size(); ++i) mass[i][i] = masses[i];
    return {read(mass), read(none), read(stiffness)};
  }

  static std::vector<std::size_t> sizes(const LinearMatrices& matrices) {
    std::vector<std::size_t> found;
    for (const auto& group : coupled_groups(matrices)) found.push_back(group.size());
    std::ranges::sort(found);
    return found;
  }

  Graph graph_;
};

const Texts between_walls{{"2*k", "-k", "0"}, {"-k", "2*k", "-k"}, {"0", "-k", "2*k"}};

TEST_F(EqualParts, FallApartIntoSumsAndDifferences) {
  const FallenApart parts = fallen_apart(chain({"m", "M", "m"}, between_walls));
  EXPECT_THAT(sizes(parts.matrices), ElementsAre(1, 2));
  EXPECT_THAT(parts.basis, ElementsAre(ElementsAre(1, 0, 1), ElementsAre(0, 1, 0), ElementsAre(1, 0, -1)));
}

TEST_F(EqualParts, FallApartInPairs) {
  const Texts ring{
      {"2*k", "-k", "0", "-k"}, {"-k", "2*k", "-k", "0"}, {"0", "-k", "2*k", "-k"}, {"-k", "0", "-k", "2*k"}};
  EXPECT_THAT(sizes(fallen_apart(chain({"m", "m", "m", "m"}, ring)).matrices), ElementsAre(2, 2));
}

TEST_F(EqualParts, MayPointInOppositeDirections) {
  const Texts opposed{{"2*k", "-k", "0"}, {"-k", "2*k", "k"}, {"0", "k", "2*k"}};
  EXPECT_THAT(sizes(fallen_apart(chain({"m", "m", "m"}, opposed)).matrices), ElementsAre(1, 2));
}

TEST_F(EqualParts, AreNotThoseOfOtherMassesOrDamping) {
  EXPECT_THAT(sizes(fallen_apart(chain({"m", "m", "M"}, between_walls)).matrices), ElementsAre(3));
  LinearMatrices damped = chain({"m", "M", "m"}, between_walls);
  damped.damping = read({{"k", "0", "0"}, {"0", "0", "0"}, {"0", "0", "0"}});
  EXPECT_THAT(sizes(fallen_apart(std::move(damped)).matrices), ElementsAre(3));
}

}  // namespace
}  // namespace qdot
