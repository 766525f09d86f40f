#include "fe_node/commands.h"

#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <omp.h>

#include "common/log.h"
#include "fe_node/bench.h"
#include "fe_node/bench_workloads.h"
#include "fe_node/deck/deck_report.h"
#include "fe_node/deck/units_guess.h"
#include "fe_node/fe_config.h"
#include "fe_node/model_builder/model_builder.h"
#include "fe_node/node_model.h"
#include "fe_node/solve.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe {
namespace {

std::string energy_table(const SolveResult& r) {
  const Energies& e = r.energies;
  const double hourglass = e.internal > 0 ? 100 * e.hourglass() / e.internal : 0.0;
  return fmt::format(
      "end              {:.6g} ms after {} steps\n"
      "kinetic energy   {:.6g} J\n"
      "internal energy  {:.6g} J\n"
      "hourglass        {:.6g} J ({:.2f} % of internal)\n"
      "bulk viscosity   {:.6g} J\n"
      "damping          {:.6g} J\n"
      "contact          {:.6g} J\n"
      "external work    {:.6g} J\n"
      "energy balance   {:+.3f} %\n"
      "added mass       {:.4g} kg of {:.6g} kg\n",
      1e3 * r.time, r.steps, e.kinetic, e.internal, e.hourglass(), hourglass, e.viscous, e.damping,
      e.contact(), e.external_work + e.interface_work, 100 * e.balance_error(), r.added_mass,
      r.total_mass);
}

void add_precision(CLI::App& options, Precision& precision) {
  static const std::map<std::string, Precision> kNames{{"double", Precision::Double},
                                                       {"single", Precision::Single}};
  options
      .add_option("--precision", precision,
                  "double or single: numbers in which elements compute; nodes are double always")
      ->transform(CLI::CheckedTransformer(kNames))
      ->default_str("double");
}

/// What `solve` and `check` have in common.
struct DeckOptions {
  std::vector<std::string> include_paths;
  std::string units;

  void define(CLI::App& options) {
    options
        .add_option("--include-path", include_paths,
                    "Folder searched for *INCLUDE files, after the decks' own; may be repeated")
        ->check(CLI::ExistingDirectory)
        ->type_size(1)
        ->allow_extra_args(false);
    options.add_option("--units", units, "Unit system, such as mm-t-s, whatever the deck states");
  }
  ReadOptions reading() const {
    ReadOptions read;
    read.include_paths.assign(include_paths.begin(), include_paths.end());
    return read;
  }
  UnitSystem unit_system() const {
    if (units.empty()) return UnitSystem::Unknown;
    const UnitSystem system = unit_system_from(units);
    if (system == UnitSystem::Unknown)
      throw UserError(Problem{{}, "--units", "m-kg-s, mm-t-s, mm-kg-ms, ...", units, {}});
    return system;
  }
};

}  // namespace

std::vector<std::string> try_model(const Deck& deck, DeckProblems& problems) {
  BuildOptions options;
  // A clear guess stands in the report already; the model builder refuses an unclear one.
  if (const UnitsGuess guess = guess_units(deck); guess.certainty == UnitsGuess::Certainty::Likely)
    options.units = guess.system;
  try {
    BuiltModel built = build_model(deck, options);
    finish_model(built);
    for (const std::string& note : built.notes) problems.warnings.add({}, note, {}, {});
    return model_summary(built.model);
  } catch (const UserError& error) {
    for (const Problem& problem : error.problems())
      problems.errors.add(problem.place, problem.what, problem.expected, problem.found,
                          problem.hint);
  }
  return {};
}

CheckFile check_command(CLI::App& options) {
  auto deck = std::make_shared<DeckOptions>();
  deck->define(options);
  return [deck](const std::filesystem::path& file) {
    const UnitSystem units = deck->unit_system();
    ReadDeck read = read_deck(file, deck->reading());
    if (units != UnitSystem::Unknown) read.deck.units = units;
    const DeckReport report = report_deck(read, file.string(), try_model);
    std::cout << report.text << std::flush;
    return report.is_sound ? ExitCode::Done : ExitCode::UserError;
  };
}

