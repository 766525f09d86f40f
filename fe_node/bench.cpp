#include "fe_node/bench.h"

#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include "fe_node/bench_workloads.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

/// Processor time of all threads so far, s: what a machine shared with other work really gave.
double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Multiply-adds on independent registers of N, flop per processor second, all threads at once.
template <class N>
double fma_rate(int threads) {
  constexpr int kChains = 10;  // latency times units, within the registers
  constexpr long kRounds = 4'000'000;
  double total = 0;
  const double start = processor_time();
#pragma omp parallel num_threads(threads) reduction(+ : total)
  {
    std::array<N, kChains> a;
    for (int i = 0; i < kChains; ++i) a[i] = constant<N>(1e-3 * i);
    const N x = constant<N>(0.999), y = constant<N>(1e-3);
    for (long round = 0; round < kRounds; ++round)
      for (N& chain : a) chain = chain * x + y;
    for (const N& chain : a) total += sum(chain);
  }
  const double rate = 2.0 * kChains * kWidth<N> * static_cast<double>(kRounds) * threads /
                      (processor_time() - start);
  return total > -1 ? rate : 0;  // keeps the sums alive
}

/// Copies two arrays of 128 MB into a third, bytes per processor second, all threads at once.
double memory_rate(int threads) {
  constexpr long kCount = 16L << 20;
  constexpr int kRounds = 4;
  std::vector<double> a(kCount, 1), b(kCount, 2), c(kCount, 3);
  double start = 0;
  for (int round = 0; round <= kRounds; ++round) {  // the first one only brings the pages in
    if (round == 1) start = processor_time();
#pragma omp parallel for schedule(static) num_threads(threads)
    for (long i = 0; i < kCount; ++i) c[i] = a[i] + 1e-3 * b[i];
  }
  return kRounds * 3.0 * 8.0 * kCount / (processor_time() - start);
}

/// Bytes that a step must bring through the core per element, from whatever cache: node records of
/// its corners, its history in and out, undeformed shape and connectivity, its share of force rows
/// and of the nodes' own update.
double bytes_per_element(const Workload& work, Precision precision) {
  const Model& model = work.model;
  const double shape = precision == Precision::Double ? 332 : 166;
  double bytes = 0;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (model.sleeper && model.sleeper->blocks[b]) continue;
    const ElementBlock& block = *model.blocks[b];
    const bool is_brick = block.kind() == ElementKind::Hex8;
    bytes += block.element_count() *
             (block.corners() * (64 + 4 + 2 + (block.has_moments() ? 24 : 0)) +
              16.0 * block.history_per_group() / kLanes + (is_brick ? shape : 16.0));
  }
  const std::size_t rows = model.tiles.force_row_count + model.tiles.moment_row_count;
  const int nodes = awake_node_count(model, work.start);
  bytes += 2 * 32.0 * static_cast<double>(rows) + nodes * (2 * 64 + 2 * 24 + 8.0);
  return bytes / work.elements;
}

struct Measurement {
  std::string workload;
  int threads = 1, elements = 0, nodes = 0, steps = 0;
  double seconds = 0;            ///< elapsed
  double processor_seconds = 0;  ///< of all threads
  double flops = 0, bytes = 0;   ///< per element-step
  double fma_rate = 0;           ///< flop per processor second
  double memory_rate = 0;        ///< bytes per processor second
  double energy_error = 0;
  double work() const { return static_cast<double>(elements) * steps; }
  double rate() const { return work() / seconds; }
  double processor_rate() const { return work() / processor_seconds; }
  /// Of the rate that arithmetic alone or memory alone would allow, whichever is lower.
  double roofline_share() const {
    return processor_rate() * std::max(flops / fma_rate, bytes / memory_rate);
  }
};

