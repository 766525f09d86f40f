// A picture in memory and its PNG form (RFC 2083; 8-bit RGB, one IDAT chunk, filter chosen per row
// by least absolute sum). Same pixels give the same bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace crosswalk::recording {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

struct Image {
  Image(int width_px, int height_px, Rgb fill);
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;  ///< row by row from the top left
  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

std::string png(const Image& image);
/// Throws UserError when the file cannot be written.
void write_png(const std::filesystem::path& file, const Image& image);
/// RFC 4648 with padding.
std::string base64(const void* data, std::size_t bytes);
/// `data:image/png;base64,...` for an `img` element.
std::string data_url(const Image& image);

}  // namespace crosswalk::recording
