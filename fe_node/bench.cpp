#include "fe_node/bench.h"

#include <array>
#include <chrono>
#include <cmath>
#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include "common/error.h"
#include "common/units.h"
#include "fe_node/element/hex8.h"
#include "fe_node/generate/primitives.h"
#include "fe_node/mesh/node_order.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Flops of a one-point brick step counted in hex8_kernel.h (a multiply-add as two), and bytes it
/// moves: 8 node records, 8 corner forces written and read, undeformed shape, connectivity.
constexpr double kFlopsPerHex = 1150, kBytesPerHex = 8 * 64 + 2 * 8 * 32 + 344 + 32;

/// Processor time of all threads so far, s: what a machine shared with other work really gave.
double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Multiply-adds on independent registers, flop per processor second, all threads at once.
double fma_rate(int threads) {
  constexpr int kChains = 16;
  constexpr long kRounds = 4'000'000;
  double total = 0;
  const double start = processor_time();
#pragma omp parallel num_threads(threads) reduction(+ : total)
  {
    std::array<Lanes, kChains> a;
    for (int i = 0; i < kChains; ++i) a[i].setConstant(1e-3 * i);
    const Lanes x = Lanes::Constant(0.999999), y = Lanes::Constant(1e-9);
    for (long round = 0; round < kRounds; ++round)
      for (Lanes& chain : a) chain = chain * x + y;
    for (const Lanes& chain : a) total += chain.sum();
  }
  const double rate =
      2.0 * kChains * kLanes * static_cast<double>(kRounds) * threads / (processor_time() - start);
  return total > -1 ? rate : 0;  // keeps the sums alive
}

/// Renumbers in Hilbert order; elements by their first node.
Mesh ordered(const Mesh& mesh) {
  Mesh out;
  const std::vector<int> order = hilbert_order(mesh.position);
  std::vector<int> now(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    now[order[n]] = static_cast<int>(n);
    out.position.push_back(mesh.position[order[n]]);
    out.node_id.push_back(mesh.node_id[order[n]]);
  }
  out.parts = mesh.parts;
  const ElementTable& table = mesh.table(ElementKind::Hex8);
  std::vector<std::pair<int, int>> by_first;
  for (int e = 0; e < table.size(); ++e) {
    int first = now[table.nodes[e * 8]];
    for (int k = 1; k < 8; ++k) first = std::min(first, now[table.nodes[e * 8 + k]]);
    by_first.emplace_back(first, e);
  }
  std::sort(by_first.begin(), by_first.end());
  ElementTable& target = out.table(ElementKind::Hex8);
  for (const auto& [first, e] : by_first) {
    for (int k = 0; k < 8; ++k) target.nodes.push_back(now[table.nodes[e * 8 + k]]);
    target.part.push_back(table.part[e]);
    target.id.push_back(table.id[e]);
  }
  return out;
}

std::vector<int> elements_of(const Mesh& mesh, int part) {
  std::vector<int> elements;
  const ElementTable& table = mesh.table(ElementKind::Hex8);
  for (int e = 0; e < table.size(); ++e)
    if (table.part[e] == part) elements.push_back(e);
  return elements;
}

