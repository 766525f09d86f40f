#include "fe_node/generate/ligaments.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "common/error.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/spine_data.h"

namespace crosswalk::fe::generate {

namespace {

/// Force and elongation at failure of a whole ligament; lines share the force. Medians of ligament
/// tests [yoganandan2000] [myklebust1988] [dvorak1988] [mattucci2012] [L, medium].
struct LigamentData {
  const char* name;
  double failure_force;       ///< N
  double failure_elongation;  ///< mm
  double slack = 0;           ///< mm
};

constexpr LigamentData kAll{"ALL", 250, 6}, kPll{"PLL", 250, 4.5}, kFlavum{"LF", 130, 6},
    kCapsule{"CL", 200, 7}, kInterspinous{"ISL", 60, 6}, kAaom{"AAOM", 232, 10},
    kPaom{"PAOM", 83, 8}, kAaam{"AAAM", 263, 10}, kPaam{"PAAM", 111, 9},
    kCapsuleC0C1{"CL_C0C1", 320, 10}, kCapsuleC1C2{"CL_C1C2", 314, 9, 2.5}, kAlar{"alar", 428, 6},
    kApical{"apical", 200, 5}, kCruciform{"cruciform", 860, 6}, kTectorial{"tectorial", 76, 6};

/// Elongation over that at failure, force over failure force [yoganandan2000] [E shape].
constexpr std::array<std::pair<double, double>, 13> kShape{{{-2, 0},
                                                            {0, 0},
                                                            {0.10, 0.02},
                                                            {0.20, 0.06},
                                                            {0.30, 0.13},
                                                            {0.40, 0.24},
                                                            {0.60, 0.52},
                                                            {0.80, 0.80},
                                                            {1.0, 1.0},
                                                            {1.2, 0.85},
                                                            {1.6, 0.45},
                                                            {2.5, 0},
                                                            {5, 0}}};

/// Force over that at rest, by strain rate in 1/s: 1.14 to 1.5 at 10, 1.3 at 72 [vivaplus2022]
/// [mattucci2012], 1 + 0.15 lg(rate / 0.24) with a gentle start [E].
constexpr std::array<std::pair<double, double>, 6> kRateFactor{
    {{-1e3, 1}, {0, 1}, {10, 1.24}, {70, 1.37}, {500, 1.5}, {1e4, 1.5}}};
constexpr int kFirstRateCurve = 4200;

/// Facet cartilage: nominal strain and stress in compression (Pa) [vivaplus2022]; two layers of 0.5
/// mm over 100 mm2, behind a gap of 0.5 mm (0.3 to 0.6 [L, medium]).
constexpr std::array<std::pair<double, double>, 6> kCartilage{
    {{0.05, 0.42e6}, {0.1, 1.01e6}, {0.2, 3.06e6}, {0.3, 7.17e6}, {0.4, 15.4e6}, {0.5, 32.1e6}}};
constexpr double kFacetGap = 0.5e-3, kCartilageThickness = 1e-3, kFacetArea = 100e-6;
/// Gaps after which bone meets bone in the two pivot joints, m; set so that single joints turn
/// about as far at 1 N m as in cadaver necks [panjabi2001] [E].
constexpr double kCondyleSideGap = 1.2e-3, kCondyleFrontGap = 0.9e-3, kCondyleBackGap = 3.2e-3,
                 kCondyleTwistGap = 1.6e-3;
constexpr double kAtlasSideGap = 0.7e-3, kAtlasBackGap = 5.0e-3;
/// A facet is a plane of the lower body on which four points of the upper one slide: struts along
/// the normal whose other end lies so far below the plane that sliding by s lifts a point by
/// s^2 / (2 length) only, 0.1 mm for 5 mm.
constexpr double kFacetStrut = 120e-3, kFacetPoint = 3.5e-3;

/// Translational stiffness of one pivot strut, N/m; four meet, giving 0.6 to 2 MN/m, the order of
/// whole segments in compression (1.3 MN/m) [moroney1988] [E].
constexpr double kPivotStiffness = 0.8e6;

class Builder {
 public:
  Builder(ModelDraft& draft, const Spine& spine)
      : draft_(draft), spine_(spine), s_(1e-3 * spine.scale) {}

