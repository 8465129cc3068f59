#include "core/base/records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace qdot {
namespace {

enum class Fruit { apple, pear };

struct FruitRecord {
  Fruit fruit{};
  int price{};
};

constexpr std::array prices{FruitRecord{Fruit::apple, 3}};

TEST(Records, AreFoundByTheirKey) {
  EXPECT_EQ(record_with(prices, Fruit::apple, &FruitRecord::fruit, "fruit").price, 3);
}

TEST(Records, AKeyWithoutOneIsNamedByTheError) {
  EXPECT_THAT([] { (void)record_with(prices, Fruit::pear, &FruitRecord::fruit, "fruit"); },
              testing::ThrowsMessage<std::logic_error>("no fruit has number 1"));
}

}  // namespace
}  // namespace qdot
