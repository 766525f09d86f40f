#include "fe_node/generate/muscles.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "common/error.h"
#include "fe_node/generate/muscles_data.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/spine_data.h"

namespace crosswalk::fe::generate {

namespace {

// One passive and active law for all muscles [vivaplus2022].
constexpr double kPeakStress = 0.5e6;     // Pa
constexpr double kPassiveStrain = 0.375;  // strain at which the passive stress reaches the peak
constexpr double kPassiveExponent = 6;
constexpr double kMaximumRate = 5;  // fibre lengths per second, 4 to 10 [L]
// The mass of muscles is in the flesh; a strand only needs enough for its own stable step.
constexpr double kStrandDensity = 20;  // kg/m3
// Strands are held by the vertebrae they pass within this distance, m [E]; not next to their ends.
constexpr double kViaReach = 0.045, kViaMargin = 0.06;

/// Reference position of a skull point, Frankfurt frame, mm, left side [E].
Vec3 skull_point(Site site) {
  switch (site) {
    case Site::MastoidTip:
      return {-15, 52, -30};
    case Site::NuchalLateral:
      return {-62, 35, -8};
    case Site::NuchalMedial:
      return {-85, 10, -5};
    case Site::NuchalInferior:
      return {-60, 20, -25};
    case Site::Basiocciput:
      return {2, 7, -22};
    default:
      return {-10, 25, -28};  // jugular process
  }
}

struct GirdlePoint {
  int block;
  Vec3 p;  ///< N, mm, left side
};

/// Landmarks of the seated male [vivaplus2022]; ribs and thirds of the clavicle [E].
GirdlePoint girdle_point(Site site) {
  switch (site) {
    case Site::SternalNotch:
      return {part::kBlockTorsoUp, {71, 8, -24}};
    case Site::ClavicleMedial:
      return {part::kBlockClavicleLeft, {48, 52, -21}};
    case Site::ClavicleLateral:
      return {part::kBlockClavicleLeft, {-7, 144, -23}};
    case Site::Acromion:
      return {part::kBlockClavicleLeft, {-25, 166, -26}};
    case Site::ScapulaSuperior:
      return {part::kBlockClavicleLeft, {-76, 74, -33}};
    case Site::ScapulaMedial:
      return {part::kBlockClavicleLeft, {-78, 77, -65}};
    case Site::Rib1:
      return {part::kBlockTorsoUp, {38, 45, -32}};
    case Site::Rib2:
      return {part::kBlockTorsoUp, {15, 60, -38}};
    case Site::Rib3:
      return {part::kBlockTorsoUp, {-50, 42, -55}};
    default:
      return {part::kBlockTorsoUp, {-60, 62, -40}};  // backs of ribs 2 to 4
  }
}

class Builder {
 public:
  Builder(ModelDraft& draft, const Spine& spine, const Vec3& head_scale,
          const MuscleOptions& options)
      : draft_(draft), spine_(spine), head_scale_(head_scale), options_(options) {}

  void run() {
    for (const Strand& strand : neck_strands()) {
      const int part = part_of(strand);
      for (const int side : {1, -1}) {
        int from = node(strand.upper, side);
        const int end = node(strand.lower, side);
        for (const int via : vias(strand, from, end)) {
          draft_.mesh.lines.push_back({from, via, part});
          from = via;
        }
        draft_.mesh.lines.push_back({from, end, part});
      }
    }
  }

 private:
  /// One part per muscle and area: the section holds the area.
  int part_of(const Strand& strand) {
    const auto [found, is_new] = part_of_muscle_.try_emplace(
        strand.muscle, part::kFirstMuscle + static_cast<int>(part_of_muscle_.size()));
    if (!is_new) return found->second;
    draft_.parts.push_back(
        {.id = found->second,
         .name = std::string("muscle_") + strand.muscle,
         .density = kStrandDensity,
         .law = mat::Muscle{.maximum_rate = kMaximumRate,
                            .peak_stress = kPeakStress,
                            .passive_strain = kPassiveStrain,
                            .passive_exponent = kPassiveExponent,
                            .activation = options_.activation},
         .section = TrussSection{.area = 1e-6 * options_.area_factor * strand.area_mm2},
         .is_strand = true,
         .source = "areas and law of VIVA+, male area factor 1.2",
         .grade = Grade::Source});
    return found->second;
  }