  void run() {
    for (int level = C2; level <= T1; ++level) add_level(static_cast<Level>(level));
    add_upper();
    add_pivots();
    add_stops();
    for (int level = C2; level <= T1; ++level) add_facets(static_cast<Level>(level));
  }

 private:
  struct End {
    Level level;
    Vec3 point;  ///< N
  };
  using Ends = std::vector<std::pair<End, End>>;

  /// Point in a body's axes, reference mm; for C0 in the Frankfurt frame of the reference head.
  End at(Level level, double x, double y, double z) const {
    return {level, spine_[level].at_reference(x, y, z)};
  }
  /// Point in body lengths already scaled, m.
  End on(Level level, double x, double y, double z) const {
    return {level, spine_[level].at(x, y, z)};
  }

  int node(const End& end) {
    const int id = draft_.mesh.add_node(end.point);
    draft_.mesh.attach(spine_[end.level].part, {id});
    return id;
  }

  void add_line(int part, const End& a, const End& b) {
    const int from = node(a), to = node(b);
    draft_.mesh.lines.push_back({from, to, part});
  }

  void add_part(int id, const std::string& name, const CurveSpec& curve, const std::string& source,
                Grade grade) {
    draft_.curves.push_back(curve);
    draft_.parts.push_back(
        {.id = id,
         .name = name,
         .density = 0,
         .law = mat::SpringNonlinearElastic{.curve = DeckId(curve.id), .rate_curve = {}},
         .section = SpringSection{},
         .source = source,
         .grade = grade});
  }

  DeckId rate_curve(int id, double length) {
    CurveSpec curve{.id = id, .name = "rate", .points = {}, .axes = CurveAxes::FactorOverVelocity};
    for (const auto& [rate, factor] : kRateFactor) curve.points.emplace_back(rate * length, factor);
    draft_.curves.push_back(curve);
    return DeckId(id);
  }

  void add_ligament(const LigamentData& data, const std::string& where, const Ends& ends) {
    const int id = part::kFirstLigament + ligaments_++;
    CurveSpec curve{.id = id, .name = data.name + where, .points = {}};
    for (const auto& [e, f] : kShape)
      curve.points.emplace_back(1e-3 * (e * data.failure_elongation + data.slack),
                                f * data.failure_force / static_cast<double>(ends.size()));
    add_part(id, data.name + where, curve, "failure force and elongation of ligament tests",
             Grade::Literature);
    double length = 0;
    for (const auto& [a, b] : ends)
      length += (a.point - b.point).norm() / static_cast<double>(ends.size());
    std::get<mat::SpringNonlinearElastic>(draft_.parts.back().law).rate_curve =
        rate_curve(kFirstRateCurve + ligaments_ - 1, length);
    for (const auto& [a, b] : ends) add_line(id, a, b);
  }

  /// Four unit vectors in the plane of a facet.
  static std::array<Vec3, 4> facet_rim(const Vec3& normal) {
    const Vec3 along = normal.cross(Vec3::UnitY()).normalized(), across = along.cross(normal);
    return {across, along, -across, -along};
  }

