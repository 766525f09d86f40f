#include "fe_node/bench_workloads.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/error.h"
#include "fe_node/contact/rigid_surface.h"
#include "fe_node/element/hex8.h"
#include "fe_node/element/hex8_full.h"
#include "fe_node/element/shell.h"
#include "fe_node/generate/head_neck.h"
#include "fe_node/generate/primitives.h"
#include "fe_node/generate/windshield.h"
#include "fe_node/mesh/node_order.h"
#include "fe_node/model_builder/model_builder.h"
#include "fe_node/own_head.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

/// Counted in the kernels, that of eight points by sum [E]; the mixed model counts as one-point
/// bricks [E].
constexpr double kFlopsPerElasticHex = 1150, kFlopsPerViscoelasticHex = 1400,
                 kFlopsPerFullViscoelasticHex = 7000, kFlopsPerPlasticShell = 1500;

/// Renumbers in Hilbert order; elements by their first node.
Mesh ordered(const Mesh& mesh, ElementKind kind) {
  Mesh out;
  const int corners = corner_count(kind);
  const std::vector<int> order = hilbert_order(mesh.position);
  std::vector<int> now(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    now[order[n]] = static_cast<int>(n);
    out.position.push_back(mesh.position[order[n]]);
    out.node_id.push_back(mesh.node_id[order[n]]);
  }
  out.parts = mesh.parts;
  const ElementTable& table = mesh.table(kind);
  std::vector<std::pair<int, int>> by_first;
  for (int e = 0; e < table.size(); ++e) {
    int first = now[table.nodes[e * corners]];
    for (int k = 1; k < corners; ++k) first = std::min(first, now[table.nodes[e * corners + k]]);
    by_first.emplace_back(first, e);
  }
  std::sort(by_first.begin(), by_first.end());
  ElementTable& target = out.table(kind);
  for (const auto& [first, e] : by_first) {
    for (int k = 0; k < corners; ++k) target.nodes.push_back(now[table.nodes[e * corners + k]]);
    target.part.push_back(table.part[e]);
    target.id.push_back(table.id[e]);
  }
  return out;
}

std::vector<int> elements_of(const Mesh& mesh, ElementKind kind, int part) {
  std::vector<int> elements;
  const ElementTable& table = mesh.table(kind);
  for (int e = 0; e < table.size(); ++e)
    if (table.part[e] == part) elements.push_back(e);
  return elements;
}

/// A: block of 1 mm steel bricks, one face held, a smooth initial velocity of 1 m/s.
Model steel_block(std::array<int, 3> cells, Precision precision) {
  Mesh mesh;
  const auto node = [&](int i, int j, int k) {
    return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i;
  };
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) {
        mesh.position.push_back(1e-3 * Vec3(i, j, k));
        mesh.node_id.emplace_back(mesh.node_count());
      }
  ElementTable& table = mesh.table(ElementKind::Hex8);
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        for (int z : {k, k + 1})
          table.nodes.insert(table.nodes.end(), {node(i, j, z), node(i + 1, j, z),
                                                 node(i + 1, j + 1, z), node(i, j + 1, z)});
        table.part.push_back(0);
        table.id.emplace_back(table.size());
      }
  mesh.parts.push_back({DeckId(1), "steel", false});
  Model model;
  model.mesh = ordered(mesh, ElementKind::Hex8);
  model.blocks.push_back(make_hex8_block(
      model.mesh, 0, elements_of(model.mesh, ElementKind::Hex8, 0),
      Elastic::from_young(7850, 210e9, 0.3),
      {.hourglass = HourglassForm::Viscous, .hourglass_coefficient = 0.1, .precision = precision}));
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const Vec3& p = model.mesh.position[n];
    if (p.z() == 0)
      model.fixed.push_back({n, {true, true, true}, {}});
    else
      model.start_velocities.push_back(
          {{n}, Vec3(std::sin(60 * p.z()), std::cos(60 * p.x()), std::sin(60 * p.y()))});
  }
  model.finish();
  return model;
}

