// The free head dropped on a rigid plate.
#include <cmath>

#include <fmt/format.h>

#include "common/units.h"
#include "fe_node/output/tissue_metrics.h"
#include "fe_node/validate/free_head.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

struct Drop {
  const char* name;
  Vec3 direction;               ///< from the cranial centre to the plate, F
  double height;                ///< m
  double low, high, reference;  ///< g
  Confidence confidence;
  const char* source;
};

struct DropOutcome {
  HeadSensor sensor;
  double contact_ms = 0, rebound = 0;
  double mps_95 = 0;
  std::string note;
};

DropOutcome drop(const FreeHead& head, const Drop& d, const CaseContext& context, int number) {
  const Vec3 n = d.direction.normalized();
  const double speed = std::sqrt(2 * kStandardGravity * d.height);
  constexpr double kEnd = 0.012, kGap = 1e-4;  // s, m
  DeckCase deck(head.draft, UnitSystem::MmTonneS);
  deck.add_plane(head.support(n) + kGap * n, -n, head.skin, 0.3);
  deck.start_velocity(speed * n);
  deck.end_at(kEnd);
  DeckRun run(deck.deck, context.folder / fmt::format("drop_{}", number), context.computing,
              kAddedMass);
  DropOutcome out{HeadSensor(run), 0, 0, 0, ""};
  const TissueMetrics metrics(
      run.model(), {{"brain", run.built().part_sets[run.built().part_set("brain")].second}});
  StrainPeaks peaks = metrics.no_peaks();
  double touching = 0;
  run.run(kEnd, kSampling, [&](const State& state) {
    out.sensor.sample(state);
    out.mps_95 = metrics.sample(run.model(), state, 0, peaks).regions.front().mps_95_so_far;
    if (run.scratch().body_wrench.back().f.norm() > 50) touching += kSampling;
  });
  out.contact_ms = 1e3 * touching;
  out.rebound = -out.sensor.velocity.back().dot(n) / speed;
  out.note = energy_note(run);
  return out;
}

const Vec3 kForehead(0.87, 0, 0.50), kVertex(0, 0, 1), kOcciput(-0.87, 0, 0.50),
    kSideOfHead(0, 0.82, 0.57);

}  // namespace

CaseResult head_drops(const CaseContext& context) {
  const FreeHead head(context.fidelity);
  const Drop drops[] = {
      {"lateral, 200 mm", kSideOfHead, 0.200, 100, 150, 125, Confidence::High, "[iso9790]"},
      {"forehead, 376 mm", kForehead, 0.376, 225, 275, 250, Confidence::High,
       "dummy certification, human-like"},
      {"forehead, 150 mm", kForehead, 0.150, 90, 180, 135, Confidence::Low, "[loyd2014]"},
      {"vertex, 150 mm", kVertex, 0.150, 90, 180, 135, Confidence::Low, "[loyd2014]"},
      {"occiput, 150 mm", kOcciput, 0.150, 90, 180, 135, Confidence::Low, "[loyd2014]"},
      {"forehead, 300 mm", kForehead, 0.300, 140, 270, 205, Confidence::Low, "[loyd2014]"}};
  CaseResult result{"head_drops",
                    "the free head dropped on a rigid plate",
                    "peak resultant acceleration of the head's centre against drop height",
                    {},
                    {{"acceleration", "Head drops", "time, ms", "acceleration, g", {}}},
                    {}};
  double low_drop = 0, high_drop = 0;
  int number = 0;
  for (const Drop& d : drops) {
    const DropOutcome out = drop(head, d, context, ++number);
    const double peak = out.sensor.peak() / kStandardGravity;
    result.measures.push_back(
        {d.name, "g", peak, d.reference, d.low, d.high, d.confidence, d.source});
    result.plots.front().series.push_back(out.sensor.series(d.name));
    result.notes.push_back(fmt::format("{}: HIC15 {:.0f}, contact {:.1f} ms, rebound {:.0f} %, {}",
                                       d.name, out.sensor.hic15(), out.contact_ms,
                                       100 * out.rebound, out.note));
    if (d.direction == kForehead && d.height == 0.150) low_drop = peak;
    if (d.direction == kForehead && d.height == 0.300) high_drop = peak;
  }
  result.measures.push_back({"forehead, 300 over 150 mm", "", high_drop / low_drop, 1.5, 1.35, 1.6,
                             Confidence::Low, "[loyd2014]"});
  return result;
}

// How head acceleration, HIC15 and strain settle with the mesh: one drop at each size.
CaseResult mesh_refinement(const CaseContext& context) {
  CaseResult result{"mesh_refinement",
                    "forehead drop from 376 mm at growing fineness",
                    "values of each mesh; the reference is the mesh before it",
                    {},
                    {{"acceleration", "Mesh refinement", "time, ms", "acceleration, g", {}}},
                    {}};
  using generate::Fidelity;
  const std::pair<const char*, Fidelity> sizes[] = {
      {"coarse", Fidelity::Coarse}, {"medium", Fidelity::Medium}, {"fine", Fidelity::Fine}};
  double before[3] = {};
  for (std::size_t i = 0; i < std::size(sizes); ++i) {
    if (sizes[i].second == Fidelity::Fine && context.fidelity != Fidelity::Fine) break;
    const FreeHead head(sizes[i].second);
    const Drop d{"forehead", kForehead, 0.376, 0, 0, 0, Confidence::Low, ""};
    const DropOutcome out = drop(head, d, context, static_cast<int>(i) + 1);
    const double now[3] = {out.sensor.peak() / kStandardGravity, out.sensor.hic15(),
                           logarithmic(out.mps_95)};
    const char* names[3] = {"peak acceleration, g", "HIC15", "MPS95 (log)"};
    for (int k = 0; k < 3; ++k) {
      Measure m{fmt::format("{}: {}", sizes[i].first, names[k]), "", now[k]};
      if (i > 0) m.reference = before[k];
      m.source = "own coarser mesh";
      result.measures.push_back(m);
      before[k] = now[k];
    }
    result.plots.front().series.push_back(out.sensor.series(sizes[i].first));
    result.notes.push_back(
        fmt::format("{}: {} bricks, {}", sizes[i].first, head.draft.mesh.hexes.size(), out.note));
  }
  return result;
}

}  // namespace crosswalk::fe::validate
