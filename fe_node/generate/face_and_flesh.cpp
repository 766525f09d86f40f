// The sweep below the head: face block and neck flesh on one structured grid, and the neck's skin.
#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "fe_node/generate/head_mesh.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {

namespace {

/// Grid: a = strip row (back to front), b = column (right to left), c = level from the bottom up.
class Sweep {
 public:
  Sweep(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape, const NeckFleshPlan& plan)
      : draft_(draft), head_(head), shape_(shape), plan_(plan), strip_(head.sphere) {
    levels_ = plan.levels_above_chin + plan.levels_below_chin;
    chin_ = plan.levels_below_chin;
    throat_row_ = strip_.face_row +
                  static_cast<int>(std::lround(kThroatShare * (strip_.rows - strip_.face_row)));
    grid_ = Grid({strip_.rows, strip_.columns, levels_});
    choose_channel();
  }

  FaceAndFlesh run() {
    for (int c = levels_; c >= 0; --c)
      for (int b = 0; b <= strip_.columns; ++b)
        for (int a = 0; a <= strip_.rows; ++a)
          if (is_used(a, b, c)) grid_.at(a, b, c) = node(a, b, c);
    add_cells(draft_, grid_, [this](int a, int b, int c) { return part_of(a, b, c); });
    add_skin();
    return collect();
  }

 private:
  static constexpr double kThroatShare = 0.6;  ///< of the face's depth that the neck carries on [E]

  /// First and last row and column of the empty channel, in node indices.
  void choose_channel() {
    first_column_ = static_cast<int>(std::lround(0.5 * strip_.columns * (1 - kChannelWidth)));
    last_column_ = strip_.columns - first_column_;
    first_row_ = std::max(1, static_cast<int>(std::lround(0.2 * strip_.face_row)));
  }
  static constexpr double kChannelWidth = 0.4;  ///< of the neck's columns

  int part_of(int a, int b, int c) const {
    const bool above_chin = c >= chin_;
    if (a >= strip_.face_row) {
      if (above_chin) return part::kFace;
      return a < throat_row_ ? part::kFlesh : -1;
    }
    const bool channel = a >= first_row_ && b >= first_column_ && b < last_column_;
    return channel ? -1 : part::kFlesh;
  }

  bool is_used(int a, int b, int c) const {
    for (int da = -1; da <= 0; ++da)
      for (int db = -1; db <= 0; ++db)
        for (int dc = -1; dc <= 0; ++dc) {
          const int i = a + da, j = b + db, k = c + dc;
          if (i < 0 || j < 0 || k < 0 || i >= strip_.rows || j >= strip_.columns || k >= levels_)
            continue;
          if (part_of(i, j, k) >= 0) return true;
        }
    return false;
  }

  int node(int a, int b, int c) {
    const int on_skull = head_.skull_outer[strip_.node(a, b)];
    if (c == levels_) return on_skull;
    return draft_.add_node(position(a, b, c, draft_.nodes[on_skull]));
  }

  /// Neck section as a grid: rows before face_row reach from the back skin over the channel to its
  /// front wall, the throat rows from there to the front skin.
  Vec3 section_point(int a, int b, double z) const {
    const NeckSection section = plan_.section(z);
    const double front_wall = kFrontWall;
    double s = 0;
    if (a <= first_row_)
      s = -1 + (1 - plan_.channel_back / section.half_depth) * a / first_row_;
    else if (a <= strip_.face_row)
      s = -plan_.channel_back / section.half_depth + (front_wall + plan_.channel_back) /
                                                         section.half_depth * (a - first_row_) /
                                                         (strip_.face_row - first_row_);
    else
      s = front_wall / section.half_depth + (1 - front_wall / section.half_depth) *
                                                (a - strip_.face_row) /
                                                (throat_row_ - strip_.face_row);
    const double t = column_share(b, section.half_breadth);
    const Vec3 disc = square_to_disc(s, t, kSectionRoundness);
    const double reach = disc.x() > 0 ? front_depth(section, z) : section.half_depth;
    return {section.centre.x() + reach * disc.x(), section.half_breadth * disc.y(), z};
  }

  /// The throat starts well behind the chin, however thick the neck, and widens downwards.
  double front_depth(const NeckSection& section, double z) const {
    const double chin_z = shape_.menton_z(), level = std::max(z, chin_z);
    const double back = plan_.section(level).centre.x() + kFrontWall;
    const double front = shape_.face_outline(shape_.face_height(level), 1, 0, back).x();
    const double in_face = kFrontWall + kThroatShare * (front - back);
    return std::min(section.half_depth, in_face + kThroatSlope * std::max(0.0, chin_z - z));
  }
  /// A rounder one would flatten the cells at the section's four corners too much when fine.
  static constexpr double kSectionRoundness = 0.85;
  static constexpr double kThroatSlope = 0.5;  ///< depth won per height below the chin [E]
  static constexpr double kFrontWall =
      0.018;  ///< channel's front before the section's centre, m [E]

