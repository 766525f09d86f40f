// A rigid hemisphere pressed into the skull: stiffness, stress of the tables, fracture.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "fe_node/generate/part_ids.h"
#include "fe_node/validate/free_head.h"
#include "fe_node/validate/head_draft.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

namespace part = generate::part;

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
constexpr double kLowStrain = 0.0025, kHighStrain = 0.0058;  // first principal, range of fracture
constexpr double kBreakingStrain = 0.016;                    // effective plastic, tables

/// What the tables of the skull bear now.
struct TableState {
  double tension = 0;  ///< largest first principal stress, mean over the table's thickness, Pa
  double strain = 0;   ///< and first principal strain, elastic
  double plastic = 0;  ///< largest of any point
  int failed = 0;      ///< shells
};

class Tables {
 public:
  Tables(const DeckRun& run, const generate::ModelDraft& draft) {
    for (const int b : blocks_of(run, "skull")) {
      const ElementBlock& block = *run.model().blocks[b];
      if (block.kind() != ElementKind::Quad4) continue;
      const int id = run.model().mesh.parts[block.part()].id.value;
      const auto& law = std::get<mat::PlasticKinematic>(draft.part(id).law);
      tables_.push_back({b, law.youngs, law.poisson});
    }
  }

  TableState look(const DeckRun& run) const {
    TableState out;
    const State& state = run.state();
    const StepContext step{state.nodes, state.spin, state.time, 0, false};
    for (const auto& [b, youngs, poisson] : tables_) {
      const ElementBlock& block = *run.model().blocks[b];
      for (int e = 0; e < block.element_count(); ++e) {
        const ElementSample s = block.sample(step, state.history[b], e);
        const Vec3 principal =
            Eigen::SelfAdjointEigenSolver<Mat3>(s.stress, Eigen::EigenvaluesOnly).eigenvalues();
        const double others = principal.sum() - principal[2];
        out.tension = std::max(out.tension, principal[2]);
        out.strain = std::max(out.strain, (principal[2] - poisson * others) / youngs);
        out.plastic = std::max(out.plastic, s.plastic_strain);
        if (!s.is_alive) ++out.failed;
      }
    }
    return out;
  }

 private:
  struct Table {
    int block;
    double youngs, poisson;  ///< Pa, 1
  };
  std::vector<Table> tables_;
};

struct Place {
  const char* name;
  Vec3 direction;
};

/// Force over travel, and the samples of it at which things happened first; -1: never.
struct PressOutcome {
  Series curve;  ///< mm, kN
  int low_strain = -1, high_strain = -1, breaking = -1;
  double tension = 0;
  int failed = 0;
  std::string note;

  /// kN
  double force_at(int sample) const {
    return sample < 0 ? kNever : curve.points[static_cast<std::size_t>(sample)].second;
  }
};

/// Mean over 1.05 mm of travel [E]: single nodes of the scalp under the sphere come and go, by
/// which the force jumps between nothing and twice its mean.
Series smoothed(const Series& raw) {
  constexpr int kReach = 3;  // samples of 0.15 mm to either side
  Series out = raw;
  const int count = static_cast<int>(raw.points.size());
  for (int i = 0; i < count; ++i) {
    const int first = std::max(0, i - kReach), last = std::min(count - 1, i + kReach);
    double sum = 0;
    for (int k = first; k <= last; ++k) sum += raw.points[k].second;
    out.points[i].second = sum / (last - first + 1);
  }
  return out;
}

