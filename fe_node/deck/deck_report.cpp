#include "fe_node/deck/deck_report.h"

#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "fe_node/deck/deck_check.h"
#include "fe_node/deck/part_table.h"
#include "fe_node/deck/units_guess.h"

namespace crosswalk::fe {

namespace {

constexpr std::size_t kTitleWidth = 28;

std::string shortened(const std::string& text, std::size_t width) {
  return text.size() <= width ? text : text.substr(0, width - 3) + "...";
}

class Report {
 public:
  Report(const ReadDeck& read, const DeckIndex& index)
      : read_(read),
        deck_(read.deck),
        index_(index),
        table_(part_table(index)),
        units_(guess_units(read.deck)),
        factors_(unit_factors(units_.system)) {}

  std::string text(const std::string& name, const std::vector<std::string>& model_lines,
                   bool is_sound) {
    head(name);
    units();
    size();
    parts();
    others();
    model(model_lines);
    keywords();
    missing();
    problems("warnings", read_.problems.warnings);
    problems("errors", read_.problems.errors);
    line("{}",
         is_sound ? "The deck is sound: it can be run." : "The deck cannot be run as it stands.");
    return std::move(out_);
  }

 private:
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Values>(values)...);
    out_ += '\n';
  }

  void head(const std::string& name) {
    line("deck      {}", name);
    if (!deck_.title.empty()) line("title     {}", shortened(deck_.title, 80));
    for (std::size_t i = 1; i < deck_.files.names.size(); ++i)
      line("includes  {}", deck_.files.names[i]);
  }

  void units() {
    const std::string name(unit_system_name(units_.system));
    switch (units_.certainty) {
      case UnitsGuess::Certainty::Stated:
        return line("units     {}, stated by the deck", name);
      case UnitsGuess::Certainty::None:
        return line("units     not stated, and nothing in the deck tells");
      case UnitsGuess::Certainty::Likely:
        line("units     {}, guessed; state it by `$ crosswalk: unit_system={}`", name, name);
        break;
      case UnitsGuess::Certainty::Ambiguous:
        line("units     {} or {}: state it by `$ crosswalk: unit_system=...`", name,
             unit_system_name(units_.second));
    }
    for (const std::string& reason : units_.reasons) line("          {}", reason);
  }

  bool has_units() const { return units_.system != UnitSystem::Unknown; }

