#include "fe_node/generate/layer_cell.h"

#include <algorithm>

namespace crosswalk::fe::generate {

void add_layer_cell(MeshDraft& draft, std::array<int, 4> bottom, std::array<int, 4> top, int part) {
  const auto &b = bottom, &t = top;
  const auto is_open = [&](int c) { return b[c % 4] != t[c % 4]; };
  const auto turn_to = [&](int first) {
    std::rotate(bottom.begin(), bottom.begin() + first, bottom.end());
    std::rotate(top.begin(), top.begin() + first, top.end());
  };
  const auto add = [&](const std::array<int, 8>& node) { draft.hexes.push_back({node, part}); };
  const auto add_tetrahedron = [&](int c) {
    add({b[c], b[(c + 1) % 4], b[(c + 3) % 4], t[c], t[c], t[c], t[c], t[c]});
  };
  int open = 0;
  for (int c = 0; c < 4; ++c) open += is_open(c);
  if (open == 4) {
    add({b[0], b[1], b[2], b[3], t[0], t[1], t[2], t[3]});
  } else if (open == 3) {  // two pyramids with their apex at the closed corner
    int closed = 0;
    while (is_open(closed)) ++closed;
    turn_to((closed + 1) % 4);
    add({b[0], t[0], t[1], b[1], b[3], b[3], b[3], b[3]});
    add({b[1], t[1], t[2], b[2], b[3], b[3], b[3], b[3]});
  } else if (open == 2 && is_open(0) != is_open(2)) {  // a wedge
    int first = 0;
    while (!(is_open(first) && is_open(first + 1))) ++first;
    turn_to(first);
    add({b[1], t[1], b[2], b[2], b[0], t[0], b[3], b[3]});
  } else {
    for (int c = 0; c < 4; ++c)
      if (is_open(c)) add_tetrahedron(c);
  }
}

}  // namespace crosswalk::fe::generate