NodeCommand solve_command() {
  return {"solve", "run a keyword deck alone", [](CLI::App& options) {
            auto request = std::make_shared<SolveRequest>();
            auto deck = std::make_shared<DeckOptions>();
            auto end_ms = std::make_shared<double>(0);
            request->folder = "solve";
            options.add_option("deck", request->deck, "Keyword deck")->required();
            deck->define(options);
            options.add_option("--out", request->folder, "Folder of the results")
                ->capture_default_str();
            options.add_option("--threads", request->threads, "Threads; 0: all")
                ->check(CLI::Range(0, 256));
            options.add_option("--end-ms", *end_ms, "End time, ms; as the deck says by default")
                ->check(CLI::PositiveNumber);
            options.add_flag("--accept-missing", request->accept_missing,
                             "Run although keywords that change the physics are not understood");
            add_precision(options, request->precision);
            options.add_option("--restart", request->restart, "restart.bin to go on from");
            return [request, deck, end_ms] {
              request->end_time = 1e-3 * *end_ms;
              if (request->threads == 0) request->threads = omp_get_max_threads();
              request->units = deck->unit_system();
              request->reading = deck->reading();
              const SolveResult result = solve_deck(*request);
              std::cout << energy_table(result);
              return ExitCode::Done;
            };
          }};
}

NodeCommand validate_command() {
  return {"validate", "component tests of the finite-element models", [](CLI::App& options) {
            using generate::Fidelity;
            auto request = std::make_shared<validate::ValidateRequest>();
            const std::map<std::string, Fidelity> sizes{{"coarse", Fidelity::Coarse},
                                                        {"medium", Fidelity::Medium},
                                                        {"fine", Fidelity::Fine}};
            options.add_option("subject", request->subject, "head, neck or windshield")
                ->required()
                ->check(CLI::IsMember({"head", "neck", "windshield"}));
            options.add_option("cases", request->names, "Names of cases; all by default");
            options.add_option("--fidelity", request->fidelity, "Mesh: coarse, medium or fine")
                ->transform(CLI::CheckedTransformer(sizes));
            options.add_option("--out", request->folder,
                               "Folder of the results; runs/validate-<subject> by default");
            options.add_option("--threads", request->computing.threads, "Threads; 0: all")
                ->check(CLI::Range(0, 256));
            add_precision(options, request->computing.precision);
            std::string footer = "Cases:\n";
            for (const validate::Case& c : validate::cases())
              footer += fmt::format("  {:<10} {:<18} {}\n", c.subject, c.name, c.purpose);
            options.footer(footer);
            return [request] {
              if (request->computing.threads == 0)
                request->computing.threads = omp_get_max_threads();
              if (request->folder.empty()) request->folder = "runs/validate-" + request->subject;
              return validate::run_validation(*request) == 0 ? ExitCode::Done
                                                             : ExitCode::NumericalLimit;
            };
          }};
}

NodeCommand model_command() {
  return {
      "model", "write the generated decks of a scenario; their masses and mesh quality",
      [](CLI::App& options) {
        struct Arguments {
          std::string scenario, folder = ".", fidelity;
        };
        auto args = std::make_shared<Arguments>();
        options.add_option("scenario", args->scenario, "Name under scenarios/tests/, or a file")
            ->required();
        options.add_option("--fidelity", args->fidelity, "Mesh; as the scenario says by default")
            ->check(CLI::IsMember({"coarse", "medium", "fine"}));
        options.add_option("--out", args->folder, "Folder that gets model/")->capture_default_str();
        return [args] {
          ConfigDocument document(args->scenario);
          if (!args->fidelity.empty())
            document.override_with(fmt::format("[run]\nfidelity = \"{}\"\n", args->fidelity),
                                   "--fidelity");
          ignore_tables_of_others(document, "fe_node");
          const FeConfig config = read_fe_config(document, read_scenario(document));
          document.finish();
          if (!config.head_neck.is_generated)
            throw UserError(Problem{Place{args->scenario}, "head_neck.deck", "`generate`",
                                    config.head_neck.deck.string(),
                                    "`crosswalk check` reports a deck of your own"});
          const NodeModel model = build_node_model(config, args->folder);
          std::cout << model.report << fmt::format("\ndecks: {}/model\n", args->folder);
          return ExitCode::Done;
        };
      }};
}

NodeCommand bench_command() {
  return {"bench", "speed of the solver on generated workloads", [](CLI::App& options) {
            auto request = std::make_shared<BenchRequest>();
            options.add_option(
                "workloads", request->workloads,
                fmt::format("Any of {}; all by default", fmt::join(workload_names(), " ")));
            options.add_option("--threads", request->threads, "Threads; 1 and all by default");
            options.add_flag("--json", request->json, "One JSON object instead of a table");
            add_precision(options, request->precision);
            return [request] {
              std::cout << run_bench(*request);
              return ExitCode::Done;
            };
          }};
}

}  // namespace crosswalk::fe