/// A: block of 1 mm steel bricks, one face held, a smooth initial velocity of 1 m/s.
Model steel_block(std::array<int, 3> cells) {
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
  model.mesh = ordered(mesh);
  model.blocks.push_back(make_hex8_block(model.mesh, 0, elements_of(model.mesh, 0),
                                         Elastic::from_young(7850, 210e9, 0.3),
                                         {HourglassForm::Viscous, 0.1}));
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

/// B: brain in a skull, an ellipsoid turned by a pulse of 10 krad/s2.
Model brain_ellipsoid() {
  constexpr int kCells = 26, kBrain = 1, kSkull = 2;
  const Vec3 outer(0.085, 0.070, 0.065), inner = outer - Vec3::Constant(0.006);
  generate::MeshDraft draft;
  const generate::CubedSphere sphere(kCells);
  const std::vector<int> surface = generate::add_ball(
      draft, sphere, [&](const Vec3& p) { return Vec3(p.cwiseProduct(inner)); },
      [](const Vec3&) { return kBrain; });
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
  model.mesh = ordered(mesh);
  model.blocks.push_back(
      make_hex8_block(model.mesh, 0, elements_of(model.mesh, 0),
                      Viscoelastic::from_single_term(1040, 2.19e9, 6e3, 1.2e3, 80), {}));
  model.blocks.push_back(make_hex8_block(model.mesh, 1, elements_of(model.mesh, 1),
                                         Elastic::from_young(1700, 6.5e9, 0.22), {}));
  for (int n = 0; n < model.mesh.node_count(); ++n)
    model.start_velocities.push_back({{n}, Vec3(0, 0, 30).cross(model.mesh.position[n])});
  model.finish();
  return model;
}

Model workload(const std::string& name) {
  if (name == "A20k") return steel_block({28, 28, 26});
  if (name == "A") return steel_block({50, 50, 40});
  if (name == "A500k") return steel_block({80, 80, 79});
  if (name == "B") return brain_ellipsoid();
  throw UserError(Problem{{}, "workload", "A20k, A, A500k or B", name, {}});
}

struct Measurement {
  std::string workload;
  int threads = 1, elements = 0, nodes = 0, steps = 0;
  double seconds = 0;            ///< elapsed
  double processor_seconds = 0;  ///< of all threads
  double fma_rate = 0;           ///< flop per processor second
  double energy_error = 0;
  double work() const { return static_cast<double>(elements) * steps; }
  double rate() const { return work() / seconds; }
  double processor_rate() const { return work() / processor_seconds; }
};

Measurement measure(const std::string& name, const Model& model, int threads) {
  Measurement m{name, threads, 0, model.mesh.node_count(), 0, 0, 0, fma_rate(threads), 0};
  for (const auto& block : model.blocks) m.elements += block->element_count();
  State state = initial_state(model);
  Scratch scratch(model, threads);
  const double dt = 0.9 * initial_stable_step(model);
  for (int i = 0; i < 5; ++i) advance_step(model, state, scratch, dt);
  constexpr double kLeastTime = 1.0;
  const Clock::time_point start = Clock::now();
  const double processor_start = processor_time();
  do {
    for (int i = 0; i < 5; ++i) advance_step(model, state, scratch, dt);
    m.steps += 5;
    m.seconds = seconds_since(start);
    m.processor_seconds = processor_time() - processor_start;
  } while (m.seconds < kLeastTime);
  m.energy_error = state.energies.balance_error();
  return m;
}

std::string table_of(const std::vector<Measurement>& measurements) {
  std::string text =
      "                           million element-steps per\n"
      "workload  elements  threads  second  core second  GB/s  of FMA rate  energy error\n";
  for (const Measurement& m : measurements)
    text += fmt::format("{:8}{:10}{:9}{:8.2f}{:13.2f}{:6.1f}{:11.1f} %{:13.1e}\n", m.workload,
                        m.elements, m.threads, 1e-6 * m.rate(), 1e-6 * m.processor_rate(),
                        1e-9 * kBytesPerHex * m.rate(),
                        100 * kFlopsPerHex * m.processor_rate() / m.fma_rate, m.energy_error);
  return text + fmt::format(
                    "FMA rate {:.1f} Gflop per core second; {} flops and {} bytes counted "
                    "per element-step\n",
                    1e-9 * measurements.back().fma_rate, kFlopsPerHex, kBytesPerHex);
}

std::string json_of(const std::vector<Measurement>& measurements) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Measurement& m : measurements)
    rows.push_back({{"workload", m.workload},
                    {"elements", m.elements},
                    {"nodes", m.nodes},
                    {"threads", m.threads},
                    {"steps", m.steps},
                    {"seconds", m.seconds},
                    {"processor_seconds", m.processor_seconds},
                    {"element_steps_per_s", m.rate()},
                    {"element_steps_per_core_s", m.processor_rate()},
                    {"bytes_per_s", kBytesPerHex * m.rate()},
                    {"flop_per_s", kFlopsPerHex * m.rate()},
                    {"fma_flop_per_core_s", m.fma_rate},
                    {"energy_balance_error", m.energy_error}});
  return nlohmann::json{{"flops_per_element_step", kFlopsPerHex},
                        {"bytes_per_element_step", kBytesPerHex},
                        {"measurements", rows}}
             .dump(2) +
         "\n";
}

}  // namespace

std::string run_bench(const BenchRequest& request) {
  std::vector<std::string> names = request.workloads;
  if (names.empty()) names = {"A20k", "A", "A500k", "B"};
  std::vector<int> threads = request.threads;
  if (threads.empty()) {
    threads = {1};
    if (omp_get_max_threads() > 1) threads.push_back(omp_get_max_threads());
  }
  std::vector<Measurement> measurements;
  for (const std::string& name : names) {
    const Model model = workload(name);
    for (int t : threads) measurements.push_back(measure(name, model, t));
  }
  return request.json ? json_of(measurements) : table_of(measurements);
}

}  // namespace crosswalk::fe
