#include "launcher/handover.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>
#include <unistd.h>

#include "common/error.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

constexpr std::array kHandovers = {
    Handover{"solve", "fe_node", "run a keyword deck alone"},
    Handover{"validate", "fe_node", "component tests of the finite-element models"},
    Handover{"model", "fe_node", "write a scenario's generated decks; masses and mesh quality"},
    Handover{
        "bench", "fe_node",
        "speed of the solver; `bench coupling`, `rating`, `report RUN`, `live RUN`: of the rest"},
    Handover{"subject", "mb_node", "show or fill in a subject's measures"},
    Handover{"study", "mb_node", "many multibody runs over a range of parameters"},
    Handover{"view", "recorder", "still pictures of the pedestrian and the car"},
    Handover{"rate", "recorder", "rate a run against test curves (CORA, ISO 18571)"},
    Handover{"injury", "recorder", "injury metrics of a run"},
    Handover{"analyze", "recorder", "channels and table of a log"},
    Handover{"compare", "recorder", "two or more runs side by side"},
    Handover{"report", "recorder", "one HTML page about a run"},
    Handover{"watch", "recorder", "live page of a run on localhost"},
    Handover{"export", "recorder", "channels in other formats"},
    Handover{"broker", "coupler", "message broker for runs across networks"},
};

/// A keyword deck rather than a scenario or an option.
bool names_deck(const fs::path& argument) {
  const std::string extension = argument.extension().string();
  if (extension == ".k" || extension == ".key" || extension == ".dyn") return true;
  std::error_code ignored;
  return extension != ".toml" && fs::is_regular_file(argument, ignored);
}

}  // namespace

std::span<const Handover> handovers() { return kHandovers; }

std::string_view program_for(std::string_view command, const std::vector<std::string>& arguments) {
  if (command == "bench" && !arguments.empty()) {
    if (arguments.front() == "coupling") return "coupler";
    for (const char* ours : {"rating", "report", "live"})
      if (arguments.front() == ours) return "recorder";
  }
  if (command == "check" && std::any_of(arguments.begin(), arguments.end(), names_deck))
    return "fe_node";
  const auto found = std::find_if(kHandovers.begin(), kHandovers.end(),
                                  [&](const Handover& h) { return h.command == command; });
  return found == kHandovers.end() ? std::string_view{} : found->program;
}

fs::path sibling_program(std::string_view name) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / name;
  if (access(program.c_str(), X_OK) != 0)
    throw UserError(Problem{Place{program.string()}, std::string(name),
                            "a program beside crosswalk", "none",
                            "build it, for example by calling ./crosswalk once"});
  return program;
}

void hand_over(const fs::path& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execvp(program.c_str(), argv.data());
  throw UserError(
      Problem{Place{program.string()}, "cannot be started", {}, std::strerror(errno), {}});
}

}  // namespace crosswalk
