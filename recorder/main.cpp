#include <functional>

#include <CLI/CLI.hpp>

#include "recorder/commands/command_line.h"

int main(int argc, char** argv) {
  using crosswalk::ExitCode;
  CLI::App app("Records a run and judges it: signals, ratings, injury metrics.", "recorder");
  app.require_subcommand(1);
  std::function<ExitCode()> action;
  const auto add = [&](const char* name, const char* purpose, const auto& define) {
    CLI::App* command = app.add_subcommand(name, purpose);
    command->callback([&action, act = define(*command)] { action = act; });
  };
  add("rate", "Rate one signal against another.", crosswalk::recording::define_rate);
  add("injury", "Injury metrics of head signals.", crosswalk::recording::define_injury);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::UserError);
  }
  return static_cast<int>(action());
}
