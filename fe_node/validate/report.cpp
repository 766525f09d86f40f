#include "fe_node/validate/report.h"

#include <cmath>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/error.h"

namespace crosswalk::fe::validate {
namespace {

std::string number(double x) { return std::isfinite(x) ? fmt::format("{:.4g}", x) : "-"; }

std::string range(const Measure& m) {
  const bool low = std::isfinite(m.low), high = std::isfinite(m.high);
  if (low && high) return fmt::format("{:.4g} .. {:.4g}", m.low, m.high);
  if (low) return fmt::format(">= {:.4g}", m.low);
  if (high) return fmt::format("<= {:.4g}", m.high);
  return "-";
}

std::ofstream open(const std::filesystem::path& path) {
  std::ofstream file(path);
  if (!file) throw UserError(Problem{{path.string()}, "results", "room to write", "none", {}});
  return file;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

void write_table(const std::vector<CaseResult>& results, const std::filesystem::path& path) {
  std::ofstream file = open(path);
  file << "case,quantity,unit,reference,accepted_low,accepted_high,confidence,ours,ratio,verdict,"
          "source\n";
  for (const CaseResult& result : results)
    for (const Measure& m : result.measures)
      fmt::print(file, "{},{},{},{},{},{},{},{},{},{},{}\n", result.name, quoted(m.quantity),
                 m.unit, number(m.reference), number(m.low), number(m.high), name(m.confidence),
                 number(m.ours), number(m.ratio()), name(m.verdict()), quoted(m.source));
}

void write_plot(const Plot& plot, const std::filesystem::path& folder) {
  std::ofstream data = open(folder / (plot.file + ".dat"));
  std::ofstream script = open(folder / (plot.file + ".gp"));
  fmt::print(script,
             "set terminal pngcairo size 900,560\nset output '{0}.png'\nset title \"{1}\"\n"
             "set xlabel \"{2}\"\nset ylabel \"{3}\"\nset grid\nset key outside below\nplot ",
             plot.file, plot.title, plot.x_label, plot.y_label);
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    fmt::print(data, "# {}\n", plot.series[s].label);
    for (const auto& [x, y] : plot.series[s].points) fmt::print(data, "{:.8g} {:.8g}\n", x, y);
    data << "\n\n";
    fmt::print(script, "{}'{}.dat' index {} using 1:2 with lines lw 2 title \"{}\"",
               s == 0 ? "" : ", ", plot.file, s, plot.series[s].label);
  }
  script << '\n';
}

bool run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  const std::string there = "cd '" + folder.string() + "'";
  const char* arguments[] = {"gnuplot", "-e", there.c_str(), script.c_str(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, "gnuplot", nullptr, nullptr, const_cast<char**>(arguments), environ) !=
      0)
    return false;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::string table_text(const CaseResult& result) {
  std::string out = fmt::format("\n{}: {}\n  {}\n", result.name, result.title, result.setup);
  out += fmt::format("  {:<46} {:>9} {:>19} {:<11} {:>9} {:>6}  {}\n", "", "reference", "accepted",
                     "confidence", "ours", "ratio", "verdict");
  for (const Measure& m : result.measures)
    out += fmt::format("  {:<46} {:>9} {:>19} {:<11} {:>9} {:>6}  {}\n",
                       m.unit.empty() ? m.quantity : m.quantity + ", " + m.unit,
                       number(m.reference), range(m), name(m.confidence), number(m.ours),
                       std::isfinite(m.ratio()) ? fmt::format("{:.2f}", m.ratio()) : "-",
                       name(m.verdict()));
  for (const std::string& note : result.notes) out += "  note: " + note + "\n";
  return out;
}

std::vector<std::string> write_results(const std::vector<CaseResult>& results,
                                       const std::filesystem::path& folder) {
  std::vector<std::string> remarks;
  write_table(results, folder / "validation.csv");
  for (const CaseResult& result : results)
    for (const Plot& plot : result.plots) {
      const std::filesystem::path place = std::filesystem::absolute(folder / result.name);
      write_plot(plot, place);
      if (!run_gnuplot(plot.file + ".gp", place) && remarks.empty())
        remarks.push_back("no pictures: gnuplot is not installed; the .gp files draw them");
    }
  return remarks;
}

int failed_gates(const std::vector<CaseResult>& results) {
  int failed = 0;
  for (const CaseResult& result : results)
    for (const Measure& m : result.measures) failed += m.is_gate() && !m.is_inside() ? 1 : 0;
  return failed;
}

}  // namespace crosswalk::fe::validate
