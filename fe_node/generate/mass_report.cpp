#include "fe_node/generate/mass_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "common/error.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/quality.h"

namespace crosswalk::fe::generate {

namespace {

constexpr double kFaceDensityMin = 1150;  // kg/m3 [E]
constexpr double kMassWeight = 10;        ///< of the mass against a moment in the fit [E]
constexpr double kSameDistance = 1e-6;    // m
constexpr int kPatch = 9;                 ///< skull nodes that share one trim mass

double density_of(const ModelDraft& draft, int part) {
  const auto found = std::find_if(draft.parts.begin(), draft.parts.end(),
                                  [part](const PartSpec& p) { return p.id == part; });
  CW_ASSERT(found != draft.parts.end());
  return found->density;
}

/// The nodes nearest to a point; equally distant ones stay together, so both sides get the same.
std::vector<int> nearest(const MeshDraft& mesh, const std::vector<int>& nodes, const Vec3& p) {
  std::vector<int> sorted = nodes;
  std::stable_sort(sorted.begin(), sorted.end(), [&](int a, int b) {
    return (mesh.nodes[a] - p).squaredNorm() < (mesh.nodes[b] - p).squaredNorm();
  });
  std::size_t count = std::min<std::size_t>(sorted.size(), kPatch);
  const auto distance = [&](std::size_t i) { return (mesh.nodes[sorted[i]] - p).norm(); };
  while (count < sorted.size() && distance(count) < distance(count - 1) + kSameDistance) ++count;
  sorted.resize(count);
  return sorted;
}

/// Masses >= 0 that fit three moments and their sum best, by projected gradient steps on the normal
/// equations; three unknowns, so many small steps cost nothing.
Vec3 fit_pair_masses(const Eigen::Matrix<double, 4, 3>& A, const Eigen::Vector4d& b) {
  const Mat3 AtA = A.transpose() * A;
  const Vec3 Atb = A.transpose() * b;
  Vec3 x = Vec3::Zero();
  for (int sweep = 0; sweep < 2000; ++sweep)
    for (int i = 0; i < 3; ++i)
      x[i] = std::max(0.0, x[i] + (Atb[i] - AtA.row(i).dot(x)) / AtA(i, i));
  return x;
}

}  // namespace

Inertia inertia_of(const ModelDraft& draft, const std::vector<int>& parts, bool with_points) {
  // Mass at the eight Gauss points of each brick: exact for the volume and the centre.
  const double g = 1.0 / std::sqrt(3.0);
  Inertia total;
  const auto holds = [&](int part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  const auto add = [&](double mass, const Vec3& p) {
    total.mass += mass;
    first += mass * p;
    second += mass * p * p.transpose();
  };
  for (const Hex& hex : draft.mesh.hexes) {
    if (!holds(hex.part)) continue;
    const HexCorners x = corners_of(draft.mesh, hex);
    const double mass = density_of(draft, hex.part) * volume(x) / 8;
    for (int q = 0; q < 8; ++q) {
      const double r = (q & 1) ? g : -g, s = (q & 2) ? g : -g, t = (q & 4) ? g : -g;
      add(mass, trilinear(x, r, s, t));
    }
  }
  for (const Quad& quad : draft.mesh.quads) {
    if (!holds(quad.part)) continue;
    const auto* shell = std::get_if<ShellSection>(&draft.part(quad.part).section);
    CW_ASSERT(shell != nullptr);
    const auto& n = draft.mesh.nodes;
    const double area =
        0.5 * (n[quad.node[2]] - n[quad.node[0]]).cross(n[quad.node[3]] - n[quad.node[1]]).norm();
    const double thickness = quad.thickness > 0 ? quad.thickness : shell->thickness;
    for (const int id : quad.node)
      add(0.25 * area * thickness * density_of(draft, quad.part), n[id]);
  }
  if (with_points)
    for (const PointMass& point : draft.mesh.masses) add(point.mass, draft.mesh.nodes[point.node]);
  if (total.mass == 0) return total;
  total.com = first / total.mass;
  const Mat3 central = second - total.mass * total.com * total.com.transpose();
  total.about_com = central.trace() * Mat3::Identity() - central;
  return total;
}

void trim_head(ModelDraft& draft, const std::vector<int>& head_parts,
               const std::vector<int>& skull_nodes, double mass, const Vec3& moments,
               MassReport& report) {
  report.target_mass = mass;
  report.target_moments = moments;
  PartSpec& face = draft.part(part::kFace);
  const double face_volume = inertia_of(draft, {part::kFace}, false).mass / face.density;
  const Inertia before = inertia_of(draft, head_parts, false);
  // The face only gives mass away: what is missing serves the moments better further out.
  const double surplus = std::max(0.0, before.mass - mass);
  face.density = std::max(kFaceDensityMin, face.density - surplus / face_volume);
  report.face_density = face.density;
  const Inertia head = inertia_of(draft, head_parts, false);
  const double missing = mass - head.mass;
  if (missing <= 0) return;
  // Pair mass m at both ends of axis i adds 2 m r^2 to the two other moments.
  std::array<std::vector<int>, 6> patch;
  Eigen::Matrix<double, 4, 3> A = Eigen::Matrix<double, 4, 3>::Zero();
  Eigen::Vector4d b;
  const double length2 = 0.075 * 0.075;  // makes mass and moments comparable
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      const Vec3 reach = (end == 0 ? -0.12 : 0.12) * Vec3::Unit(axis);
      auto& nodes = patch[2 * axis + end];
      nodes = nearest(draft.mesh, skull_nodes, head.com + reach);
      for (const int id : nodes) {
        const Vec3 r = draft.mesh.nodes[id] - head.com;
        const double share = 1.0 / static_cast<double>(nodes.size());
        for (int moment = 0; moment < 3; ++moment)
          A(moment, axis) += share * (r.squaredNorm() - r[moment] * r[moment]) / length2;
      }
    }
    A(3, axis) = 2 * kMassWeight;
    b[axis] = (moments[axis] - head.about_com(axis, axis)) / length2;
  }
  b[3] = kMassWeight * missing;
  const Vec3 pair = fit_pair_masses(A, b);
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end)
      for (const int id : patch[2 * axis + end]) {
        const double m = pair[axis] / static_cast<double>(patch[2 * axis + end].size());
        if (m > 0) draft.mesh.masses.push_back({id, m});
        report.added_mass += m;
      }
}