  double column_share(int b, double half_breadth) const {
    const double wall = plan_.channel_half_width / half_breadth;
    if (b <= first_column_) return -1 + (1 - wall) * b / first_column_;
    if (b >= last_column_) return 1 - (1 - wall) * (strip_.columns - b) / first_column_;
    return wall * (2.0 * (b - first_column_) / (last_column_ - first_column_) - 1);
  }

  Vec3 position(int a, int b, int c, const Vec3& on_skull) const {
    const double chin_z = shape_.menton_z();
    if (c <= chin_) {
      const double z = plan_.bottom_z + (chin_z - plan_.bottom_z) * c / chin_;
      if (a <= throat_row_) return section_point(a, b, z);
      return face_point(a, b, chin_z);
    }
    const double down = static_cast<double>(levels_ - c) / (levels_ - chin_);  // 0 skull, 1 chin
    const double z = (1 - down) * on_skull.z() + down * chin_z;
    const double reach = smooth_step(0.0, 0.6, down);
    Vec3 target;
    if (a <= strip_.face_row) {
      target = section_point(a, b, z);
    } else {
      // Both outlines are those of this level: their back moves with the spine, and rows of
      // another level would pass those behind them.
      target = face_point(a, b, z);
      if (a <= throat_row_) {
        const double low = smooth_step(0.3, 1.0, down);
        target = (1 - low) * target + low * section_point(a, b, z);
      }
    }
    Vec3 p = (1 - reach) * on_skull + reach * target;
    p.z() = z;
    return p;
  }

  Vec3 face_point(int a, int b, double z) const {
    const double depth = static_cast<double>(a - strip_.face_row) / (strip_.rows - strip_.face_row);
    const double back = plan_.section(z).centre.x() + kFrontWall;
    Vec3 p = shape_.face_outline(shape_.face_height(z), depth, 2.0 * b / strip_.columns - 1, back);
    p.z() = z;
    return p;
  }

  /// On the outer faces of the flesh: back, both sides and, below the chin, the throat.
  void add_skin() {
    for (int c = 0; c < levels_; ++c) {
      const auto add = [&](int a, int b, int next_a, int next_b) {
        draft_.quads.push_back({{grid_.at(a, b, c), grid_.at(next_a, next_b, c),
                                 grid_.at(next_a, next_b, c + 1), grid_.at(a, b, c + 1)},
                                part::kNeckSkin});
      };
      const int front = c < chin_ ? throat_row_ : strip_.face_row;
      for (int b = 0; b < strip_.columns; ++b) {
        add(0, b, 0, b + 1);
        if (c < chin_) add(front, b, front, b + 1);
      }
      for (int a = 0; a < front; ++a)
        for (const int b : {0, strip_.columns}) add(a, b, a + 1, b);
    }
  }

  FaceAndFlesh collect() const {
    FaceAndFlesh result;
    for (int c = 0; c < levels_; ++c)
      for (int b = 0; b <= strip_.columns; ++b)
        for (int a = 0; a <= throat_row_; ++a) {
          const int id = grid_.at(a, b, c);
          if (id < 0) continue;
          if (c == 0) result.bottom.push_back(id);
          const bool of_face = a >= strip_.face_row && c >= chin_;
          const bool inside_columns = b >= first_column_ && b <= last_column_;
          const bool inside_rows = a >= first_row_ && a <= strip_.face_row;
          if (c > 0 && inside_columns && inside_rows && !of_face) result.channel_wall.push_back(id);
        }
    return result;
  }

  MeshDraft& draft_;
  const HeadMesh& head_;
  const HeadShape& shape_;
  const NeckFleshPlan& plan_;
  HeadStrip strip_;
  Grid grid_;
  int levels_ = 0, chin_ = 0, throat_row_ = 0;
  int first_row_ = 1, first_column_ = 0, last_column_ = 0;
};

}  // namespace

FaceAndFlesh add_face_and_flesh(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape,
                                const NeckFleshPlan& plan) {
  CW_ASSERT(plan.levels_above_chin > 0 && plan.levels_below_chin > 0);
  return Sweep(draft, head, shape, plan).run();
}

}  // namespace crosswalk::fe::generate
