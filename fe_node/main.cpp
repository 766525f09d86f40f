// fe_node: the finite-element head and neck. `fe_node run --scenario FILE --run-id ID`
#include <cstdlib>

#include <omp.h>
#include <unistd.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include "common/node_main.h"
#include "common/solver_node.h"
#include "fe_node/commands.h"
#include "fe_node/fe_config.h"
#include "fe_node/fe_node.h"
#include "fe_node/own_head.h"

namespace {

/// Two settings of the runtime, which reads them before main(); hence the program starts itself
/// once more. A user's own are kept.
///
/// Waiting threads of OpenMP spin for long by default, which starves the other processes of a
/// coupled run and, on a busy machine, the solver's own threads. For 1 ms of v2370 on two busy
/// cores it took 12 s with 20000 spins, 3.3 s with 300 and 1.4 s without.
///
/// Nodes, shapes and histories of a medium head fill some 50 MB; in pages of 2 MB a step takes 7 %
/// less than in pages of 4 kB.
void settle_runtime(char** argv) {
  if (std::getenv("CROSSWALK_RUNTIME_SETTLED") != nullptr) return;
  setenv("CROSSWALK_RUNTIME_SETTLED", "1", 1);
  if (std::getenv("GOMP_SPINCOUNT") == nullptr) setenv("OMP_WAIT_POLICY", "passive", 0);
  setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", 0);
  execv("/proc/self/exe", argv);
}

/// Numbers below the smallest normal one (1e-38 in single precision) count as zero, in this thread
/// and those it starts: on some processors each costs a hundred cycles, and a pane just touched is
/// full of them.
void flush_denormal_numbers() {
#ifdef __SSE__
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  using namespace crosswalk;
  settle_runtime(argv);
  flush_denormal_numbers();
  return node_main(
      argc, argv,
      {.name = "fe_node",
       .purpose = "computes the finite-element head and neck",
       .read =
           [](ConfigDocument& document, const Scenario& scenario) {
             const fe::FeConfig config = fe::read_fe_config(document, scenario);
             if (!config.head_neck.deck.empty()) fe::read_own_deck(config);
           },
       .run =
           [](RunContext& context) {
             fe::FeConfig config = fe::read_fe_config(context.document, context.scenario);
             context.document.finish();
             fe::FeNode node(std::move(config), omp_get_max_threads(), context.directory.root());
             return run_fe_node(context, node);
           },
       .check_file = fe::check_command,
       .commands = {fe::solve_command(), fe::validate_command(), fe::model_command(),
                    fe::bench_command()}});
}
