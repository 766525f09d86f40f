#include "fe_node/deck/keyword_reader.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include "fe_node/deck/expression.h"
#include "fe_node/deck/include_transform.h"
#include "fe_node/deck/keyword_effects.h"
#include "fe_node/deck/keyword_table.h"
#include "fe_node/deck/number.h"
#include "fe_node/deck/parameter_reader.h"
#include "fe_node/deck/units_reader.h"

namespace crosswalk::fe {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kKeptCards = 1000;  // of a keyword that is not interpreted

using Table = std::unordered_map<std::string_view, const KeywordEntry*>;

const Table& keyword_table() {
  static const Table kTable = [] {
    Table out;
    for (const auto entries :
         {mesh_keywords(), part_keywords(), material_keywords(), table_keywords(), set_keywords(),
          condition_keywords(), constraint_keywords(), control_keywords()})
      for (const KeywordEntry& entry : entries) out.emplace(entry.base, &entry);
    return out;
  }();
  return kTable;
}

/// Splits what follows a base keyword into the options its entry allows; false when it cannot.
bool take_options(std::string_view rest, const KeywordEntry& entry,
                  std::vector<std::string>& options) {
  while (!rest.empty()) {
    rest.remove_prefix(1);  // the underscore
    const auto fits = [&](std::string_view option) {
      return rest.starts_with(option) &&
             (rest.size() == option.size() || rest[option.size()] == '_');
    };
    const auto option = std::find_if(entry.options.begin(), entry.options.end(), fits);
    if (option == entry.options.end()) return false;
    options.emplace_back(*option);
    rest.remove_prefix(option->size());
  }
  return true;
}

struct Match {
  const KeywordEntry* entry = nullptr;
  std::vector<std::string> options;
};

/// The entry with the longest base that fits the keyword.
Match find_entry(std::string_view keyword) {
  std::string_view base = keyword;
  while (!base.empty()) {
    Match match;
    const auto at = keyword_table().find(base);
    if (at != keyword_table().end() &&
        take_options(keyword.substr(base.size()), *at->second, match.options)) {
      match.entry = at->second;
      return match;
    }
    const std::size_t cut = base.rfind('_');
    base = cut == std::string_view::npos ? std::string_view() : base.substr(0, cut);
  }
  return {};
}

class DeckReader {
 public:
  DeckReader(ReadDeck& out, const ReadOptions& options)
      : deck_(out.deck),
        problems_(out.problems),
        options_(options),
        lines_(out.deck.files.names, out.problems),
        io_(lines_, parameters_, out.deck.files.names, out.problems) {}

  void read_file(const fs::path& path) {
    if (lines_.push_file(path, {}) != LineSource::Pushed::Opened) {
      problems_.errors.add(Place{path.string(), 0, 0}, "file", "a readable keyword deck",
                           "no such file");
      return;
    }
    root_folder_ = path.parent_path();
    read_innermost();
    finish();
  }

  void read_text(std::string text, const std::string& name) {
    lines_.push_text(std::move(text), name);
    read_innermost();
    finish();
  }

 private:
  /// All of the innermost open file.
  void read_innermost() {
    parameters_.enter_file();
    bool has_complained = false;
    while (const std::string* line = lines_.peek()) {
      if (!line->empty() && line->front() == '*') {
        read_block();
        continue;
      }
      if (!line->empty() && !has_complained) {
        error("line", "a keyword that starts with * in column 1", fmt::format("'{:.40}'", *line));
        has_complained = true;
      }
      lines_.take();
    }
    parameters_.leave_file();
    lines_.pop();
  }

  void finish() {
    add_waiting();
    if (keyword_count_ == 0 && problems_.errors.empty())
      problems_.errors.add(Place{deck_.files.names.front(), 0, 0}, "file", "a keyword deck",
                           "no keyword");
    read_directives(lines_.directives(), deck_, problems_);
    for (const DeckTable& table : deck_.tables)
      if (std::any_of(table.curves.begin(), table.curves.end(),
                      [](DeckId id) { return !id.given(); }))
        problems_.errors.add(deck_.place(table.source),
                             fmt::format("*DEFINE_TABLE {}", table.id.value),
                             fmt::format("{} curves after it", table.values.size()), "fewer");
  }

  void error(const std::string& what, const std::string& expected, const std::string& found) {
    problems_.errors.add(deck_.place(lines_.place()), what, expected, found);
  }