  void add_level(Level upper) {
    const Level lower = static_cast<Level>(upper + 1);
    const SpineBody &u = spine_[upper], &l = spine_[lower];
    const std::string where = "_" + u.name + l.name;
    Ends front, back, flavum, spinous, capsule;
    for (const int i : {-1, 0, 1}) {
      const double yu = 0.25 * i * u.width(), yl = 0.25 * i * l.width();
      front.push_back({on(upper, 0.5 * u.depth(), yu, 0), on(lower, 0.5 * l.depth(), yl, 0)});
      back.push_back({on(upper, -0.5 * u.depth(), yu, 0), on(lower, -0.5 * l.depth(), yl, 0)});
    }
    for (const int side : {-1, 1}) {
      const double y = side * 6 * s_;
      flavum.push_back({on(upper, -0.5 * u.depth() - u.canal_depth, y, -3 * s_),
                        on(lower, -0.5 * l.depth() - l.canal_depth, y, 3 * s_)});
      const Vec3 centre = spine_.facet_centre(upper, side),
                 normal = spine_.facet_normal(upper, side);
      for (const Vec3& rim : facet_rim(normal)) {
        const Vec3 p = centre + 5 * s_ * rim;
        capsule.push_back({{upper, p + 3 * s_ * normal}, {lower, p - 3 * s_ * normal}});
      }
    }
    for (const double share : {0.5, 0.9}) {
      const auto along = [share](const SpineBody& b) {
        return -0.5 * b.depth() - 0.5 * b.canal_depth - share * b.spinous;
      };
      spinous.push_back({on(upper, along(u), 0, -3 * s_), on(lower, along(l), 0, 3 * s_)});
    }
    add_ligament(kAll, where, front);
    add_ligament(kPll, where, back);
    add_ligament(kFlavum, where, flavum);
    add_ligament(kCapsule, where, capsule);
    add_ligament(kInterspinous, where, spinous);
  }

  /// Occiput, atlas and axis. Attachment points [E] after anatomy plates.
  void add_upper() {
    const SpineBody& axis = spine_[C2];
    const double back_of_axis = -0.5 * axis.depth() / s_, front_of_axis = 0.5 * axis.depth() / s_;
    const double dens_tip = 0.5 * axis.height / axis.size.z() + kDensHeight;
    const double lamina = back_of_axis - axis.canal_depth / s_;
    Ends aaom, paom, aaam, paam, c0c1, c1c2, tectorial;
    for (const double y : {-8.0, 0.0, 8.0}) {
      aaom.push_back({at(C0, 0, y, -23), at(C1, 17, y, 3)});
      paom.push_back({at(C0, -36, y, -25.5), at(C1, -22, y, 3)});
      aaam.push_back({at(C1, 17, y, -3), at(C2, front_of_axis, y, 0)});
      tectorial.push_back({at(C0, -5, 0.5 * y, -18), at(C2, back_of_axis, 0.5 * y, 0)});
    }
    for (const double y : {-6.0, 6.0}) paam.push_back({at(C1, -22, y, -3), at(C2, lamina, y, 0)});
    for (const double side : {-1.0, 1.0})
      for (const auto& [x, y] : {std::pair{6.0, 20.0}, {-6.0, 20.0}, {0.0, 15.0}, {0.0, 25.0}}) {
        c0c1.push_back({at(C0, -11 + x, side * y, -22), at(C1, x, side * y, 5)});
        c1c2.push_back({at(C1, x, side * y, -6), at(C2, -4 + x, side * (y - 3), 8)});
      }
    add_ligament(kAaom, "", aaom);
    add_ligament(kPaom, "", paom);
    add_ligament(kAaam, "", aaam);
    add_ligament(kPaam, "", paam);
    add_ligament(kCapsuleC0C1, "", c0c1);
    add_ligament(kCapsuleC1C2, "", c1c2);
    add_ligament(kAlar, "",
                 {{at(C2, 0, 1, dens_tip), at(C0, -8, 14, -23.5)},
                  {at(C2, 0, -1, dens_tip), at(C0, -8, -14, -23.5)}});
    add_ligament(kApical, "", {{at(C2, 0, 0, dens_tip), at(C0, -2, 0, -23.5)}});
    add_ligament(kCruciform, "",
                 {{at(C1, -1, 0, 2), at(C0, -2, 0, -23.5)},
                  {at(C1, -1, 0, -2), at(C2, back_of_axis, 0, 0)}});
    add_ligament(kTectorial, "", tectorial);
  }