Measurement measure(const std::string& name, const Workload& work, Precision precision,
                    int threads) {
  Measurement m;
  m.workload = name;
  m.threads = threads;
  m.elements = work.elements;
  m.nodes = awake_node_count(work.model, work.start);
  m.flops = work.flops_per_element;
  m.bytes = bytes_per_element(work, precision);
  m.fma_rate =
      precision == Precision::Double ? fma_rate<Lanes>(threads) : fma_rate<SingleLanes>(threads);
  m.memory_rate = memory_rate(threads);
  State state = work.start;
  Scratch scratch(work.model, threads);
  double dt = 0.9 * compute_forces(work.model, state, scratch).stable_step;
  state = work.start;
  const auto five_steps = [&] {
    for (int i = 0; i < 5; ++i) dt = 0.9 * advance_step(work.model, state, scratch, dt).stable_step;
  };
  five_steps();
  constexpr double kLeastTime = 1.0;  // processor seconds a thread
  const Clock::time_point start = Clock::now();
  const double processor_start = processor_time();
  do {
    five_steps();
    m.steps += 5;
    m.seconds = seconds_since(start);
    m.processor_seconds = processor_time() - processor_start;
  } while (m.processor_seconds < kLeastTime * threads);
  m.energy_error = state.energies.balance_error();
  return m;
}

/// Processor time of one thread over that of so many; waiting for others counts on neither side.
double efficiency(const std::vector<Measurement>& all, const Measurement& m) {
  for (const Measurement& one : all)
    if (one.workload == m.workload && one.threads == 1)
      return m.processor_rate() / one.processor_rate();
  return 0;
}

std::string table_of(const std::vector<Measurement>& measurements, const char* precision) {
  std::string text =
      "                           million element-steps per     of FMA   of the  thread\n"
      "workload  elements  threads  second  core second  GB/s   rate  roofline  efficiency  energy "
      "error\n";
  for (const Measurement& m : measurements)
    text +=
        fmt::format("{:8}{:10}{:9}{:8.2f}{:13.2f}{:6.1f}{:6.1f} %{:8.1f} %{:12.2f}{:14.1e}\n",
                    m.workload, m.elements, m.threads, 1e-6 * m.rate(), 1e-6 * m.processor_rate(),
                    1e-9 * m.bytes * m.rate(), 100 * m.flops * m.processor_rate() / m.fma_rate,
                    100 * m.roofline_share(), efficiency(measurements, m), m.energy_error);
  const Measurement& last = measurements.back();
  return text + fmt::format(
                    "{}, {} lanes, elements in {} precision; per core second {:.1f} Gflop of "
                    "multiply-adds, {:.1f} GB "
                    "copied in memory\n",
                    processor_name(), kLanes, precision, 1e-9 * last.fma_rate,
                    1e-9 * last.memory_rate);
}

std::string json_of(const std::vector<Measurement>& measurements, const char* precision) {
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
                    {"thread_efficiency", efficiency(measurements, m)},
                    {"flops_per_element_step", m.flops},
                    {"bytes_per_element_step", m.bytes},
                    {"bytes_per_s", m.bytes * m.rate()},
                    {"flop_per_s", m.flops * m.rate()},
                    {"fma_flop_per_core_s", m.fma_rate},
                    {"memory_bytes_per_core_s", m.memory_rate},
                    {"roofline_share", m.roofline_share()},
                    {"energy_balance_error", m.energy_error}});
  return nlohmann::json{{"processor", processor_name()},
                        {"lanes", kLanes},
                        {"precision", precision},
                        {"measurements", rows}}
             .dump(2) +
         "\n";
}

}  // namespace

std::string run_bench(const BenchRequest& request) {
  std::vector<std::string> names = request.workloads;
  if (names.empty()) names = workload_names();
  std::vector<int> threads = request.threads;
  if (threads.empty()) {
    threads = {1};
    if (omp_get_max_threads() > 1) threads.push_back(omp_get_max_threads());
  }
  std::vector<Measurement> measurements;
  for (const std::string& name : names) {
    const Workload work = make_workload(name, request.precision);
    for (int t : threads) measurements.push_back(measure(name, work, request.precision, t));
  }
  const char* precision = request.precision == Precision::Double ? "double" : "single";
  return request.json ? json_of(measurements, precision) : table_of(measurements, precision);
}

}  // namespace crosswalk::fe
