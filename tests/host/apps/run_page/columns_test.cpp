// Columns of numbers as text of a page, taken apart again by means of the test's own.
#include "host/apps/run_page/columns.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <random>

#include "host/apps/run_page/deflate.hpp"
#include "host/base/json/json.hpp"

namespace liana::run_page {
namespace {

std::string from_base64(const std::string& text) {
  static const std::string kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(kLetters.find(letter));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out.push_back(static_cast<char>(bits >> count & 0xFFu));
  }
  return out;
}

std::string inflated(const std::string& bytes, std::size_t size) {
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
  std::string out(size + 16, '\0'), in = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return out;
}

std::vector<std::int16_t> cells_of(const std::string& bytes, std::size_t column, std::size_t rows) {
  std::vector<std::int16_t> cells;
  std::uint16_t now = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const auto low = static_cast<unsigned char>(bytes.at(2 * rows * column + row));
    const auto high = static_cast<unsigned char>(bytes.at(2 * rows * column + rows + row));
    now = static_cast<std::uint16_t>(now + (low | high << 8));
    cells.push_back(static_cast<std::int16_t>(now));
  }
  return cells;
}

TEST(Columns, ComeBackFromThePageToHalfAStep) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-30.0, 30.0);
  std::vector<std::vector<double>> values(3);
  for (std::vector<double>& column : values) {
    for (int row = 0; row < 500; ++row) column.push_back(any(random));
  }
  std::vector<Column> columns;
  for (std::size_t i = 0; i < values.size(); ++i) columns.push_back(column_of("measured_js_deg", i, "deg", values[i]));
  const std::string bytes = inflated(from_base64(packed(columns)), 3000);
  ASSERT_EQ(bytes.size(), 3000u);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::vector<std::int16_t> cells = cells_of(bytes, i, 500);
    for (std::size_t row = 0; row < 500; ++row)
      EXPECT_NEAR(cells[row] * columns[i].scale, values[i][row], 0.5 * columns[i].scale + 1e-12);
  }
}

TEST(Columns, HaveASpecialCellForWhatIsNotThereAndNoneForARealValue) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Column column = column_of("clearance.distance_m", 0, "m", {none, 3.2767, -3.2767, 1.0 / 0.0});
  EXPECT_EQ(column.cells, (std::vector<std::int16_t>{kNotThere, 32767, -32767, kNotThere}));
}

TEST(Columns, AreCoarserWhenAValueWouldNotFit) {
  EXPECT_EQ(column_of("a", 0, "deg", {32.0}).scale, 1e-3);
  EXPECT_EQ(column_of("a", 0, "deg", {33.0}).scale, 1e-2);
  const Column frames = column_of("buses.frames", 0, "1", {4.0e9});
  EXPECT_NEAR(frames.cells[0] * frames.scale, 4.0e9, 0.5 * frames.scale);
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(from_base64(base64(std::string("\x00\xFF\x80", 3))), std::string("\x00\xFF\x80", 3));
}

}  // namespace
}  // namespace liana::run_page
