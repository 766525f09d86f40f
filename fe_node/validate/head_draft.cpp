#include "fe_node/validate/head_draft.h"

#include <algorithm>

#include <Eigen/LU>

#include "common/error.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/quality.h"

namespace crosswalk::fe::validate {

namespace part = generate::part;
using generate::ModelDraft;

namespace {

constexpr int kOcciput = part::kFirstVertebra - 10;
/// Pa, a hundredth of water's: tissue in a rigid skull keeps its volume all the same (Poisson's
/// ratio 0.4998 and above), and the step is larger. Of pressures nothing is read in these cases.
constexpr double kSoftBulk = 0.01 * generate::kWaterBulk;

/// Renumbers the nodes that are used; -1 for the others.
class Renumbering {
 public:
  Renumbering(const generate::MeshDraft& from, generate::MeshDraft& to)
      : from_(from), to_(to), number_(from.nodes.size(), -1) {}
  int use(int node) {
    if (number_[node] < 0) number_[node] = to_.add_node(from_.nodes[node]);
    return number_[node];
  }
  std::vector<int> kept(const std::vector<int>& nodes) const {
    std::vector<int> out;
    for (int n : nodes)
      if (number_[n] >= 0) out.push_back(number_[n]);
    return out;
  }
  int kept(int node) const { return number_[node]; }

 private:
  const generate::MeshDraft& from_;
  generate::MeshDraft& to_;
  std::vector<int> number_;
};

bool holds(const std::vector<int>& parts, int id) {
  return std::find(parts.begin(), parts.end(), id) != parts.end();
}

}  // namespace

ModelDraft extract(const ModelDraft& whole, const std::vector<int>& parts) {
  ModelDraft out;
  out.title = whole.title;
  Renumbering number(whole.mesh, out.mesh);
  const auto take = [&](auto element, auto& into) {
    if (!holds(parts, element.part)) return;
    for (int& n : element.node) n = number.use(n);
    into.push_back(element);
  };
  for (const generate::Hex& hex : whole.mesh.hexes) take(hex, out.mesh.hexes);
  for (const generate::Quad& quad : whole.mesh.quads) take(quad, out.mesh.quads);
  for (generate::Line line : whole.mesh.lines) {
    if (!holds(parts, line.part)) continue;
    line.from = number.use(line.from);
    line.to = number.use(line.to);
    out.mesh.lines.push_back(line);
  }
  for (const generate::PointMass& mass : whole.mesh.masses)
    if (number.kept(mass.node) >= 0) out.mesh.masses.push_back({number.kept(mass.node), mass.mass});
  for (const generate::NodeSet& set : whole.mesh.sets)
    if (const std::vector<int> nodes = number.kept(set.nodes); !nodes.empty())
      out.mesh.sets.push_back({set.name, nodes});
  for (const generate::RigidAttachment& attached : whole.mesh.attachments)
    if (const std::vector<int> nodes = number.kept(attached.nodes);
        holds(parts, attached.part) && !nodes.empty())
      out.mesh.attachments.push_back({attached.part, nodes});
  for (const generate::PartSpec& spec : whole.parts)
    if (holds(parts, spec.id)) out.parts.push_back(spec);
  for (generate::PartSetSpec set : whole.part_sets) {
    std::erase_if(set.parts, [&](int id) { return !holds(parts, id); });
    if (!set.parts.empty()) out.part_sets.push_back(set);
  }
  for (const generate::CurveSpec& curve : whole.curves) out.curves.push_back(curve);
  return out;
}

std::vector<int> parts_of_set(const ModelDraft& draft, const std::string& name) {
  for (const generate::PartSetSpec& set : draft.part_sets)
    if (set.name == name) return set.parts;
  CW_ASSERT(false && "part set of the generator");
  return {};
}

int rigid_skull_part() { return kOcciput; }

ModelDraft rigid_skull_head(const generate::HeadNeck& whole) {
  ModelDraft draft = whole.draft;
  for (generate::Hex& hex : draft.mesh.hexes)
    if (hex.part == part::kDiploe) hex.part = kOcciput;
  std::vector<int> parts = parts_of_set(draft, "brain");
  parts.insert(parts.end(),
               {part::kCsf, part::kCord, kOcciput, part::kPia, part::kFalx, part::kTentorium});
  ModelDraft out = extract(draft, parts);
  out.title = "Brain in a rigid skull";
  for (generate::PartSpec& spec : out.parts)
    if (auto* law = std::get_if<mat::Viscoelastic>(&spec.law)) law->bulk = kSoftBulk;
  return out;
}

ModelDraft whole_head(const generate::HeadNeck& whole) {
  ModelDraft out = extract(whole.draft, parts_of_set(whole.draft, "head"));
  out.title = "Head without neck";
  return out;
}

Vec3 TissuePoint::position(const DeckRun& run) const {
  Vec3 p = Vec3::Zero();
  for (int c = 0; c < 8; ++c) p += weight[c] * run.state().nodes[run.node_of(node[c])].position();
  return p;
}

TissuePoint tissue_point(const ModelDraft& draft, const std::vector<int>& parts, const Vec3& p) {
  const generate::Hex* best = nullptr;
  double nearest = 0;
  for (const generate::Hex& hex : draft.mesh.hexes) {
    if (!holds(parts, hex.part)) continue;
    const double distance =
        (generate::trilinear(generate::corners_of(draft.mesh, hex), 0, 0, 0) - p).squaredNorm();
    if (best != nullptr && distance >= nearest) continue;
    best = &hex;
    nearest = distance;
  }
  CW_ASSERT(best != nullptr);
  // Newton's method for the natural coordinates; the derivative of a trilinear map by differences
  // is exact.
  const generate::HexCorners x = generate::corners_of(draft.mesh, *best);
  Vec3 r = Vec3::Zero();
  for (int sweep = 0; sweep < 20; ++sweep) {
    const Vec3 gap = p - generate::trilinear(x, r.x(), r.y(), r.z());
    Mat3 J;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 a = r + 0.5 * Vec3::Unit(axis), b = r - 0.5 * Vec3::Unit(axis);
      J.col(axis) =
          generate::trilinear(x, a.x(), a.y(), a.z()) - generate::trilinear(x, b.x(), b.y(), b.z());
    }
    r += J.inverse() * gap;
    r = r.cwiseMax(-1.5).cwiseMin(1.5);
  }
  TissuePoint point;
  point.node = best->node;
  constexpr int kSign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  for (int c = 0; c < 8; ++c)
    point.weight[c] =
        0.125 * (1 + kSign[c][0] * r.x()) * (1 + kSign[c][1] * r.y()) * (1 + kSign[c][2] * r.z());
  return point;
}

}  // namespace crosswalk::fe::validate
