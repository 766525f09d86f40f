#include "mb_node/subject_report.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk::mb {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

std::string measures_text(const BodyDescription& body, const PublishedScaling& published) {
  const Anthropometry got = measured_on(body);
  std::string text = fmt::format("   measure{:26}asked   obtained  difference{}\n", "",
                                 published.empty() ? "" : "           published model");
  for (const Measure& m : anthropometry_measures()) {
    const double unit = m.kind == MeasureKind::Mass ? 1 : 1e3;
    const double asked = unit * body.measures.*m.value, obtained = unit * got.*m.value;
    std::string line = fmt::format("{:3} {:28}{:9.1f}", m.number, m.name, asked);
    line += obtained == 0  // not on this body
                ? fmt::format("{:>11}{:>11}{:11}", "-", "-", "")
                : fmt::format("  {:9.1f}  {:+9.1f}  {:+6.1f} %", obtained, obtained - asked,
                              100 * (obtained / asked - 1));
    if (const auto other = published.find(std::string(m.name)); other != published.end()) {
      const double value = unit * other->second;
      line += fmt::format("  {:+9.1f}  {:+6.1f} %", value - asked, 100 * (value / asked - 1));
    }
    text += line + "\n";
  }
  text +=
      "   (kg for the mass, else mm; obtained: taken back from the model's joints and ellipsoids";
  if (!published.empty()) {
    text += ";\n   published model: difference of its own scaled measures [yu2020, Table 2]";
  }
  text += ")\n";
  const WorstLength ours = worst_length(body), theirs = worst_length(body.measures, published);
  text += fmt::format("   largest of the heights and lengths: {:.1f} mm ({})",
                      1e3 * ours.difference, ours.measure);
  if (!published.empty()) {
    text +=
        fmt::format("; published model {:.1f} mm ({})", 1e3 * theirs.difference, theirs.measure);
  }
  return text + "\n";
}

std::string heights_text(const BodyDescription& body) {
  std::string text =
      "Height reconciliation\n   equation                                   residual mm   sigma "
      "mm\n";
  for (const HeightResidual& r : body.height_residuals) {
    text += fmt::format("   {:44}{:+9.1f}  {:9.1f}\n", r.equation, 1e3 * r.residual, 1e3 * r.sigma);
  }
  return text;
}

/// Head and neck: the sum of the bodies' central moments, as the published table is read, and the
/// moments about the common centre of mass.
std::string head_neck_text(const BodyDescription& body, const PublishedScaling& published) {
  Inertia whole;
  Vec3 central = Vec3::Zero();
  for (const char* name : {"head", "neck_low", "neck_up"}) {
    const int i = body.find_segment(name);
    if (i < 0) return "";
    const Segment& s = body.segments[i];
    whole = whole + Inertia{s.mass, s.com, s.inertia};
    central += s.inertia.diagonal();
  }
  const auto row = [](const char* what, double mass, const Vec3& I) {
    return fmt::format("   {:44}{:9.4f}{:12.6f}{:11.6f}{:11.6f}\n", what, mass, I.x(), I.y(),
                       I.z());
  };
  std::string text =
      fmt::format("Head and neck\n   {:44}{:>9}{:>34}\n", "", "mass kg", "Ixx, Iyy, Izz kg m2");
  text += row("sum of the bodies' central moments", whole.mass, central);
  const auto table = [&](const char* name) {
    const auto found = published.find(name);
    return found == published.end() ? 0.0 : found->second;
  };
  if (const double mass = table("head_neck_mass"); mass > 0) {
    text += row("the same as printed [yu2020, Table A1]", mass,
                {table("head_neck_Ixx"), table("head_neck_Iyy"), table("head_neck_Izz")});
  }
  text += row("about the common centre of mass", whole.mass, whole.about_com.diagonal());
  return text;
}

std::string bodies_text(const BodyDescription& body) {
  std::string text =
      "Bodies\n   name              mass kg   COM x, y, z mm            Ixx, Iyy, Izz 1e-4 kg m2\n";
  for (const Segment& s : body.segments) {
    text += fmt::format("   {:16}{:9.4f}{:9.1f}{:8.1f}{:8.1f}{:11.2f}{:9.2f}{:9.2f}\n", s.name,
                        s.mass, 1e3 * s.com.x(), 1e3 * s.com.y(), 1e3 * s.com.z(),
                        1e4 * s.inertia(0, 0), 1e4 * s.inertia(1, 1), 1e4 * s.inertia(2, 2));
  }
  return text + fmt::format("   total {:19.4f}\n", body.total_mass());
}

}  // namespace

PublishedScaling read_published_scaling(const std::filesystem::path& file,
                                        const std::string& subject) {
  std::ifstream in(file);
  if (!in) throw UserError({{}, "published scaling", "a readable file", file.string(), ""});
  PublishedScaling out;
  std::size_t column = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() > 1 && cells[0] == "measure") {
      for (std::size_t i = 2; i < cells.size(); ++i) {
        if (cells[i] == subject) column = i;
      }
      continue;
    }
    if (column == 0 || cells.size() <= column || cells[column].empty()) continue;
    out[cells[0]] = std::stod(cells[column]) * (cells[1] == "mm" ? 1e-3 : 1);
  }
  return out;
}

WorstLength worst_length(const BodyDescription& body) {
  const Anthropometry got = measured_on(body);
  PublishedScaling ours;
  for (const Measure& m : anthropometry_measures()) {
    if (got.*m.value > 0) ours[std::string(m.name)] = got.*m.value;
  }
  return worst_length(body.measures, ours);
}

WorstLength worst_length(const Anthropometry& asked, const PublishedScaling& published) {
  WorstLength worst;
  for (const Measure& m : anthropometry_measures()) {
    const auto found = published.find(std::string(m.name));
    if (m.kind != MeasureKind::Length || found == published.end()) continue;
    const double difference = std::abs(found->second - asked.*m.value);
    if (difference > worst.difference) worst = {std::string(m.name), difference};
  }
  return worst;
}

std::string subject_report(const BodyDescription& body, const PublishedScaling& published) {
  std::string text = fmt::format("Subject {}\n\n", body.name) + measures_text(body, published);
  text += "\n" + heights_text(body) + "\n";
  if (const std::string head = head_neck_text(body, published); !head.empty()) text += head + "\n";
  return text + bodies_text(body);
}

}  // namespace crosswalk::mb
