#include "fe_node/mesh/node_order.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace crosswalk::fe {
namespace {

constexpr int kBits = 16;

/// Index along the Hilbert curve of a cell in a 2^16 cube, by Skilling's transpose algorithm
/// [skilling2004].
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (int i = 0; i < 3; ++i) {
      if (x[i] & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ x[i]) & p;
        x[0] ^= t;
        x[i] ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  for (std::uint32_t& a : x) a ^= t;
  std::uint64_t index = 0;
  for (int bit = kBits - 1; bit >= 0; --bit)
    for (std::uint32_t a : x) index = index << 1 | ((a >> bit) & 1u);
  return index;
}

}  // namespace

std::vector<int> hilbert_order(const std::vector<Vec3>& points) {
  std::vector<int> order(points.size());
  if (points.empty()) return order;
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = std::max((high - low).maxCoeff(), 1e-300);
  std::vector<std::uint64_t> key(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    order[n] = static_cast<int>(n);
    std::array<std::uint32_t, 3> cell;
    for (int i = 0; i < 3; ++i)
      cell[i] = static_cast<std::uint32_t>((points[n][i] - low[i]) / size * ((1 << kBits) - 1));
    key[n] = hilbert_index(cell);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  return order;
}

}  // namespace crosswalk::fe
