#include "fe_node/deck/deck_writer.h"

#include <fstream>
#include <sstream>

#include "fe_node/deck/keyword_table.h"

namespace crosswalk::fe {

namespace {

void write_unread(CardWriter& out, const UnreadKeyword& unread) {
  // Materials are written with the other materials.
  if (unread.keyword.starts_with("MAT_")) return;
  out.keyword(unread.keyword);
  for (std::string card : unread.cards) out.raw_line(card);
}

void write_includes(CardWriter& out, const Deck& deck) {
  for (const MissingInclude& include : deck.missing_includes) {
    out.keyword("INCLUDE");
    std::string name = include.name;
    out.line("filename", name);
  }
}

}  // namespace

void write_deck(std::ostream& stream, const Deck& deck) {
  stream << "*KEYWORD\n";
  if (deck.units != UnitSystem::Unknown)
    stream << "$ crosswalk: unit_system=" << unit_system_name(deck.units) << '\n';
  {
    CardWriter out(stream);
    if (!deck.title.empty()) {
      out.keyword("TITLE");
      std::string title = deck.title;
      out.line("title", title);
    }
    write_control(out, deck);
    write_parts(out, deck);
    write_materials(out, deck);
    write_tables(out, deck);
    write_sets(out, deck);
    write_conditions(out, deck);
    write_constraints(out, deck);
    write_contacts(out, deck);
    for (const UnreadKeyword& unread : deck.unread) write_unread(out, unread);
    write_includes(out, deck);
    write_mesh(out, deck);
  }
  stream << "*END\n";
}

std::string deck_text(const Deck& deck) {
  std::ostringstream out;
  write_deck(out, deck);
  return out.str();
}

void write_deck(const std::filesystem::path& path, const Deck& deck) {
  std::ofstream out(path, std::ios::binary);
  write_deck(out, deck);
  out.close();
  if (out) return;
  Problem problem;
  problem.place.file = path.string();
  problem.what = "deck";
  problem.expected = "a file that can be written";
  throw UserError(std::move(problem));
}

}  // namespace crosswalk::fe