  /// The keyword line, its column format, and its cards.
  void read_block() {
    ++keyword_count_;
    const Source source = lines_.place();
    std::string keyword = upper_case(trimmed(std::string_view(*lines_.peek()).substr(1)));
    lines_.take();
    CardFormat format = format_;
    const std::size_t blank = keyword.find(' ');
    std::string tail = blank == std::string::npos ? "" : keyword.substr(blank);
    keyword.erase(std::min(blank, keyword.size()));
    tail = trimmed(tail);
    // The sign of the format stands at the keyword's end or by itself after it.
    std::string sign = tail;
    while (!keyword.empty() &&
           std::string_view("+-%").find(keyword.back()) != std::string_view::npos) {
      sign = keyword.back();
      keyword.pop_back();
    }
    if (tail.empty()) tail = sign;
    if (keyword == "KEYWORD") return read_keyword_options(tail);
    if (sign == "+") format = CardFormat::Long;
    if (sign == "-") format = CardFormat::Standard;
    if (sign == "%") format = CardFormat::I10;
    io_.begin(keyword, source, format);
    dispatch(keyword, tail);
    warn_of_rest(keyword);
  }

  void read_keyword_options(const std::string& tail) {
    io_.begin("KEYWORD", lines_.place(), CardFormat::Standard);
    if (tail.find("LONG=Y") != std::string::npos) format_ = CardFormat::Long;
    if (tail.find("LONG=S") != std::string::npos) format_ = CardFormat::Standard;
    if (tail.find("I10=Y") != std::string::npos) format_ = CardFormat::I10;
    io_.skip_rest();
  }

  void dispatch(const std::string& keyword, const std::string& tail) {
    if (keyword == "END") {
      lines_.end_file();
      return;
    }
    if (keyword == "TITLE") return io_.has_card() ? io_.line("TITLE", deck_.title) : void();
    if (keyword == "COMMENT") return io_.skip_rest();
    if (keyword == "INCLUDE") return read_includes();
    if (keyword == "INCLUDE_TRANSFORM") return read_transformed_include();
    if (keyword.starts_with("INCLUDE_PATH")) return read_include_paths();
    if (keyword == "CONTROL_UNITS") return read_control_units(io_, deck_);
    if (read_parameter_keyword(keyword, io_, parameters_, problems_, deck_)) return;
    Match match = find_entry(keyword);
    KeywordBlock block{deck_, io_, problems_, {}, std::move(match.options)};
    if (match.entry != nullptr) {
      block.base = match.entry->base;
      return match.entry->read(block);
    }
    if (keyword.starts_with("CONTACT_") && read_contact(block, keyword.substr(8))) return;
    if (keyword.starts_with("DATABASE_") && read_database(block, keyword.substr(9))) return;
    keep_unread(keyword, tail);
  }

  void keep_unread(const std::string& keyword, const std::string& tail) {
    const KeywordEffect effect = effect_of(keyword);
    UnreadKeyword unread{.keyword = tail.empty() ? keyword : keyword + ' ' + tail,
                         .effect = effect.effect,
                         .reason = std::string(effect.reason),
                         .cards = {},
                         .card_count = 0,
                         .source = io_.keyword_source()};
    if (keyword.starts_with("MAT_")) {
      KeywordBlock block{deck_, io_, problems_, {}, {}};
      std::string name = keyword;
      if (name.ends_with("_TITLE") && name != "MAT_TITLE") {
        block.options.emplace_back("TITLE");
        name.erase(name.size() - 6);
      }
      read_unsupported_material(block, name);
      unread.reason += fmt::format(" (material {})", deck_.materials.back().id.value);
    }
    if (keyword.starts_with("INCLUDE_")) note_missing(std::string(trimmed(io_.next_line())));
    while (io_.has_card()) {
      std::string card;
      io_.raw_line(card);
      ++unread.card_count;
      if (unread.cards.size() < kKeptCards) unread.cards.push_back(std::move(card));
    }
    deck_.unread.push_back(std::move(unread));
  }

  /// Cards a keyword was not expected to have.
  void warn_of_rest(const std::string& keyword) {
    if (!io_.has_content()) {
      io_.skip_rest();
      return;
    }
    const Source source = lines_.depth() > 0 ? lines_.place() : io_.keyword_source();
    problems_.warnings.add(deck_.place(source), "*" + keyword,
                           fmt::format("{} cards", io_.card_number()), "more",
                           "the rest of them was not read");
    io_.skip_rest();
  }