// The base of the skull moves at constant speed against a fixed sphere, as a sphere against a
// fixed base.
PressOutcome press(const FreeHead& head, const Place& place, const CaseContext& context) {
  constexpr double kSpeed = 7.5, kAnvil = 0.048, kEnd = 0.0016;  // m/s, m, s
  const Vec3 n = place.direction.normalized();
  DeckCase deck(head.draft, UnitSystem::MmTonneS);
  std::vector<int> base;
  for (const generate::Hex& hex : head.draft.mesh.hexes)
    if (hex.part == part::kDiploe)
      for (int node : hex.node)
        if (head.draft.mesh.nodes[node].z() < head.marks.tragion.z() + 0.005) base.push_back(node);
  const Points steady[2] = {{{0, kSpeed}, {1, kSpeed}}, {{0, 0}, {1, 0}}};
  for (int axis = 0; axis < 3; ++axis) {
    Points v = steady[0];
    for (auto& point : v) point.second *= n[axis];
    deck.guide_nodes(base, axis, v);
    deck.guide_part(rigid_skull_part(), axis, v);
    deck.guide_part(rigid_skull_part(), 3 + axis, steady[1]);
  }
  deck.start_velocity(kSpeed * n);
  deck.add_sphere(head.support(n) + (kAnvil + 1e-4) * n, kAnvil, head.skin, 0.3);
  deck.end_at(kEnd);
  DeckRun run(deck.deck, context.folder / place.name, context.computing, kAddedMass);
  const Tables tables(run, head.draft);
  PressOutcome out;
  out.curve.label = place.name;
  run.run(kEnd, 2e-5, [&](const State& state) {
    const double force = run.scratch().body_wrench.back().f.norm();
    out.curve.points.emplace_back(1e3 * kSpeed * state.time, 1e-3 * force);
    const TableState now = tables.look(run);
    const int sample = static_cast<int>(out.curve.points.size()) - 1;
    const auto first = [sample](int& at, bool happened) {
      if (happened && at < 0) at = sample;
    };
    first(out.low_strain, now.strain > kLowStrain);
    first(out.high_strain, now.strain > kHighStrain);
    first(out.breaking, now.plastic > kBreakingStrain);
    out.tension = std::max(out.tension, now.tension);
    out.failed = now.failed;
  });
  out.curve = smoothed(out.curve);
  out.note = energy_note(run);
  return out;
}

/// Largest force until a table breaks, kN.
double peak_of(const PressOutcome& out) {
  double peak = 0;
  for (int i = 0; i < static_cast<int>(out.curve.points.size()); ++i)
    if (out.breaking < 0 || i <= out.breaking) peak = std::max(peak, out.force_at(i));
  return peak;
}

/// Mean slope between two forces, kN/mm.
double secant(const Series& curve, double low, double high) {
  double at_low = kNever, at_high = kNever;
  for (const auto& [x, f] : curve.points) {
    if (std::isnan(at_low) && f >= low) at_low = x;
    if (std::isnan(at_high) && f >= high) at_high = x;
  }
  return (high - low) / (at_high - at_low);
}

}  // namespace

CaseResult skull_stiffness(const CaseContext& context) {
  FreeHead head(context.fidelity);
  for (const int id : {part::kOuterTable, part::kInnerTable})
    std::get<mat::PlasticKinematic>(head.draft.part(id).law).failure_strain = kBreakingStrain;
  CaseResult result{
      "skull_stiffness",
      "rigid hemisphere of 48 mm radius pressed into the head at 7.5 m/s",
      "base of the skull held; whole head with scalp; stiffness between 20 and 80 % of the largest "
      "force before a table breaks (plastic strain 0.016), all forces mean over 1 mm of travel",
      {},
      {{"force", "Force on the hemisphere", "travel, mm", "force, kN", {}}},
      {}};
  for (const Place& place : {Place{"vertex", {0, 0, 1}}, Place{"parietal", {0, 0.82, 0.57}}}) {
    const PressOutcome out = press(head, place, context);
    const std::string at = std::string(", ") + place.name;
    const double peak = peak_of(out);
    result.measures.push_back({"stiffness" + at, "kN/mm", secant(out.curve, 0.2 * peak, 0.8 * peak),
                               4.02, 2.5, 6, Confidence::High, "[yoganandan1995] dynamic mean"});
    result.measures.push_back({"force at 0.58 % strain of a table" + at, "kN",
                               out.force_at(out.high_strain), 11.9, 8, 15, Confidence::Medium,
                               "[yoganandan1995] failure load"});
    result.measures.push_back({"force when a table breaks" + at, "kN", out.force_at(out.breaking),
                               11.9, 8, 15, Confidence::Medium, "[yoganandan1995] failure load"});
    result.notes.push_back(fmt::format(
        "{}: table strain of 0.25 % at {:.1f} kN, largest tension {:.0f} MPa, {} shells failed; {}",
        place.name, out.force_at(out.low_strain), 1e-6 * out.tension, out.failed, out.note));
    result.plots.front().series.push_back(out.curve);
  }
  return result;
}

}  // namespace crosswalk::fe::validate
