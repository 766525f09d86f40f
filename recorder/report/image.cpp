#include "recorder/report/image.h"

#include <array>
#include <cstdlib>
#include <fstream>

#include <zlib.h>

#include "common/error.h"

namespace crosswalk::recording {
namespace {

void append_u32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 0xFFU);
}

const Bytef* bytes_of(const std::string& text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

void append_chunk(std::string& out, const std::string& kind, const std::string& body) {
  append_u32(out, static_cast<std::uint32_t>(body.size()));
  const std::string checked = kind + body;
  out += checked;
  append_u32(out, static_cast<std::uint32_t>(
                      crc32(0, bytes_of(checked), static_cast<uInt>(checked.size()))));
}

/// The row after one of the PNG filters None, Sub, Up; `above` is empty in the first row.
std::string filtered_row(const std::string& row, const std::string& above, int filter) {
  std::string out(1, static_cast<char>(filter));
  for (std::size_t i = 0; i < row.size(); ++i) {
    const char left = i >= 3 ? row[i - 3] : char{0};
    const char up = above.empty() ? char{0} : above[i];
    const char predicted = filter == 0 ? char{0} : filter == 1 ? left : up;
    out += static_cast<char>(row[i] - predicted);
  }
  return out;
}

std::string best_filtered(const std::string& row, const std::string& above) {
  std::string best;
  long best_sum = -1;
  for (int filter = 0; filter < 3; ++filter) {
    std::string candidate = filtered_row(row, above, filter);
    long sum = 0;
    for (std::size_t i = 1; i < candidate.size(); ++i) {
      sum += std::abs(static_cast<int>(static_cast<signed char>(candidate[i])));
    }
    if (best_sum < 0 || sum < best_sum) {
      best_sum = sum;
      best = std::move(candidate);
    }
  }
  return best;
}

}  // namespace

Image::Image(int width_px, int height_px, Rgb fill)
    : width(width_px),
      height(height_px),
      pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), fill) {}

std::string png(const Image& image) {
  std::string raw;
  std::string above;
  for (int y = 0; y < image.height; ++y) {
    std::string row;
    for (int x = 0; x < image.width; ++x) {
      const Rgb& p = image.at(x, y);
      row += static_cast<char>(p.r);
      row += static_cast<char>(p.g);
      row += static_cast<char>(p.b);
    }
    raw += best_filtered(row, above);
    above = std::move(row);
  }
  uLongf packed_size = compressBound(static_cast<uLong>(raw.size()));
  std::string packed(packed_size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(packed.data()), &packed_size, bytes_of(raw),
                               static_cast<uLong>(raw.size()), Z_BEST_COMPRESSION);
  CW_ASSERT(status == Z_OK);
  packed.resize(packed_size);

  std::string out = "\x89PNG\r\n\x1a\n";
  std::string head;
  append_u32(head, static_cast<std::uint32_t>(image.width));
  append_u32(head, static_cast<std::uint32_t>(image.height));
  head += std::string{"\x08\x02\x00\x00\x00", 5};  // 8 bit, RGB, deflate, adaptive, not interlaced
  append_chunk(out, "IHDR", head);
  append_chunk(out, "IDAT", packed);
  append_chunk(out, "IEND", "");
  return out;
}

void write_png(const std::filesystem::path& file, const Image& image) {
  std::ofstream stream(file, std::ios::binary);
  const std::string bytes = png(image);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) {
    throw UserError(Problem{{file.string()}, "picture", "a file that can be written", "", ""});
  }
}

std::string base64(const void* data, std::size_t bytes) {
  static constexpr std::array<char, 65> kDigits{
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"};
  const auto* p = static_cast<const unsigned char*>(data);
  std::string out;
  out.reserve((bytes + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes; i += 3) {
    const std::size_t left = bytes - i;
    const unsigned group = (static_cast<unsigned>(p[i]) << 16U) |
                           (left > 1 ? static_cast<unsigned>(p[i + 1]) << 8U : 0U) |
                           (left > 2 ? static_cast<unsigned>(p[i + 2]) : 0U);
    out += kDigits[group >> 18U];
    out += kDigits[(group >> 12U) & 63U];
    out += left > 1 ? kDigits[(group >> 6U) & 63U] : '=';
    out += left > 2 ? kDigits[group & 63U] : '=';
  }
  return out;
}

std::string data_url(const Image& image) {
  const std::string bytes = png(image);
  return "data:image/png;base64," + base64(bytes.data(), bytes.size());
}

}  // namespace crosswalk::recording