  /// A file name as the deck writes it: " +" at the end continues it on the next line.
  std::string read_file_name() {
    std::string name, line;
    do {
      io_.line("FILENAME", line);
      const bool is_continued = line.ends_with(" +") && name.size() < LineSource::kMaxLine;
      name += is_continued ? line.substr(0, line.size() - 2) : line;
      if (!is_continued) break;
    } while (io_.has_content());
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
  }

  void read_includes() {
    std::vector<std::pair<std::string, Source>> names;
    while (io_.has_content()) {
      std::string name = read_file_name();
      names.emplace_back(std::move(name), io_.source());
    }
    if (options_.includes == ReadOptions::Includes::Ignore) return;
    for (const auto& [name, source] : names) include(name, source);
  }

  void include(const std::string& name, Source source) {
    for (const fs::path& candidate : candidates(name)) {
      switch (lines_.push_file(candidate, source)) {
        case LineSource::Pushed::Opened:
          return read_included_file(source);
        case LineSource::Pushed::Refused:
          return;
        case LineSource::Pushed::Missing:
          break;
      }
    }
    deck_.missing_includes.push_back({.name = name, .source = source});
  }

  void read_included_file(Source) {
    const CardFormat outer_format = format_;
    read_innermost();
    format_ = outer_format;
  }

  /// The file is read into a deck of its own, which waits until all of this file's
  /// *DEFINE_TRANSFORMATIONs are known.
  void read_transformed_include() {
    if (!io_.has_content()) return error("*INCLUDE_TRANSFORM", "a file name", "no card");
    const std::string name = read_file_name();
    const Source source = io_.source();
    IncludeTransform card;
    card.source = source;
    read_include_transform(io_, card);
    warn_of_rest("INCLUDE_TRANSFORM");
    if (options_.includes == ReadOptions::Includes::Ignore) return;
    Deck outer = std::exchange(deck_, Deck{});
    std::swap(outer.files, deck_.files);
    std::vector<TransformedInclude> outer_waiting = std::exchange(waiting_, {});
    const std::size_t directives = lines_.directives().size();
    include(name, source);
    add_waiting();
    // Units said in a file that is converted are not those of the deck.
    if (card.changes_units()) lines_.directives().resize(directives);
    std::swap(outer.files, deck_.files);
    std::swap(outer, deck_);
    waiting_ = std::move(outer_waiting);
    waiting_.push_back({std::move(card), std::move(outer)});
  }

  void add_waiting() {
    for (TransformedInclude& include : waiting_)
      add_transformed(deck_, std::move(include), problems_);
    waiting_.clear();
  }

  void note_missing(const std::string& name) {
    if (options_.includes == ReadOptions::Includes::Ignore || name.empty()) return;
    std::error_code error;
    for (const fs::path& candidate : candidates(name))
      if (fs::is_regular_file(candidate, error)) return;
    deck_.missing_includes.push_back({.name = name, .source = lines_.place()});
  }

  std::vector<fs::path> candidates(const std::string& name) const {
    if (fs::path(name).is_absolute()) return {name};
    std::vector<fs::path> out{lines_.folder() / name, root_folder_ / name};
    for (const fs::path& folder : include_paths_) out.push_back(folder / name);
    for (const fs::path& folder : options_.include_paths) out.push_back(folder / name);
    return out;
  }

  void read_include_paths() {
    while (io_.has_content()) {
      const fs::path folder = read_file_name();
      include_paths_.push_back(folder.is_absolute() ? folder : lines_.folder() / folder);
    }
  }

  Deck& deck_;
  DeckProblems& problems_;
  const ReadOptions& options_;
  Parameters parameters_;
  LineSource lines_;
  CardReader io_;
  CardFormat format_ = CardFormat::Standard;
  fs::path root_folder_;
  std::vector<fs::path> include_paths_;
  std::vector<TransformedInclude> waiting_;
  long keyword_count_ = 0;
};

}  // namespace

ReadDeck read_deck(const fs::path& path, const ReadOptions& options) {
  ReadDeck out;
  DeckReader(out, options).read_file(path);
  return out;
}

ReadDeck read_deck_text(std::string text, const std::string& name, const ReadOptions& options) {
  ReadDeck out;
  DeckReader(out, options).read_text(std::move(text), name);
  return out;
}

}  // namespace crosswalk::fe
