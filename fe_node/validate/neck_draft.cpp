#include "fe_node/validate/neck_draft.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/validate/head_draft.h"

namespace crosswalk::fe::validate {

namespace part = generate::part;

namespace {

bool is_muscle(int id) { return id >= part::kFirstMuscle && id < part::kFlesh; }
bool is_flesh(int id) { return id == part::kFlesh || id == part::kNeckSkin; }
bool is_block(int id) {
  return id == part::kBlockTorsoUp || id == part::kBlockClavicleLeft ||
         id == part::kBlockClavicleRight;
}

double angle_about(int axis, const BodyState& upper, const BodyState& lower) {
  const Mat3 R = (lower.X_WB.q.conjugate() * upper.X_WB.q).toRotationMatrix();
  if (axis == 0) return std::atan2(-R(1, 2), R(2, 2));
  if (axis == 1) return std::atan2(R(0, 2), R(2, 2));
  return std::atan2(R(1, 0), R(0, 0));
}

}  // namespace

const std::array<const char*, kNeckLevels> kLevelNames{"C0-C1", "C1-C2", "C2-C3", "C3-C4",
                                                       "C4-C5", "C5-C6", "C6-C7", "C7-T1"};

generate::HeadNeck reference_neck(generate::Fidelity fidelity) {
  generate::HeadNeckSpec spec;
  spec.fidelity = fidelity;
  return generate::build_head_neck(spec);
}

generate::ModelDraft ligamentous_spine(const generate::HeadNeck& whole) {
  const std::vector<int> head = parts_of_set(whole.draft, "head");
  std::vector<int> parts;
  for (const generate::PartSpec& spec : whole.draft.parts) {
    const bool of_head = std::find(head.begin(), head.end(), spec.id) != head.end();
    if (is_muscle(spec.id) || is_flesh(spec.id)) continue;
    if (is_block(spec.id) && spec.id != part::kBlockTorsoUp) continue;
    if (!of_head || spec.id == rigid_skull_part()) parts.push_back(spec.id);
  }
  return extract(whole.draft, parts);
}

generate::ModelDraft neck_with_rigid_head(const generate::HeadNeck& whole) {
  generate::ModelDraft draft = whole.draft;
  const std::vector<int> head = parts_of_set(draft, "head");
  const auto of_head = [&](int id) {
    return std::find(head.begin(), head.end(), id) != head.end();
  };
  // One density for one rigid part: the mass of the head stays, its centre nearly.
  const Inertia wanted = generate::inertia_of(draft, head, true);
  for (generate::Hex& hex : draft.mesh.hexes)
    if (of_head(hex.part)) hex.part = rigid_skull_part();
  draft.mesh.masses.clear();
  std::erase_if(draft.mesh.quads, [&](const generate::Quad& q) { return of_head(q.part); });
  std::vector<int> parts;
  for (const generate::PartSpec& spec : draft.parts)
    if (!of_head(spec.id) || spec.id == rigid_skull_part()) parts.push_back(spec.id);
  generate::ModelDraft out = extract(draft, parts);
  generate::PartSpec& rigid = out.part(rigid_skull_part());
  rigid.density *= wanted.mass / generate::inertia_of(out, {rigid_skull_part()}, false).mass;
  return out;
}

int part_of_level(generate::Level level) { return rigid_skull_part() + 10 * level; }

int body_of_part(const DeckRun& run, const generate::ModelDraft& draft, int part) {
  const std::string& wanted = draft.part(part).name;
  const std::vector<RigidBody>& bodies = run.model().bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].name == wanted) return static_cast<int>(b);
  CW_ASSERT(false && "rigid part of the generator");
  return -1;
}

std::vector<int> spine_bodies(const DeckRun& run, const generate::ModelDraft& draft) {
  std::vector<int> bodies;
  for (int level = generate::C0; level <= generate::T1; ++level)
    bodies.push_back(body_of_part(run, draft, part_of_level(static_cast<generate::Level>(level))));
  return bodies;
}

std::vector<double> level_angles(const State& state, const std::vector<int>& bodies, int axis) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < bodies.size(); ++i)
    out.push_back(angle_about(axis, state.bodies[bodies[i]], state.bodies[bodies[i + 1]]));
  return out;
}

const char* name(Bearer bearer) {
  constexpr const char* kNames[] = {"discs", "ligaments", "facets", "struts", "muscles", "flesh"};
  return kNames[static_cast<int>(bearer)];
}

std::array<double, kBearers> energy_by_bearer(const DeckRun& run) {
  std::array<double, kBearers> sum{};
  const auto& blocks = run.model().blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const int id = run.model().mesh.parts[blocks[b]->part()].id.value;
    if (id < part::kFirstDisc || id > part::kNeckSkin) continue;
    Bearer bearer = Bearer::Disc;  // ground, fibres, nucleus
    if (is_flesh(id))
      bearer = Bearer::Flesh;
    else if (id >= part::kFirstMuscle)
      bearer = Bearer::Muscle;
    else if (id >= part::kFirstJointStrut && id < part::kFirstFibre)
      bearer = Bearer::Strut;
    else if (id >= part::kFacet && id < part::kFirstJointStrut)
      bearer = Bearer::Facet;
    else if (id >= part::kFirstLigament && id < part::kFacet)
      bearer = Bearer::Ligament;
    const BlockSums& sums = run.scratch().block_sums[b];
    sum[static_cast<int>(bearer)] += sums.internal + sums.hourglass;
  }
  return sum;
}

}  // namespace crosswalk::fe::validate
