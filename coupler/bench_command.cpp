#include "coupler/bench_command.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <numeric>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/interrupt.h"
#include "common/lcm_transport.h"
#include "common/participant.h"
#include "common/version.h"
#include "coupler/coupler.h"
#include "coupler/lcm_link.h"

extern char** environ;

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

struct BenchRequest {
  std::string what, part, url, run_id;
  fs::path scenario;
  int windows = 4000;
};

constexpr const char* kScenario =
    "[run]\nname = \"bench\"\nduration_ms = 1.0\n[[interfaces]]\nbody = \"block\"\n";
constexpr int kWarmUp = 200;  // exchanges before the clock counts
constexpr std::int64_t kWindowNs = 20000;

std::vector<InterfaceBody> one_body() {
  std::vector<InterfaceBody> bodies(1);
  bodies[0].name = "block";
  bodies[0].is_attached = true;
  bodies[0].block.mass = 1;
  return bodies;
}

/// A body at rest.
class EmptyMb : public MbParticipant {
 public:
  std::vector<InterfaceBody> interface_bodies() const override { return one_body(); }
  void attach(const std::vector<InterfaceBody>&) override {}
  MbReply advance(const MbGrant& grant, RecordSink&) override {
    MbReply reply;
    reply.first_contact = true;
    reply.bodies.resize(1);
    if (grant.want_mobility) reply.mobility = Eigen::MatrixXd::Identity(6, 6);
    return reply;
  }
  std::string description() const override { return R"({"bodies":["block"]})"; }
  std::int64_t progress() const override { return 0; }
  std::vector<std::byte> save_state() const override { return {}; }
  void load_state(const std::vector<std::byte>&) override {}
};

class EmptyFe : public FeParticipant {
 public:
  std::vector<InterfaceBody> interface_bodies() const override { return one_body(); }
  std::vector<InterfaceBody> place(std::vector<InterfaceBody> bodies) override {
    bodies[0].block.mass = 1;
    return bodies;
  }
  FeReply advance(const FeGrant&, RecordSink&) override {
    FeReply reply;
    reply.loads.resize(1);
    return reply;
  }
  std::string description() const override { return R"({"regions":[]})"; }
  std::int64_t progress() const override { return 0; }
  std::vector<std::byte> save_state() const override { return {}; }
  void load_state(const std::vector<std::byte>&) override {}
};

/// A process of the benchmark, ended with it.
class Child {
 public:
  explicit Child(std::vector<std::string> words) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    if (posix_spawn(&pid_, argv[0], nullptr, nullptr, argv.data(), environ) != 0)
      throw UserError(Problem{Place{words.front()}, "cannot be started", {}, {}, {}});
  }
  ~Child() {
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

 private:
  pid_t pid_ = -1;
};

std::int64_t scenario_digest(const fs::path& file) {
  ConfigDocument document(file);
  ignore_tables_of_others(document, "coupler");
  return static_cast<std::int64_t>(read_scenario(document).digest);
}

ExitCode serve_node(const BenchRequest& request) {
  const bool is_mb = request.part == "mb";
  Bus bus(open_transport(request.url), request.run_id, is_mb ? Role::Mb : Role::Fe);
  const NodeIdentity identity{.scenario_digest = scenario_digest(request.scenario),
                              .version = version_text(),
                              .bodies = {"block"},
                              .n_attached = 1};
  if (is_mb) {
    EmptyMb mb;
    return MbSession(bus, mb, identity, {}).run(interrupt_flag());
  }
  EmptyFe fe;
  return FeSession(bus, fe, identity, {}).run(interrupt_flag());
}

/// Answers every message on TO_<part> with as many bytes as a node would.
ExitCode serve_echo(const BenchRequest& request) {
  const bool is_mb = request.part == "echo_mb";
  const int size = is_mb ? msg::mb_done{}.getEncodedSize() : msg::fe_done{}.getEncodedSize();
  const std::vector<std::byte> answer(static_cast<std::size_t>(size));
  const auto transport = plain_lcm_transport(request.url);
  transport->subscribe(is_mb ? "TO_MB" : "TO_FE",
                       [&](const std::string&, std::span<const std::byte>, std::int64_t) {
                         transport->publish(is_mb ? "FROM_MB" : "FROM_FE", answer);
                       });
  while (!is_interrupted()) transport->handle(100);
  return ExitCode::Done;
}