  void size() {
    std::string kinds;
    for (const auto& [kind, count] : table_.elements)
      kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, kind);
    line("nodes     {}", deck_.nodes.size());
    line("elements  {}", kinds.empty() ? "none" : kinds);
    if (!deck_.nodes.empty()) {
      Vec3 low = deck_.nodes.front().position, high = low;
      for (const DeckNode& node : deck_.nodes) {
        low = low.cwiseMin(node.position);
        high = high.cwiseMax(node.position);
      }
      line("box       x {:.6g} .. {:.6g}, y {:.6g} .. {:.6g}, z {:.6g} .. {:.6g}", low.x(),
           high.x(), low.y(), high.y(), low.z(), high.z());
    }
    if (!deck_.parts.empty()) line("mass      {}", mass_text(table_.mass()));
    if (deck_.control.end_time)
      line("end time  {:g}{}", *deck_.control.end_time,
           has_units() ? fmt::format(" ({:g} ms)", *deck_.control.end_time * factors_.time * 1e3)
                       : "");
  }

  std::string mass_text(double mass) const {
    return has_units() ? fmt::format("{:.4g} kg", mass * factors_.mass)
                       : fmt::format("{:.4g} deck units", mass);
  }

  std::string law_of(const Part& part) const {
    if (part.composite) return fmt::format("{} layers", part.composite->layers.size());
    const Material* material = index_.material(part.material);
    if (material == nullptr) return fmt::format("{} missing", part.material.value);
    return fmt::format("{} {}", material->id.value, material_keyword(*material).substr(4));
  }

  std::string section_of(const Part& part) const {
    constexpr const char* kNames[] = {"solid", "shell", "thick shell", "beam", "discrete", "belt"};
    if (part.composite) return fmt::format("shell {}", part.composite->formulation);
    const Section* section = index_.section(part.section);
    if (section == nullptr) return fmt::format("{} missing", part.section.value);
    const int formulation = std::visit(
        [](const auto& law) {
          if constexpr (requires { law.formulation; })
            return law.formulation;
          else
            return 0;
        },
        section->law);
    const char* name = kNames[section->law.index()];
    return formulation == 0 ? name : fmt::format("{} {}", name, formulation);
  }

  void parts() {
    if (deck_.parts.empty()) return;
    line("");
    line("{:>9}  {:<28}  {:<24}  {:<14}  {:<40}  {:>12}", "part", "title", "elements", "section",
         "material", has_units() ? "mass kg" : "mass");
    for (const PartRow& row : table_.rows) {
      std::string kinds;
      for (const auto& [kind, count] : row.elements)
        kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, kind);
      const double mass = (row.mass + row.added_mass) * (has_units() ? factors_.mass : 1);
      line("{:>9}  {:<28}  {:<24}  {:<14}  {:<40}  {:>12.4g}", row.part->id.value,
           shortened(row.part->title, kTitleWidth), kinds.empty() ? "-" : kinds,
           section_of(*row.part), shortened(law_of(*row.part), 40), mass);
    }
  }

  void count(const char* word, std::size_t number) {
    if (number > 0) counts_ += fmt::format("{}{} {}", counts_.empty() ? "" : ", ", word, number);
  }

  void others() {
    counts_.clear();
    count("parts", deck_.parts.size());
    count("sections", deck_.sections.size());
    count("materials", deck_.materials.size());
    count("curves", deck_.curves.size());
    count("curve functions (not evaluated)", deck_.curve_functions.size());
    count("tables", deck_.tables.size());
    count("sets", deck_.sets.size() + deck_.segment_sets.size());
    count("coordinate systems", deck_.coordinate_nodes.size() + deck_.coordinate_systems.size());
    count("contacts", deck_.contacts.size());
    count("joints", deck_.joints.size());
    count("joint stiffnesses", deck_.joint_stiffnesses.size());
    count("merged rigid bodies", deck_.merged_rigid_bodies.size());
    count("extra-node groups", deck_.extra_nodes.size());
    count("nodal rigid bodies", deck_.nodal_rigid_bodies.size());
    count("spot welds and node ties", deck_.node_ties.size());
    count("interpolations", deck_.interpolations.size());
    count("rigid walls", deck_.rigid_walls.size());
    count("SPC", deck_.spcs.size());
    count("prescribed motions", deck_.prescribed_motions.size());
    count("initial velocities", deck_.initial_velocities.size() + deck_.nodal_velocities.size() +
                                    deck_.rigid_velocities.size() +
                                    deck_.generated_velocities.size());
    count("loads", deck_.nodal_loads.size() + deck_.rigid_loads.size() + deck_.pressures.size() +
                       deck_.body_loads.size());
    count("dampings", deck_.dampings.size());
    if (counts_.empty()) return;
    line("");
    line("besides   {}", counts_);
  }

  void model(const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    line("");
    line("model");
    for (const std::string& one : lines) line("  {}", one);
  }

  /// Keywords that are not interpreted, each once with its first place and its number.
  void keywords() {
    struct Row {
      const UnreadKeyword* first;
      long times = 0;
    };
    std::map<std::pair<int, std::string>, Row> rows;
    for (const UnreadKeyword& unread : deck_.unread) {
      Row& row = rows.try_emplace({static_cast<int>(unread.effect), unread.keyword}, Row{&unread})
                     .first->second;
      ++row.times;
    }
    if (rows.empty()) return;
    line("");
    line("keywords that are not interpreted");
    for (const auto& [key, row] : rows) {
      const char* effect = row.first->effect == Effect::Physics
                               ? "changes the physics: refused unless --accept-missing"
                           : row.first->effect == Effect::Tuning
                               ? "ignored: a setting of another program"
                               : "ignored: output only";
      line("  {}: *{}{}: {} ({})", deck_.place(row.first->source).text(), key.second,
           row.times > 1 ? fmt::format(" ({} times)", row.times) : "", effect, row.first->reason);
    }
  }

  void missing() {
    if (deck_.missing_includes.empty()) return;
    line("");
    line("files that are missing");
    for (const MissingInclude& include : deck_.missing_includes)
      line("  {}: {}", deck_.place(include.source).text(), include.name);
  }

  void problems(const char* word, const ProblemList& list) {
    if (list.empty()) {
      if (word[0] == 'e') line("");
      return;
    }
    line("");
    line("{} ({})", word, list.total());
    for (const Problem& problem : list.summary()) line("  {}", problem.text());
    if (word[0] == 'e') line("");
  }

  const ReadDeck& read_;
  const Deck& deck_;
  const DeckIndex& index_;
  PartTable table_;
  UnitsGuess units_;
  UnitFactors factors_;
  std::string out_, counts_;
};

bool changes_physics(const UnreadKeyword& unread) { return unread.effect == Effect::Physics; }

}  // namespace

DeckReport report_deck(ReadDeck& read, const std::string& name, const ModelTrial& trial) {
  const DeckIndex index(read.deck);
  check_deck(index, read.problems);
  std::vector<std::string> model_lines;
  if (trial && read.problems.errors.empty() && read.deck.missing_includes.empty())
    model_lines = trial(read.deck, read.problems);
  DeckReport report;
  report.is_sound = read.problems.errors.empty() && read.deck.missing_includes.empty() &&
                    std::none_of(read.deck.unread.begin(), read.deck.unread.end(), changes_physics);
  report.text = Report(read, index).text(name, model_lines, report.is_sound);
  return report;
}

DeckReport report_deck(const std::filesystem::path& path, const ReadOptions& options) {
  ReadDeck read = read_deck(path, options);
  return report_deck(read, path.string());
}

}  // namespace crosswalk::fe