/// B: brain in a skull, an ellipsoid turned by a pulse of 10 krad/s2; Bfull: the brain of
/// eight-point bricks, as in the generated head.
Model brain_ellipsoid(bool is_full, Precision precision) {
  constexpr int kCells = 26, kBrain = 1, kSkull = 2;
  const Vec3 outer(0.085, 0.070, 0.065), inner = outer - Vec3::Constant(0.006);
  generate::MeshDraft draft;
  const generate::CubedSphere sphere(kCells);
  const std::vector<int> surface = generate::add_ball(
      draft, sphere, [&](const Vec3& p) { return Vec3(p.cwiseProduct(inner)); },
      [](const generate::BallCell&) { return kBrain; });
  generate::add_layer(
      draft, sphere, surface, [](int) { return true; },
      [&](int n) { return Vec3(sphere.direction(n).cwiseProduct(outer)); }, kSkull);
  Mesh mesh;
  for (const Vec3& p : draft.nodes) {
    mesh.position.push_back(p);
    mesh.node_id.emplace_back(mesh.node_count());
  }
  ElementTable& table = mesh.table(ElementKind::Hex8);
  for (const generate::Hex& hex : draft.hexes) {
    table.nodes.insert(table.nodes.end(), hex.node.begin(), hex.node.end());
    table.part.push_back(hex.part - 1);
    table.id.emplace_back(table.size());
  }
  mesh.parts = {{DeckId(1), "brain", false}, {DeckId(2), "skull", false}};
  Model model;
  model.mesh = ordered(mesh, ElementKind::Hex8);
  const auto make_brain = is_full ? make_full_hex8_block : make_hex8_block;
  model.blocks.push_back(make_brain(model.mesh, 0, elements_of(model.mesh, ElementKind::Hex8, 0),
                                    Viscoelastic::from_single_term(1040, 2.19e9, 6e3, 1.2e3, 80),
                                    {.precision = precision}));
  model.blocks.push_back(
      make_hex8_block(model.mesh, 1, elements_of(model.mesh, ElementKind::Hex8, 1),
                      Elastic::from_young(1700, 6.5e9, 0.22), {.precision = precision}));
  for (int n = 0; n < model.mesh.node_count(); ++n)
    model.start_velocities.push_back({{n}, Vec3(0, 0, 30).cross(model.mesh.position[n])});
  model.finish();
  return model;
}

/// C: pane of 1.45 x 1.00 m in 5 mm shells, its edges held across, a sphere of 4.5 kg just above
/// it.
Model struck_pane(Precision precision) {
  constexpr int kX = 290, kY = 200;
  constexpr double kCell = 0.005, kRadius = 0.0825, kMass = 4.5;
  Mesh mesh;
  for (int j = 0; j <= kY; ++j)
    for (int i = 0; i <= kX; ++i) {
      mesh.position.push_back(kCell * Vec3(i - kX / 2, j - kY / 2, 0));
      mesh.node_id.emplace_back(mesh.node_count());
    }
  ElementTable& table = mesh.table(ElementKind::Quad4);
  for (int j = 0; j < kY; ++j)
    for (int i = 0; i < kX; ++i) {
      const int n = j * (kX + 1) + i;
      table.nodes.insert(table.nodes.end(), {n, n + 1, n + kX + 2, n + kX + 1});
      table.part.push_back(0);
      table.id.emplace_back(table.size());
    }
  mesh.parts.push_back({DeckId(1), "pane", false});
  Model model;
  model.mesh = ordered(mesh, ElementKind::Quad4);
  ShellPlastic steel;
  steel.density = 7850;
  steel.youngs_modulus = 210e9;
  steel.poisson_ratio = 0.3;
  steel.yield = YieldStress(HardeningCurve::linear(180e6, 1e9));
  model.blocks.push_back(make_shell_block(
      model.mesh, ElementKind::Quad4, 0, elements_of(model.mesh, ElementKind::Quad4, 0),
      uniform_section(steel, 1e-3, 5), {.precision = precision}));
  RigidSurfaceSpec contact;
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const Vec3& p = model.mesh.position[n];
    contact.nodes.push_back(n);
    if (std::abs(p.x()) > (kX / 2 - 0.5) * kCell || std::abs(p.y()) > (kY / 2 - 0.5) * kCell)
      model.fixed.push_back({n, {true, true, true}, {}});
  }
  RigidBody sphere;
  sphere.name = "sphere";
  sphere.own = Inertia{kMass, Vec3(0, 0, kRadius + 1e-4),
                       0.4 * kMass * kRadius * kRadius * Mat3::Identity()};
  model.bodies.push_back(sphere);
  contact.name = "sphere and pane";
  contact.patches.push_back({"sphere", {RigidEllipsoid{{}, Vec3::Constant(kRadius)}}, {}});
  contact.patches[0].law = PenaltyLaw{0.1, 0.9 * initial_stable_step(model), 0.1};
  contact.friction = 0.3;
  model.contacts.push_back(make_rigid_surface_contact(std::move(contact)));
  model.finish();
  return model;
}