const MassRow& MassReport::row(const std::string& name) const {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const MassRow& r) { return r.name == name; });
  CW_ASSERT(found != rows.end());
  return *found;
}

std::string MassReport::text() const {
  std::string out =
      "part        mass kg    centre x, y, z mm        Ixx, Iyy, Izz about it, kg m2   Ixz\n";
  for (const MassRow& row : rows) {
    const Inertia& i = row.inertia;
    const Vec3 c = 1e3 * i.com;
    out +=
        fmt::format("{:<10} {:8.3f}  {:8.1f} {:6.1f} {:7.1f}    {:9.5f} {:9.5f} {:9.5f} {:9.5f}\n",
                    row.name, i.mass, c.x(), c.y(), c.z(), i.about_com(0, 0), i.about_com(1, 1),
                    i.about_com(2, 2), i.about_com(0, 2));
  }
  if (target_mass > 0) {
    const Inertia& head = row("head").inertia;
    out += fmt::format("{:<10} {:8.3f}  {:26}{:9.5f} {:9.5f} {:9.5f}\n", "target", target_mass, "",
                       target_moments.x(), target_moments.y(), target_moments.z());
    out += fmt::format("{:<10} {:8.3f}  {:26}{:9.3f} {:9.3f} {:9.3f}\n", "head / it",
                       head.mass / target_mass, "", head.about_com(0, 0) / target_moments.x(),
                       head.about_com(1, 1) / target_moments.y(),
                       head.about_com(2, 2) / target_moments.z());
  }
  out +=
      fmt::format("face density {:.0f} kg/m3, flesh density {:.0f} kg/m3, trim masses {:.3f} kg\n",
                  face_density, flesh_density, added_mass);
  out +=
      "[yu2020, Table A1]: THUMS head-neck 5.66 kg, 0.015126 0.017991 0.010557 kg m2 (fits a head "
      "alone about its\n own centre); scaled TNO head and neck 6.21, 6.39, 6.30 kg (V2370, V2371, "
      "V2374)\n";
  return out;
}

}  // namespace crosswalk::fe::generate