  /// Where a strand along the spine slides on the vertebrae between its ends: at their height on
  /// its straight way, as long as that is near enough to the spine. Downwards.
  std::vector<int> vias(const Strand& strand, int from, int end) {
    std::vector<int> nodes;
    if (!strand.follows_spine) return nodes;
    const Vec3 a = draft_.mesh.nodes[from], b = draft_.mesh.nodes[end];
    const int last = strand.lower.level > 0 ? strand.lower.level - 1 : T1;
    for (int level = std::max(strand.upper.level, 0) + 1; level <= std::min<int>(last, T1);
         ++level) {
      const SpineBody& body = spine_.bodies[level];
      const double share = (a.z() - body.X_NB.p.z()) / (a.z() - b.z());
      const Vec3 p = a + share * (b - a);
      if (share < kViaMargin || share > 1 - kViaMargin) continue;
      if ((p - body.X_NB.p).norm() > kViaReach * spine_.scale) continue;
      nodes.push_back(draft_.mesh.add_node(p));
      draft_.mesh.attach(body.part, {nodes.back()});
    }
    return nodes;
  }

  int node(const StrandEnd& end, int side) {
    Vec3 p;
    if (end.site == Site::Hyoid) return hyoid(side);
    int part = spine_[C0].part;
    if (end.level > 0) {
      p = vertebra_point(end, side, part);
    } else if (end.site <= Site::JugularProcess) {
      p = spine_.tragion + 1e-3 * skull_point(end.site).cwiseProduct(head_scale_);
      p.y() *= side;
    } else {
      const GirdlePoint point = girdle_point(end.site);
      p = 1e-3 * spine_.scale * point.p;
      p.y() *= side;
      part = point.block == part::kBlockClavicleLeft && side < 0 ? part::kBlockClavicleRight
                                                                 : point.block;
    }
    const int id = draft_.mesh.add_node(p);
    draft_.mesh.attach(part, {id});
    return id;
  }

  /// Levels below T3 lie on the torso block along the line of T2 and T3.
  Vec3 vertebra_point(const StrandEnd& end, int side, int& part) const {
    CW_ASSERT(end.level < kLevels);
    const SpineBody& body = spine_.bodies[end.level];
    part = body.part;
    const double s = 1e-3 * spine_.scale;
    switch (end.site) {
      case Site::Spinous:
        return end.level == C1 ? body.at(-22 * s, side * 5 * s, 0) : body.spinous_tip();
      case Site::Transverse:
        return body.transverse_tip(side);
      case Site::Articular:
        return body.at(-kFacetBehind * s, side * kFacetSide * s, 0);
      default:
        return body.at(end.level == C1 ? 17 * s : 0.5 * body.depth(), side * 4 * s, 0);
    }
  }

  /// The hyoid hangs on the mandible: the nearest node of the face block.
  int hyoid(int side) const {
    const Vec3 wanted = spine_.tragion + 1e-3 * Vec3(45, side * 12, -75).cwiseProduct(head_scale_);
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const Hex& hex : draft_.mesh.hexes) {
      if (hex.part != part::kFace) continue;
      for (const int id : hex.node) {
        const double distance = (draft_.mesh.nodes[id] - wanted).squaredNorm();
        if (distance < least) {
          least = distance;
          best = id;
        }
      }
    }
    CW_ASSERT(best >= 0);
    return best;
  }

  ModelDraft& draft_;
  const Spine& spine_;
  Vec3 head_scale_;
  MuscleOptions options_;
  std::map<std::string, int> part_of_muscle_;
};

}  // namespace

void add_muscles(ModelDraft& draft, const Spine& spine, const Vec3& head_scale,
                 const MuscleOptions& options) {
  Builder(draft, spine, head_scale, options).run();
}

}  // namespace crosswalk::fe::generate