/// D: the head and neck of the coupled model at `medium`; its torso blocks are driven.
Workload head_and_neck(bool has_pane, Precision precision) {
  generate::HeadNeckSpec spec;
  spec.fidelity = generate::Fidelity::Medium;
  Deck deck = generate::generate_head_neck(spec);
  BuildOptions options;
  options.driven_parts = {"block_torso_up", "block_clavicle_l", "block_clavicle_r"};
  options.mass_scaling_step = 0;
  options.precision = precision;
  if (has_pane) {
    for (const DeckNode& node : deck.nodes)
      options.last_nodes_from = std::max(options.last_nodes_from, node.id.value + 1);
    generate::WindshieldSpec pane;
    pane.cell = 0.005;
    generate::join_windshield(deck, pane, kHeadSurface, 0.3);
    options.driven_parts.push_back(generate::kWindshieldFrame);
  }
  BuiltModel built = build_model(deck, options);
  finish_model(built);
  Workload work;
  work.flops_per_element = kFlopsPerViscoelasticHex;
  Model& model = built.model;
  if (has_pane) {
    const auto& pane = built.part_sets[built.part_set(generate::kWindshieldParts)].second;
    const auto frame = std::find_if(model.bodies.begin(), model.bodies.end(), [](const auto& b) {
      return b.name == generate::kWindshieldFrame;
    });
    model.sleeper = make_sleeper(model, pane, static_cast<int>(frame - model.bodies.begin()),
                                 generate::kWindshieldContact);
    model.sleeper->X_BD.p = -frame->origin;
  }
  for (std::size_t b = 0; b < model.blocks.size(); ++b)
    if (!model.sleeper || !model.sleeper->blocks[b])
      work.elements += model.blocks[b]->element_count();
  work.start = initial_state(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].name == "block_torso_up") work.start.bodies[b].V_WB.v = {2, 0, 0};
  work.model = std::move(model);
  return work;
}

Workload of_model(Model model, double flops_per_element) {
  Workload work;
  work.start = initial_state(model);
  for (const auto& block : model.blocks) work.elements += block->element_count();
  work.model = std::move(model);
  work.flops_per_element = flops_per_element;
  return work;
}

}  // namespace

std::vector<std::string> workload_names() {
  return {"A20k", "A", "A500k", "B", "Bfull", "C", "D", "Dpane"};
}

Workload make_workload(std::string_view name, Precision precision) {
  if (name == "A20k") return of_model(steel_block({28, 28, 26}, precision), kFlopsPerElasticHex);
  if (name == "A") return of_model(steel_block({50, 50, 40}, precision), kFlopsPerElasticHex);
  if (name == "A500k") return of_model(steel_block({80, 80, 79}, precision), kFlopsPerElasticHex);
  if (name == "B") return of_model(brain_ellipsoid(false, precision), kFlopsPerViscoelasticHex);
  if (name == "Bfull")
    return of_model(brain_ellipsoid(true, precision), kFlopsPerFullViscoelasticHex);
  if (name == "C") {
    Workload work = of_model(struck_pane(precision), kFlopsPerPlasticShell);
    work.start.bodies[0].V_WB.v = {0, 0, -11.1};
    return work;
  }
  if (name == "D") return head_and_neck(false, precision);
  if (name == "Dpane") return head_and_neck(true, precision);
  throw UserError(Problem{{},
                          "workload",
                          fmt::format("one of {}", fmt::join(workload_names(), " ")),
                          std::string(name),
                          {}});
}

}  // namespace crosswalk::fe
