// All rows at once have the errors that they have one after the other.

#include "core/motion/all_row_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/motion/row_tables.hpp"

namespace qdot {
namespace {

constexpr std::size_t count = 9, width = 4;
constexpr double never = std::numeric_limits<double>::infinity();

/// Rows at whole numbers, which are not rounded, as far apart as `growth` makes them.
struct Tables {
  std::vector<double> t, left_out, motion, other, apart;
  std::vector<double> sizes;

  explicit Tables(double growth) : left_out(count), sizes(width, 1.0) {
    for (std::size_t i = 0; i < count; ++i) {
      const double s = static_cast<double>(i);
      t.push_back(s);
      for (std::size_t k = 0; k < width; ++k) {
        const double y = std::cos(s + static_cast<double>(k)), off = 1e-6 * std::pow(growth, s);
        motion.push_back(y);
        other.push_back(y + (k % 2 == 0 ? off : -off) * std::sin(7 * s + 1));
        apart.push_back(off / 3);
      }
    }
  }

  [[nodiscard]] std::vector<double> all(double lost_from) const {
    AllRowErrors errors(
        {t, left_out, motion, sizes}, {{count, other, apart, {}, {}}},
        [](std::size_t, std::span<double>) { return false; }, [] { return std::vector<bool>(2); });
    return errors.first(count, lost_from);
  }

  [[nodiscard]] std::vector<double> one_by_one(double lost_from) const {
    RowErrors errors(sizes, [] { return std::vector<bool>(2); });
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = [&](const std::vector<double>& table) {
        return std::span(table).subspan(i * width, width);
      };
      std::vector<double> unseen(width);  // of slopes: half-way to the next row, or a tenth of L_q/L_v
      for (std::size_t k = 0; k < 2; ++k) {
        unseen[k] = 0.1 * std::abs(row(motion)[2 + k] - row(other)[2 + k]);
        unseen[2 + k] = 0.1 * std::abs(row(motion)[k] - row(other)[k]);
      }
      if (t[i] >= lost_from) errors.lose();
      const OtherRow same{row(other), row(apart)};
      errors.add(t[i], row(motion), std::span(&same, 1), unseen);
      result.insert(result.end(), errors.so_far().begin(), errors.so_far().end());
    }
    return result;
  }
};

TEST(AllRowErrors, AreThoseOfRowsOneAfterTheOther) {
  for (const double growth : {1.0, 2.0, 10.0}) {  // the last is lost on the way
    const Tables tables(growth);
    EXPECT_EQ(tables.all(never), tables.one_by_one(never)) << growth;
    EXPECT_EQ(tables.all(4), tables.one_by_one(4)) << growth;
  }
}

TEST(AllRowErrors, CountWhatRoundingOfAnInstantMoves) {
  Tables tables(1);
  tables.other = tables.motion;
  tables.apart.assign(tables.apart.size(), 0.0);
  const std::vector<double> exact = tables.all(never);
  tables.left_out[3] = -1e-9;
  const std::vector<double> accelerations(count * 2, 5.0);
  AllRowErrors errors(
      {tables.t, tables.left_out, tables.motion, tables.sizes},
      {{count, tables.other, {}, {}, accelerations}}, [](std::size_t, std::span<double>) { return false; },
      [] { return std::vector<bool>(2); });
  const std::vector<double> moved = errors.first(count, never);
  EXPECT_EQ(moved[2 * width], exact[2 * width]);
  EXPECT_NEAR(moved[3 * width], 1e-9 * std::abs(tables.motion[3 * width + 2]), 1e-15);
  EXPECT_NEAR(moved[3 * width + 2], 5e-9, 1e-15);
}

TEST(RowTables, LookThroughColumns) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> table{1, -2, 1, -5, 1, none};
  EXPECT_EQ(largest_in_columns(table, 2), (std::vector<double>{1, 5}));
  EXPECT_EQ(largest_in_columns({}, 2), (std::vector<double>{0, 0}));
}

}  // namespace
}  // namespace qdot