/// Times of the bare exchange of `n` windows, s.
std::vector<double> bare_exchanges(const std::string& url, int n) {
  const auto transport = plain_lcm_transport(url);
  int answers = 0;
  transport->subscribe(
      "FROM_.*", [&](const std::string&, std::span<const std::byte>, std::int64_t) { ++answers; });
  const std::vector<std::byte> to_mb(static_cast<std::size_t>(msg::step_to_mb{}.getEncodedSize())),
      to_fe(static_cast<std::size_t>(msg::step_to_fe{}.getEncodedSize()));
  const auto exchange = [&](const char* channel, const std::vector<std::byte>& bytes) {
    const int before = answers;
    do {
      transport->publish(channel, bytes);
      transport->handle(100);  // lost, or nobody there yet: again
    } while (answers == before && !is_interrupted());
  };
  std::vector<double> times;
  for (int i = -kWarmUp; i < n && !is_interrupted(); ++i) {
    const auto begin = Clock::now();
    exchange("TO_MB", to_mb);
    exchange("TO_FE", to_fe);
    if (i >= 0) times.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return times;
}

/// Times of `n` empty windows under the real coupler and recorder, s.
std::vector<double> empty_windows(const BenchRequest& request, std::int64_t digest, int n) {
  using namespace coupling;
  Bus bus(open_transport(request.url), request.run_id, Role::Coupler);
  CouplerSettings settings;
  settings.duration_ns = kWindowNs * (n + kWarmUp);
  settings.window_ns = kWindowNs;
  Hub hub(bus,
          {.scenario_name = "bench",
           .scenario_digest = digest,
           .version = version_text(),
           .window_ns = settings.window_ns,
           .duration_ns = settings.duration_ns},
          Patience{.join_s = 30}, interrupt_flag(), [](EventLevel, const std::string&) {});
  hub.claim();
  const std::vector<InterfaceBody> bodies = hub.gather();
  settings.scheme.n_attached = hub.n_attached();
  LcmMbLink mb(hub);
  LcmFeLink fe(hub, mb);
  std::vector<double> times;
  auto last = Clock::now();
  Coupler coupler(settings, mb, &fe, &hub.records(),
                  {.before_window =
                       [&](std::int64_t window) {
                         hub.set_window(window);
                         hub.follow_recorder(window);
                       },
                   .after_window =
                       [&](std::int64_t next) {
                         const auto now = Clock::now();
                         if (next > kWarmUp)
                           times.push_back(std::chrono::duration<double>(now - last).count());
                         last = now;
                       }});
  hub.start();
  coupler.run(bodies);
  hub.finish(coupler.state().window - 1);
  return times;
}

void print_row(const char* what, std::vector<double>& times) {
  std::sort(times.begin(), times.end());
  const auto part = [&](double p) {
    return 1e6 * times[static_cast<std::size_t>(p * static_cast<double>(times.size() - 1))];
  };
  const double mean =
      1e6 * std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
  fmt::print("{:<46}{:>8.1f}{:>8.1f}{:>8.1f}\n", what, part(0.5), mean, part(0.99));
}

ExitCode measure(BenchRequest request) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("crosswalk_bench_{}", getpid());
  fs::create_directories(folder);
  request.scenario = folder / "scenario.toml";
  std::ofstream(request.scenario) << kScenario;
  request.run_id = fmt::format("bench-{}", getpid());
  request.url = default_lcm_url(request.run_id);
  const std::string bare_url = default_lcm_url(request.run_id + "-bare");
  const fs::path self = fs::read_symlink("/proc/self/exe");
  const auto part = [&](const char* name, const std::string& url) {
    return std::vector<std::string>{self.string(),
                                    "bench",
                                    "coupling",
                                    "--as",
                                    name,
                                    "--url",
                                    url,
                                    "--run-id",
                                    request.run_id,
                                    "--scenario",
                                    request.scenario.string()};
  };
  std::vector<double> bare, windows;
  const auto add_bare = [&] {
    const Child mb(part("echo_mb", bare_url)), fe(part("echo_fe", bare_url));
    const std::vector<double> times = bare_exchanges(bare_url, request.windows / 2);
    bare.insert(bare.end(), times.begin(), times.end());
  };
  add_bare();  // half before and half after, as other load may change
  {
    const Child mb(part("mb", request.url)), fe(part("fe", request.url));
    const Child recorder({(self.parent_path() / "recorder").string(), "run", "--scenario",
                          request.scenario.string(), "--run-id", request.run_id, "--url",
                          request.url, "--out", (folder / "run").string()});
    windows = empty_windows(request, scenario_digest(request.scenario), request.windows);
  }
  add_bare();
  fs::remove_all(folder);
  fmt::print("{} windows, {} processors\n{:<46}{:>8}{:>8}{:>8}\n", windows.size(),
             sysconf(_SC_NPROCESSORS_ONLN), "microseconds", "median", "mean", "99 %");
  print_row("bare LCM: to mb and back, to fe and back", bare);
  print_row("empty window, four processes, all recorded", windows);
  fmt::print("ratio of the medians {:.2f}\n", windows[windows.size() / 2] / bare[bare.size() / 2]);
  return ExitCode::Done;
}

ExitCode bench(const BenchRequest& request) {
  catch_interrupts();
  if (request.part.starts_with("echo")) return serve_echo(request);
  if (!request.part.empty()) return serve_node(request);
  return measure(request);
}

}  // namespace

NodeCommand bench_command() {
  return {.name = "bench",
          .purpose = "Cost of a coupling window whose solvers do nothing: `bench coupling`.",
          .define = [](CLI::App& app) -> std::function<ExitCode()> {
            auto request = std::make_shared<BenchRequest>();
            app.add_option("what", request->what, "coupling")
                ->required()
                ->check(CLI::IsMember({"coupling"}));
            app.add_option("--windows", request->windows, "Windows timed")
                ->capture_default_str()
                ->check(CLI::Range(100, 1000000));
            // How the benchmark starts its own processes.
            const std::string own;
            app.add_option("--as", request->part)->group(own);
            app.add_option("--url", request->url)->group(own);
            app.add_option("--run-id", request->run_id)->group(own);
            app.add_option("--scenario", request->scenario)->group(own);
            return [request] { return bench(*request); };
          }};
}

}  // namespace crosswalk