  void add_pivots() {
    const CurveSpec curve{
        .id = part::kFirstJointStrut,
        .name = "pivot strut",
        .points = {{-1e-2, -1e-2 * kPivotStiffness}, {1e-2, 1e-2 * kPivotStiffness}}};
    add_part(part::kFirstJointStrut, "pivot_struts", curve, "condyles and dens as pivots",
             Grade::Estimate);
    for (const double x : {-10.0, 10.0})
      for (const double y : {-20.0, 20.0}) {
        add_line(part::kFirstJointStrut, at(C1, x, y, -3.5),
                 at(C0, kCondyleFrankfurtX, 0, kCondyleFrankfurtZ));
        add_line(part::kFirstJointStrut, at(C2, -6 + 0.6 * x, 0.75 * y, 8), at(C1, 5, 0, -4.5));
      }
  }

  /// A part of struts that push like cartilage once `gap` is closed.
  int contact_part(const std::string& name, double gap, double area, const std::string& source) {
    const int id = part::kFacet + contacts_++;
    CurveSpec curve{.id = id, .name = name, .points = {}};
    for (auto point = kCartilage.rbegin(); point != kCartilage.rend(); ++point)
      curve.points.emplace_back(-gap - point->first * kCartilageThickness, -point->second * area);
    curve.points.insert(curve.points.end(), {{-gap, 0}, {0, 0}, {1e-2, 0}});
    add_part(id, name, curve, source, Grade::Estimate);
    return id;
  }

  /// Struts whose upper end lies at the height of the pivot: those at its side do not feel flexion,
  /// those before and behind it do not feel lateral bending.
  void add_stops() {
    const char* source = "gap set against joint ranges of Panjabi 2001";
    const double x = kCondyleFrankfurtX, z = kCondyleFrankfurtZ;
    int part = contact_part("condyle_side", kCondyleSideGap, kFacetArea, source);
    for (const double y : {-20.0, 20.0}) add_line(part, at(C1, 0, y, -5), at(C0, x, y, z));
    add_line(contact_part("condyle_front", kCondyleFrontGap, kFacetArea, source), at(C1, 10, 0, -5),
             at(C0, x + 10, 0, z));
    add_line(contact_part("condyle_back", kCondyleBackGap, kFacetArea, source), at(C1, -10, 0, -5),
             at(C0, x - 10, 0, z));
    part = contact_part("condyle_twist", kCondyleTwistGap, kFacetArea, source);
    for (const double y : {-20.0, 20.0}) add_line(part, at(C1, -14, y, 7), at(C0, x, y, z));
    part = contact_part("atlas_side", kAtlasSideGap, kFacetArea, source);
    // The atlas turns by 30 degrees on the axis, its facets by 9 mm: planes as at the facets below.
    const Vec3 up = spine_[C2].X_NB.R() * Vec3::UnitZ();
    for (const double y : {-17.0, 17.0}) {
      const End facet = at(C1, 5, y, -4.5);
      add_line(part, {C2, facet.point - kFacetStrut * up}, facet);
    }
    add_line(contact_part("atlas_back", kAtlasBackGap, kFacetArea, source), at(C2, -33, 0, -6),
             at(C1, -22, 0, -4.5));
  }

  void add_facets(Level upper) {
    if (facet_part_ == 0)
      facet_part_ = contact_part("facets", kFacetGap, 0.25 * kFacetArea,
                                 "cartilage curve of VIVA+, gap and area estimated");
    const Level lower = static_cast<Level>(upper + 1);
    for (const int side : {-1, 1}) {
      const Vec3 centre = spine_.facet_centre(upper, side),
                 normal = spine_.facet_normal(upper, side);
      for (const Vec3& rim : facet_rim(normal)) {
        const Vec3 point = centre + spine_.scale * kFacetPoint * rim;
        add_line(facet_part_, {lower, point - kFacetStrut * normal}, {upper, point});
      }
    }
  }

  ModelDraft& draft_;
  const Spine& spine_;
  double s_;
  int ligaments_ = 0;
  int contacts_ = 0;
  int facet_part_ = 0;
};

}  // namespace

void add_ligaments(ModelDraft& draft, const Spine& spine) { Builder(draft, spine).run(); }

}  // namespace crosswalk::fe::generate
