#include "launcher/remote.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>
#include <sys/wait.h>

#include "common/error.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

constexpr int kLastSignal = 64;
constexpr int kSshFailed = 255;

/// ssh with its options, up to the host.
std::vector<std::string> ssh_words() {
  std::vector<std::string> words;
  if (const char* other = std::getenv("CROSSWALK_SSH"); other != nullptr && *other != '\0') {
    std::istringstream in(other);
    for (std::string word; in >> word;) words.push_back(word);
  } else {
    // Never a question for a password; a host that is gone is noticed within 15 s.
    words = {"ssh", "-T", "-o", "BatchMode=yes", "-o", "ServerAliveInterval=5"};
  }
  return words;
}

std::string ssh_text(const std::string& host, const std::string& command) {
  std::string text;
  for (const std::string& word : ssh_words()) text += shell_word(word) + " ";
  return text + shell_word(host) + " " + shell_word(command);
}

/// Runs a shell command; its exit code and what it printed.
std::pair<int, std::string> shell(const std::string& command) {
  std::FILE* pipe = popen(("{ " + command + "; } 2>&1").c_str(), "r");
  CW_ASSERT(pipe != nullptr);
  std::string text;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), n);
  const int status = pclose(pipe);
  while (text.ends_with('\n')) text.pop_back();
  return {WIFEXITED(status) ? WEXITSTATUS(status) : kSshFailed, text};
}

/// "fe" or "fe_node" -> "fe_node"; empty when there is no such process.
std::string full_name(const Scenario& scenario, const std::string& name) {
  for (const NodeSpec& node : scenario.nodes)
    if (node.name == name || node.name == name + "_node") return node.name;
  return {};
}

}  // namespace

void place_nodes(Scenario& scenario, const std::string& placement) {
  std::istringstream in(placement);
  for (std::string entry; std::getline(in, entry, ',');) {
    const std::size_t equals = entry.find('=');
    const std::string name = full_name(scenario, entry.substr(0, equals));
    const std::string host = equals == std::string::npos ? "" : entry.substr(equals + 1);
    // A host is a word of a command line: an option of ssh must not pass for one.
    if (name.empty() || host.empty() || host.front() == '-')
      throw UserError(Problem{{},
                              "--on",
                              "process=host,... with the processes mb, fe, coupler, recorder",
                              fmt::format("\"{}\"", entry),
                              "for example --on fe=bighost,recorder=storehost"});
    for (NodeSpec& node : scenario.nodes)
      if (node.name == name) node.host = host == "local" ? "" : host;
  }
}

std::set<std::string> hosts_of(const Scenario& scenario) {
  std::set<std::string> hosts;
  for (const NodeSpec& node : scenario.nodes)
    if (!node.host.empty() && (node.name != "fe_node" || scenario.has_fe()))
      hosts.insert(node.host);
  return hosts;
}

fs::path remote_folder(const std::string& run_id) { return fs::path(".crosswalk") / run_id; }

ProcessSpec in_remote_folder(ProcessSpec spec, const RunDirectory& directory) {
  const std::string root = directory.root().string();
  for (std::string& argument : spec.arguments)
    if (argument.starts_with(root)) argument = fs::path(argument).lexically_relative(root).string();
  return spec;
}

ProcessSpec forwarded_port(const std::string& host, int port) {
  const std::vector<std::string> words = ssh_words();
  ProcessSpec spec{.name = "tunnel to " + host,
                   .program = words.front(),
                   .arguments = {},
                   .log = {},
                   .is_output_piped = true,
                   .host = host};
  spec.arguments.assign(words.begin() + 1, words.end());
  for (const std::string& word :
       {std::string("-o"), std::string("ExitOnForwardFailure=yes"), std::string("-R"),
        fmt::format("{0}:127.0.0.1:{0}", port), host, std::string("echo ready; exec cat")})
    spec.arguments.push_back(word);
  return spec;
}

ProcessSpec Remote::over_ssh(const ProcessSpec& planned, const RunDirectory& directory) const {
  const ProcessSpec there = in_remote_folder(planned, directory);
  const std::string script = fmt::format(
      "cd {} || exit 2; exec 3<&0; {} </dev/null 3<&- & node=$!; "
      "{{ while read -r signal; do kill -s \"$signal\" $node; done; kill -s TERM $node; sleep 3; "
      "kill -s KILL $node; }} <&3 3<&- >/dev/null 2>&1 & watcher=$!; exec 3<&-; "
      "wait $node; code=$?; kill $watcher 2>/dev/null; exit $code",
      shell_word(remote_folder(run_id).string()), there.command_text());
  ProcessSpec spec = planned;
  const std::vector<std::string> words = ssh_words();
  spec.program = words.front();
  spec.arguments.assign(words.begin() + 1, words.end());
  spec.arguments.push_back(planned.host);
  spec.arguments.push_back("sh -c " + shell_word(script));
  return spec;
}

void Remote::send(const std::string& host, const RunDirectory& directory, bool is_resumed) const {
  const std::string folder = shell_word(remote_folder(run_id).string());
  const std::string what =
      is_resumed ? "scenario.toml checkpoints signals.lcmlog" : "scenario.toml";
  const auto [code, text] = shell(
      fmt::format("tar -C {} -cf - {} | {}", shell_word(directory.root().string()), what,
                  ssh_text(host, fmt::format("{1}mkdir -p {0}/logs && tar -C {0} -xf -", folder,
                                             is_resumed ? "" : "rm -rf " + folder + "; "))));
  if (code != 0)
    throw UserError(Problem{{},
                            "host " + host,
                            "a machine that `ssh " + host + "` reaches without a password",
                            text.empty() ? fmt::format("exit {}", code) : text,
                            "try the command in a shell"});
}

std::string Remote::gather(const std::string& host, const RunDirectory& directory) const {
  const std::string folder = shell_word(remote_folder(run_id).string());
  const auto [code, text] = shell(fmt::format(
      "{} | tar -C {} --exclude=./scenario.toml --transform={} --transform={} -xf -",
      ssh_text(host, fmt::format("tar -C {} -cf - .", folder)),
      shell_word(directory.root().string()), shell_word("s,^\\./logs/,./logs/" + host + "/,"),
      shell_word("s,^\\./provenance\\.json,./provenance-" + host + ".json,")));
  return code == 0 ? "" : fmt::format("{}: {}", host, text);
}

}  // namespace crosswalk
