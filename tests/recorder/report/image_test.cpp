#include "recorder/report/image.h"

#include <cstring>

#include <gtest/gtest.h>
#include <zlib.h>

namespace crosswalk::recording {
namespace {

std::uint32_t u32(const std::string& bytes, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < 4; ++i) v = v << 8U | static_cast<unsigned char>(bytes[at + i]);
  return v;
}

/// Undoes the PNG: pixels of an 8-bit RGB file with the filters None, Sub and Up.
std::vector<Rgb> decoded(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const std::size_t width = u32(bytes, 16);
  const std::size_t height = u32(bytes, 20);
  const std::size_t data = 33;  // signature 8, IHDR chunk 25
  const std::size_t length = u32(bytes, data);
  EXPECT_EQ(bytes.substr(data + 4, 4), "IDAT");
  const auto* body = reinterpret_cast<const Bytef*>(bytes.data() + data + 4);
  EXPECT_EQ(crc32(0, body, static_cast<uInt>(length + 4)), u32(bytes, data + 8 + length));
  std::string raw((3 * width + 1) * height, '\0');
  uLongf size = raw.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(raw.data()), &size, body + 4, length), Z_OK);
  std::vector<Rgb> pixels;
  std::string above(3 * width, '\0');
  for (std::size_t y = 0; y < height; ++y) {
    std::string row = raw.substr(y * (3 * width + 1) + 1, 3 * width);
    const int filter = raw[y * (3 * width + 1)];
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (filter == 1 && i >= 3) row[i] = static_cast<char>(row[i] + row[i - 3]);
      if (filter == 2) row[i] = static_cast<char>(row[i] + above[i]);
    }
    for (std::size_t x = 0; x < width; ++x) {
      const auto c = [&row, x](std::size_t k) { return static_cast<std::uint8_t>(row[3 * x + k]); };
      pixels.push_back({c(0), c(1), c(2)});
    }
    above = row;
  }
  return pixels;
}

TEST(Png, GivesBackEveryPixel) {
  Image image(17, 11, Rgb{255, 255, 255});
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.at(x, y) = {static_cast<std::uint8_t>(37 * x + 5 * y), static_cast<std::uint8_t>(x * y),
                        static_cast<std::uint8_t>(255 - 11 * y)};
    }
  }
  EXPECT_EQ(decoded(png(image)), image.pixels);
}

TEST(Base64, Rfc4648Vectors) {
  const auto encoded = [](const char* text) { return base64(text, std::strlen(text)); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace crosswalk::recording
